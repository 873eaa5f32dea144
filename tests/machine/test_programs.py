"""The neutral program: blocks that are packed and come back, and the path that they command."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from elastogeo.errors import InputError, MachineError, PathError
from elastogeo.machine import Arc, Block, Comment, Dwell, Line, Program, Rapid, Stop
from tests.conftest import build_machine

MACHINE = build_machine("wCAFYXZSt")
CIRCLE: list[Block] = [
    Comment("start"),
    Rapid({"X": 10.0, "Y": 0.0, "Z": 5.0}),
    Line({"X": 0.0}, 20.0),
    Dwell(1.5),
    Arc("XY", {"X": 0.0, "Y": 0.0}, (100.0, 0.0), 1, 10.0),
    Stop("look"),
    Arc("XY", {"X": 200.0, "Y": 0.0}, (100.0, 0.0), -1, 10.0),
]


def test_blocks_come_back_as_they_were_given() -> None:
    program = Program("p", CIRCLE)
    assert list(program.blocks) == CIRCLE
    assert program == Program("p", CIRCLE)
    assert program != Program("p", CIRCLE[:-1])
    assert program.axes == ("X", "Y", "Z")
    assert repr(program) == "<Program 'p': 7 blocks, X Y Z>"


def test_a_circle_keeps_its_radius_sense_and_feed() -> None:
    path = Program("p", CIRCLE).path(MACHINE, step=0.5)
    x, y = (path.commands[:, MACHINE.index(axis)] for axis in "XY")
    arcs = path.block >= 4
    np.testing.assert_allclose(np.hypot(x[arcs] - 100, y[arcs]), 100, rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(path.velocity[arcs], axis=1), 10.0, rtol=1e-12)
    full = np.unwrap(np.arctan2(y, x - 100)[path.block == 4])
    assert full[-1] - full[0] == pytest.approx(2 * pi, abs=0.01)
    assert full[1] > full[0]
    half = path.block == 6
    assert y[half].max() > 99.9  # clockwise from x = 0: over the top
    assert y[half].min() > -1e-9
    assert tuple(path.commands[-1][[MACHINE.index("X"), MACHINE.index("Y")]]) == (200.0, 0.0)
    assert path.end_time == pytest.approx(0.5 + 1.5 + 2 * pi * 10 + pi * 10)


def test_velocity_is_the_derivative_of_the_path() -> None:
    helix = Arc("ZX", {"Z": 0.0, "X": 0.0, "Y": 7.0, "C": 0.4}, (30.0, 40.0), -1, 12.0, turns=2)
    program = Program("p", [Rapid({"X": 0.0, "Y": 0.0, "Z": 0.0, "C": 0.0}), helix])
    path = program.path(MACHINE, step=0.05)
    slope = np.gradient(path.commands, path.time, axis=0)
    np.testing.assert_allclose(path.velocity[2:-2], slope[2:-2], atol=1e-3)
    linear = [MACHINE.index(axis) for axis in "XYZ"]
    np.testing.assert_allclose(np.linalg.norm(path.velocity[:, linear], axis=1), 12.0, rtol=1e-9)
    z, x = (path.commands[:, MACHINE.index(axis)] for axis in "ZX")
    np.testing.assert_allclose(np.hypot(z - 30, x - 40), 50.0, atol=1e-11)
    assert program.moves().sweep[-1] == pytest.approx(-4 * pi)


@pytest.mark.parametrize(("plane", "axes"), [("XY", "XY"), ("YZ", "YZ"), ("ZX", "ZX")])
def test_counter_clockwise_goes_from_the_first_axis_to_the_second(plane: str, axes: str) -> None:
    first, second = axes
    quarter = Arc(plane, {first: 0.0, second: 10.0}, (0.0, 0.0), 1, 5.0)
    program = Program("p", [Rapid({first: 10.0, second: 0.0}), quarter])
    assert program.moves().sweep[-1] == pytest.approx(pi / 2)
    middle = program.path(MACHINE, step=1e9, turn=1).commands
    assert len(middle) == 1


def test_the_extent_of_an_arc_is_where_it_bulges() -> None:
    bulge = Arc("XY", {"X": -6.0, "Y": 8.0}, (0.0, 0.0), 1, 5.0)
    program = Program("p", [Rapid({"X": 6.0, "Y": 8.0}), bulge])
    assert program.extent() == {"X": (-6.0, 6.0), "Y": (8.0, 10.0)}
    other = Program("p", [Rapid({"X": 6.0, "Y": 8.0}), replace(bulge, sense=-1)])
    assert other.extent() == {"X": (-10.0, 10.0), "Y": (-10.0, 8.0)}


def test_rotary_axes_alone_turn_at_their_own_feed() -> None:
    path = Program("p", [Rapid({"C": 0.0}), Line({"C": 1.0}, 0.1)]).path(MACHINE, step=1.0, turn=0.01)
    assert len(path) == 100
    assert path.end_time == pytest.approx(10.0)
    np.testing.assert_allclose(path.velocity[:, MACHINE.index("C")], 0.1)


def test_parts_of_a_path_are_the_path() -> None:
    program = Program("p", CIRCLE * 3)
    whole = program.path(MACHINE, step=1.0)
    parts = list(program.paths(MACHINE, step=1.0, blocks=4))
    assert len(parts) == 3
    for name in ("commands", "velocity", "block", "feed", "time"):
        joined = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_allclose(joined, getattr(whole, name), rtol=1e-14, err_msg=name)


@pytest.mark.parametrize(
    ("blocks", "message"),
    [
        (
            [Rapid({"X": 0.0}), Line({"X": 2.0}, 1.0), Line({"X": 1.0}, 0.0)],
            "block 3 of the program has no positive",
        ),
        ([Rapid({"X": 0.0}), Line({"X": float("inf")}, 1.0)], "block 2 of the program has a number that is not finite"),
        ([Rapid({"X": 0.0, "Y": 0.0}), Arc("XY", {"X": 0.0}, (0.0, 0.0), 1, 1.0)], "block 2 .* is an arc of radius zero"),
        ([Rapid({"X": 0.0, "Y": 0.0}), Arc("XY", {"X": 9.0}, (5.0, 0.0), 1, 1.0)], "1 mm off its circle, more than 0.01 mm"),
    ],
)
def test_what_no_machine_can_do_is_refused(blocks: list[Block], message: str) -> None:
    with pytest.raises(PathError, match=message):
        Program("p", blocks).path(MACHINE, step=1.0, tolerance=0.01)


def test_axes_that_are_not_there_are_refused() -> None:
    with pytest.raises(MachineError, match="has no axis B, which the program moves"):
        Program("p", [Line({"B": 1.0}, 1.0)]).path(MACHINE, step=1.0)
    with pytest.raises(InputError, match="a block moves the axis 'Q'; axes are X Y Z"):
        Program("p", [Line({"Q": 1.0}, 1.0)])
    with pytest.raises(InputError, match="a block moves X to nan; give a number"):
        Program("p", [Line({"X": float("nan")}, 1.0)])
    with pytest.raises(InputError, match="an arc in plane 'XZ' of sense 1"):
        Program("p", [Arc("XZ", {"X": 1.0}, (0.0, 0.0), 1, 1.0)])
