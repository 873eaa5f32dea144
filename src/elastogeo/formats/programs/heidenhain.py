"""Heidenhain Klartext, written: circles in XY about a pole, helices by their angle, all other circles as lines.

Assumed, because no public manual was found: in which sense `DR` counts out of the plane XY (so no such circle is written),
and that a feed counts along all axes with a degree as a millimetre where linear and rotary axes move together.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from math import acos, ceil, cos, degrees, hypot, sin

from elastogeo.formats.program_files import Flavour, Writing, register
from elastogeo.formats.programs.iso_writing import number, rate, said
from elastogeo.formats.programs.klartext import read_klartext
from elastogeo.formats.programs.recognised import language
from elastogeo.machine import PLANE_AXES, PROGRAM_AXES, Arc, Array, Comment, Dwell, Line, Program, Rapid, Stop

_LINEAR = 6
_CLOSED = 1e-7


def can_read(head: bytes) -> bool:
    """Whether a program begins with `BEGIN PGM`."""
    return language(head) == "heidenhain"


def write(program: Program, writing: Writing) -> str:
    """A program in Klartext, with the tool axis Z."""
    name = re.sub(r"[^A-Z0-9]+", "_", said(program.name).upper()).strip("_")[:24] or "PROGRAM"
    decimals = writing.decimals or 4
    tolerance = ["CYCL DEF 32.0 TOLERANCE", f"CYCL DEF 32.1 T{number(writing.blending, 4)}"] if writing.blending else []
    lines = [f"BEGIN PGM {name} MM", *tolerance, "M5", *_blocks(program, decimals, writing), "M2", f"END PGM {name} MM"]
    return "\n".join(f"{k} {line}" for k, line in enumerate(lines)) + "\n"


def _blocks(program: Program, decimals: int, writing: Writing) -> Iterator[str]:
    moves = program.moves()
    row = 0
    for block in program.blocks:
        match block:
            case Comment(text):
                yield f"; {said(text).upper()}"
            case Stop(message):
                yield f"STOP ; {said(message).upper()}" if message else "STOP"
            case Dwell(seconds):
                yield "CYCL DEF 9.0 DWELL TIME"
                yield f"CYCL DEF 9.1 DWELL {number(seconds, 3)}"
            case Rapid(to):
                yield f"L{_words(to, decimals)} R0 FMAX"
                row += 1
            case Line(to, feed):
                change = moves.end[row] - moves.start[row]
                yield f"L{_words(to, decimals)} R0{_feed(feed, change)}"
                row += 1
            case Arc():
                yield from _arc(block, moves.start[row], moves.end[row], float(moves.sweep[row]), decimals, writing)
                row += 1


def _words(to: Mapping[str, float], decimals: int) -> str:
    return "".join(f" {axis}{_signed(degrees(v) if axis in 'ABC' else v, decimals)}" for axis, v in to.items())


def _signed(value: float, decimals: int) -> str:
    text = number(value, decimals)
    return text if text.startswith("-") else f"+{text}"


def _feed(feed: float, change: Array) -> str:
    """The word F of a line: where rotary axes move along, of all axes with a degree as a millimetre."""
    linear = hypot(*change[:_LINEAR].tolist())
    rotary = hypot(*(degrees(part) for part in change[_LINEAR:].tolist()))
    if not rotary:
        return f" F{rate(60 * feed)}"
    return f" F{rate(60 * feed * hypot(linear, rotary) / linear if linear else 60 * degrees(feed))}"


def _arc(arc: Arc, start: Array, end: Array, sweep: float, decimals: int, writing: Writing) -> Iterator[str]:
    """A circle in XY, a helix about Z, or lines."""
    axes = PLANE_AXES[arc.plane]
    others = {axis: value for axis, value in arc.to.items() if axis not in axes}
    if arc.plane != "XY" or set(others) - {"Z"}:
        yield from _lines(arc, start, end, sweep, decimals, writing)
        return
    begin = [round(float(value), decimals) for value in start[:2]]
    finish = [round(float(value), decimals) for value in end[:2]]
    whole = hypot(*(end[:2] - start[:2])) <= _CLOSED
    way, feed = "DR+" if arc.sense > 0 else "DR-", f" F{rate(60 * arc.feed)}"
    if finish == begin and not whole:  # too short for the decimals: as a circle it would be a full one
        yield f"L{_words(arc.to, decimals)} R0{feed}"
        return
    yield f"CC X{_signed(arc.centre[0], decimals)} Y{_signed(arc.centre[1], decimals)}"
    if others or arc.turns > 1:
        rise = f" IZ{_signed(end[2] - start[2], decimals)}" if others else ""
        yield f"CP IPA{_signed(degrees(sweep), 6)}{rise} {way}{feed}"
        return
    place = begin if whole else finish
    yield f"C X{_signed(place[0], decimals)} Y{_signed(place[1], decimals)} {way}{feed}"


def _lines(arc: Arc, start: Array, end: Array, sweep: float, decimals: int, writing: Writing) -> Iterator[str]:
    """An arc as lines that leave it by the chord of the writing at most."""
    columns = [PROGRAM_AXES.index(axis) for axis in PLANE_AXES[arc.plane]]
    first, second = (float(start[column]) - centre for column, centre in zip(columns, arc.centre, strict=True))
    radius = hypot(first, second)
    step = min(2 * acos(max(1 - writing.chord / radius, -1.0)), writing.turn_step)
    count = max(ceil(abs(sweep) / step), 1)
    before = start
    length = hypot(radius * abs(sweep), *(float(end[k] - start[k]) for k in range(_LINEAR) if k not in columns))
    time = length / arc.feed / count
    for k in range(1, count + 1):
        turned = sweep * k / count
        place = start + (end - start) * k / count
        if k < count:
            place[columns[0]] = arc.centre[0] + first * cos(turned) - second * sin(turned)
            place[columns[1]] = arc.centre[1] + first * sin(turned) + second * cos(turned)
        else:
            place[columns] = end[columns]
        change = place - before
        feed = hypot(*change[:_LINEAR].tolist()) / time
        moved = {axis: float(place[k]) for k, axis in enumerate(PROGRAM_AXES) if change[k] or axis in PLANE_AXES[arc.plane]}
        yield f"L{_words(moved, decimals)} R0{_feed(feed, change)}"
        before = place


_SAMPLE = """\
0 BEGIN PGM CIRCLE MM
1 L X+101.5 Y+0.0 R0 FMAX
2 L X+100.0 R0 F300.0
3 CC X+0.0 Y+0.0
4 C X+100.0 Y+0.0 DR+ F1000.0
5 CYCL DEF 9.0 DWELL TIME
6 CYCL DEF 9.1 DWELL 1.5
7 M2
8 END PGM CIRCLE MM
"""
register(Flavour("heidenhain", "Heidenhain Klartext", ".h", can_read, read_klartext, write, lambda: _SAMPLE))
