"""`elastogeo identify`: from a test to its parameters, with a verdict and a report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elastogeo.cli.options import (
    AsJson,
    Levels,
    Parameters,
    Prefer,
    Reciprocal,
    Reference,
    Robust,
    TestPath,
    WithoutLevels,
    reference_level,
    refuse_if,
)


def identify(
    test: TestPath,
    parameters: Parameters = None,
    prefer: Prefer = None,
    reference: Reference = "test",
    level: Levels = None,
    without_level: WithoutLevels = None,
    reciprocal: Reciprocal = False,
    robust: Robust = False,
    report: Annotated[Path | None, typer.Option(help="Folder to write the report and its figures to.")] = None,
    as_json: AsJson = False,
) -> None:
    """Identify the parameters that a test asks for.

    \b
    Example:
      elastogeo identify my-test --report my-report
    """
    from elastogeo.cli import screen
    from elastogeo.formats import read_test
    from elastogeo.identification import identify as identified
    from elastogeo.identification import with_question
    from elastogeo.report import identification_json

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = with_question(
            read_test(test), parameters, prefer, reference_level(reference), level, without_level, reciprocal, robust
        )
        step("identifying")
        result = identified(asked)
        written = screen.write_report(result, report, step) if report else None
    if as_json:
        screen.show_json(identification_json(result))
    else:
        screen.show_identification(result)
        if written:
            screen.say(f"Report: {written}")
    refuse_if(result.verdict)
