"""ISO 6983 as Fanuc and many others read it: plain blocks, no word that only one control has.

A dwell is in milliseconds without a decimal point (P); every coordinate is written with one, because a number without it may
count in the least increment of the control.
"""

from __future__ import annotations

from elastogeo.formats.program_files import Flavour, Reading, Writing, register
from elastogeo.formats.programs.iso_text import read_iso
from elastogeo.formats.programs.iso_writing import Language, iso_text, said
from elastogeo.formats.programs.modal import Dialect
from elastogeo.formats.programs.recognised import language
from elastogeo.machine import Program

DIALECT = Dialect("ISO 6983", dwell_p="ms", feed_counts="all", ends=(2, 30, 99))


def can_read(head: bytes) -> bool:
    """Whether a program has the words of ISO 6983 and none that only another control takes."""
    return language(head) == "iso"


def read(data: bytes, source: str, reading: Reading) -> Program:
    """A program of plain blocks."""
    return read_iso(data, source, reading, DIALECT, point_matters=True)


def write(program: Program, writing: Writing) -> str:
    """A program of plain blocks."""
    return iso_text(program, writing, _LANGUAGE)


def _begin(program: Program, writing: Writing) -> list[str]:
    return [
        "%",
        f"O{writing.program_number:04d} ({said(program.name).upper()[:32]})",
        f"G21 G17 G90 G94 G40 G49 G80{f' {writing.zero}' if writing.zero else ''}",
        "M5",
        "M9",
    ]


_LANGUAGE = Language(
    decimals=4,
    begin=_begin,
    end=lambda *_: ["M30", "%"],
    comment=lambda text: f"({said(text).upper()})",
    stop=lambda message: f"M0 ({said(message).upper()})" if message else "M0",
    dwell=lambda seconds: f"G4 P{round(1000 * seconds)}",
)

_SAMPLE = """\
%
O0001 (A CIRCLE)
G21 G17 G90 G94
G0 X101.5 Y0.0
G1 X100.0 F300.0
G3 X100.0 Y0.0 I-100.0 J0.0 F1000.0
G4 P1500
M30
%
"""
register(Flavour("iso", "ISO 6983, Fanuc", ".nc", can_read, read, write, lambda: _SAMPLE))
