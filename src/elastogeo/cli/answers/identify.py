"""`elastogeo identify`: from a test, or several, to parameters, with a verdict and a report."""

from __future__ import annotations

import elastogeo as eg
from elastogeo.cli.options import (
    AsJson,
    Levels,
    Parameters,
    Prefer,
    Reciprocal,
    Reference,
    Report,
    Robust,
    TestPaths,
    WithoutLevels,
    reference_level,
)


def identify(
    tests: TestPaths,
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
    """Identify the parameters that one test or several ask for.

    \b
    Examples:
      elastogeo identify my-test --report my-report
      elastogeo identify xy yz zx
      elastogeo identify my-campaign
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_campaign(tests)
        step("identifying")
        result = eg.identify(
            asked,
            parameters=parameters,
            prefer=prefer,
            reference=reference_level(reference),
            levels=level,
            without_levels=without_level,
            reciprocal=reciprocal,
            robust=robust,
        )
    screen.show(result, report, as_json)
