"""`elastogeo predict`: how far the tool will be off along a path."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

import elastogeo as eg
from elastogeo.cli.axis_values import axis_values
from elastogeo.cli.options import AsJson, Parameters, Reciprocal, Report, TestPaths
from elastogeo.errors import InputError

if TYPE_CHECKING:
    from elastogeo.machine import PathForce

Directions = Literal["workpiece", "machine", "path"]


def predict(
    tests: TestPaths,
    path: Annotated[Path, typer.Option(help="Table of axis commands or tool points, or an NC program.")],
    cut: Annotated[Path | None, typer.Option(help="Cut file: force or milling model, tool and holder, workpiece.")] = None,
    force: Annotated[
        str | None,
        typer.Option(help="Force on the tool [N] as 0,-200,0; or a file of measured forces. Instead of the cut's."),
    ] = None,
    along: Annotated[Directions, typer.Option(help="Directions in which --force counts.")] = "workpiece",
    zero: Annotated[
        list[str] | None,
        typer.Option(help="Command of an axis at the zero of the workpiece (G54), as in X_mm=100; may be repeated."),
    ] = None,
    feed: Annotated[float | None, typer.Option(help="Feed [mm/min] where the path says none.")] = None,
    step: Annotated[float, typer.Option(help="Distance of points along a program [mm].")] = 1.0,
    parameters: Parameters = None,
    reciprocal: Reciprocal = False,
    datum: Annotated[
        Literal["machine", "probed"],
        typer.Option(help="Where the workpiece sits: as the machine says, or as its own probe finds it along the path."),
    ] = "machine",
    prior: Annotated[bool, typer.Option("--prior", help="Give what is not supported by the stated prior.")] = False,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Predict how far the tool will be off along a path.

    Along the axes of the workpiece and normal to the path, with the interval that the tests support, split into geometry,
    compliance and tool.

    \b
    Examples:
      elastogeo predict my-campaign --path contour.csv --force 0,-200,0 --along path
      elastogeo predict my-campaign --path slot.nc --cut slot.toml --zero X_mm=100 --zero Y_mm=-50
    """
    from elastogeo.cli import screen

    at_zero = axis_values(zero, "--zero", "X_mm=100")
    with screen.progress("reading the runs", quiet=as_json) as now:
        asked = eg.read_campaign(tests)
        now("identifying")
        result = eg.identify(asked, parameters=parameters, reciprocal=reciprocal)
        now("predicting along the path")
        per_second = None if feed is None else feed / 60
        made = eg.read_path(path, result.campaign.machine, zero=at_zero, feed=per_second, step=step)
        loads = None if cut is None else eg.read_cut(cut)
        found = eg.predict(result, made, loads, force=_force(force, along), along=along, prior=prior, datum=datum)
    screen.show(found, report, as_json)


def _force(given: str | None, along: Directions) -> tuple[float, ...] | PathForce | None:
    """Three numbers, or what a file holds."""
    if given is None:
        return None
    if Path(given).exists():
        from elastogeo.formats import read_forces

        return read_forces(given, along)
    try:
        return tuple(float(part) for part in given.split(","))
    except ValueError:
        raise InputError(f"--force is {given!r}, neither a file nor numbers; write three in N, as 0,-200,0") from None
