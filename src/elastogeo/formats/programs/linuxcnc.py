"""LinuxCNC: ISO 6983 with a dwell in seconds, turns of an arc (P), and messages to the operator."""

from __future__ import annotations

from elastogeo.formats.program_files import Flavour, Reading, Writing, register
from elastogeo.formats.programs.iso_text import read_iso
from elastogeo.formats.programs.iso_writing import Language, iso_text, number, said
from elastogeo.formats.programs.modal import Dialect
from elastogeo.formats.programs.recognised import language
from elastogeo.machine import Program

DIALECT = Dialect("LinuxCNC", turns="P", dwell_p="s", feed_counts="linear", harmless=frozenset({7, 8}))


def can_read(head: bytes) -> bool:
    """Whether a program has words that only LinuxCNC takes: `G64 P`, `G91.1`, a dwell of P with a point, `(MSG, ...)`."""
    return language(head) == "linuxcnc"


def read(data: bytes, source: str, reading: Reading) -> Program:
    """A program for LinuxCNC."""
    return read_iso(data, source, reading, DIALECT)


def write(program: Program, writing: Writing) -> str:
    """A program for LinuxCNC."""
    return iso_text(program, writing, _LANGUAGE)


def _begin(program: Program, writing: Writing) -> list[str]:
    blending = f"G64 P{number(writing.blending, 4)}" if writing.blending else "G61"
    return [
        f"(LINUXCNC, {said(program.name).upper()})",
        f"G21 G17 G90 G91.1 G94 G40 G49 G80{f' {writing.zero}' if writing.zero else ''}",
        blending,
        "M5 M9",
    ]


def _stop(message: str) -> str:
    return f"M0 (MSG, {said(message).upper()})" if message else "M0"


_LANGUAGE = Language(
    decimals=6,
    begin=_begin,
    end=lambda *_: ["M2"],
    comment=lambda text: f"({said(text).upper()})",
    stop=_stop,
    dwell=lambda seconds: f"G4 P{number(seconds, 3)}",
    turns="P",
)

_SAMPLE = """\
(LINUXCNC, A CIRCLE)
G21 G17 G90 G94
G0 X101.5 Y0.0
G1 X100.0 F300.0
G3 X100.0 Y0.0 I-100.0 J0.0 F1000.0
G4 P1.5
M2
"""
register(Flavour("linuxcnc", "LinuxCNC", ".ngc", can_read, read, write, lambda: _SAMPLE))
