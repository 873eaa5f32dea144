"""Programs of words, a letter and a number each (ISO 6983): LinuxCNC, Fanuc, SINUMERIK, written."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from math import degrees, hypot, pi

import numpy as np

from elastogeo.errors import InputError
from elastogeo.formats.program_files import Writing
from elastogeo.machine import PLANE_AXES, PROGRAM_AXES, Arc, Array, Comment, Dwell, Line, Program, Rapid, Stop

_LINEAR = 6
_PLANE_WORDS = {"XY": "G17", "YZ": "G19", "ZX": "G18"}
_CENTRE_WORDS = {"X": "I", "Y": "J", "Z": "K"}
_CLOSED = 1e-7
_SAID = str.maketrans({"(": "[", ")": "]", ";": ",", "°": " deg", "µ": "u", "μ": "u", '"': "'", "%": " percent", "×": "x"})


@dataclass(frozen=True, slots=True)
class Language:
    """How a control of this family is told what it is to do.

    Attributes
    ----------
    decimals : int
        Of millimetres and degrees.
    begin, end : callable
        The lines before and after the blocks, of a program and how it is written.
    comment, stop, dwell : callable
        The line of a comment, of a stop with a message, of a dwell of so many seconds.
    turns : str
        Word of the turns of an arc; empty to write every turn as a block of its own.
    inverse_time : bool
        Whether a block that moves linear and rotary axes together says how many of it fit in a minute (G93).
    """

    decimals: int
    begin: Callable[[Program, Writing], list[str]]
    end: Callable[[Program, Writing], list[str]]
    comment: Callable[[str], str]
    stop: Callable[[str], str]
    dwell: Callable[[float], str]
    turns: str = ""
    inverse_time: bool = True


def iso_text(program: Program, writing: Writing, language: Language) -> str:
    """The text of a program of words."""
    language = replace(language, decimals=writing.decimals or language.decimals)
    body = list(_blocks(program, language))
    lines = "\n".join(language.begin(program, writing) + body + language.end(program, writing)).split("\n")
    if writing.numbers:
        lines = [f"N{10 * k} {line}" if line[:1].isalpha() else line for k, line in enumerate(lines, 1)]
    return "\n".join(lines) + "\n"


def said(text: str) -> str:
    """A text in the letters that every control can show: ASCII without brackets, on one line."""
    plain = unicodedata.normalize("NFKD", text.translate(_SAID)).encode("ascii", "ignore").decode()
    return " ".join(plain.split())


def number(value: float, decimals: int) -> str:
    """A number with a decimal point and without needless zeros: `12.5`, `-3.0`."""
    text = f"{value:.{decimals}f}".rstrip("0")
    text = f"{text}0" if text.endswith(".") else text
    return "0.0" if float(text) == 0 else text


def rate(value: float) -> str:
    """A feed with six significant digits, never with an exponent."""
    text = np.format_float_positional(value, precision=6, fractional=False, trim="0")
    return str(text)


@dataclass(slots=True)
class _State:
    """What the control has been told so far, in the decimals written."""

    plane: str = ""
    feed: str = ""
    inverse: bool = False


def _blocks(program: Program, language: Language) -> Iterator[str]:
    """The lines of all blocks."""
    moves = program.moves()
    state, row = _State(), 0
    for block in program.blocks:
        match block:
            case Comment(text):
                yield language.comment(text)
            case Stop(message):
                yield language.stop(message)
            case Dwell(seconds):
                yield language.dwell(seconds)
            case Rapid(to):
                yield f"G0{_words(to, language.decimals)}"
                row += 1
            case Line(to, feed):
                change = moves.end[row] - moves.start[row]
                length = float(moves.length[row])
                yield from _line(to, feed, change, length, language, state)
                row += 1
            case Arc():
                yield from _arc(block, moves.start[row], float(moves.sweep[row]), language, state)
                row += 1


def _words(to: Mapping[str, float], decimals: int) -> str:
    return "".join(f" {axis}{number(degrees(v) if axis in 'ABC' else v, decimals)}" for axis, v in to.items())


def _line(
    to: Mapping[str, float],
    feed: float,
    change: Array,
    length: float,
    language: Language,
    state: _State,
) -> Iterator[str]:
    linear, rotary = bool(change[:_LINEAR].any()), bool(change[_LINEAR:].any())
    if linear and rotary and language.inverse_time:
        yield from _mode(state, inverse=True)
        state.feed = ""
        yield f"G1{_words(to, language.decimals)} F{rate(60.0 * feed / length)}"
        return
    yield from _mode(state, inverse=False)
    yield f"G1{_words(to, language.decimals)}{_feed(degrees(feed) if rotary and not linear else feed, state)}"


def _mode(state: _State, *, inverse: bool) -> Iterator[str]:
    if inverse != state.inverse:
        state.inverse, state.feed = inverse, ""
        yield "G93" if inverse else "G94"


def _feed(feed: float, state: _State) -> str:
    """The word F where the feed is another than before."""
    text = rate(60.0 * feed)
    if text == state.feed:
        return ""
    state.feed = text
    return f" F{text}"


def _arc(arc: Arc, start: Array, sweep: float, language: Language, state: _State) -> Iterator[str]:
    yield from _mode(state, inverse=False)
    if arc.plane != state.plane:
        state.plane = arc.plane
        yield _PLANE_WORDS[arc.plane]
    for part, turns in _parts(arc, start, sweep, several=bool(language.turns)):
        yield from _one_arc(part, start, turns, language, state)
        for axis, value in part.to.items():
            start[PROGRAM_AXES.index(axis)] = value


def _one_arc(arc: Arc, start: Array, turns: int, language: Language, state: _State) -> Iterator[str]:
    d = language.decimals
    axes = PLANE_AXES[arc.plane]
    begin = [round(float(start[PROGRAM_AXES.index(axis)]), d) for axis in axes]
    end = [round(arc.to.get(axis, value), d) for axis, value in zip(axes, begin, strict=True)]
    others = {axis: value for axis, value in arc.to.items() if axis not in axes}
    whole = hypot(*(arc.to.get(axis, start[PROGRAM_AXES.index(axis)]) - start[PROGRAM_AXES.index(axis)] for axis in axes))
    if whole <= _CLOSED:
        end = begin
    elif end == begin:  # too short for the decimals: written as an arc it would be a full circle
        yield f"G1{_words(arc.to, d)}{_feed(arc.feed, state)}"
        return
    places = "".join(f" {axis}{number(value, d)}" for axis, value in zip(axes, end, strict=True))
    centre = zip(axes, arc.centre, begin, strict=True)
    offsets = "".join(f" {_CENTRE_WORDS[axis]}{number(round(c, d) - b, d)}" for axis, c, b in centre)
    more = f" {language.turns}{turns}" if turns > 1 else ""
    yield f"G{3 if arc.sense > 0 else 2}{places}{_words(others, d)}{offsets}{more}{_feed(arc.feed, state)}"


def _parts(arc: Arc, start: Array, sweep: float, *, several: bool) -> Iterator[tuple[Arc, int]]:
    """An arc with its turns, or one part for each turn."""
    if arc.turns == 1 or several:
        yield arc, arc.turns
        return
    out = {axis: value for axis, value in arc.to.items() if axis not in PLANE_AXES[arc.plane]}
    if any(axis in "ABC" for axis in out):
        raise InputError(
            "an arc of several turns moves a rotary axis along, and this control has no word for its turns; write every turn"
        )
    begin = {axis: float(start[PROGRAM_AXES.index(axis)]) for axis in (*PLANE_AXES[arc.plane], *out)}
    for turn in range(1, arc.turns):
        part = 2 * pi * turn / abs(sweep)
        along = {axis: begin[axis] + (out[axis] - begin[axis]) * part for axis in out}
        yield (
            Arc(
                arc.plane,
                {**{axis: begin[axis] for axis in PLANE_AXES[arc.plane]}, **along},
                arc.centre,
                arc.sense,
                arc.feed,
            ),
            1,
        )
    yield Arc(arc.plane, arc.to, arc.centre, arc.sense, arc.feed), 1
