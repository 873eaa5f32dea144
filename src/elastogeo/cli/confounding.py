"""`elastogeo confounding`: what a test can and cannot tell apart, before or after it is run."""

from __future__ import annotations

from typing import Annotated

import typer

from elastogeo.cli.options import AsJson, Parameters, Prefer, Reciprocal, Reference, Report, TestPath, reference_level


def confounding(
    test: TestPath,
    parameters: Parameters = None,
    prefer: Prefer = None,
    reference: Reference = "test",
    reciprocal: Reciprocal = False,
    planned: Annotated[
        int, typer.Option(help="Readings of a full turn to assume for every run, instead of reading the run files.")
    ] = 0,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Say what a test can and cannot tell apart.

    \b
    Example, before any run has been made:
      elastogeo confounding my-test --planned 360 -p 'C_*'
    """
    from elastogeo.cli import screen
    from elastogeo.formats import read_test
    from elastogeo.identification import explain, with_question

    asked = with_question(
        read_test(test, planned=planned), parameters, prefer, reference_level(reference), reciprocal=reciprocal
    )
    screen.show(explain(asked), report, as_json)
