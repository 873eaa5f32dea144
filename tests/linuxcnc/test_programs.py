"""LinuxCNC's own interpreter makes of our programs the moves that were planned: both radii and the sweep recomputed."""

from __future__ import annotations

from math import atan2, degrees, hypot, pi
from pathlib import Path

import numpy as np
import pytest

from elastogeo.formats import Writing, program_text
from elastogeo.machine import PLANE_AXES, Arc, Line, Program, Rapid
from tests.formats.test_programs import blocks
from tests.linuxcnc.interpreter import Canonical, interpret
from tests.linuxcnc.unpacked import linuxcnc_or_skip
from tests.observe.planned_programs import planned_tests

AXES = "XYZABC"
PRINTED = 1e-4
"""The interpreter prints four decimals."""


def check_moves(program: Program, canonical: list[Canonical], decimals: int, turns_apart: bool) -> int:
    """Every canonical move is the planned one; how many were looked at."""
    moves = program.moves()
    near = PRINTED + 10.0**-decimals
    at = np.zeros(6)
    found = iter([move for move in canonical if move.kind != "DWELL"])
    row = seen = 0
    named: set[str] = set()
    for block in program.blocks:
        if not isinstance(block, Rapid | Line | Arc):
            continue
        end = [moves.end[row][k] if k < 6 else degrees(moves.end[row][k]) for k in (0, 1, 2, 6, 7, 8)]
        parts = block.turns if isinstance(block, Arc) and turns_apart else 1
        sweep = 0.0
        for _ in range(parts):
            move = next(found)
            seen += 1
            if isinstance(block, Arc):
                at, angle = arc_of(move, at, block, near)
                sweep += angle
                assert move.feed == pytest.approx(60 * block.feed, rel=1e-4, abs=1e-3)
            else:
                assert move.kind == ("STRAIGHT_TRAVERSE" if isinstance(block, Rapid) else "STRAIGHT_FEED")
                at = np.array(move.values)
                if isinstance(block, Line):
                    turned = not np.any(moves.end[row][:3] - moves.start[row][:3])
                    feed = 60 * (degrees(block.feed) if turned else block.feed)
                    # in inverse time the control counts the feed along the digits that were written
                    assert abs(move.feed - feed) <= feed * (2e-4 + near / moves.length[row]) + 1e-3
        named |= set(block.to)
        # where the other axes stand at the beginning, no program says
        off = [abs(got - wanted) for axis, got, wanted in zip(AXES, at, end, strict=True) if axis in named]
        assert max(off) <= near
        if isinstance(block, Arc):
            assert sweep == pytest.approx(moves.sweep[row], abs=4 * near)
        row += 1
    assert next(found, None) is None
    return seen


def arc_of(move: Canonical, start: np.ndarray, arc: Arc, near: float) -> tuple[np.ndarray, float]:
    """The end of a canonical arc, and its sweep [rad] recomputed from its own numbers; both radii are the planned one."""
    assert move.kind == "ARC_FEED"
    assert move.plane == arc.plane
    first, second, centre_1, centre_2, turns, along, *rotary = move.values
    assert (centre_1, centre_2) == pytest.approx(arc.centre, abs=2 * near)
    columns = [AXES.index(axis) for axis in PLANE_AXES[arc.plane]]
    a, b = start[columns[0]] - centre_1, start[columns[1]] - centre_2
    c, d = first - centre_1, second - centre_2
    planned = hypot(a, b)
    assert hypot(c, d) == pytest.approx(planned, abs=3 * near)
    sense = 1 if turns > 0 else -1
    assert sense == arc.sense
    part = (atan2(d, c) - atan2(b, a)) * sense % (2 * pi)
    if hypot(c - a, d - b) < 3 * near:
        part = 2 * pi
    end = np.array([0.0, 0.0, 0.0, *rotary])
    end[columns] = first, second
    end[({0, 1, 2} - set(columns)).pop()] = along
    return end, sense * (part + 2 * pi * (abs(turns) - 1))


@pytest.mark.parametrize(("flavour", "decimals"), [("linuxcnc", 6), ("iso", 4), ("iso", 3)])
@pytest.mark.parametrize("seed", range(4))
def test_everything_that_a_program_can_say(flavour: str, decimals: int, seed: int, tmp_path: Path) -> None:
    linuxcnc_or_skip()
    program = Program("everything", list(blocks(seed)))
    canonical = interpret(program_text(program, flavour, Writing(decimals=decimals)), tmp_path)
    assert check_moves(program, canonical, decimals, turns_apart=flavour == "iso") > 20
    assert [move.values for move in canonical if move.kind == "DWELL"] == [(2250.0,) if flavour == "iso" else (2.25,)]


@pytest.mark.parametrize("name", planned_tests())
@pytest.mark.parametrize("flavour", ["linuxcnc", "iso"])
def test_the_program_of_every_planned_test(name: str, flavour: str, tmp_path: Path) -> None:
    linuxcnc_or_skip()
    program = planned_tests()[name]().program()
    canonical = interpret(program_text(program, flavour), tmp_path)
    moves = check_moves(program, canonical, 6 if flavour == "linuxcnc" else 4, turns_apart=flavour == "iso")
    assert moves == sum(isinstance(block, Rapid | Line | Arc) for block in program.blocks) > 0
