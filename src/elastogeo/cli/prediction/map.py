"""`elastogeo map`: the compliance at the tool over the volume, where the tests support it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.axis_values import axis_values, by_axis
from elastogeo.cli.options import AsJson, Parameters, Reciprocal, Report, TestPaths
from elastogeo.errors import InputError

_RANGE = 3


def map(
    tests: TestPaths,
    along: Annotated[
        list[str] | None,
        typer.Option(help="Axis to go along: first, last, count, as in X_mm=-200:200:21; may be repeated."),
    ] = None,
    at: Annotated[
        list[str] | None, typer.Option(help="Where another axis stands, as in C_deg=30 or Z_mm=-100; may be repeated.")
    ] = None,
    direction: Annotated[
        str,
        typer.Option(help="Of the force, and of what counts: softest, X, Y, Z, or as in 1,1,0."),
    ] = "softest",
    tool: Annotated[str | None, typer.Option(help="Tool point in the last tool-side carriage [mm], as in 0,0,-160.")] = None,
    least_stiffness: Annotated[
        float | None, typer.Option("--least-stiffness", help="Limit [N/um] to decide on at every place (ISO 14253-1).")
    ] = None,
    design: Annotated[
        Path | None, typer.Option(help="Joints by design or finite elements to compare with: a table, or TOML.")
    ] = None,
    prior: Annotated[
        bool, typer.Option("--prior", help="Give what the tests do not tell by a stated prior, and its share.")
    ] = False,
    parameters: Parameters = None,
    reciprocal: Reciprocal = False,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Map how stiff the machine is at the tool, over its volume.

    A campaign of a dozen well-chosen circles tells it everywhere; one circle hardly beyond its own place. What the tests do
    not tell has no number.

    \b
    Examples:
      elastogeo map my-campaign -p 'C_???' --reciprocal --report my-map
      elastogeo map xy yz zx -p 'C_???' --along X_mm=-200:200:21 --at Y_mm=0 --at Z_mm=0 --direction X
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = eg.read_campaign(tests)
        step("identifying and mapping")
        found = eg.map_compliance(
            asked,
            along={axis: _range(text, axis) for axis, text in by_axis(along, "--along", "X_mm=-200:200:21").items()} or None,
            at=axis_values(at, "--at", "C_deg=30"),
            direction=_direction(direction),
            tool=None if tool is None else _numbers(tool, "--tool", "0,0,-160"),
            least_stiffness=None if least_stiffness is None else least_stiffness * 1000.0,
            design=None if design is None else eg.read_design(design),
            prior=prior,
            parameters=parameters,
            reciprocal=reciprocal,
        )
    screen.show(found, report, as_json)


def _range(text: str, axis: str) -> tuple[float, float, int]:
    parts = text.split(":")
    try:
        first, last = (float(part) for part in parts[:2])
        count = int(parts[2])
    except (ValueError, IndexError):
        raise InputError(f"--along of {axis} is {text!r}; give first, last and how many, as in -200:200:21") from None
    if len(parts) > _RANGE:
        raise InputError(f"--along of {axis} is {text!r}; give first, last and how many, as in -200:200:21")
    return first, last, count


def _direction(text: str) -> str | tuple[float, ...]:
    return _numbers(text, "--direction", "1,1,0") if "," in text else text


def _numbers(text: str, option: str, example: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"{option} is {text!r}; give numbers, as in {example}") from None
