"""`elastogeo explain`: what a test can and cannot distinguish, before or after it is run."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Parameters, Prefer, Reciprocal, Reference, Report, TestPaths, reference_level


def explain(
    tests: TestPaths,
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
    """Say what one test or several can and cannot distinguish.

    \b
    Example, before any run has been made:
      elastogeo explain my-test --planned 360 -p 'C_*'
    """
    from elastogeo.cli import screen

    found = eg.explain(
        eg.read_campaign(tests, planned=planned),
        parameters=parameters,
        prefer=prefer,
        reference=reference_level(reference),
        reciprocal=reciprocal,
    )
    screen.show(found, report, as_json)
