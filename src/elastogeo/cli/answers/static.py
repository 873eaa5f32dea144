"""`elastogeo static`: what a static load shows: hysteresis, Cartesian stiffness, the twist of the tool."""

from __future__ import annotations

from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report, TestPath


def static(
    test: TestPath,
    feedback: Annotated[
        str, typer.Option(help="What the loaded axis closes its position loop on: motor (its encoder) or scale.")
    ] = "motor",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Evaluate a static test.

    Force ramps, weights, displacement probes, a frame of sensors. Beside the joint compliances that the test asks for:
    hysteresis and static compliance of force ramps (and where in the drive the loaded axis yields, if its positions were
    recorded), the Cartesian stiffness from displacement probes, the twist of the tool and the sensor that stands out from a
    sensor frame.

    \b
    Example:
      elastogeo static examples/static-force --report my-report
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_test(test)
        step("evaluating")
        found = eg.evaluate_static(asked, feedback)
    screen.show(found, report, as_json)
