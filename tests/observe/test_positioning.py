"""The positioning test: signs along the command on either branch, sides, cycles, sensors of every kind, refusals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import InputError
from elastogeo.estimate import Factor, confounding, factor_blocks, merge
from elastogeo.identification import identify, merged, systems_of
from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import (
    Circle,
    Expansion,
    Imperfection,
    KnownInfluence,
    LoadedBallBar,
    MachineTest,
    Positioning,
    Question,
    Run,
    approaches,
)
from elastogeo.sources import design_rows, select_sources, simulate

TARGETS = (-190.0, -120.0, -35.0, 42.0, 117.0, 180.0)


def machine(topology: str, tool: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Machine:
    return Machine(topology, parse_topology(topology), tool=tool)


def moved(
    setup: Positioning,
    values: Mapping[str, float],
    on: Machine,
    parameters: tuple[str, ...] = (),
    **more: object,
) -> MachineTest:
    """A test with the readings that these values cause, without noise."""
    blank = MachineTest("test", on, setup, (Run("run", {}),), Question(parameters), **more)  # type: ignore[arg-type]
    return simulate(blank, values, exact=False)


def run_of(target: list[float], **columns: list[float]) -> Run:
    return Run("run", {"target": np.array(target), **{name: np.array(values) for name, values in columns.items()}})


@pytest.mark.parametrize("topology", ["wFXYt", "wXFYt"], ids=["carries the tool", "carries the workpiece"])
def test_positions_count_along_the_command_on_either_branch(topology: str) -> None:
    """The tool travels too far by 1e-4 of its way, and loses 6 um where it turns back."""
    test = moved(Positioning("X", targets=TARGETS, cycles=2), {"B_XX": 0.006}, machine(topology))
    columns = test.runs[0].columns
    off = columns["position"] - columns["target"]
    assert_allclose(off[columns["direction"] > 0], -0.003, atol=1e-15)
    assert_allclose(off[columns["direction"] < 0], 0.003, atol=1e-15)
    too_far = replace(test.runs[0], columns={**columns, "position": columns["target"] * 1.0001})
    found = identify(replace(test, runs=(too_far,)), parameters=["E_XX1"])
    carriage = 1.0 if topology == "wFXYt" else -1.0  # an error motion is that of the carriage
    assert found["E_XX1"].value == pytest.approx(carriage * 1e-4, rel=1e-9)


def test_a_rotary_table_is_read_about_its_own_axis() -> None:
    targets = tuple(np.deg2rad([0.0, 47.0, 101.0, 160.0, 222.0, 290.0, 355.0]))
    table = machine("wCFXYZt")
    test = moved(Positioning("C", targets=targets), {"E_CCc1": 2e-5, "E_CCs2": -1e-5, "B_CC": 4e-6}, table)
    assert test.asked == ("E_CC[cs][12]", "B_CC")
    found = identify(test)
    assert found["E_CCc1"].value == pytest.approx(2e-5, rel=1e-9)
    assert found["E_CCs2"].value == pytest.approx(-1e-5, rel=1e-9)
    assert found["B_CC"].value == pytest.approx(4e-6, rel=1e-9)


def test_an_angular_sensor_reads_the_angular_error_motion() -> None:
    sensor = Positioning("X", about=(0.0, 1.0, 0.0), targets=TARGETS)
    test = moved(
        sensor, {"E_BX1": 2e-7, "E_BX2": 3e-10, "E_XX1": 1e-4, "E_AX1": 1e-6}, machine("wFXYZt", (10.0, 20.0, -90.0))
    )
    assert "deviation" in test.runs[0].columns
    found = identify(test)
    assert set(found) == {"E_BX1", "E_BX2", "E_BX3", "B_BX"}
    assert found["E_BX1"].value == pytest.approx(2e-7, rel=1e-9)
    assert found["E_BX2"].value == pytest.approx(3e-10, rel=1e-9)


def test_straightness_is_what_no_straight_line_explains() -> None:
    """The reference may lie askew: the slope of the readings is its own, the bow is the axis's."""
    across = Positioning("X", direction=(0.0, 1.0, 0.0), targets=TARGETS)
    test = moved(across, {"E_YX2": 2e-7, "E_YX1": 3e-5, "B_YX": 0.001}, machine("wFXYZt"))
    found = identify(test)
    assert set(found) == {"E_YX2", "E_YX3", "B_YX"}
    assert found["E_YX2"].value == pytest.approx(2e-7, rel=1e-9)
    assert found["B_YX"].value == pytest.approx(0.001, rel=1e-9)
    assert identify(test, parameters=["E_YX1", "E_YX2"]).confounding.null == ("E_YX1",)


def test_the_place_of_the_probe_mixes_angular_error_motions_in() -> None:
    """Abbe: 80 mm below the carriage's frame a pitch of E_BX1 is -80 mm of E_XX1, and one test does not distinguish them."""
    low = machine("wFXYZt", (0.0, 0.0, -80.0))
    setup = Positioning("X", targets=TARGETS)
    assert identify(moved(setup, {"E_BX1": 1e-7}, low))["E_XX1"].value == pytest.approx(-80e-7, rel=1e-9)
    asked = identify(moved(setup, {"E_BX1": 1e-7}, low, ("E_XX1", "E_BX1")))
    assert asked["E_XX1"].stands_for == {"E_XX1": 1.0, "E_BX1": pytest.approx(-80.0)}
    at_frame = identify(moved(replace(setup, tool=(0.0, 0.0, 0.0)), {"E_BX1": 1e-7}, low, ("E_XX1", "E_BX1")))
    assert at_frame.confounding.null == ("E_BX1",)


def test_polynomials_count_from_the_middle_of_all_targets_or_from_where_the_set_up_says() -> None:
    setup = Positioning("X", targets=(0.0, 100.0, 300.0))
    one, other = (replace(setup, pose=pose).observe(machine("wFXYt"), Run("run", {})) for pose in ({}, {"X": 20.0}))
    assert (one.centre[0], other.centre[0]) == (150.0, 20.0)


STANDARD = [0.0, 10.0, 20.0, 20.0, 10.0, 0.0]


def test_the_order_of_targets_shows_sides_and_cycles() -> None:
    twice = np.array(2 * STANDARD)
    found = approaches(run_of(2 * STANDARD), twice)
    assert found.sense.tolist() == 2 * [1, 1, 1, -1, -1, -1]
    assert found.cycle.tolist() == [1] * 6 + [2] * 6
    # without overshoot at the ends each end is approached from one side only
    plain = np.array([0.0, 10.0, 20.0, 10.0, 0.0, 10.0])
    assert approaches(run_of(list(plain)), plain).sense.tolist() == [1, 1, 1, -1, -1, 1]


def test_a_step_cycle_needs_its_directions_and_counts_approaches_of_each_target() -> None:
    """Each target from both sides before the next (pilgrim step)."""
    target = np.repeat([0.0, 10.0], 4)
    sense = np.tile([1.0, -1.0], 4)
    found = approaches(run_of(list(target), direction=list(sense)), target)
    assert found.cycle.tolist() == [1, 1, 2, 2, 1, 1, 2, 2]


def test_targets_that_differ_by_rounding_are_one() -> None:
    target = np.array([0.0, 10.0, 20.0, 20.0 + 1e-9, 10.0 - 1e-9, 0.0])
    assert approaches(run_of(list(target)), target).sense.tolist() == [1, 1, 1, -1, -1, -1]


def test_a_missing_reading_leaves_the_other_cycles_as_they_are() -> None:
    target, sense, cycle = 2 * STANDARD, 2 * [1.0] * 3 + [-1.0] * 3, [1.0] * 6 + [2.0] * 6
    sense = 2 * ([1.0] * 3 + [-1.0] * 3)
    kept = [k for k in range(12) if k != 1]
    run = run_of(
        [target[k] for k in kept],
        direction=[sense[k] for k in kept],
        cycle=[cycle[k] for k in kept],
        deviation=[0.001 * k for k in kept],
    )
    first, second = Positioning("X").observe_all(machine("wFXYt"), [run])
    assert (len(first), len(second)) == (5, 6)
    assert (first.run, second.run) == ("run, cycle 1", "run, cycle 2")
    assert_allclose(first.reading, [0.0, 0.002, 0.003, 0.004, 0.005])


def test_every_cycle_has_a_zero_of_its_own() -> None:
    """A drift from cycle to cycle changes neither the error motion nor the backlash."""
    test = moved(Positioning("X", targets=TARGETS), {"E_XX1": 1e-5, "B_XX": 0.004}, machine("wFXYt"))
    columns = dict(test.runs[0].columns)
    drifted = {**columns, "position": columns["position"] + 0.002 * columns["cycle"]}
    found = identify(replace(test, runs=(replace(test.runs[0], columns=drifted),)))
    assert found["E_XX1"].value == pytest.approx(1e-5, rel=1e-8)
    assert found["B_XX"].value == pytest.approx(0.004, rel=1e-8)


def test_a_scale_that_is_off_counts_for_the_whole_way() -> None:
    """2 um/m of a sensor is 2 um/m of E_XX1, although the deviations are micrometres only."""
    known = (KnownInfluence("sensor-scale", "laser", relative=2e-6),)
    test = moved(Positioning("X", targets=TARGETS), {"E_XX1": 1e-5}, machine("wFXYt"), influences=known)
    scatter = test.runs[0].columns["position"] + 1e-5 * np.random.default_rng(3).standard_normal(60)
    noisy = replace(test, runs=(replace(test.runs[0], columns={**test.runs[0].columns, "position": scatter}),))
    line = next(line for line in identify(noisy).budget.lines[0] if line.label == "laser")
    assert line.contribution == pytest.approx(2e-6, rel=1e-3)


def test_one_direction_shows_no_backlash_and_is_not_asked_for_it() -> None:
    up = run_of([0.0, 10.0, 20.0, 30.0, 0.0, 10.0, 20.0, 30.0], direction=[1.0] * 8, deviation=[0.0, 1e-3, 2e-3, 3e-3] * 2)
    assert Positioning("X").default_parameters([up]) == ("E_XX[1-3]",)


SPOILED = {
    "lacks the column target": {"target": None},
    "neither a position nor a deviation": {"position": None},
    "both position and deviation": {"deviation": np.zeros(6)},
    "positions fall while the targets grow": {"position": -np.array(STANDARD)},
    "the positions change by 1000 per unit of the target": {"position": 1000 * np.array(STANDARD)},
    "direction of reading 1 is 0.5": {"direction": np.full(6, 0.5)},
    "number the cycles 1, 2, 3": {"cycle": np.full(6, 0.5)},
    "cycle 1 comes 2 times to the target 0 in the direction +": {"cycle": np.ones(6), "direction": np.ones(6)},
    "6 of target, 5 of cycle, 6 of position": {"cycle": np.ones(5)},
}


@pytest.mark.parametrize("message", SPOILED)
def test_what_no_positioning_test_records_is_refused(message: str) -> None:
    columns: dict[str, Array] = {"target": np.array(STANDARD), "position": np.array(STANDARD)}
    spoiled = {**columns, **SPOILED[message]}
    run = Run("run", {name: values for name, values in spoiled.items() if values is not None})
    with pytest.raises(InputError, match=message.replace("+", r"\+")):
        Positioning("X").observe_all(machine("wFXYt"), [run])


def test_units_and_places_that_cannot_be_are_refused() -> None:
    far = run_of([0.0, 400.0], position=[0.0, 400.0])
    short = Machine("short", parse_topology("wFXt"), (Joint("X", travel=(-100.0, 100.0)),))
    with pytest.raises(InputError, match=r"targets of X go from 0 to 400 mm, its travel from -100 to 100 mm"):
        Positioning("X").observe(short, far)
    with pytest.raises(InputError, match=r"span 57\.3 turns; are they degrees given as radians"):
        Positioning("C").observe(machine("wCFXYt"), run_of([0.0, 360.0], position=[0.0, 360.0]))
    with pytest.raises(InputError, match="arcseconds or microradians given as radians"):
        Positioning("X", about=(0, 1, 0)).observe(machine("wFXYt"), run_of([0.0, 50.0], deviation=[0.0, 5.0]))
    with pytest.raises(InputError, match="micrometres given as millimetres, or positions given as deviations"):
        Positioning("X").observe(machine("wFXYt"), run_of([0.0, 50.0], deviation=[0.0, 30.0]))
    with pytest.raises(InputError, match="does not read along the axis"):
        Positioning("X", direction=(0, 1, 0)).observe(machine("wFXYt"), run_of([0.0, 50.0], position=[0.0, 0.1]))
    with pytest.raises(InputError, match="stays at one target"):
        Positioning("X").observe_all(machine("wFXYt"), [run_of([5.0, 5.0], position=[5.0, 5.0])])
    with pytest.raises(InputError, match="states a force"):
        Positioning("X").observe(machine("wFXYt"), replace(far, force=100.0))
    with pytest.raises(InputError, match="direction or about, not both"):
        Positioning("X", direction=(1, 0, 0), about=(0, 1, 0))
    with pytest.raises(InputError, match="the axis is 'Q'"):
        Positioning("Q")


def bar_factor(names: tuple[str, ...], on: Machine) -> Factor:
    """Of a loaded bar on the circle of the thesis, two forces."""
    angle = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    runs = tuple(Run(f"{force:g}", {"angle": angle, "radial": np.zeros(72)}, force=force) for force in (36.0, 742.0))
    test = MachineTest("bar", on, LoadedBallBar(Circle(150.0), 30.0), runs, Question(names))
    return merged(systems_of(test).runs)


def test_a_bar_and_a_laser_together_distinguish_what_a_bar_alone_does_not() -> None:
    """The bar's length looks as E_XX1 = E_YY1 on a circle: 13 of 14. Positioning of X, or of Y, distinguishes them."""
    on = machine("wFYXt")
    names = tuple(source.name for source in select_sources(on, ["elasto-geometric-xy", "E_R0"]))
    bar = bar_factor(names, on)
    alone = confounding(bar)
    assert (len(alone.labels), alone.rank) == (14, 13)
    assert set(alone.stands_for("E_XX1")) >= {"E_XX1", "E_R0"} or set(alone.stands_for("E_R0")) >= {"E_XX1", "E_YY1"}
    for axis in "XY":
        blocks = []
        for cycle in Positioning(axis, targets=TARGETS).observe_all(on, [Run("laser", {})]):
            rows = design_rows(select_sources(on, names), on, cycle)
            rows[:, names.index("E_R0")] = 0.0  # that is the bar's length; the zero of the laser is its own
            blocks.append(rows - rows.mean(axis=0))
        together = confounding(merge(bar, factor_blocks(names, blocks)))
        assert together.rank == 14
        assert together.condition_scaled < 30


def bar_and_laser(seed: int) -> tuple[MachineTest, MachineTest]:
    """A loaded bar that is 6 um too long, and a positioning test of X, of one machine."""
    on, angle = machine("wFYXt"), np.linspace(0, 2 * np.pi, 36, endpoint=False)
    runs = tuple(
        Run(f"{force:g} N, {k}", {"angle": angle, "radial": 0 * angle}, force=force)
        for force in (36.0, 742.0)
        for k in range(3)
    )
    asked = Question(("elasto-geometric-xy", "E_R0"))
    bar = MachineTest("bar", on, LoadedBallBar(Circle(150.0), 30.0), runs, asked)
    laser = MachineTest("laser", on, Positioning("X", targets=TARGETS), (Run("laser", {}),), Question(("E_XX1",)))
    motion = {"E_XX1": 2e-5, "E_YY1": -3e-5, "C_XXX": 6e-5}
    return (
        simulate(bar, {**motion, "E_R0": 0.006}, Imperfection(noise=1e-4), seed, exact=False),
        simulate(laser, {**motion, "E_R0": 1.5}, Imperfection(noise=2e-4), seed + 1, exact=False),
    )


def test_a_campaign_of_bar_and_laser_distinguishes_them_by_the_door() -> None:
    """The zero of the laser is its own: it may be anything."""
    bar, laser = bar_and_laser(4)
    alone = identify(bar)
    assert (alone.confounding.rank, len(alone.confounding.labels)) == (13, 14)
    together = identify([bar, laser])
    assert (together.confounding.rank, len(together.confounding.labels)) == (14, 14)
    assert set(together.together) >= {"E_YY1", "E_R0@bar"}  # neither test tells them; E_XX1 the laser tells alone
    for name, true in (("E_XX1", 2e-5), ("E_YY1", -3e-5), ("E_R0@bar", 0.006)):
        value = together[name]
        assert value.estimate is not None
        assert abs(value.value - true) < 5 * value.estimate.standard_uncertainty
        assert value.estimate.standard_uncertainty < 0.1 * abs(true)


def test_a_campaign_of_laser_and_angular_sensor_frees_positioning_of_its_lever() -> None:
    """80 mm below the carriage the laser reads E_XX1 - 80 mm E_BX1; with the pitch read beside it both are known."""
    on = machine("wFXYZt", (0.0, 0.0, -80.0))
    truth = {"E_XX1": 1e-5, "E_BX1": 2e-7}
    tests = []
    for seed, setup in enumerate((Positioning("X", targets=TARGETS), Positioning("X", about=(0, 1, 0), targets=TARGETS))):
        blank = MachineTest(f"test-{seed}", on, setup, (Run("run", {}),), Question(tuple(truth)))
        tests.append(simulate(blank, truth, Imperfection(noise=4e-4, angle_noise=4e-7), seed, exact=False))
    assert identify(tests[0]).confounding.rank == 1
    together = identify(tests)
    assert together.confounding.rank == 2
    for name, true in truth.items():
        low, high = together[name].interval or (np.nan, np.nan)
        assert low <= true <= high
        assert high - low < abs(true)


WARM = Expansion(temperature=22.0, expansion=11.5e-6, temperature_uncertainty=0.3, expansion_uncertainty=1e-6)
GLASS = Expansion(temperature=25.0, expansion=8e-6)


def test_lengths_are_referred_to_20_degrees() -> None:
    """2 K of steel are 23 um/m too far; a glass scale 5 K too warm reads 40 um/m too little."""
    target = np.array([-100.0, 0.0, 100.0])
    for axis, sensor, stretch in ((WARM, None, 23e-6), (None, GLASS, -40e-6), (WARM, GLASS, -17e-6)):
        run = run_of(list(target), position=list(target * (1 + 1e-5 + stretch)))
        seen = Positioning("X", axis_at=axis, sensor_at=sensor).observe(machine("wFXYt"), run)
        assert_allclose(seen.reading, 1e-5 * target, atol=1e-12)
        assert_allclose(seen.correction, stretch * target, atol=1e-12)


def test_a_sensor_that_counts_the_other_way_is_corrected_the_other_way() -> None:
    target = np.array([-100.0, 0.0, 100.0])
    run = run_of(list(target), position=list(-target * (1 + 1e-5 + 23e-6)))
    seen = Positioning("X", direction=(-1.0, 0.0, 0.0), axis_at=WARM).observe(machine("wFXYt"), run)
    assert_allclose(seen.reading, -1e-5 * target, atol=1e-12)


def test_a_simulated_warm_machine_gives_its_parameters_at_20_degrees_and_their_uncertainty() -> None:
    """11.5e-6 x 0.3 K, and 2 K x 1e-6: both of every length."""
    setup = Positioning("X", targets=TARGETS, axis_at=WARM)
    found = identify(moved(setup, {"E_XX1": 1e-5, "B_XX": 0.002}, machine("wFXYt"), ("E_XX1", "B_XX")))
    assert found["E_XX1"].value == pytest.approx(1e-5, rel=1e-9)
    lines = {line.label: line.contribution for line in found.budget.lines[0]}
    assert lines["temperature of the axis"] == pytest.approx(11.5e-6 * 0.3, rel=1e-9)
    assert lines["expansion of the axis"] == pytest.approx(2e-6, rel=1e-9)


def test_temperatures_that_no_test_has_are_refused() -> None:
    with pytest.raises(InputError, match="between 0 and 60: is it in kelvin"):
        Expansion(295.0, 11.5e-6)
    with pytest.raises(InputError, match=r"steel has 11\.5e-6: write expansion_um_per_m = 11\.5"):
        Expansion(22.0, 11.5)
    with pytest.raises(InputError, match="give none below zero"):
        Expansion(22.0, 11.5e-6, -0.1)
    with pytest.raises(InputError, match="C is not read along a linear axis"):
        Positioning("C", axis_at=WARM)
    with pytest.raises(InputError, match="X is not read along a linear axis"):
        Positioning("X", direction=(0, 1, 0), axis_at=WARM)


def test_tests_of_several_places_count_their_polynomials_from_one_centre() -> None:
    """One curve of X, 1e-5 x + 1e-7 x^2, read left and right of zero: alone each has its E_XX1, together they have one."""
    tests = []
    for name, low, high in (("left", -300.0, 0.0), ("right", 0.0, 300.0)):
        places = np.linspace(low, high, 7) + np.array([0.0, 3.0, -5.0, 2.0, 7.0, -4.0, 0.0])
        target, sense = np.tile(np.concatenate([places, places[::-1]]), 3), np.tile(np.repeat([1.0, -1.0], 7), 3)
        run = run_of(list(target), direction=list(sense), deviation=list(1e-5 * target + 1e-7 * target**2))
        tests.append(MachineTest(name, machine("wFXYt"), Positioning("X"), (run,), Question(("E_XX1", "E_XX2"))))
    assert [identify(test)["E_XX1"].value for test in tests] == pytest.approx([1e-5 - 3e-5, 1e-5 + 3e-5])
    together = identify(tests)
    assert together.rmse < 1e-12
    assert together["E_XX1"].value == pytest.approx(1e-5)
    assert together["E_XX2"].value == pytest.approx(1e-7)
