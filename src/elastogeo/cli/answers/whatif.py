"""`elastogeo whatif`: the trace that a machine would give without a named fault."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Parameters, Reference, Report, TestPath, reference_level


def whatif(
    test: TestPath,
    correct: Annotated[
        list[str], typer.Option("--correct", "-c", help="Parameter (or pattern) whose fault is corrected; may be repeated.")
    ],
    parameters: Parameters = None,
    reference: Reference = "test",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Predict the trace with named faults corrected.

    With the circular deviation of ISO 230-4, before and after, and the peak to peak of each run.

    \b
    Example:
      elastogeo whatif my-test --correct B_XX --correct "E_??1"
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_test(test)
        step("identifying")
        predicted = eg.what_if(asked, correct, parameters=parameters, reference=reference_level(reference))
    screen.show(predicted, report, as_json)
