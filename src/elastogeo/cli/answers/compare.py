"""`elastogeo compare`: two tests of one machine, and what changed between them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Parameters, Reference, Report, reference_level


def compare(
    before: Annotated[Path, typer.Argument(metavar="BEFORE", help="The earlier test: a folder or a test file.")],
    after: Annotated[Path, typer.Argument(metavar="AFTER", help="The later test of the same machine.")],
    parameters: Parameters = None,
    reference: Reference = "test",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Say what changed between two tests, and how surely.

    \b
    Example:
      elastogeo compare test-2025 test-2026
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        tests = eg.read_test(before), eg.read_test(after)
        step("identifying both tests")
        found = eg.compare(*tests, parameters=parameters, reference=reference_level(reference))
    screen.show(found, report, as_json)
