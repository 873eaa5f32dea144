"""`elastogeo whatif`: the trace that a machine would give without a named fault."""

from __future__ import annotations

from typing import Annotated

import typer

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
    """Predict the trace and its circular deviation with named faults corrected.

    \b
    Example:
      elastogeo whatif my-test --correct B_XX --correct "E_??1"
    """
    from elastogeo.cli import screen
    from elastogeo.formats import read_test
    from elastogeo.identification import identify, what_if, with_question

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = with_question(read_test(test), parameters, None, reference_level(reference))
        step("identifying")
        predicted = what_if(identify(asked), correct)
    screen.show(predicted, report, as_json)
