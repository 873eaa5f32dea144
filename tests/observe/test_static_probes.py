"""Displacement probes about a loaded ball on a turning table: what a run becomes, joint and Cartesian compliances."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError, RankError
from elastogeo.identification import identify
from elastogeo.identification.static_tests.cartesian import cartesian_of
from elastogeo.machine import Machine, loop_frames
from elastogeo.observe import THESIS_CALIBRATION, Imperfection, MachineTest, Question, Run
from elastogeo.observe.static_loads.probes import DisplacementProbes
from elastogeo.sources import select_sources, simulate

MakeMachine = Callable[..., Machine]
ANGLE = np.arange(24) * 2 * np.pi / 24
SKEW = ((1.0, 0.2, 0.0), (0.0, 1.0, 0.3), (0.4, 0.0, 1.0))
PROBES = ("displacement_1", "displacement_2", "displacement_3")

JOINTS = {
    "C_XXX": 6e-5,
    "C_YYX": 1e-5,
    "C_ZZX": 2e-5,
    "C_XYX": 3e-6,
    "C_YXX": 3e-6,
    "C_YYY": 4e-5,
    "C_XZY": 5e-6,
    "C_ZXY": 5e-6,
    "C_ZZZ": 3e-5,
    "C_XXA": 8e-6,
}
"""Translational compliances of joints that stand upright whatever C does: their sum is the Cartesian compliance."""

SUM = np.array([[6e-5 + 8e-6, 3e-6, 5e-6], [3e-6, 1e-5 + 4e-5, 0.0], [5e-6, 0.0, 2e-5 + 3e-5]])


def turned_test(machine: Machine, bar: tuple[float, ...], forces: tuple[float, ...] = (250.0, 500.0)) -> MachineTest:
    setup = DisplacementProbes(SKEW, bar, {"X": 120.0, "Y": 40.0, "Z": -200.0}, {"C": 1.0})
    columns = {"angle": ANGLE, **{name: np.zeros(len(ANGLE)) for name in PROBES}}
    runs = tuple(Run(f"{force:g} N", columns, force=force) for force in forces)
    return MachineTest("probes", machine, setup, runs, Question(("C_*",)))


def test_the_ball_stays_at_its_place_on_the_table_and_the_bar_turns_with_it(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt", tool=(0.0, 0.0, -180.0), seed=8)
    test = turned_test(machine, (1.0, 0.0, 1.0), (250.0,))
    (observed,) = test.observations()
    frames = loop_frames(machine, observed.commands, observed.tool)
    ball = frames.workpiece.components(frames.point - frames.workpiece.origin)
    assert_allclose(ball, np.broadcast_to(ball[0], ball.shape), atol=1e-9)
    assert_allclose(observed.workpiece, ball[0], atol=1e-9)
    bar = frames.workpiece.components(observed.wrench[:, :3])
    assert_allclose(bar, np.broadcast_to(250 * np.array([1, 0, 1]) / np.sqrt(2), bar.shape), atol=1e-9)
    probes = frames.workpiece.components(observed.direction[:, :3])
    for k, probe in enumerate(SKEW):
        part = probes[k * 24 : (k + 1) * 24]
        assert_allclose(part, np.broadcast_to(probe / np.linalg.norm(probe), part.shape), atol=1e-12)
    assert np.ptp(observed.commands, axis=0)[machine.index("X")] > 10


def test_probes_and_bar_may_stand_in_the_foundation(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    setup = DisplacementProbes(SKEW, (0.0, 0.0, -1.0), {"X": 50.0, "A": 0.3}, {"C": 1.0}, False, False)
    (observed,) = MachineTest("", machine, setup, turned_test(machine, (1, 0, 0), (9.0,)).runs).observations()
    assert_allclose(observed.wrench, np.tile([0, 0, -9.0, 0, 0, 0], (72, 1)))
    assert_allclose(observed.direction[:24, :3], np.tile(np.array(SKEW[0]) / np.linalg.norm(SKEW[0]), (24, 1)))


def test_rows_are_probe_after_probe(make_machine: MakeMachine) -> None:
    """C_XXX alone, upright, bar along x of the table: displacement along x of the machine, seen by each turned probe."""
    machine = make_machine("wCAYfXZt")
    test = simulate(turned_test(machine, (1.0, 0.0, 0.0), (250.0,)), {"C_XXX": 6e-5}, exact=False)
    (observed,) = test.observations()
    assert_allclose(observed.pose, np.tile(ANGLE, 3))
    for k, (name, probe) in enumerate(zip(PROBES, SKEW, strict=True)):
        n = np.array(probe) / np.linalg.norm(probe)
        # the table turns by minus its command: x of the table is at the angle -C in the machine
        expected = 6e-5 * 250 * np.cos(ANGLE) * (n[0] * np.cos(ANGLE) + n[1] * np.sin(ANGLE))
        assert_allclose(test.runs[0].columns[name], expected, atol=1e-15)
        assert_allclose(observed.reading[k * 24 : (k + 1) * 24], expected, atol=1e-15)


def test_joint_compliances_come_back_in_their_combinations(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt", tool=(20.0, 10.0, -180.0), seed=8)
    random = np.random.default_rng(2)
    sizes = {"mm/N": 1e-5, "rad/N": 3e-8, "mm/(N mm)": 3e-8, "rad/(N mm)": 1e-10}
    truth = {s.name: sizes[s.unit] * float(random.standard_normal()) for s in select_sources(machine, ["C_*"])}
    result = identify(simulate(turned_test(machine, (1.0, 0.0, 1.0)), truth, exact=False))
    assert result.confounding.rank > 9  # more than a Cartesian compliance: the table's own part turns with it
    for parameter in result.parameters:
        stated = sum(c * truth[name] for name, c in parameter.stands_for.items())
        size = sum(abs(c * truth[name]) for name, c in parameter.stands_for.items())
        tolerance = max(1e-9, 1e-15 * result.confounding.condition_scaled)
        assert parameter.value == pytest.approx(stated, abs=tolerance * size)


def test_the_cartesian_compliance_is_the_sum_of_the_joints(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    test = simulate(turned_test(machine, (1.0, 0.0, 1.0)), JOINTS, exact=False)
    found = cartesian_of(machine, test.observations())
    assert_allclose(found.compliance, SUM, rtol=0, atol=1e-9 * SUM.max())
    stiffness, _ = found.stiffness()
    assert_allclose(stiffness @ SUM, np.eye(3), atol=1e-8)


def test_a_level_bar_leaves_the_column_of_z_undetermined(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    test = simulate(turned_test(machine, (1.0, 0.0, 0.0)), JOINTS, exact=False)
    found = cartesian_of(machine, test.observations())
    assert found.undetermined == ("C_XZ", "C_YZ", "C_ZZ")
    assert_allclose(found.compliance[:, :2], SUM[:, :2], rtol=0, atol=1e-9 * SUM.max())
    assert np.isnan(found.compliance[:, 2]).all()
    with pytest.raises(RankError, match="do not determine the columns of the forces along Z: the forces lie in one plane"):
        found.stiffness()


def test_zeros_of_probes_are_found_with_the_compliance(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    test = simulate(turned_test(machine, (1.0, 0.0, 1.0)), JOINTS, exact=False)
    offsets = np.array([0.004, -0.002, 0.007])
    observed = [o.with_reading(o.reading + np.repeat(offsets, 24)) for o in test.observations()]
    found = cartesian_of(machine, observed, sensors=3)
    assert_allclose(found.compliance, SUM, rtol=0, atol=1e-9 * SUM.max())
    assert_allclose([zero.value for zero in found.zeros], offsets, atol=1e-12)
    assert np.abs(cartesian_of(machine, observed).compliance - SUM).max() > 1e-6  # without them it would be wrong


def test_seen_from_the_table(make_machine: MakeMachine) -> None:
    """Of the table's own joint alone: the same matrix at all angles in its frame."""
    machine = make_machine("wCAYfXZt")
    own = {"C_XXC": 6e-5, "C_YYC": 2e-5, "C_ZZC": 1e-5}
    setup = DisplacementProbes(SKEW, None, {}, {"C": 1.0})
    random = np.random.default_rng(4)
    columns = {name: random.uniform(-300, 300, 24) for name in ("force_x", "force_y", "force_z")}
    columns |= {"angle": ANGLE, **{name: np.zeros(24) for name in PROBES}}
    test = simulate(MachineTest("", machine, setup, (Run("one", columns),)), own, exact=False)
    found = cartesian_of(machine, test.observations(), in_workpiece=True)
    assert_allclose(found.compliance, np.diag([6e-5, 2e-5, 1e-5]), atol=1e-13)


def test_a_pressure_gives_the_force(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    test = turned_test(machine, (1.0, 0.0, 0.0))
    runs = (Run("1 bar", test.runs[0].columns, pressure=1.0),)
    with pytest.raises(InputError, match="run '1 bar' gives a pressure of 1 bar, and the test no force calibration"):
        MachineTest("", machine, test.setup, runs).observations()
    (observed,) = MachineTest("", machine, replace(test.setup, calibration=THESIS_CALIBRATION), runs).observations()
    assert observed.force == pytest.approx(112.0)


def test_each_probe_has_its_own_noise(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    test = simulate(turned_test(machine, (1.0, 0.0, 0.0)), {"C_XXX": 0.0}, Imperfection(noise=1e-4), seed=1)
    values = np.array([run.columns[name] for run in test.runs for name in PROBES])
    assert values.std() == pytest.approx(1e-4, rel=4 / np.sqrt(2 * values.size))
    correlation = np.corrcoef(values)[~np.eye(6, dtype=bool)]
    assert np.abs(correlation).max() < 5 / np.sqrt(24)


def test_bad_runs_are_refused(make_machine: MakeMachine) -> None:
    machine = make_machine("wCAYfXZt")
    good = turned_test(machine, (1.0, 0.0, 0.0))

    def observe(columns: dict[str, np.ndarray], force: float | None = 1.0) -> None:
        good.setup.observe(machine, Run("bad", {**good.runs[0].columns, **columns}, force=force))

    with pytest.raises(InputError, match=r"run 'bad': the angles span 54\.9 turns; are they degrees given as radians"):
        observe({"angle": np.rad2deg(ANGLE)})
    with pytest.raises(InputError, match="run 'bad' has no force"):
        observe({}, None)
    with pytest.raises(InputError, match="displacement_2 reaches 12 mm; are they micrometres given as millimetres"):
        observe({"displacement_2": np.full(24, 12.0)})
    with pytest.raises(InputError, match="every reading needs one value of each"):
        observe({"displacement_3": np.zeros(5)})
    with pytest.raises(InputError, match="the reading of reading 25 is no finite number"):
        observe({"displacement_2": np.full(24, np.nan)})
    with pytest.raises(InputError, match="lacks the column displacement_3"):
        good.setup.observe(machine, Run("bad", dict.fromkeys(("angle", *PROBES[:2]), ANGLE), force=1.0))
    with pytest.raises(InputError, match="there is no probe; give each its direction"):
        DisplacementProbes(())
    with pytest.raises(InputError, match="probe 2 is"):
        DisplacementProbes(((1.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
