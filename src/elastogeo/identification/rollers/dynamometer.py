"""The force from the currents against that of a dynamometer, run by run (section 6.6.1, Figure 6.7)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.drive import ForceAgreement, ForceRecord, SharedError, compare_forces
from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array
from elastogeo.observe import Pressed, Run

MOST_DELAY = 0.5
"""By how much [s] the clock of a dynamometer may be off."""

_GAUGES = {"force_x": 0, "force_y": 1, "force_z": 2}


@dataclass(frozen=True, slots=True, eq=False)
class ComparedForce:
    """One run: the force on the roller in one direction, from the currents and from the dynamometer.

    Attributes
    ----------
    run, column : str
        The column is `force_x`, ...: in the direction x of the foundation.
    engagement : float [mm]
        Commanded.
    angle : array, shape (m,) [rad]
        Of the line of centres.
    current, dynamometer : array, shape (m,) [N]
        The dynamometer's on the clock of the currents, its delay undone.
    """

    run: str
    column: str
    engagement: float
    angle: Array
    current: Array
    dynamometer: Array

    @property
    def rms_difference(self) -> float:
        """Root mean square of current less dynamometer [N]."""
        return float(np.sqrt(np.mean((self.current - self.dynamometer) ** 2)))


@dataclass(frozen=True, slots=True, eq=False)
class AgainstDynamometer:
    """What a dynamometer says of the force from the currents.

    Attributes
    ----------
    agreement : ForceAgreement
        Gain and offset over all runs.
    forces : tuple of ComparedForce
        Run by run.
    """

    agreement: ForceAgreement
    forces: tuple[ComparedForce, ...]


def against_dynamometer(runs: Sequence[Run], pressed: Pressed) -> tuple[AgainstDynamometer | None, str]:
    """The force from the currents against the columns `force_x` and so on, axis by axis; else why it was not compared.

    Each goes once to and fro in a turn, so that the records align; where they do not, they are held against each other on
    the clock of the run.
    """
    named = {run.name: run for run in runs}
    columns = [(name, gauge) for name in pressed.forces for gauge in _GAUGES if gauge in named[name].columns]
    if not columns:
        return None, ""
    pairs = [_pair(named[name], gauge, pressed) for name, gauge in columns]
    try:
        agreement = _compared(pairs, _shared(columns, pressed), [name for name, _ in columns])
    except UnsupportedError as error:
        return None, str(error)
    forces = []
    for (name, gauge), (own, _), delay in zip(columns, pairs, agreement.delays, strict=True):
        run, track = named[name], pressed.tracks[name]
        measured = np.interp(track.time - delay.seconds, run.columns["time"], run.columns[gauge])
        forces.append(ComparedForce(name, gauge, run.engagement or 0.0, track.angle, own.force, measured))
    return AgainstDynamometer(agreement, tuple(forces)), ""


def _pair(run: Run, gauge: str, pressed: Pressed) -> tuple[ForceRecord, ForceRecord]:
    columns: Mapping[str, Array] = run.columns
    track = pressed.tracks[run.name]
    own = pressed.forces[run.name].force * track.direction[:, _GAUGES[gauge]]
    measured = np.interp(track.time, columns["time"], columns[gauge])
    return ForceRecord(track.time, own), ForceRecord(track.time, measured)


def _shared(columns: Sequence[tuple[str, str]], pressed: Pressed) -> list[SharedError]:
    """What drives and their friction, identified once, may put wrong in the forces of all runs."""
    several = zip(*(pressed.forces[name].influences for name, _ in columns), strict=True)
    directions = [pressed.tracks[name].direction[:, _GAUGES[gauge]] for name, gauge in columns]
    return [
        SharedError(label, size, freedom, tuple(one[-1] * along for one, along in zip(of_runs, directions, strict=True)))
        for of_runs in several
        for label, size, freedom, _ in of_runs[:1]
    ]


def _compared(
    pairs: Sequence[tuple[ForceRecord, ForceRecord]], shared: Sequence[SharedError], names: Sequence[str]
) -> ForceAgreement:
    try:
        return compare_forces(pairs, MOST_DELAY, shared=shared, names=names)
    except UnsupportedError:
        return compare_forces(pairs, 0.0, shared=shared, names=names)
