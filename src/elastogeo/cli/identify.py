"""`elastogeo identify`: from a test to its parameters, with a verdict and a report."""

from __future__ import annotations

from elastogeo.cli.options import (
    AsJson,
    Levels,
    Parameters,
    Prefer,
    Reciprocal,
    Reference,
    Report,
    Robust,
    TestPath,
    WithoutLevels,
    reference_level,
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
    report: Report = None,
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

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = with_question(
            read_test(test), parameters, prefer, reference_level(reference), level, without_level, reciprocal, robust
        )
        step("identifying")
        result = identified(asked)
    screen.show(result, report, as_json)
