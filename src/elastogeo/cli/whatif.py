"""`elastogeo whatif`: the trace that a machine would give without a named fault."""

from __future__ import annotations

from typing import Annotated

import typer

from elastogeo.cli.options import AsJson, Parameters, Reference, TestPath, reference_level


def whatif(
    test: TestPath,
    correct: Annotated[
        list[str], typer.Option("--correct", "-c", help="Parameter (or pattern) whose fault is corrected; may be repeated.")
    ],
    parameters: Parameters = None,
    reference: Reference = "test",
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
    from elastogeo.report import what_if_json

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = with_question(read_test(test), parameters, None, reference_level(reference))
        step("identifying")
        result = identify(asked)
        predicted = what_if(result, correct)
    if as_json:
        screen.show_json(what_if_json(predicted, result))
    else:
        screen.show_what_if(predicted)
