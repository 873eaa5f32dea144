"""`elastogeo diagnose`: a ball bar test's faults, ranked."""

from __future__ import annotations

import elastogeo as eg
from elastogeo.cli.options import AsJson, Parameters, Reference, Report, TestPath, reference_level


def diagnose(
    test: TestPath,
    parameters: Parameters = None,
    reference: Reference = "test",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Rank the faults of a ball bar test.

    Asks for backlash, play, squareness, gains, straightness, cyclic, servo and reversal errors where the test asks for
    nothing of its own. Says what could not be distinguished, and gives the ISO 230-4 parameters of the traces.

    \b
    Example:
      elastogeo diagnose my-test -p ball-bar-xy
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_test(test)
        step("identifying")
        found = eg.diagnose(asked, parameters=parameters, reference=reference_level(reference))
    screen.show(found, report, as_json)
