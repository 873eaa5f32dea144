"""The stiffness map of a ball-roller test: by direction, by level, with a rig, against a dynamometer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import FeedDrive, KnownBalance, SetupCompliance
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification import StiffnessMap, map_stiffness
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.observe import BallRoller, Circle, Imperfection, LoadedBallBar, MachineTest, Question, Rig, Run
from elastogeo.report import sentence_of
from elastogeo.sources import simulate

TRUTH = {"C_XXX": 6.9e-5, "C_YYY": 5.8e-5, "C_XYX": 4e-6, "E_XX1": -5e-5, "E_Xt0": 2e-3}
BALANCES = (
    KnownBalance("X", inertia=6.0, viscous=90.0, coulomb=1550.0, constant=0.0),
    KnownBalance("Y", inertia=4.0, viscous=70.0, coulomb=1600.0, constant=0.0),
)
NOISY = Imperfection(noise=1e-4, current_noise=0.03, eccentricity=2e-4, force_scatter=2e-3)
RIG = Rig(1 / 2650, standard_uncertainty=1e-5, angle=0.0)


def runs(engagements: tuple[float, ...]) -> tuple[Run, ...]:
    angle = np.linspace(0, 2.06 * np.pi, 360)
    return tuple(
        Run(f"{1000 * e:g}um-{s}-{r}", {"angle": angle}, engagement=e, sense=s, repeat=r)
        for e in engagements
        for r in (1, 2)
        for s in (1, -1)
    )


def simulated(engagements: tuple[float, ...] = (0.0, 0.06, 0.13, 0.2), seed: int = 1, **setup: object) -> MachineTest:
    parsed = parse_topology("wCAYfXZt")
    machine = Machine(name="m", topology=parsed, joints=tuple(map(Joint, parsed.axes)), tool=(0.0, 0.0, -150.0))
    drives = tuple(
        FeedDrive(axis, torque_constant=k, pitch=10.0, efficiency=0.9, relative_uncertainty=0.01)
        for axis, k in (("X", 1650.0), ("Y", 1520.0))
    )
    roller = BallRoller(Circle(56.4), 1000 / 60, drives, SetupCompliance(constant=1 / 15e3), harmonics=20, **setup)
    test = MachineTest("map", machine, replace(roller, balances=BALANCES), runs(engagements), Question(tuple(TRUTH)))
    return replace(simulate(test, TRUTH, NOISY, seed), setup=roller)


def true_compliance(angle: np.ndarray) -> np.ndarray:
    """`u^T C u` of the two joints, by hand: `C_XXX c^2 + C_YYY s^2 + C_XYX c s`."""
    c, s = np.cos(angle), np.sin(angle)
    return TRUTH["C_XXX"] * c**2 + TRUTH["C_YYY"] * s**2 + TRUTH["C_XYX"] * c * s


@pytest.fixture(scope="module")
def found() -> StiffnessMap:
    return map_stiffness(simulated(), simulated(seed=2, rig=(RIG,)))


def test_the_map_holds_the_true_compliance_in_every_direction(found: StiffnessMap) -> None:
    overall, true = found.overall, true_compliance(found.overall.angle)
    assert len(overall.angle) == 24
    inside = (overall.interval[:, 0] <= true) & (true <= overall.interval[:, 1])
    assert inside.mean() >= 0.9
    assert_allclose(overall.compliance, true, rtol=0.035)
    assert_allclose(overall.stiffness, 1 / overall.compliance)
    assert (overall.stiffness_interval[:, 0] < overall.stiffness).all()
    assert (overall.stiffness < overall.stiffness_interval[:, 1]).all()


def test_secants_increments_and_model_hold_it_too(found: StiffnessMap) -> None:
    """The truth is one spring, so its increments are that; a secant is the spring with its path, known here by hand."""
    true, angle = true_compliance(found.overall.angle), found.overall.angle
    path = TRUTH["E_Xt0"] * np.cos(angle) + TRUTH["E_XX1"] * 56.4 * np.cos(angle) ** 2
    assert [[round(force, -1) for force in level.force] for level in found.secants] == [[470], [1010], [1550]]
    for step in found.increments:
        assert ((step.interval[:, 0] <= true) & (true <= step.interval[:, 1])).mean() >= 0.9
    for level in found.secants:
        seen = true + path / level.force[0]
        assert ((level.interval[:, 0] <= seen) & (seen <= level.interval[:, 1])).mean() >= 0.9
    assert [level.kind for level in found.modelled] == ["modelled"]
    assert_allclose(found.path, path, atol=2e-3)


def test_the_interval_holds_what_drives_and_setup_bring(found: StiffnessMap) -> None:
    labels = set(found.overall.labels)
    assert {"force per current of X", "friction and inertia of Y", "losses when driven back"} <= labels
    # 1 % of the force per current is 1 % of the whole compliance, the set-up's included, in the direction of one drive
    contribution = found.overall.contribution("force per current of X")[0]
    assert_allclose(contribution, 0.01 * (TRUTH["C_XXX"] + 1 / 15e3), rtol=0.03)


def test_the_joints_of_the_question_come_with_it(found: StiffnessMap) -> None:
    for parameter in found.joints.parameters:
        assert parameter.interval[0] <= TRUTH[parameter.name] <= parameter.interval[1]


def test_the_rig_is_seen_where_it_gives_way(found: StiffnessMap) -> None:
    """Eq. 6.16: with the rig the compliance is that without it and the rig's own."""
    assert found.rig is not None
    assert found.rig.check.agrees.mean() >= 0.85
    rig, angle = found.rig, found.rig.without.angle
    assert_allclose(rig.predicted, true_compliance(angle) + RIG.along(angle), rtol=0.03)
    assert (rig.softest, rig.engagements) == (0, pytest.approx((0.06, 0.13, 0.2)))
    softened = [secant.force[0] < without.force[0] for secant, without in zip(rig.secants, found.secants, strict=True)]
    assert softened == [True, True, True]
    check = next(check for check in found.verdict if check.name == "compliance with the rig as predicted")
    assert check.passed


def test_a_rig_of_another_compliance_does_not_agree() -> None:
    wrong = simulated(seed=2, rig=(RIG,))
    stated = replace(wrong, setup=replace(wrong.setup, rig=(replace(RIG, compliance=1.3 * RIG.compliance),)))
    found = map_stiffness(simulated(), stated)
    assert found.rig is not None
    assert not found.rig.check.agrees[0]
    check = next(check for check in found.verdict if check.name == "compliance with the rig as predicted")
    assert not check.passed


@pytest.mark.parametrize(("gain", "agrees"), [(1.0, True), (1.1, False)])
def test_a_dynamometer_is_compared_with_the_currents(gain: float, agrees: bool) -> None:
    """Against the force that Eq. 6.4 gives from the true compliance and path, by hand, with the noise of a dynamometer."""
    test, random = simulated(), np.random.default_rng(5)
    measured = []
    for run in test.runs:
        x, y = run.columns["position_x"], run.columns["position_y"]
        angle, engagement = np.arctan2(y, x), run.engagement or 0.0
        path = TRUTH["E_Xt0"] * np.cos(angle) + TRUTH["E_XX1"] * 56.4 * np.cos(angle) ** 2
        force = (engagement - path) / (true_compliance(angle) + 1 / 15e3) * (engagement > 0) / gain
        noise = 3.0 * random.standard_normal((2, len(angle)))
        gauge = {"force_x": force * np.cos(angle) + noise[0], "force_y": force * np.sin(angle) + noise[1]}
        measured.append(replace(run, columns={**run.columns, **gauge}))
    found = map_stiffness(replace(test, runs=tuple(measured)))
    assert found.dynamometer is not None
    assert_allclose(found.dynamometer.agreement.gain, gain, rtol=0.01)
    assert found.dynamometer.agreement.gain_is_one == agrees
    assert len(found.dynamometer.forces) == 2 * 12
    for compared in found.dynamometer.forces:
        left = compared.current - gain * compared.dynamometer
        assert np.sqrt(np.mean(left**2)) < 0.03 * np.abs(compared.current).max()
    check = next(check for check in found.verdict if check.name == "force agrees with the dynamometer")
    assert check.passed == found.dynamometer.agreement.agrees


def test_a_dynamometer_that_measures_something_else_is_said() -> None:
    test, random = simulated(), np.random.default_rng(5)
    noise = tuple(replace(run, columns={**run.columns, "force_x": random.standard_normal(360)}) for run in test.runs)
    found = map_stiffness(replace(test, runs=noise))
    assert found.dynamometer is None
    check = next(check for check in found.verdict if check.name == "force agrees with the dynamometer")
    assert check.passed is None
    assert sentence_of(check).startswith("Not tested: the force records correlate by")


def test_one_level_does_not_tell_compliance_from_path() -> None:
    with pytest.raises(
        UnsupportedError, match=r"compliance and path are not distinguished in any of 24 directions; it takes"
    ):
        map_stiffness(simulated((0.0, 0.2)))


def test_another_instrument_has_no_map() -> None:
    test = simulated()
    with pytest.raises(InputError, match="has no ball-roller set-up"):
        map_stiffness(replace(test, setup=LoadedBallBar(Circle(150.0), 30.0)))


def test_a_rig_test_must_name_its_rig() -> None:
    with pytest.raises(InputError, match="needs a test without one, and one whose set-up names it"):
        map_stiffness(simulated(), simulated())


def test_a_rig_gives_way_along_its_direction() -> None:
    assert_allclose(Rig(2.0, angle=0.0).along(np.array([0.0, np.pi / 2, np.pi / 4])), [2.0, 0.0, 1.0], atol=1e-15)
    assert_allclose(Rig(2.0).along(np.array([0.0, 1.0])), 2.0)
    with pytest.raises(InputError, match="it must be positive"):
        Rig(-1.0)
