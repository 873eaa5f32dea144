"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

TestPath = Annotated[Path, typer.Argument(metavar="TEST", help="A folder with a test.toml, or a test file.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Parameters = Annotated[
    list[str] | None,
    typer.Option("--parameter", "-p", help="Name, pattern (C_??X) or preset (planar-xy) to ask for; may be repeated."),
]
Reference = Annotated[
    float | None, typer.Option("--reference", help="Force level [N] to take off from all others; nan for none.")
]
Prefer = Annotated[
    list[str] | None,
    typer.Option("--prefer", help="Parameter to retain before others that cannot be told from it; may be repeated."),
]
