"""The stiffness map of a ball-roller test: how stiff the machine is in every direction, at every engagement (chapter 6).

Three kinds of stiffness come out, each under its name. The secant of Eq. 6.5 takes all that the encoders show for elastic:
what the path is off, and what gives way before the least engagement, makes it rise with the engagement even where the
machine does not stiffen. The increment between two engagements is free of both. The modelled one is the slope of the law
that the engagements support (`laws`). All hold the scatter of the runs and all that is uncertain in drives and set-up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from elastogeo.drive import (
    ForceAgreement,
    ForceRecord,
    RigCheck,
    compare_forces,
    motor_parameters,
    rig_check,
    with_rig,
)
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.identification import identify_observed
from elastogeo.identification.question import effects_of, systems_of
from elastogeo.identification.rollers.curves import Curves, curves_of
from elastogeo.identification.rollers.laws import Law, LawChoice, choose_law, fit_law, points, within_levels
from elastogeo.identification.rollers.result import INCREMENT, MODELLED, SECANT, Stiffness, StiffnessMap
from elastogeo.identification.rollers.verdict import map_verdict
from elastogeo.machine import Array
from elastogeo.observe import BallRoller, MachineTest, Observations, ObservedInfluence, Pressed

MOST_DELAY = 0.5
"""By how much [s] the clock of a dynamometer may be off."""


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
    pressed = setup.pressed(test.machine, test.runs)
    observations = setup.observed(test.machine, test.runs, pressed)
    fitted = _fitted(test, observations)
    measured, untested = _against_dynamometer(test, pressed)
    drives = {drive.axis: drive for drive in setup.drives}
    found = StiffnessMap(
        joints=identify_observed(test, observations),
        modelled=fitted.modelled,
        secants=fitted.secants,
        increments=fitted.increments,
        law=fitted.choice,
        path=fitted.law.path,
        balances=pressed.balances,
        motors={axis: motor_parameters(balance, drives[axis]) for axis, balance in pressed.balances.items()},
        dynamometer=measured,
        rig=None if rig_test is None else _with_rig(fitted.modelled[-1], rig_test),
        verdict=(),
    )
    return replace(found, verdict=map_verdict(found, setup.drives, untested))


@dataclass(frozen=True, slots=True, eq=False)
class _Fitted:
    """What the curves of a test say."""

    law: Law
    choice: LawChoice
    modelled: tuple[Stiffness, ...]
    secants: tuple[Stiffness, ...]
    increments: tuple[Stiffness, ...]


def _fitted(test: MachineTest, observations: Sequence[Observations]) -> _Fitted:
    curves = curves_of(_with_stated(test, observations))
    law, choice = choose_law(curves)
    mean = curves.mean(curves.force)
    at = mean[-1:] if law.name == "constant" else mean
    runs = np.bincount(curves.level)[:, np.newaxis]
    variance, freedom = within_levels(curves, law.compliance(curves.force))
    if freedom < 1:
        variance, freedom = law.variance, law.degrees_of_freedom
    step = np.diff(mean, axis=0)

    def slope(change: int | None) -> Array:
        return fit_law(curves, law.name, law.powers, change).compliance(at)

    def secant(change: int | None) -> Array:
        force, reading = (curves.mean(values) for values in points(curves, change))
        return np.asarray(reading / force)

    def increment(change: int | None) -> Array:
        force, reading = (curves.mean(values) for values in points(curves, change))
        return np.asarray(np.diff(reading, axis=0) / np.diff(force, axis=0))

    levels = [(level,) for level in curves.levels]
    pairs = list(zip(curves.levels, curves.levels[1:], strict=False))
    return _Fitted(
        law=law,
        choice=choice,
        modelled=_kinds(
            MODELLED,
            [()] if law.name == "constant" else levels,
            curves,
            slope,
            (_slope_scatter(curves, law, at), law.degrees_of_freedom),
        ),
        secants=_kinds(SECANT, levels, curves, secant, (np.sqrt(variance / runs) / mean, freedom)),
        increments=_kinds(
            INCREMENT,
            pairs,
            curves,
            increment,
            (np.sqrt(variance * (1 / runs[1:] + 1 / runs[:-1])) / step, freedom),
        ),
    )


def _kinds(
    kind: str,
    forces: Sequence[tuple[float, ...]],
    curves: Curves,
    compliance: Callable[[int | None], Array],
    scatter: tuple[Array, int],
) -> tuple[Stiffness, ...]:
    """A stiffness of one kind at each of some levels, with what every change of the curves does to it."""
    values = compliance(None)
    moved = np.array([compliance(n) - values for n in range(len(curves.changes))]).reshape(-1, *values.shape)
    size, freedom = scatter
    known = size if freedom > 0 else np.full(values.shape, np.inf)
    return tuple(
        Stiffness(
            kind=kind,
            force=force,
            angle=curves.angle,
            compliance=values[n],
            scatter=known[n],
            scatter_freedom=freedom,
            systematic=moved[:, n],
            labels=tuple(change.label for change in curves.changes),
            freedoms=tuple(change.degrees_of_freedom for change in curves.changes),
        )
        for n, force in enumerate(forces)
    )


def _slope_scatter(curves: Curves, law: Law, at: Array) -> Array:
    """Standard uncertainty of the slope of a law at forces, shape of the forces, from the scatter about the law."""
    design = np.stack([*(curves.force.T**power for power in law.powers), np.ones(curves.force.T.shape)], axis=-1)
    norms = np.linalg.norm(design, axis=1, keepdims=True)
    root = np.linalg.pinv(design / norms) / norms.swapaxes(1, 2)
    slopes = [power * at.T ** (power - 1) for power in law.powers]
    gradient = np.stack([*slopes, np.zeros(at.T.shape)], axis=-1)
    return np.asarray((np.linalg.norm(gradient @ root, axis=2) * np.sqrt(law.variance)[:, np.newaxis]).T)


def _with_stated(test: MachineTest, observations: Sequence[Observations]) -> Sequence[Observations]:
    """The observations with the systematic influences that the test states beside those of drives and set-up."""
    if not test.influences:
        return observations
    own = len(observations[0].influences)
    known = effects_of(test, systems_of(test, observations))[own:]
    return [
        replace(
            run,
            influences=(
                *run.influences,
                *(
                    ObservedInfluence(
                        effect.influence.label,
                        effect.influence.standard_uncertainty,
                        effect.influence.degrees_of_freedom,
                        effect.stretch[k] * run.wrench,
                        np.zeros(len(run)) if effect.shift is None else -effect.shift[k],
                    )
                    for effect in known
                ),
            ),
        )
        for k, run in enumerate(observations)
    ]


def _roller_of(test: MachineTest) -> BallRoller:
    if test.setup.extra != "stiffness-map":
        raise InputError(f"test {test.name!r} has no ball-roller set-up; identify it with: elastogeo identify")
    return cast("BallRoller", test.setup)


def _against_dynamometer(test: MachineTest, pressed: Pressed) -> tuple[ForceAgreement | None, str]:
    """The force from the currents against the columns `force_x` and so on, axis by axis; else why it was not compared.

    Each goes once to and fro in a turn, so that the records align; where they do not, they are held against each other on
    the clock of the run.
    """
    gauges = {"force_x": 0, "force_y": 1, "force_z": 2}
    runs = {run.name: run for run in test.runs}
    pairs = []
    for name, contact in pressed.forces.items():
        columns, track = runs[name].columns, pressed.tracks[name]
        for gauge, k in gauges.items():
            if gauge in columns:
                measured = np.interp(track.time, columns["time"], columns[gauge])
                own = contact.force * track.direction[:, k]
                pairs.append((ForceRecord(track.time, own), ForceRecord(track.time, measured)))
    if not pairs:
        return None, ""
    try:
        return _compared(pairs), ""
    except UnsupportedError as error:
        return None, str(error)


def _compared(pairs: Sequence[tuple[ForceRecord, ForceRecord]]) -> ForceAgreement:
    try:
        return compare_forces(pairs, MOST_DELAY)
    except UnsupportedError:
        return compare_forces(pairs, 0.0)


def _with_rig(before: Stiffness, test: MachineTest) -> RigCheck:
    """Eq. 6.16 in every direction; what drives and set-up share between the two tests does not count twice."""
    after = _fitted(test, test.observations()).modelled[-1]
    rigs = _roller_of(test).rig
    own = np.linalg.norm([before.scatter, *(rig.standard_uncertainty * rig.share(before.angle) for rig in rigs)], axis=0)
    systematic = [np.linalg.norm(found.systematic, axis=0) for found in (before, after)]
    return rig_check(
        after.compliance,
        after.scatter,
        with_rig(before.compliance, np.sum([rig.along(before.angle) for rig in rigs], axis=0)),
        own,
        freedom=(after.scatter_freedom, before.scatter_freedom),
        u_shared=np.abs(systematic[1] - systematic[0]),
    )
