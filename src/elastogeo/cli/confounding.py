"""`elastogeo confounding`: what a test can and cannot tell apart, before or after it is run."""

from __future__ import annotations

from typing import Annotated

import typer

from elastogeo.cli.options import AsJson, Parameters, Prefer, Reciprocal, Reference, TestPath, reference_level


def confounding(
    test: TestPath,
    parameters: Parameters = None,
    prefer: Prefer = None,
    reference: Reference = "test",
    reciprocal: Reciprocal = False,
    planned: Annotated[
        int, typer.Option(help="Readings of a full turn to assume for every run, instead of reading the run files.")
    ] = 0,
    as_json: AsJson = False,
) -> None:
    """Say what a test can and cannot tell apart.

    \b
    Example, before any run has been made:
      elastogeo confounding my-test --planned 360 -p 'C_*'
    """
    from elastogeo.cli import screen
    from elastogeo.formats import full_turn, read_test
    from elastogeo.identification import confounding_of, systems_of, what_reciprocity_buys, with_question
    from elastogeo.report import confounding_json

    planned_test = read_test(test, full_turn(planned)) if planned else read_test(test)
    asked = with_question(planned_test, parameters, prefer, reference_level(reference), reciprocal=reciprocal)
    found = confounding_of(asked, systems_of(asked))
    if as_json:
        screen.show_json(confounding_json(found, asked))
    else:
        screen.show_confounding(found)
        if reciprocal:
            screen.say(what_reciprocity_buys(asked).sentence)
