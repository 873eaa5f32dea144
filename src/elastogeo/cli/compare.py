"""`elastogeo compare`: two tests of one machine, and what changed between them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elastogeo.cli.options import AsJson, Parameters, Reference, Report, reference_level


def compare(
    before: Annotated[Path, typer.Argument(metavar="BEFORE", help="The earlier test: a folder or a test file.")],
    after: Annotated[Path, typer.Argument(metavar="AFTER", help="The later test of the same machine.")],
    parameters: Parameters = None,
    reference: Reference = "test",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Say what changed between two tests of one machine, and whether it is significant.

    \b
    Example:
      elastogeo compare test-2025 test-2026
    """
    from elastogeo.cli import screen
    from elastogeo.formats import read_test
    from elastogeo.identification import compare as compared
    from elastogeo.identification import identify, with_question

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = [with_question(read_test(test), parameters, None, reference_level(reference)) for test in (before, after)]
        step("identifying both tests")
        found = compared(*(identify(test) for test in asked))
    screen.show(found, report, as_json)
