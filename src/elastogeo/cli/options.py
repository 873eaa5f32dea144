"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from elastogeo.errors import InputError

TestPaths = Annotated[
    list[Path],
    typer.Argument(metavar="TEST...", help="Folders with a test.toml or a campaign.toml; several are asked together."),
]
TestPath = Annotated[Path, typer.Argument(metavar="TEST", help="A folder with a test.toml, or a test file.")]
Report = Annotated[Path | None, typer.Option(help="Folder to write the report to: a page, a PDF, figures, JSON.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Parameters = Annotated[
    list[str] | None,
    typer.Option("--parameter", "-p", help="Name, pattern (C_??X) or preset (planar-xy) to ask for; may be repeated."),
]
Reference = Annotated[
    str, typer.Option("--reference", help="Force level [N] to subtract from all others; test: as the test says; none.")
]
Prefer = Annotated[
    list[str] | None,
    typer.Option("--prefer", help="Parameter to retain before others that cannot be told from it; may be repeated."),
]
Store = Annotated[
    str,
    typer.Option("--store", envvar="ELASTOGEO_STORE", help="The history: its file (SQLite), or postgresql://..."),
]

Levels = Annotated[list[float] | None, typer.Option("--level", help="Force level [N] to use alone; may be repeated.")]
WithoutLevels = Annotated[
    list[float] | None, typer.Option("--without-level", help="Force level [N] to leave out; may be repeated.")
]
Reciprocal = Annotated[bool, typer.Option("--reciprocal", help="Take each joint as symmetric: C_dfj and C_fdj are one.")]
Robust = Annotated[bool, typer.Option("--robust", help="Let outlying readings count less (Huber).")]

STORE = "history.db"
"""Where the history is if nothing else is said: a file in the folder that one is in."""
OfSeries = Annotated[str, typer.Option("--series", help="Which series of the machine: its name, or a part of it.")]
Who = Annotated[
    str, typer.Option("--who", envvar="ELASTOGEO_WHO", help="Who does this, for the audit trail; else who is logged in.")
]


def reference_level(given: str) -> float | Literal["test", "none"]:
    """The reference level that an option names."""
    words: dict[str, Literal["test", "none"]] = {"test": "test", "none": "none"}
    if given in words:
        return words[given]
    try:
        return float(given)
    except ValueError:
        raise InputError(f"--reference is {given!r}; give a force in N, none, or test (as the test says)") from None
