"""Programs of words, a letter and a number each (ISO 6983): LinuxCNC, Fanuc and their like, read."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator

from elastogeo.errors import FormatError
from elastogeo.formats.program_files import Reading
from elastogeo.formats.programs.modal import Dialect, Modal
from elastogeo.formats.text.delimited import utf8_text
from elastogeo.machine import Program

MOST_IN_LINE = 4000
"""Characters that a block may have."""

SHOWN = 40
_WORD = re.compile(r"([A-Z])([+-]?(?:\d+\.?\d*|\.\d+))", re.ASCII)
_WORDS = re.compile(r"(?:[A-Z][+-]?(?:\d+\.?\d*|\.\d+))*", re.ASCII)
_COMMENT = re.compile(r"\(([^()]*)\)")
_SPECIAL = frozenset("GMNOSTHD")
"""Words that are no positions: of these S, T, H, D move nothing (spindle, tool, offsets)."""

_NO_WORDS = str.maketrans("", "", " \t\r\n\x0b\x0c\ufeff")
_STOPS, _CALLS = frozenset({0, 1}), frozenset({97, 98, 198})
_POSITIONS = frozenset("XYZUVWABCIJKR")


def program_lines(data: bytes, source: str) -> Iterator[tuple[int, str]]:
    """The lines of a program with their numbers from 1.

    Raises
    ------
    FormatError
        If it is no text, or a line is longer than any block.
    """
    try:
        text = utf8_text(data)
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None
    for number, coded in enumerate(io.BytesIO(text), 1):
        line = coded.decode()
        if len(line) > MOST_IN_LINE:
            raise FormatError(
                f"{source}, line {number}: has {len(line)} characters, and a block has {MOST_IN_LINE} at most; "
                "is it a program?"
            )
        yield number, line


def read_iso(data: bytes, source: str, reading: Reading, dialect: Dialect, *, point_matters: bool = False) -> Program:
    """A program of words.

    Parameters
    ----------
    data : bytes
    source : str
        For messages.
    reading : Reading
    dialect : Dialect
    point_matters : bool
        Whether the control may take a number without a decimal point in its least increment.

    Raises
    ------
    FormatError
        At the first line that cannot be followed.
    """
    modal = Modal(source, dialect, reading)
    opened, name, increments = False, "", 0
    for number, line in program_lines(data, source):
        modal.number = number
        comment = ""
        if "(" in line or ";" in line:
            line, comment = _split(line, modal)
        text = line.translate(_NO_WORDS).upper()
        if text.startswith("/"):
            modal.left_out["marks of blocks to skip (/), which are not skipped"] += 1
            text = text.lstrip("/0123456789")
        if text.startswith("%"):
            modal.ended = modal.ended or opened
            opened = True
            continue
        if modal.ended:
            if text:
                modal.left_out["lines after the end of the program"] += 1
            continue
        if not text:
            if comment:
                modal.comment(comment)
            continue
        if _WORDS.fullmatch(text) is None:
            raise modal.fail(_why_not(text))
        codes, words, functions = [], {}, []
        for letter, value in _WORD.findall(text):
            if letter not in _SPECIAL:
                if letter in words:
                    raise modal.fail(f"the word {letter} stands twice in one block; take one out")
                words[letter] = float(value)
                if point_matters and "." not in value and letter in _POSITIONS:
                    increments += value.strip("+-0") != ""
                    words[letter] *= 0.001 if reading.whole_numbers == "um" else 1.0
            elif letter == "G":
                codes.append(float(value))
            elif letter == "M":
                functions.append(int(float(value)))
                if functions[-1] in _CALLS:
                    raise modal.fail(f"M{value} calls another program; post-process one program without calls")
            elif letter == "O":
                name = name or f"O{value}"
            elif letter != "N":
                modal.left_out[f"{letter}{value}"] += 1
        if comment and not set(functions) & _STOPS:
            modal.comment(comment)
        if codes or words:
            modal.block(codes, words)
        if functions:
            _do(functions, comment, modal)
    if increments:
        modal.left_out[f"numbers without a decimal point taken in {reading.whole_numbers}"] += increments
    return modal.program(name or source)


def _do(functions: list[int], comment: str, modal: Modal) -> None:
    """What the words M of a block do after its motion."""
    for function in functions:
        if function in _STOPS:
            modal.stop(comment)
        elif function in modal.dialect.ends:
            modal.ended = True
        else:
            modal.left_out[f"M{function}"] += 1


def _split(line: str, modal: Modal) -> tuple[str, str]:
    """A line without its comments, and these; `(MSG, ...)` and `(DEBUG, ...)` are what they say."""
    found = [re.sub(r"(?i)^(msg|print|debug),", "", text).strip() for text in _COMMENT.findall(line)]
    line = _COMMENT.sub(" ", line)
    line, _, rest = line.partition(";")
    if "(" in line or ")" in line:
        raise modal.fail(f"the comment in {line.strip()[:SHOWN]!r} does not close; write both brackets on one line")
    return line, " ".join(filter(None, [*found, rest.strip()]))


def _why_not(text: str) -> str:
    """Why a line is no sequence of words."""
    good = _WORDS.match(text)
    rest = text[good.end() if good else 0 :]
    shown = f"{rest[:SHOWN]!r} is not understood"
    if any(sign in text for sign in "#[]=<>*"):
        return f"{shown}: variables and expressions are not computed; post-process the program to plain numbers"
    if re.match(r"[A-Z][+-]?(NAN|INF)", rest):
        return f"{shown}: the number is not finite; post-process the program again"
    if "," in rest:
        return f"{shown}: a decimal mark is a point, and a corner with ,R or ,C is not rounded here; write plain blocks"
    return f"{shown}: a block is made of words such as X1.5; correct it, or name another flavour"
