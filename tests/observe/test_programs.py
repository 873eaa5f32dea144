"""The program of a planned test drives the machine model along the poses that the instrument observes."""

from __future__ import annotations

from dataclasses import replace
from math import inf, pi, radians

import numpy as np
import pytest
from scipy.spatial import cKDTree

from elastogeo.errors import InputError, PathError
from elastogeo.formats import flavours, program_text, read_program_bytes
from elastogeo.machine import Arc, Array, Comment, Dwell, Joint, Line, Machine, Program, ProgramLimits, ProgramPath, Stop
from elastogeo.observe import MachineTest, Procedure, Run, instruments
from tests.observe.planned_programs import CIRCLES, MOVING, circle_test, of_template, planned_tests

PLANNED = planned_tests()
LEVER = 100.0
"""What a radian counts in millimetres here."""


def scaled(machine: Machine, commands: Array) -> Array:
    return commands * [LEVER if axis in "ABCS" else 1.0 for axis in machine.axes]


def distance(machine: Machine, path: ProgramPath, commands: Array) -> tuple[Array, Array]:
    """How far commands are from the polyline of a path, and the nearest of its points."""
    points, wanted = scaled(machine, path.commands), scaled(machine, commands)
    nearest = cKDTree(points).query(wanted)[1]
    best = np.full(len(wanted), inf)
    for first in (np.maximum(nearest - 1, 0), nearest):
        last = np.minimum(first + 1, len(points) - 1)
        way = points[last] - points[first]
        length = np.maximum(np.sum(way**2, axis=1), 1e-30)
        part = np.clip(np.sum((wanted - points[first]) * way, axis=1) / length, 0, 1)
        best = np.minimum(best, np.linalg.norm(points[first] + part[:, np.newaxis] * way - wanted, axis=1))
    return best, nearest


def part_of(program: Program, path: ProgramPath, run: str) -> ProgramPath:
    """The part of a path from where the readings of a run begin to the next comment."""
    begins = [k for k, block in enumerate(program.blocks) if isinstance(block, Comment)]
    names = ["".join(block.text.split(",")[0].upper().split()) for block in program.blocks if isinstance(block, Comment)]
    place = names.index("".join(f"readings of run {run}".upper().split()))
    last = begins[place + 1] if place + 1 < len(begins) else len(program.blocks)
    at = np.flatnonzero((path.block >= begins[place]) & (path.block < last))
    at = np.concatenate([[at[0] - 1], at])  # from where the readings begin
    return replace(path, **{name: getattr(path, name)[at] for name in ("commands", "velocity", "block", "feed", "time")})


def observed(test: MachineTest, run: Run) -> tuple[Array, Array]:
    """Commands and velocities that an instrument counts with."""
    if "angle" in run.columns and test.instrument in ("static-force", "sensor-frame", "joint-probe"):
        run = replace(run, columns={})
    if test.instrument == "positioning":
        seen = test.setup.observe(test.machine, run)
        return seen.commands, seen.velocity
    count = max(map(len, run.columns.values()), default=1)
    columns = {**run.columns, **{name: np.zeros(count) for name in test.setup.quantities if name not in run.columns}}
    seen = test.setup.observe(test.machine, replace(run, columns=columns))
    return seen.commands, seen.velocity


def test_every_instrument_that_moves_is_here() -> None:
    still = {name for name in instruments() if not name.startswith(("dial", "recipe"))} - MOVING
    assert still == set()


@pytest.mark.parametrize("name", CIRCLES)
def test_a_circle_is_driven_along_the_observed_commands_at_the_observed_velocity(name: str) -> None:
    test = CIRCLES[name]()
    program = test.program()
    path = program.path(test.machine, step=0.4, turn=radians(0.2))
    for run in test.runs:
        part = part_of(program, path, run.name)
        commands, velocity = observed(test, run)
        off, nearest = distance(test.machine, part, commands)
        assert off.max() < 3e-4
        difference = scaled(test.machine, part.velocity[nearest] - velocity)
        assert (
            np.linalg.norm(difference, axis=1).max() < 0.012 * np.linalg.norm(scaled(test.machine, velocity), axis=1).max()
        )


@pytest.mark.parametrize("name", PLANNED)
@pytest.mark.parametrize("flavour", sorted({*flavours()} - {"steps"}))
def test_every_flavour_drives_the_model_through_every_pose(name: str, flavour: str) -> None:
    test = PLANNED[name]()
    written = test.program()
    program = read_program_bytes(program_text(written, flavour).encode("ascii"), "x")
    path = program.path(test.machine, step=0.5, turn=radians(0.2), tolerance=2e-4)
    assert path.end_time == pytest.approx(written.path(test.machine, step=50.0).end_time, rel=2e-4)
    for run in test.runs if test.instrument != "ball-roller" else ():
        commands, _ = observed(test, run)
        off, _ = distance(test.machine, path, commands)
        poses = 6e-3 if test.instrument in ("sphere-nest", "displacement-probes") else 1e-3
        assert off.max() < poses
    stops = [block for block in program.blocks if isinstance(block, Stop)]
    assert len(stops) == sum(isinstance(block, Stop) for block in written.blocks)
    assert all(block.message for block in stops)


def test_the_arcs_are_arcs_where_the_axes_make_them() -> None:
    arcs = {name: sum(isinstance(b, Arc) for b in test().program().blocks) for name, test in CIRCLES.items()}
    lines = {"tilted", "tilted in part", "across a turned axis", "plane of the table", "table turns", "table tilts"}
    lines |= {"bar and table turn"}
    assert {name for name, count in arcs.items() if not count} == lines
    assert arcs["XY"] == 6  # three for each run: before, the readings, after


def test_a_run_is_fed_in_overshoots_and_is_fed_out() -> None:
    test = CIRCLES["XY"]()
    program = test.program(Procedure(start=pi / 2, overshoot=pi / 4, feed_in=2.5, approach=4.0))
    moves = program.moves()
    kinds = [type(block).__name__ for block in program.blocks if not isinstance(block, Comment)]
    # to the circle, three arcs, out; back outside to where the other direction begins; the same again
    assert kinds[6:] == ["Line", "Arc", "Arc", "Arc", "Line", "Line", "Arc", "Arc", "Arc", "Line", "Stop", "Line"]
    degrees = np.round(np.degrees(moves.sweep[moves.sweep != 0]), 9).tolist()
    assert degrees == [45.0, 360.0, 45.0, -45.0, -360.0, -45.0] or degrees[3] != -45.0
    x, y = (program.path(test.machine, 0.5).commands[:, test.machine.index(axis)] for axis in "XY")
    assert np.hypot(x, y).max() == pytest.approx(152.5)


def test_rolls_press_inside_of_the_circle_by_their_engagement() -> None:
    test = of_template("ball-roller")
    program = test.program()
    arcs = [block for block in program.blocks if isinstance(block, Arc)]
    moves = program.moves()
    radius = np.linalg.norm(np.take_along_axis(moves.start, moves.columns, axis=1) - moves.centre, axis=1)[moves.sweep != 0]
    wanted = [test.setup.nominal_radius - (run.engagement or 0.0) for run in test.runs for _ in range(3)]
    assert len(arcs) == len(wanted)
    np.testing.assert_allclose(radius, wanted, rtol=1e-12)
    assert len(set(np.round(radius, 6))) > 2


def test_targets_are_approached_from_their_side() -> None:
    test = of_template("positioning")
    program = test.program(Procedure(overrun=7.0, dwell=4.0))
    dwells = [k for k, block in enumerate(program.blocks) if isinstance(block, Dwell)]
    columns = test.setup._columns(test.runs[0])
    assert len(dwells) == len(test.runs) * len(columns["target"])
    moves = program.moves()
    x = {int(block): (start[0], end[0]) for block, start, end in zip(moves.block, moves.start, moves.end, strict=True)}
    for dwell, target, sense in zip(dwells, columns["target"], columns["direction"], strict=False):
        start, end = x[dwell - 1]
        assert end == pytest.approx(target)
        assert np.sign(end - start) == sense
    assert {program.blocks[k].seconds for k in dwells} == {4.0}
    assert program.extent()["X"] == pytest.approx((columns["target"].min() - 7.0, columns["target"].max() + 7.0))


def test_loads_are_changed_by_a_stop_or_a_dwell() -> None:
    test = CIRCLES["thesis"]()
    said = [block.message for block in test.program().blocks if isinstance(block, Stop)]
    assert [text for text in said if "force" in text] == ["set the force to 100 N", "set the force to 400 N"]
    waiting = test.program(Procedure(change=20.0))
    assert [block.seconds for block in waiting.blocks if isinstance(block, Dwell)] == [20.0, 20.0]
    assert not any("force" in block.message for block in waiting.blocks if isinstance(block, Stop))


@pytest.mark.parametrize(
    ("order", "names"),
    [
        ("listed", ["a", "b", "c", "d"]),
        ("counter-clockwise first", ["a", "c", "b", "d"]),
        ("by level", ["a", "d", "b", "c"]),
    ],
)
def test_runs_come_in_the_order_asked_for(order: str, names: list[str]) -> None:
    test = CIRCLES["thesis"]()
    sets = [("a", 100.0, 1), ("b", 400.0, -1), ("c", 400.0, 1), ("d", 100.0, -1)]
    runs = tuple(replace(test.runs[0], name=name, force=force, sense=sense) for name, force, sense in sets)
    blocks = replace(test, runs=runs).program(Procedure(order=order)).blocks
    texts = [block.text for block in blocks if isinstance(block, Comment)]
    assert [text.split(",")[0].removeprefix("run ") for text in texts if text.startswith("run ")] == names


def limited(test: MachineTest, **travel: tuple[float, float]) -> MachineTest:
    joints = tuple(replace(joint, travel=travel.get(joint.name, joint.travel)) for joint in test.machine.joints)
    assert all(isinstance(joint, Joint) for joint in joints)
    return replace(test, machine=replace(test.machine, joints=joints))


def test_limits_are_refused_with_axis_value_and_limit() -> None:
    test = CIRCLES["XY"]()
    with pytest.raises(PathError, match=r"needs X from 151.5 to 151.5 mm, its travel is -140 to 140 mm"):
        limited(test, X=(-140.0, 140.0)).program()
    with pytest.raises(PathError, match=r"needs X from 151.5 to 151.5 mm, its travel is -151 to 151 mm"):
        limited(test, X=(-151.0, 151.0)).program()
    assert limited(test, Z=(-10.0, 20.0)).program().extent()["Z"] == (0.0, 20.0)
    assert "Z" in limited(test, Z=(-10.0, 0.0)).program().axes
    limits = ProgramLimits(most_feed=10.0)
    with pytest.raises(PathError, match="has a feed of 1000 mm/min, the limit is 600 mm/min; choose a slower feed"):
        test.program(limits=limits)
    with pytest.raises(PathError, match="has an arc of radius 150 mm, the limits are 0 and 100 mm; choose a bar"):
        test.program(limits=ProgramLimits(most_radius=100.0))
    with pytest.raises(PathError, match="has an arc of radius 150 mm, the limits are 200 and inf mm; choose a bar"):
        test.program(limits=ProgramLimits(least_radius=200.0))
    with pytest.raises(PathError, match=r"the tool point is 160 mm from the last carriage along Z, the limits .* 100 mm"):
        test.program(limits=ProgramLimits(most_tool=100.0))
    five = circle_test(replace(CIRCLES["table turns"]().setup.circle))
    with pytest.raises(PathError, match=r"needs C from -?\d"):
        limited(five, C=(-3.0, 3.0)).program()
    targets = of_template("positioning")
    with pytest.raises(PathError, match=r"X cannot come to the target .* from below, its travel is -201.3 to 300 mm"):
        limited(targets, X=(-201.3, 300.0)).program()


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"overshoot": 180.0}, "the overshoot is 180 rad; .* is it degrees given as radians"),
        ({"start": 90.0}, "the start angle is 90 rad; .* is it degrees given as radians"),
        ({"feed_in": float("nan")}, "feed_in of the procedure is nan; it must be a number, at least 0"),
        ({"approach": 0.0}, "approach of the procedure is 0; it must be a number, above 0"),
        ({"order": "random"}, "the order of the runs is 'random'; write one of listed"),
        ({"change": -1.0}, "the change of the load takes -1 s"),
    ],
)
def test_a_procedure_that_no_machine_can_do_is_refused(settings: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        Procedure(**settings)  # type: ignore[arg-type]


def test_an_instrument_of_its_own_only_stops() -> None:
    blocks = instruments()["dial-gauge"]().program(of_template("ball-bar").machine, [Run("one", {})], Procedure())
    assert [type(block) for block in blocks] == [Comment, Stop]
    assert not any(isinstance(block, Line) for block in blocks)


def test_a_bar_at_probes_that_do_not_turn_stands_still() -> None:
    test = of_template("displacement-probes")
    still = replace(test, setup=replace(test.setup, rotary_turn={}))
    program = still.program()
    assert [type(block).__name__ for block in program.blocks if isinstance(block, Line | Arc)] == ["Line", "Line"]
    assert sum(isinstance(block, Dwell) for block in program.blocks) == len(test.runs)
