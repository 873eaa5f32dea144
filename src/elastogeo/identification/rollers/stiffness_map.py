"""The stiffness map of a ball-roller test: how stiff the machine is in every direction, at every engagement (chapter 6).

Three kinds of stiffness come out, each under its name (`kinds`); all hold the scatter of the runs and all that is uncertain
in drives and set-up. Beside them: what each motor took along the turn, the force against a dynamometer, a test with a rig.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from elastogeo.drive import motor_parameters
from elastogeo.errors import InputError
from elastogeo.identification.identification import identify_observed
from elastogeo.identification.question import with_stated
from elastogeo.identification.rollers.curves import Curves, curves_of
from elastogeo.identification.rollers.dynamometer import against_dynamometer
from elastogeo.identification.rollers.kinds import Fitted, fitted
from elastogeo.identification.rollers.result import StiffnessMap
from elastogeo.identification.rollers.rig_test import RigTest, compare_with_rig
from elastogeo.identification.rollers.torque_parts import torque_parts
from elastogeo.identification.rollers.verdict import map_verdict
from elastogeo.observe import BallRoller, MachineTest, Observations


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
    curves = curves_of(with_stated(test, observations))
    stiffness = fitted(curves)
    measured, untested = against_dynamometer(test.runs, pressed)
    drives = {drive.axis: drive for drive in setup.drives}
    found = StiffnessMap(
        joints=identify_observed(test, observations),
        modelled=stiffness.modelled,
        secants=stiffness.secants,
        increments=stiffness.increments,
        law=stiffness.choice,
        path=stiffness.law.path,
        balances=pressed.balances,
        motors={axis: motor_parameters(balance, drives[axis]) for axis, balance in pressed.balances.items()},
        engagements=_engagements(test, curves, observations),
        torques=torque_parts(test.runs, pressed, setup.least_speed),
        dynamometer=measured,
        rig=None if rig_test is None else _with_rig(stiffness, rig_test),
        verdict=(),
    )
    return replace(found, verdict=map_verdict(found, setup.drives, untested))


def _roller_of(test: MachineTest) -> BallRoller:
    if test.setup.extra != "stiffness-map":
        raise InputError(f"test {test.name!r} has no ball-roller set-up; identify it with: elastogeo identify")
    return cast("BallRoller", test.setup)


def _engagements(test: MachineTest, curves: Curves, observations: Sequence[Observations]) -> tuple[float, ...]:
    """Mean commanded engagement of the runs of each level [mm]."""
    commanded = {run.name: run.engagement or 0.0 for run in test.runs}
    of_run = np.array([commanded[run.run] for run in observations])
    return tuple(float(of_run[curves.level == n].mean()) for n in range(len(curves.levels)))


def _with_rig(without: Fitted, test: MachineTest) -> RigTest:
    observations = test.observations()
    curves = curves_of(with_stated(test, observations))
    found = fitted(curves)
    return compare_with_rig(
        without.modelled[-1],
        found.modelled[-1],
        _roller_of(test).rig,
        _engagements(test, curves, observations),
        found.secants,
        found.increments,
    )
