"""`elastogeo calibrate`: a bar's force against pressure, and how far the set-up of an instrument gives way."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report


def calibrate(
    readings: Annotated[
        list[Path],
        typer.Argument(
            metavar="READINGS...",
            help="Files with pressure_bar and force_N of a load cell, or displacement_um of a dial at the workpiece ball; "
            "or one with engagement_um, force_N, ball_um and roller_um of a ball-roller device.",
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Calibration file to write, for test files to name.")
    ] = None,
    load_cell: Annotated[float, typer.Option(help="Relative standard uncertainty of the load cell.", min=0.0)] = 0.0,
    dial: Annotated[float, typer.Option(help="Relative standard uncertainty of the dial.", min=0.0)] = 0.0,
    elevation_deg: Annotated[float, typer.Option(help="Of the bar over the horizontal, while the dial was read.")] = 0.0,
    resolution_um: Annotated[float, typer.Option(help="Of the dials at ball and roller.", min=0.0)] = 0.0,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Calibrate a bar's force, or how far a set-up gives way.

    The force of a loaded bar from readings of a load cell, the deflection of its set-up (Eq. 5.38) from those of a dial; or
    the stiffness of ball, roller bearing and machine from dials at both (indicator test, Tables 6.5 and 6.6). Each with its
    uncertainty. A test file takes what was found with calibration = "gauge.toml".

    \b
    Example:
      elastogeo calibrate load-cell.csv dial.csv --load-cell 0.002 -o gauge.toml
    """
    from elastogeo.cli import screen
    from elastogeo.formats import write_calibration
    from elastogeo.identification import IndicatorTest

    columns = [eg.read_run(path).columns for path in readings]
    found = eg.calibrate(
        *columns, load_cell=load_cell, dial=dial, elevation=radians(elevation_deg), resolution=resolution_um / 1000
    )
    if output:
        if isinstance(found, IndicatorTest):
            write_calibration(output, rollers=found.setup, name=output.stem)
        else:
            force = None if found.force is None else found.force.calibration
            setup = None if found.setup is None else found.setup.per_pressure
            write_calibration(output, force, setup, name=output.stem)
    screen.show(found, report, as_json)
    if output and not as_json:
        screen.say(f'Calibration: {output}. In a test file: calibration = "{output.name}"')
