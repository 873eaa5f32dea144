"""`elastogeo stiffness`: the stiffness of a machine in every direction, from motor currents and encoders."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report, TestPath


def stiffness(
    test: TestPath,
    rig_test: Annotated[
        Path | None, typer.Option("--rig-test", help="The same test with a rig of known compliance in the loop.")
    ] = None,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Map the stiffness that a ball-roller test shows.

    From motor currents and encoders alone: the drives' friction from the runs without engagement, the force, the compliance
    in every direction and at every engagement, and the joint parameters that the test asks for.

    \b
    Example:
      elastogeo stiffness my-test --report my-report
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_test(test)
        other = eg.read_test(rig_test) if rig_test else None
        step("identifying")
        found = eg.map_stiffness(asked, other)
    screen.show(found, report, as_json)
