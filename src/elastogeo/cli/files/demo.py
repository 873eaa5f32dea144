"""`elastogeo demo`: the example test, identified, with its report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson


def demo(
    report: Annotated[Path, typer.Option(help="Folder to write the report and its figures to.")] = Path("demo-report"),
    as_json: AsJson = False,
) -> None:
    """Identify the example test and write its report.

    It is a loaded ball bar test at six forces, rebuilt from a thesis's tables.

    \b
    Example:
      elastogeo demo --report demo-report
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        test = eg.read_test(eg.example_test())
        step("identifying")
        result = eg.identify(test)
    screen.show(result, report, as_json)
