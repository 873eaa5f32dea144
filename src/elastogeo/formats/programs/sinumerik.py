"""SINUMERIK: words of ISO 6983 with names of their own (`CR=`, `TURN=`), positions as `IC()` and `AC()`, messages.

Assumed, because no public manual was found: `TURN=n` counts turns beside the arc itself; where linear and rotary axes move
together in feed per minute, the feed counts along the linear ones. Neither is relied on in writing: every turn is a block,
and blocks that move both say how many of them fit in a minute (`G93`).
"""

from __future__ import annotations

import re

from elastogeo.formats.program_files import Flavour, Reading, Writing, register
from elastogeo.formats.programs.iso_text import SHOWN, program_lines
from elastogeo.formats.programs.iso_writing import Language, iso_text, number, said
from elastogeo.formats.programs.modal import Dialect, Modal
from elastogeo.formats.programs.recognised import language
from elastogeo.machine import Program

DIALECT = Dialect(
    "SINUMERIK",
    radius="CR",
    turns="TURN",
    more_turns=1,
    feed_counts="linear",
    ends=(2, 17, 30),
    harmless=frozenset(
        {60, 64, 450, 451, 500, 601, 602, 603, 641, 642, 643, 644, 645, 710, 290, 291, *range(505, 600), *range(805, 840)}
    ),
)
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)"
_WORD = re.compile(rf"([A-Z]+)=(?:(AC|IC|DC|ACP|ACN)\(({_NUMBER})\)|({_NUMBER}))|([A-Z])({_NUMBER})(?![\d.=])", re.ASCII)
_CALL = re.compile(r"([A-Z]+\d*)\(([^()]*)\)")
_MESSAGE = re.compile(r"""(?i)\bMSG\s*\(\s*(?:"([^"]*)")?\s*\)""")
_HARMLESS = re.compile(
    r"SOFT|BRISK|DRIVE|FFWON|FFWOF|STOPRE|TRAFOOF|COMPOF|COMPON|COMPCAD|CFTCP|CFC|CFIN|DIAMOF|NORM|CUT2D|CDOF|WALIMON|WALIMOF"
    r"|ORIWKS|ORIMKS|ORIAXES|UPATH|SPATH|RET"
)
_SILENT = frozenset({"S", "T", "D", "H", "SPOS", "CTOL", "OTOL", "ADIS", "ADISPOS", "ACC", "FB", "FL"})
_STATED = frozenset({"FGROUP", "FGREF", "EXTERN", "PROC", "SETMS"})
_TRANSFORMS = re.compile(
    r"TRAORI|TRACYL|TRANSMIT|TRAANG|CYCLE\d+|TRANS|ATRANS|ROTS?|AROTS?|SCALE|ASCALE|MIRROR|AMIRROR|FRAME|TOROT"
)
_STOPS = (0, 1)


def can_read(head: bytes) -> bool:
    """Whether a program has words that only SINUMERIK takes."""
    return language(head) == "sinumerik"


def read(data: bytes, source: str, reading: Reading) -> Program:
    """A program for SINUMERIK."""
    modal = Modal(source, DIALECT, reading)
    message, name = "", ""
    for at, line in program_lines(data, source):
        modal.number = at
        if line.startswith("%"):
            name = name or line[1:].strip()
            continue
        found = _MESSAGE.search(line)
        if found:
            message = found[1] or ""
            line = _MESSAGE.sub(" ", line)
        line, _, comment = line.partition(";")
        if modal.ended:
            continue
        text = "".join(line.split()).upper().lstrip("/")
        if not text:
            if comment.strip():
                modal.comment(comment.strip())
            continue
        functions, codes = _block(re.sub(r"^N\d+:?", "", text), modal)
        if any(function in _STOPS for function in functions):
            modal.stop(message or comment.strip())
        elif comment.strip() and not codes:
            modal.comment(comment.strip())
        modal.ended = modal.ended or text == "RET" or any(function in DIALECT.ends for function in functions)
    return modal.program(name or source)


def _block(text: str, modal: Modal) -> tuple[list[int], bool]:
    """Do what a block says; its words M, and whether it had others."""
    text = _CALL.sub(lambda call: _call(call, modal), text)
    codes: list[float] = []
    words: dict[str, float] = {}
    modes: dict[str, bool] = {}
    functions: list[int] = []
    place = 0
    while place < len(text):
        found = _WORD.match(text, place)
        if found is None:
            place = _other(text, place, modal)
            continue
        place = found.end()
        word, value = found[1] or found[5], float(found[3] or found[4] or found[6])
        if found[2]:
            modes[word] = found[2] == "IC"
        if word == "G" and not found[1]:
            codes.append(value)
        elif word == "M" and not found[1]:
            functions.append(int(value))
        elif word in _SILENT:
            modal.left_out[word] += 1
        elif word == "L" or (word == "P" and not codes):
            raise modal.fail(f"{found[0][:SHOWN]} calls another program; post-process one program without calls")
        elif word in words:
            raise modal.fail(f"the word {word} stands twice in one block; take one out")
        else:
            words[word] = value
    for function in functions:
        if function not in (*_STOPS, *DIALECT.ends):
            modal.left_out[f"M{function}"] += 1
    if 700 in codes:
        raise modal.fail("G700 is inches; post-process the program in millimetres")
    if codes or words:
        modal.block(
            [code for code in codes if code not in (74, 75, 153)] + [53.0] * bool({74, 75, 153} & {*codes}), words, modes
        )
    return functions, bool(codes or words)


def _call(call: re.Match[str], modal: Modal) -> str:
    """A function with its arguments: left out, refused, or the position that it is."""
    if call[1] in ("AC", "IC", "DC", "ACP", "ACN"):
        return call[0]
    if call[1] in _STATED or _HARMLESS.fullmatch(call[1]):
        modal.left_out[call[1]] += 1
        return ""
    if _TRANSFORMS.fullmatch(call[1]):
        raise modal.fail(f"{call[1]} transforms positions; post-process axis positions")
    if any(call[1].endswith(mode) and call[1] != mode for mode in ("AC", "IC", "DC", "ACP", "ACN")):
        return call[0]
    raise modal.fail(f"{call[0][:SHOWN]!r} is not known to SINUMERIK here; post-process plain blocks")


def _other(text: str, place: int, modal: Modal) -> int:
    """The end of a word that is no letter with a number."""
    found = _HARMLESS.match(text, place)
    if found:
        modal.left_out[found[0]] += 1
        return found.end()
    rest = text[place:]
    if _TRANSFORMS.match(rest):
        raise modal.fail(f"{rest[:SHOWN]!r} transforms positions; post-process axis positions")
    if re.match(r"R\d|[A-Z]+\d*=R|.*[=*/+]", rest):
        raise modal.fail(f"{rest[:SHOWN]!r}: variables and expressions are not computed; post-process plain numbers")
    raise modal.fail(f"{rest[:SHOWN]!r} is not understood; write words such as X1.5, or name another flavour")


def write(program: Program, writing: Writing) -> str:
    """A program for SINUMERIK."""
    return iso_text(program, writing, _LANGUAGE)


def _begin(program: Program, writing: Writing) -> list[str]:
    return [
        f"; SINUMERIK: {said(program.name).upper()}",
        f"G710 G17 G90 G94 G40{f' {writing.zero}' if writing.zero else ''}",
        "G64" if writing.blending else "G60",
        "M5",
        "M9",
    ]


def _stop(message: str) -> str:
    return f'MSG("{said(message).upper()[:120]}")\nM0' if message else "M0"


_LANGUAGE = Language(
    decimals=5,
    begin=_begin,
    end=lambda *_: ["M30"],
    comment=lambda text: f"; {said(text).upper()}",
    stop=_stop,
    dwell=lambda seconds: f"G4 F{number(seconds, 3)}",
)

_SAMPLE = """\
; SINUMERIK: A CIRCLE
G710 G17 G90 G94
G0 X101.5 Y0.0
G1 X100.0 F300.0
G3 X100.0 Y0.0 I-100.0 J0.0 F1000.0
G4 F1.5
M30
"""
register(Flavour("sinumerik", "SINUMERIK", ".mpf", can_read, read, write, lambda: _SAMPLE))
