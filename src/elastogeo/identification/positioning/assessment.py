"""What a positioning test says: the values of ISO 230-2 with their uncertainty, and the error motion of the axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.identification import identify
from elastogeo.identification.positioning.result import PositioningResults
from elastogeo.identification.positioning.standard import by_target
from elastogeo.identification.positioning.uncertainty import straightened, with_uncertainty
from elastogeo.identification.positioning.verdict import followed, standard_checks
from elastogeo.identification.question import stated_shifts
from elastogeo.identification.result import Identification
from elastogeo.machine import COMPONENTS, Array
from elastogeo.observe import MachineTest, Observations, Positioning, distinct
from elastogeo.sources import Situation


def evaluate_positioning(test: MachineTest) -> PositioningResults:
    """What a positioning test says (ISO 230-2).

    Along the axis, deviations count along its own command: positive where the axis goes too far in its positive direction.
    Across it a straight line through all readings is subtracted first, so that E is its straightness.

    Parameters
    ----------
    test : MachineTest
        With the set-up `positioning`.

    Raises
    ------
    InputError
        If the test has another instrument, or a run cannot be evaluated.
    """
    if test.setup.extra != "positioning":
        raise InputError(
            f"the test {test.name!r} is made with {test.instrument}; values of ISO 230-2 take the instrument positioning"
        )
    setup = cast("Positioning", test.setup)
    observed = test.observations()
    along = all(run.nominal is not None for run in observed)
    straight = not (along or setup.is_angular or setup.is_rotary)
    command = np.concatenate([run.pose for run in observed])
    target, sense = distinct(command), np.concatenate([_sense(test, run) for run in observed])
    reading = np.concatenate([_along_command(run) * run.reading for run in observed])
    cycle = np.repeat(np.arange(1, len(observed) + 1), [len(run) for run in observed])
    joints, refusal = _joints(test)
    values = with_uncertainty(target, sense, reading, stated_shifts(test, observed), straight)
    shown = straightened(target, reading) if straight else reading
    found = by_target(target, sense, shown)
    place = np.searchsorted(found.target, target)
    checks = standard_checks(found, sense, shown, cycle, place, setup.is_rotary, setup.is_angular)
    if joints is not None:
        checks.append(followed(joints, sense, place, setup.is_angular))
    return PositioningResults(
        test=test,
        joints=joints,
        refusal=refusal,
        target=target,
        sense=sense,
        reading=shown,
        cycle=cycle,
        targets=found,
        values=values,
        axis=setup.axis,
        along=along,
        angular=setup.is_angular,
        rotary=setup.is_rotary,
        levers={} if setup.is_angular else _levers(test, observed),
        verdict=(*checks, *(joints.verdict if joints else ())),
    )


def _joints(test: MachineTest) -> tuple[Identification | None, str]:
    try:
        return identify(test), ""
    except UnsupportedError as error:
        return None, str(error)


def _sense(test: MachineTest, run: Observations) -> Array:
    axis = cast("Positioning", test.setup).axis
    return np.zeros(len(run)) if run.sense is None else run.sense[:, test.machine.index(axis)]


def _along_command(run: Observations) -> float:
    """-1 where the sensor counts against the command of the axis, else +1."""
    if run.nominal is None or len(run) < 2:
        return 1.0
    return -1.0 if float((run.nominal - run.nominal.mean()) @ (run.pose - run.pose.mean())) < 0 else 1.0


def _levers(test: MachineTest, observed: Sequence[Observations]) -> Mapping[str, float]:
    """How far from the axis's frame the sensor reads: what the readings change per angular error motion [mm/rad]."""
    axis = cast("Positioning", test.setup).axis
    site = ("motion", axis)
    lever = np.vstack([Situation(test.machine, run).sensitivity(site)[:, 3:] for run in observed])
    greatest = lever[np.abs(lever).argmax(axis=0), np.arange(3)]
    return {f"E_{COMPONENTS[3 + k]}{axis}": float(size) for k, size in enumerate(greatest)}
