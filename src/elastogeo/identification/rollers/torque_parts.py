"""What the motors of a ball-roller test take along the turn, part by part (Eq. 6.6, Figure 6.5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.drive import motion_columns
from elastogeo.machine import Array
from elastogeo.observe import Pressed, Run

LOAD = "load"
"""Name of the part that the ball takes: the disturbance torque of Eq. 6.6."""


@dataclass(frozen=True, slots=True, eq=False)
class TorqueParts:
    """The effort of one motor along one run, and the parts that the torque balance makes of it.

    Attributes
    ----------
    axis, run : str
    engagement : float [mm]
        Commanded.
    unit : str
        Of the effort: `N mm` of a rotary motor, `N` of a linear one.
    angle : array, shape (m,) [rad]
        Of the line of centres, going on beyond a turn.
    recorded : array, shape (m,)
        Effort from the current.
    parts : mapping of str to array, shape (m,)
        By the terms of the balance, and `load`: what holds the force of the ball, smoothed to harmonics of the turn.
    counts : array of bool, shape (m,)
        Where the axis moves fast enough for its friction to have a direction; elsewhere no part rests on the record.
    """

    axis: str
    run: str
    engagement: float
    unit: str
    angle: Array
    recorded: Array
    parts: Mapping[str, Array]
    counts: NDArray[np.bool_]

    @property
    def residual(self) -> Array:
        """What the parts leave of the recorded effort, shape (m,): friction that the balance does not know, and noise."""
        return np.asarray(self.recorded - np.sum(list(self.parts.values()), axis=0))

    def peak(self, part: str) -> float:
        """Greatest size of a part where the axis moves, in `unit`."""
        return float(np.abs(self.parts[part][self.counts]).max())


def torque_parts(runs: Sequence[Run], pressed: Pressed, least_speed: float) -> tuple[TorqueParts, ...]:
    """The parts of every drive along the first run of the greatest engagement.

    Parameters
    ----------
    runs : sequence of Run
        Of the test.
    pressed : Pressed
        What the recordings amount to.
    least_speed : float [mm/s]
        Below which the friction of a drive has no known direction.
    """
    run = max((run for run in runs if run.name in pressed.forces), key=lambda run: run.engagement or 0.0)
    track = pressed.tracks[run.name]
    found = []
    for axis, balance in pressed.balances.items():
        record = track.records[axis]
        labels, columns = motion_columns(record, balance.model)
        parts = {label: columns[:, k] * balance.values[balance.labels.index(label)] for k, label in enumerate(labels)}
        found.append(
            TorqueParts(
                axis=axis,
                run=run.name,
                engagement=run.engagement or 0.0,
                unit=record.effort_unit,
                angle=track.angle,
                recorded=record.effort,
                parts={**parts, LOAD: pressed.forces[run.name].load[axis]},
                counts=np.asarray(np.abs(record.velocity) >= least_speed),
            )
        )
    return tuple(found)
