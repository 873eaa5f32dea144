"""`elastogeo inspect`: what a file is, and how a test file maps what it holds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson


def inspect(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Readings, a log, a folder of a recording, or a document.")],
    as_json: AsJson = False,
) -> None:
    """Say what a file is, and what its columns mean.

    Lists the columns or channels with their units and first values, and writes down how a test or drive file maps them.

    \b
    Example:
      elastogeo inspect export.csv
    """
    from elastogeo.cli import screen

    screen.show(eg.inspect_file(file), None, as_json)
