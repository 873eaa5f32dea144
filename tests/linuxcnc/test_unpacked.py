"""LinuxCNC is there, and its interpreter runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.linuxcnc.interpreter import RefusedError, interpret
from tests.linuxcnc.unpacked import linuxcnc_or_skip


def test_the_interpreter_reads_a_circle(tmp_path: Path) -> None:
    linuxcnc_or_skip()
    moves = interpret("G21 G17 G90\nG0 X100 Y0 Z0\nG1 F600 X99\nG3 X99 Y0 I-99 J0\nG4 P0.5\nM2\n", tmp_path)
    assert [move.kind for move in moves] == ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED", "DWELL"]
    assert moves[2].values[:5] == (99.0, 0.0, 0.0, 0.0, 1.0)
    assert moves[2].feed == 600.0


def test_the_interpreter_refuses_an_arc_that_is_none(tmp_path: Path) -> None:
    linuxcnc_or_skip()
    with pytest.raises(RefusedError, match=r"[Rr]adius"):
        interpret("G21 G17 G90\nG0 X100 Y0 Z0\nG3 F600 X80 Y0 I-100 J0\nM2\n", tmp_path)
