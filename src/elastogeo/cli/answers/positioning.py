"""`elastogeo positioning`: the values of ISO 230-2 of an axis, with their uncertainty."""

from __future__ import annotations

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report, TestPath


def positioning(
    test: TestPath,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Evaluate a positioning test by ISO 230-2.

    Accuracy A, systematic deviation E, repeatability R, reversal B and mean deviation M of a linear or rotary axis, with
    what they are worth; straightness and angular error motions from the same kind of file. The error motion that the test
    asks for is identified beside them.

    \b
    Example:
      elastogeo positioning my-test --report my-report
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_test(test)
        step("evaluating")
        found = eg.evaluate_positioning(asked)
    screen.show(found, report, as_json)
