"""`elastogeo drive`: from the logs of a control to the torque balance of each feed drive."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report


def drive(
    logs: Annotated[
        list[Path], typer.Argument(metavar="LOG...", help="A drive file or its folder, or logs with units in their headers.")
    ],
    axis: Annotated[list[str] | None, typer.Option("--axis", help="Axis to identify; may be repeated.")] = None,
    held_out: Annotated[
        list[str] | None, typer.Option("--held-out", help="Run that is predicted only; may be repeated.")
    ] = None,
    model: Annotated[
        list[str] | None,
        typer.Option("--model", metavar="[AXIS=]NAME", help="Model whose parameters come first; may be repeated by axis."),
    ] = None,
    compare: Annotated[bool, typer.Option(help="Compare richer models on left-out runs.")] = True,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Identify the torque balance of feed drives.

    Inertia, friction, constant, loads. A log names its channels current_x, position_x (velocity_x, acceleration_x) with
    their units; a drive file says it for logs that do not. Every run is predicted from all others, models of the friction
    are compared by that, and the parameters of the one that the runs support come first, axis by axis.

    \b
    Example:
      elastogeo drive run_1.csv run_2.csv run_3.csv
    """
    from dataclasses import replace

    from elastogeo.cli import screen

    with screen.progress("reading the logs", quiet=as_json) as step:
        test = eg.read_drives(logs, tuple(axis or ()), tuple(held_out or ()))
        step("identifying the drives")
        wanted = dict(entry.rpartition("=")[::2] for entry in model or ())
        result = eg.identify_drives(replace(test, compare=compare and test.compare, models={**test.models, **wanted}))
    screen.show(result, report, as_json)
