"""An independent interpreter makes of our SINUMERIK programs the moves that were planned, arcs as its own lines too."""

from __future__ import annotations

import re
from functools import cache
from math import degrees, hypot, pi

import numpy as np
import pytest

from elastogeo.formats import Writing, program_text
from elastogeo.machine import PLANE_AXES, Arc, Dwell, Line, Program, Rapid
from elastogeo.observe import Procedure
from tests.formats.test_programs import blocks
from tests.observe.planned_programs import planned_tests
from tests.sinumerik.interpreter import Interpreted, interpret, interpreter_or_skip

COLUMNS = dict(zip("XYZABC", (0, 1, 2, 6, 7, 8), strict=True))
PLANES = {"XY": "G17", "YZ": "G19", "ZX": "G18"}
CENTRES = {"X": "I", "Y": "J", "Z": "K"}
NEAR = 2e-5
"""Five decimals are written."""

FLAT = 2e-3
"""The interpreter's own lines leave an arc by half of this at most [mm]."""

SEEDS = [f"everything {seed}" for seed in range(3)]


@cache
def program_of(name: str) -> Program:
    if name in SEEDS:
        return Program(name, list(blocks(int(name.split()[1]))))
    return planned_tests()[name]().program(Procedure(chord=0.05, between=0.2))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Interpreted]:
    interpreter_or_skip()
    names = [*SEEDS, *planned_tests()]
    texts = [text_of(program_of(name)) for name in names]
    return dict(zip(names, interpret(texts, tmp_path_factory.mktemp("sinumerik")), strict=True))


def text_of(program: Program) -> str:
    return program_text(program, "sinumerik", Writing(decimals=5))


@pytest.mark.parametrize("name", [*SEEDS, *planned_tests()])
def test_the_moves_are_those_that_were_planned(name: str, made: dict[str, Interpreted]) -> None:
    program, moves = program_of(name), program_of(name).moves()
    text = text_of(program).splitlines()
    lines = [k for k, line in enumerate(text, 1) if re.match(r"G[0-3] ", line)]
    shown = iter(lines)
    named: set[str] = set()
    planned = [block for block in program.blocks if isinstance(block, Rapid | Line | Arc)]
    for block, start, end, sweep in zip(planned, moves.start, moves.end, moves.sweep.tolist(), strict=True):
        named |= set(block.to)
        turned = 0.0
        for _ in range(block.turns if isinstance(block, Arc) else 1):
            line = next(shown)
            row = made[name].blocks[line]
            kind = "G0" if isinstance(block, Rapid) else "G1" if isinstance(block, Line) else "G3" if sweep > 0 else "G2"
            assert row["gg01_motion"] == kind
            if isinstance(block, Arc):
                turned += swept(block, made[name].blocks[line], made[name].flat[line], start)
        off = [abs(row[axis] - (degrees(end[k]) if k > 5 else end[k])) for axis, k in COLUMNS.items() if axis in named]
        assert max(off) < NEAR
        assert turned == pytest.approx(sweep, abs=1e-4)
        if not isinstance(block, Rapid) and row["gg15_feed_type"] == "G94":
            alone = isinstance(block, Line) and not np.any(end[:6] - start[:6])
            assert row["F"] == pytest.approx(60 * (degrees(block.feed) if alone else block.feed), rel=1e-5)
    assert next(shown, None) is None
    waits = [row["dwell"] for line, row in made[name].blocks.items() if text[line - 1].startswith("G4 ")]
    assert waits == [block.seconds for block in program.blocks if isinstance(block, Dwell)]


def swept(arc: Arc, row: dict[str, float], parts: list[dict[str, float]], start: np.ndarray) -> float:
    """The angle that the interpreter's own lines go around the planned centre, on the planned radius."""
    assert row["gg06_plane_select"] == PLANES[arc.plane]
    axes = PLANE_AXES[arc.plane]
    begin = [start[COLUMNS[axis]] for axis in axes]
    for axis, centre, at in zip(axes, arc.centre, begin, strict=True):
        assert row[CENTRES[axis]] == pytest.approx(centre - at, abs=2 * NEAR)
    points = np.array([begin, *([part[axis] for axis in axes] for part in parts)]) - arc.centre
    radius = hypot(*points[0])
    assert np.abs(np.linalg.norm(points, axis=1) - radius).max() < FLAT
    angle = np.unwrap(np.arctan2(points[:, 1], points[:, 0]), discont=pi)
    return float(angle[-1] - angle[0])
