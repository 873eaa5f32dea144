"""The stiffness map of a ball-roller test: how stiff the machine is in every direction, at every engagement (chapter 6).

The map is identified as everything else is: a compliance and a deviation of the path in each direction are the parameters
(`sources.volumetric`), so that what does not depend on the load falls out by itself once there are two levels, and the
intervals hold the scatter of the runs and all that is uncertain in drives and set-up.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.drive import (
    ForceAgreement,
    ForceRecord,
    MotorParameter,
    RigCheck,
    TorqueBalance,
    compare_forces,
    motor_parameters,
    rig_check,
    with_rig,
)
from elastogeo.errors import DegreesOfFreedomError, InputError, UnsupportedError
from elastogeo.estimate import solve, solve_by_run
from elastogeo.identification.budget import SCATTER, Budget, uncertainty_budget
from elastogeo.identification.check import Check
from elastogeo.identification.identification import confounding_of, effects_of, identify, systems_of
from elastogeo.identification.result import Identification
from elastogeo.identification.systems import merged
from elastogeo.machine import Array
from elastogeo.observe import BallRoller, MachineTest
from elastogeo.result import Result
from elastogeo.sources import NODES

PRESET = "volumetric"
MOST_DELAY = 0.5
"""By how much [s] the clock of a dynamometer may be off."""


@dataclass(frozen=True, slots=True)
class Stiffness:
    """Volumetric compliance and stiffness in k directions.

    Attributes
    ----------
    force : float or None [N]
        The level to which it holds, from the least one on; None for all levels together.
    angle : array, shape (k,) [rad]
        In the plane of the test.
    compliance, standard_uncertainty : array, shape (k,) [mm/N]
    interval : array, shape (k, 2) [mm/N]
        95 %.
    """

    force: float | None
    angle: Array
    compliance: Array
    standard_uncertainty: Array
    interval: Array

    @property
    def stiffness(self) -> Array:
        """Shape (k,) [N/mm]; infinite where the compliance is not positive."""
        return _inverse(self.compliance)

    @property
    def stiffness_interval(self) -> Array:
        """Shape (k, 2) [N/mm]; without an upper bound where the compliance may be zero."""
        return _inverse(self.interval[:, ::-1])


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class StiffnessMap(Result):
    """What a ball-roller test says.

    Attributes
    ----------
    joints : Identification
        Of what the test's own question asks for.
    volumetric : Identification
        Of compliance and path by direction.
    overall : Stiffness
        Of all levels together.
    levels : tuple of Stiffness
        From the least level to each other: how it goes with the load.
    balances : mapping of str to TorqueBalance
        Of the drives, by axis.
    dynamometer : ForceAgreement or None
        Of the force from the currents with the one that was measured, if one was.
    rig : RigCheck or None
        Whether compliance with a rig is that without it and the rig's, in each direction.
    verdict : tuple of Check
    """

    joints: Identification
    volumetric: Identification
    overall: Stiffness
    levels: tuple[Stiffness, ...]
    balances: Mapping[str, TorqueBalance]
    dynamometer: ForceAgreement | None
    rig: RigCheck | None
    verdict: tuple[Check, ...]

    @property
    def motors(self) -> dict[str, tuple[MotorParameter, ...]]:
        """The balances as the motors feel them, by axis (Table 6.4)."""
        drives = {drive.axis: drive for drive in _roller_of(self.joints.test).drives}
        return {axis: motor_parameters(balance, drives[axis]) for axis, balance in self.balances.items()}


def map_stiffness(test: MachineTest, rig_test: MachineTest | None = None) -> StiffnessMap:
    """The stiffness map of a ball-roller test, and the joint parameters that its question asks for.

    Parameters
    ----------
    test : MachineTest
        With a ball-roller set-up.
    rig_test : MachineTest, optional
        The same with a rig of known compliance in the loop, which its set-up names.

    Raises
    ------
    InputError
        If a test has another instrument, or a rig where none may be, or none where one must.
    UnsupportedError
        If the levels do not tell compliance and path apart, or the runs do not tell the drives' friction from the load.
    """
    setup = _roller_of(test)
    if rig_test is not None and (setup.rig or not _roller_of(rig_test).rig):
        raise InputError("the check with a rig needs a test without one, and one whose set-up names it: [[setup.rig]]")
    volumetric = identify(_asking_for_map(test))
    agreement, gauge = _against_dynamometer(test, setup)
    checked = None if rig_test is None else _with_rig(volumetric, rig_test)
    return StiffnessMap(
        joints=identify(test),
        volumetric=volumetric,
        overall=_stiffness(volumetric.budget, None, volumetric),
        levels=_by_level(test, volumetric),
        balances=setup.torque_balances(test.machine, test.runs),
        dynamometer=agreement,
        rig=checked,
        verdict=tuple(check for check in (*volumetric.verdict, gauge, _rig_verdict(checked)) if check is not None),
    )


def _roller_of(test: MachineTest) -> BallRoller:
    if not isinstance(test.setup, BallRoller):
        raise InputError(f"test {test.name!r} has no ball-roller set-up; identify it with: elastogeo identify")
    return test.setup


def _asking_for_map(test: MachineTest) -> MachineTest:
    """The test with its question put to the map; the two do not mix."""
    return replace(test, question=replace(test.question, parameters=(PRESET,), prefer=(), reciprocal=False))


def _stiffness(budget: Budget, force: float | None, volumetric: Identification) -> Stiffness:
    """Compliance by direction, of a solution of the map."""
    names = [f"V_{degrees:03d}" for degrees in NODES]
    missing = [name for name in names if name not in budget.labels]
    mixed = [p.name for p in volumetric.parameters if p.name in names and not p.separated]
    if missing or mixed:
        raise UnsupportedError(
            f"compliance and path are not told apart in {len({*missing, *mixed})} of {len(names)} directions: "
            f"it takes two engagements all around the ball"
        )
    at = [budget.labels.index(name) for name in names]
    return Stiffness(
        force=force,
        angle=np.deg2rad(NODES),
        compliance=budget.interval[at].mean(axis=1),
        standard_uncertainty=budget.standard_uncertainty[at],
        interval=budget.interval[at],
    )


def _by_level(test: MachineTest, volumetric: Identification) -> tuple[Stiffness, ...]:
    """The map from the least level and one other at a time; none where these are too few runs for an uncertainty."""
    asked = _asking_for_map(test)
    whole = systems_of(asked)
    least, *others = whole.levels
    found = []
    for force in others:
        systems = replace(whole, runs=whole.at(least, force))
        retained = confounding_of(asked, systems).retained
        try:
            solution = solve_by_run([run.factor for run in systems.runs], retained)
        except DegreesOfFreedomError:
            solution = solve(merged(systems.runs), retained)
        budget = uncertainty_budget(systems, solution, effects_of(asked, systems))
        found.append(_stiffness(budget, force, volumetric))
    return tuple(found)


def _against_dynamometer(test: MachineTest, setup: BallRoller) -> tuple[ForceAgreement | None, Check | None]:
    """The force from the currents against the columns `force_x` and so on, axis by axis; nothing without them.

    Each goes once to and fro in a turn, so that the records align; where they do not, they are held against each other on
    the clock of the run.
    """
    gauges = {"force_x": 0, "force_y": 1, "force_z": 2}
    if not any(gauges.keys() & run.columns.keys() for run in test.runs):
        return None, None
    pairs = []
    runs = {run.name: run for run in test.runs}
    for name, (track, contact) in setup.contacts(test.machine, test.runs).items():
        columns = runs[name].columns
        for gauge, k in gauges.items():
            if gauge in columns:
                measured = np.interp(track.time, columns["time"], columns[gauge])
                own = contact.force * track.direction[:, k]
                pairs.append((ForceRecord(track.time, own), ForceRecord(track.time, measured)))
    if not pairs:
        return None, None
    name = "force agrees with the dynamometer"
    try:
        agreement = _compared(pairs)
    except UnsupportedError as error:
        return None, Check(name, False, {"said": f"This could not be judged: {error}."})
    return agreement, Check(name, agreement.agrees, {"said": agreement.sentence})


def _compared(pairs: Sequence[tuple[ForceRecord, ForceRecord]]) -> ForceAgreement:
    try:
        return compare_forces(pairs, MOST_DELAY)
    except UnsupportedError:
        return compare_forces(pairs, 0.0)


def _with_rig(before: Identification, test: MachineTest) -> RigCheck:
    """Eq. 6.16 in every direction; what drives and set-up share between the two tests does not count twice."""
    after = identify(_asking_for_map(test))
    without, measured = (_stiffness(found.budget, None, found) for found in (before, after))
    rigs, angle = _roller_of(test).rig, without.angle
    scatter = [_scatter(found) for found in (before, after)]
    own = np.linalg.norm([scatter[0], *(rig.standard_uncertainty * rig.share(angle) for rig in rigs)], axis=0)
    return rig_check(
        measured.compliance,
        scatter[1],
        with_rig(without.compliance, np.sum([rig.along(angle) for rig in rigs], axis=0)),
        own,
        freedom=(_freedom(after), _freedom(before)),
        u_shared=np.abs(_systematic(after) - _systematic(before)),
    )


def _lines(found: Identification, name: str) -> Mapping[str, float]:
    return {line.label: line.contribution for line in found.budget.lines[found.budget.labels.index(name)]}


def _scatter(found: Identification) -> Array:
    return np.array([_lines(found, f"V_{degrees:03d}")[SCATTER] for degrees in NODES])


def _systematic(found: Identification) -> Array:
    """Standard uncertainty of what is alike in all tests with these drives and this set-up, by direction."""
    lines = (_lines(found, f"V_{degrees:03d}") for degrees in NODES)
    return np.array([np.linalg.norm([size for label, size in line.items() if label != SCATTER]) for line in lines])


def _freedom(found: Identification) -> Array:
    at = [found.solution.labels.index(f"V_{degrees:03d}") for degrees in NODES]
    return np.asarray(found.solution.degrees_of_freedom[at])


def _rig_verdict(rig: RigCheck | None) -> Check | None:
    if rig is None:
        return None
    share, worst = float(np.mean(rig.agrees)), int(np.argmax(np.abs(rig.normalised_error)))
    return Check(
        "compliance with the rig as predicted",
        share >= rig.coverage - 0.1,
        {
            "said": f"Measured and predicted compliance agree within their uncertainty in {share:.0%} of {len(NODES)} directions; "
            f"at worst, at {NODES[worst]} degrees, the normalised error is {rig.normalised_error[worst]:.2f}."
        },
    )


def _inverse(compliance: Array) -> Array:
    positive = compliance > 0
    return np.where(positive, 1.0 / np.where(positive, compliance, 1.0), np.inf)
