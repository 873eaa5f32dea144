"""Static tests as wholes: by instrument, what comes out is what was put in by hand, and what cannot be had is said."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError
from elastogeo.formats import read_test
from elastogeo.identification.static_tests.assessment import evaluate_static
from elastogeo.identification.static_tests.result import StaticResults
from elastogeo.machine import Array, Machine, loop_frames, parse_topology
from elastogeo.observe import (
    DisplacementProbes,
    KnownInfluence,
    MachineTest,
    Question,
    Run,
    Sensor,
    SensorFrame,
    StaticForce,
)
from elastogeo.report import sentence_of
from elastogeo.report.static_tests.tables import static_tables
from elastogeo.sources import simulate

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SOFT = 5e-5
"""Compliance of the simulated structure [mm/N]."""
QUESTION = Question(("C_XXX", "E_R0"))
UP = np.linspace(0, 400, 21)
RAMP = np.tile(np.concatenate([UP, UP[-2::-1]]), 3)
RISING = np.tile(np.concatenate([np.ones(21), np.zeros(20)]), 3)


def ramp(name: str = "r", seed: int = 1, soft: float = SOFT, loop: float = 0.0, sense: float = 1.0, **columns: Array) -> Run:
    """Three loading cycles; falling branches lie up to `loop` [mm] above rising ones, a parabola; noise of 0.02 um."""
    random = np.random.default_rng(seed)
    lens = loop * 4 * RAMP * (400 - RAMP) / 400**2 * (1 - RISING)
    moved = soft * RAMP + lens + 2e-5 * random.standard_normal(len(RAMP))
    return Run(name, {"force": RAMP, "displacement": sense * moved, **columns})


def a_test(runs: Sequence[Run], topology: str = "wFYXt", question: Question = QUESTION, **setup: object) -> MachineTest:
    given = {"direction": (1.0, 0.0, 0.0), **setup}
    return MachineTest("t", Machine("m", parse_topology(topology)), StaticForce(**given), tuple(runs), question)


def failed(found: StaticResults, decisive: bool = False) -> set[str]:
    return {check.name for check in found.verdict if not check.passed and (check.decisive or not decisive)}


def test_a_loop_that_was_put_in_comes_out_with_its_energy() -> None:
    (place,) = evaluate_static(a_test([ramp("a", 1, loop=1e-3), ramp("b", 2, loop=1e-3)])).places
    for run in place.runs:
        assert run.hysteresis is not None
        assert run.hysteresis.mean_hysteresis.value == pytest.approx(2 / 3 * 1e-3, rel=0.03)
        assert run.hysteresis.greatest_hysteresis.value == pytest.approx(1e-3, rel=0.03)
        assert run.hysteresis.greatest_at == pytest.approx(200, abs=20)
        assert run.hysteresis.static_compliance.value == pytest.approx(SOFT, rel=2e-3)
        low, high = run.hysteresis.range
        assert run.hysteresis.energy_lost.value == pytest.approx(2 / 3 * 1e-3 * (high - low), rel=0.03)
    assert place.line is not None
    # more readings stand at zero than at the full load, so the lens tilts the line a little
    assert place.line.compliance.value == pytest.approx(SOFT, rel=5e-3)


def test_a_loop_is_more_than_the_straight_line_allows_and_the_check_says_so() -> None:
    assert "straight line enough" not in failed(evaluate_static(a_test([ramp("a"), ramp("b", 2)])))
    found = evaluate_static(a_test([ramp("a", loop=1e-3), ramp("b", 2, loop=1e-3)]))
    assert "straight line enough" in failed(found)
    assert not failed(found, decisive=True)


def test_a_sensor_against_the_force_reads_the_same_compliance() -> None:
    (place,) = evaluate_static(a_test([ramp(sense=-1.0), ramp("b", 2, sense=-1.0)], sensor=(-1.0, 0.0, 0.0))).places
    assert place.along
    assert place.line is not None
    assert place.line.compliance.value == pytest.approx(SOFT, rel=2e-3)


def test_a_wrong_sign_along_the_force_is_decisive_and_across_it_is_none() -> None:
    runs = [ramp(sense=-1.0), ramp("b", 2, sense=-1.0)]
    found = evaluate_static(a_test(runs))
    assert "displacement with the force" in failed(found, decisive=True)
    assert any("in run r: -" in said and "turn the sensor's sign" in said for said in map(sentence_of, found.verdict))
    across = evaluate_static(a_test(runs, sensor=(0.0, 1.0, 0.0), question=Question(("C_YXX", "E_R0"))))
    assert not across.places[0].along
    assert "displacement with the force" not in {check.name for check in across.verdict}


def test_a_loop_that_gains_energy_is_decisive() -> None:
    found = evaluate_static(a_test([ramp(loop=-1e-3), ramp("b", 2)]))
    (check,) = [check for check in found.verdict if check.name == "energy is lost, not gained"]
    assert check.decisive
    assert not check.passed
    assert "the loop runs the wrong way round" in sentence_of(check)


def test_places_and_directions_have_lines_of_their_own() -> None:
    def pushed(name: str, x: float, soft: float, axis: int) -> Run:
        force = np.outer(RAMP, np.eye(3)[axis])
        columns = {f"force_{letter}": force[:, k] for k, letter in enumerate("xyz")}
        run = ramp(name, soft=soft, x=np.full(len(RAMP), x))
        return replace(run, columns={**columns, **{k: v for k, v in run.columns.items() if k != "force"}})

    runs = [pushed("a", 0.0, 4e-5, 0), pushed("b", 100.0, 6e-5, 0), pushed("c", 0.0, 1e-6, 1), pushed("d", 0.0, 4e-5, 0)]
    found = evaluate_static(a_test(runs, direction=None, sensor=(1.0, 0.0, 0.0), question=Question(("C_XXX", "C_XYX"))))
    seen = {tuple(run.run for run in place.runs): place for place in found.places}
    assert set(seen) == {("a", "d"), ("b",), ("c",)}
    for names, soft in ((("a", "d"), 4e-5), (("b",), 6e-5), (("c",), 1e-6)):
        line = seen[names].line
        assert line is not None
        assert line.compliance.value == pytest.approx(soft, abs=5e-8)
    assert_allclose(seen["c",].direction, [0, 1, 0], atol=1e-12)
    assert not seen["c",].along
    assert seen["b",].commands["X"] == 100.0


def test_a_force_that_leaves_its_line_is_refused() -> None:
    run = ramp()
    columns = {"force_x": RAMP, "force_y": 0.2 * RAMP**2 / 400, "force_z": 0 * RAMP}
    run = replace(run, columns={**columns, "displacement": run.columns["displacement"]})
    with pytest.raises(InputError, match=r"run 'r': its force does not keep to a line, it departs by .* N of 408 N"):
        evaluate_static(a_test([run], direction=None, sensor=(1.0, 0.0, 0.0)))


def test_a_stated_influence_counts_in_the_joints_and_in_what_the_instrument_shows() -> None:
    """The line is the joint's compliance here: value and interval are those of `identify`."""
    plain = a_test([ramp(name, seed, loop=1e-3) for seed, name in enumerate("abc")])
    stated = replace(plain, influences=(KnownInfluence("force-scale", "load cell", relative=0.01),))
    (before,), (after,) = evaluate_static(plain).places, evaluate_static(stated).places
    assert before.line is not None
    assert after.line is not None
    assert before.line.compliance.standard_uncertainty < 0.001 * SOFT
    assert after.line.compliance.standard_uncertainty == pytest.approx(0.01 * after.line.compliance.value, rel=0.02)
    joint = evaluate_static(stated).joints.parameters[0]
    assert after.line.compliance.value == pytest.approx(joint.value, rel=1e-9)
    assert after.line.compliance.interval() == pytest.approx(joint.interval, rel=1e-3)
    loops = [place.runs[0].hysteresis for place in (before, after)]
    assert loops[1].static_compliance.standard_uncertainty > 0.0098 * SOFT
    assert loops[1].energy_lost.standard_uncertainty > 0.0099 * loops[1].energy_lost.value
    assert loops[1].mean_hysteresis.standard_uncertainty == pytest.approx(loops[0].mean_hysteresis.standard_uncertainty)


def test_two_runs_give_a_line_without_an_interval_and_say_how_many_it_takes() -> None:
    found = evaluate_static(a_test([ramp(), ramp("b", 2)]))
    assert found.places[0].line is not None
    assert not found.places[0].line.compliance.known
    assert found.places[0].line.stiffness().value == pytest.approx(1 / SOFT, rel=1e-3)
    (check,) = [check for check in found.verdict if check.name == "uncertainty of the instrument's results by run"]
    assert check.passed is False
    assert sentence_of(check) == (
        "2 runs are too few to show how the straight line scatters: no interval is given; 4 runs like these give one."
    )


def test_one_branch_only_leaves_the_line_and_says_why_there_is_no_loop() -> None:
    half = Run("half", {"force": UP, "displacement": SOFT * UP + 1e-5 * np.sin(7.0 * UP)})
    found = evaluate_static(a_test([half, ramp()]))
    runs = found.places[0].runs
    assert runs[0].hysteresis is None
    assert "only a rising branch covers its range of 400 N" in runs[0].refusal
    assert runs[1].hysteresis is not None
    (check,) = [check for check in found.verdict if check.name == "loading cycles"]
    assert sentence_of(check).startswith(
        "1 of 2 runs say nothing of hysteresis. Run half: of 1 branches of the force only a rising"
    )
    assert found.places[0].line is not None


@pytest.mark.parametrize("topology", ["wFYXt", "wXFYt"])
def test_the_positive_sense_of_an_axis_is_that_of_its_command(topology: str) -> None:
    machine = Machine("m", parse_topology(topology))
    k = machine.index("X")
    rest, moved = loop_frames(machine, np.zeros((1, 2))), loop_frames(machine, np.eye(2)[[k]])
    apart = [frames.point - frames.workpiece.origin for frames in (rest, moved)]
    assert_allclose(apart[1] - apart[0], [[1, 0, 0]], atol=1e-12)


@pytest.mark.parametrize("topology", ["wFYXt", "wXFYt"])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_springs_of_the_drive_come_back(topology: str, sense: float) -> None:
    def run(name: str, seed: int) -> Run:
        random = np.random.default_rng(seed)
        servo, screw = sense * 1e-5 * RAMP, sense * 2e-5 * RAMP
        position = 200 + servo + 1e-6 * random.standard_normal(len(RAMP))
        return ramp(name, seed, position_x=position, scale_x=200 + servo + screw)

    runs = [run(f"r{seed}", seed) for seed in range(4)]
    found = evaluate_static(a_test(runs, topology, direction=(sense, 0.0, 0.0)))
    drive = found.places[0].drive
    assert drive is not None
    assert drive.axis == "X"
    expected = {"servo": 1e-5, "transmission": 2e-5, "guideway and structure": 2e-5}
    assert {part.name: part.compliance.value for part in drive.parts} == pytest.approx(expected, rel=5e-3)
    assert sum(part.share or 0.0 for part in drive.parts) == pytest.approx(1.0, rel=1e-6)
    assert "drive of X: springs in series" in {check.name for check in found.verdict}


@pytest.mark.parametrize(("amperes", "held"), [(0.004, "motor holds it"), (0.0, "friction may hold the axis")])
def test_the_current_says_whether_motor_or_friction_holds_the_axis(amperes: float, held: str) -> None:
    """A servo of 100 N/um held by 4 A per kN; or by friction, and the current only scatters."""
    random = np.random.default_rng(4)

    def run(k: int) -> Run:
        noise = 1e-3 * random.standard_normal((2, len(RAMP)))
        return ramp(f"r{k}", k, position_x=1e-5 * RAMP + 1e-4 * noise[0], current_x=amperes * RAMP + noise[1])

    found = evaluate_static(a_test([run(k) for k in range(6)]))
    place = found.places[0]
    assert place.drive is not None
    assert place.drive.current is not None
    low, high = place.drive.current.interval()
    assert low < amperes < high
    assert place.drive.parts[0].stiffness().value == pytest.approx(1e5, rel=0.01)
    (table,) = [table for table in static_tables(found) if "Where axis X yields" in table.title]
    assert held in table.note


def test_currents_of_some_runs_only_are_refused() -> None:
    runs = [ramp("a", 1, position_x=1e-5 * RAMP, current_x=RAMP), ramp("b", 2, position_x=1e-5 * RAMP)]
    with pytest.raises(InputError, match="run 'b' lacks the column current_x that other runs of this place have"):
        evaluate_static(a_test(runs))


def test_a_loop_closed_on_the_scale_holds_the_transmission() -> None:
    runs = [ramp(f"r{k}", k, position_x=-2e-5 * RAMP, scale_x=1e-5 * RAMP, command_x=0 * RAMP) for k in range(4)]
    drive = evaluate_static(a_test(runs), feedback="scale").places[0].drive
    assert drive is not None
    assert {part.name: part.acts for part in drive.parts} == {
        "servo": True,
        "guideway and structure": True,
        "transmission": False,
    }
    with pytest.raises(InputError, match="a position loop is closed on 'belt'; say motor or scale"):
        evaluate_static(a_test(runs), feedback="belt")


def test_positions_that_will_not_do_are_refused_and_those_of_other_axes_left_alone() -> None:
    assert evaluate_static(a_test([ramp(position_y=1e-5 * RAMP)])).places[0].drive is None
    assert evaluate_static(a_test([ramp(command_x=0 * RAMP)])).places[0].drive is None
    with pytest.raises(InputError, match="run 'r': position_x moves by 8 mm; a static test stands still"):
        evaluate_static(a_test([ramp(position_x=0.02 * RAMP)]))
    with pytest.raises(InputError, match="run 'b' lacks the column position_x that other runs of this place have"):
        evaluate_static(a_test([ramp(position_x=1e-5 * RAMP), ramp("b", scale_x=1e-5 * RAMP)]))


def test_weights_that_do_not_come_back_give_the_stiffness_of_the_rig() -> None:
    found = evaluate_static(read_test(EXAMPLES / "static-rig"))
    (place,) = found.places
    assert place.line is not None
    assert place.line.counted.runs == 9
    low, high = place.line.stiffness().interval()
    assert low < 2650 < high
    assert all(run.hysteresis is None for run in place.runs)
    assert "loading cycles" in failed(found)
    assert not failed(found, decisive=True)


def test_probes_give_compliance_stiffness_and_directions() -> None:
    found = evaluate_static(read_test(EXAMPLES / "static-probes"))
    cartesian = found.cartesian
    assert cartesian is not None
    assert not cartesian.zeroed
    # simulation.toml, summed over X and Y
    truth = np.array([[6.8e-5, 0, 0.5e-5], [0, 5e-5, 0], [0.5e-5, 0, 3e-5]])
    assert_allclose(cartesian.compliance.compliance, truth, atol=2e-7)
    assert cartesian.stiffness is not None
    assert_allclose(cartesian.stiffness, np.linalg.inv(truth), rtol=5e-3, atol=60)
    assert [one.compliance.value for one in cartesian.principal] == pytest.approx(
        sorted(np.linalg.eigvalsh(truth), reverse=True), rel=5e-3
    )
    assert cartesian.symmetry is None
    assert "uncertainty of the instrument's results by run" in failed(found)
    checks = {check.name: check for check in found.verdict}
    assert checks["no energy gained"].decisive
    assert checks["no energy gained"].passed is None


def test_probes_under_one_force_say_which_columns_are_not_determined() -> None:
    random = np.random.default_rng(5)
    angle = np.linspace(0, 1, 30)
    readings = {f"displacement_{k}": 0.02 * (k == 1) + 5e-5 * random.standard_normal(30) for k in (1, 2, 3)}
    setup = DisplacementProbes(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), bar=(1.0, 0.0, 0.0))
    machine = Machine("m", parse_topology("wFYXt"))
    runs = (Run("r", {"angle": angle, **readings}, force=400.0),)
    found = evaluate_static(MachineTest("t", machine, setup, runs, Question(("C_XXX", "C_YXX"))))
    cartesian = found.cartesian
    assert cartesian is not None
    assert cartesian.zeroed
    assert cartesian.compliance.compliance[0, 0] == pytest.approx(5e-5, rel=0.01)
    assert cartesian.stiffness is None
    assert cartesian.principal == ()
    assert "do not determine the columns of the forces along Y, Z" in cartesian.refusal
    assert "compliance determined" in failed(found)


def frame_test(
    sensors: int = 8, resolution: float | None = None, bad: int | None = None, blind: bool = False
) -> MachineTest:
    """A dwell without load, at 300 N and at 600 N along x, five readings each, at a frame about the tool."""
    places = [(60, -40, 30), (60, 40, 30), (60, 0, -50), (-40, 60, 20), (40, 60, 30), (0, 0, 90), (50, 0, 90), (5, 40, 90)]
    ways = [(1, 0, 0)] * 3 + [(0, 1, 0)] * 2 + [(0, 0, 1)] * 3
    chosen = [(p, (1, 0, 0) if blind else w) for p, w in zip(places, ways, strict=True)][:sensors]
    frame = SensorFrame(tuple(Sensor(place, way) for place, way in chosen), direction=(1.0, 0.0, 0.0))
    machine = Machine("m", parse_topology("wFYXt"))
    force = np.repeat([0.0, 300.0, 600.0], 5)
    blank = Run("r", {"force": force})
    question = Question(("C_XXX", "C_BXX", "C_CXX"))
    test = MachineTest("t", machine, frame, (blank, replace(blank, name="s")), question, resolution=resolution)
    simulated = simulate(test, {"C_XXX": 5e-5, "C_BXX": 2e-8}, exact=False)
    random = np.random.default_rng(7)
    runs = []
    for run in simulated.runs:
        columns = {
            name: values + (5e-5 * random.standard_normal(len(values)) if name != "force" else 0.0)
            for name, values in run.columns.items()
        }
        if bad is not None and run.name == "s":
            columns[f"displacement_{bad}"] = columns[f"displacement_{bad}"] + 0.003 * (force > 0)
        runs.append(replace(run, columns=columns))
    return replace(simulated, runs=tuple(runs))


def test_a_frame_gives_the_twist_of_every_load_step() -> None:
    found = evaluate_static(frame_test())
    run = found.twists[0]
    assert [step.force for step in run.steps] == [0.0, 300.0, 600.0]
    assert [step.readings for step in run.steps] == [5, 5, 5]
    step = run.greatest
    expected = np.array([5e-5, 0, 0, 0, 2e-8, 0]) * 600
    assert (np.abs(step.twist - expected) < 5 * run.twist.standard_uncertainty / np.sqrt(5)).all()
    (place,) = found.twist_places
    assert place.runs == ("r", "s")
    assert place.compliance[0].value == pytest.approx(5e-5, rel=0.01)
    assert not any(one.known for one in place.compliance)
    assert failed(found) & {"twist determined", "sensors agree", "uncertainty of the instrument's results by run"} == {
        "uncertainty of the instrument's results by run"
    }


def test_runs_of_a_frame_give_the_twist_per_force_an_interval() -> None:
    one = frame_test()
    runs = [replace(run, name=f"{run.name}{k}") for k, run in enumerate(one.runs * 2)]
    shifted = [
        replace(
            run,
            columns={
                name: v + (1e-4 * k * run.columns["force"] / 600) * (name != "force") for name, v in run.columns.items()
            },
        )
        for k, run in enumerate(runs)
    ]
    (place,) = evaluate_static(replace(one, runs=tuple(shifted))).twist_places
    assert place.counted.by_run
    low, high = place.compliance[0].interval()
    # every run reads 0.1 um more at 600 N than the one before it
    assert high - low > 2e-4 / 600
    assert low < place.compliance[0].value < high


def test_a_sensor_that_lies_is_named_with_its_run() -> None:
    found = evaluate_static(frame_test(bad=2))
    assert [run.twist.suspect for run in found.twists] == [None, 2]
    (check,) = [check for check in found.verdict if check.name == "sensors agree"]
    assert not check.passed
    assert "stands out: sensor 2 in run s." in sentence_of(check)


def test_a_frame_that_cannot_see_the_twist_says_so_and_the_joints_stand() -> None:
    found = evaluate_static(frame_test(sensors=6))
    assert found.twists == ()
    assert found.refusal == "six sensors leave no residual: give the resolution of the readings, or add a sensor"
    assert "twist determined" in failed(found)
    assert len(found.joints.parameters) == 3
    blind = evaluate_static(frame_test(blind=True))
    assert blind.refusal.startswith("this frame of 8 sensors does not see Y, Z, A")
    assert len(blind.joints.parameters) == 3


def test_six_sensors_count_on_the_resolution() -> None:
    (run, _) = evaluate_static(frame_test(sensors=6, resolution=1e-4)).twists
    # a rectangular distribution of that width
    assert run.twist.standard_deviation == pytest.approx(1e-4 / np.sqrt(12))
    found = evaluate_static(frame_test(sensors=6, resolution=1e-4))
    assert any("Nothing checks sensor 1, 2, 3, 4, 5, 6" in sentence_of(check) for check in found.verdict)


def test_another_instrument_is_sent_to_its_own_command(make_test) -> None:
    with pytest.raises(InputError, match=r"was made with a loaded-ball-bar; .* use: elastogeo identify"):
        evaluate_static(make_test("wFYXt"))
    with pytest.raises(InputError, match=r"was made with a ball-roller; .* use: elastogeo stiffness"):
        evaluate_static(read_test(EXAMPLES / "ball-roller"))


def test_a_missing_column_and_micrometres_for_millimetres_are_refused() -> None:
    run = ramp()
    with pytest.raises(InputError, match="run 'r' lacks the column displacement; its columns are: force"):
        evaluate_static(a_test([replace(run, columns={"force": RAMP})]))
    wrong = {**run.columns, "displacement": 1000 * run.columns["displacement"]}
    with pytest.raises(InputError, match=r"displacement reaches 20.* mm; are they micrometres given as millimetres"):
        evaluate_static(a_test([replace(run, columns=wrong)]))
