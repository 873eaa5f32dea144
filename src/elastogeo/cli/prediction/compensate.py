"""`elastogeo compensate`: the compensation files of a control, and what is left of the errors after them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Report
from elastogeo.errors import InputError


def compensate(
    tests: Annotated[list[Path], typer.Argument(metavar="TEST...", help="Folders of positioning tests, one an axis.")],
    control: Annotated[
        str, typer.Option(help="linuxcnc, sinumerik-lec, sinumerik-cec, heidenhain, fanuc, isg, csv.")
    ] = "linuxcnc",
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="Folder to write the files of the control to.")
    ] = None,
    setting: Annotated[
        list[str] | None, typer.Option("--set", help="A setting of the control, as in type=1; may be repeated.")
    ] = None,
    zero: Annotated[
        list[str] | None, typer.Option(help="Where the error of an axis counts as zero, as in X_mm=0 or C_deg=0.")
    ] = None,
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Write the compensation files of a control, and say what is left after them.

    Only what the tests determine, and what is greater than its uncertainty, is written; the rest is named.

    \b
    Example:
      elastogeo compensate axis-x --control linuxcnc --output for-the-control
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        asked = [eg.read_test(test) for test in tests]
        step("evaluating")
        found = eg.compensate(
            *(eg.evaluate_positioning(one) for one in asked),
            control=control,
            settings=_pairs(setting, "--set", "type=1"),
            zero_at=_zeros(zero),
        )
    if output and found.files:
        written = found.write(output)
        if not as_json:
            screen.say(f"Files: {', '.join(map(str, written))}")
    screen.show(found, report, as_json)


def _pairs(given: list[str] | None, option: str, example: str) -> dict[str, str]:
    pairs = {}
    for text in given or ():
        name, equals, value = text.partition("=")
        if not (name and equals and value):
            raise InputError(f"{option} is {text!r}; give a name and a value, as in {example}")
        pairs[name.strip()] = value.strip()
    return pairs


def _zeros(given: list[str] | None) -> dict[str, float]:
    """Positions in the units of the house, by axis."""
    from math import radians

    found = {}
    for name, value in _pairs(given, "--zero", "X_mm=0").items():
        axis, _, unit = name.partition("_")
        try:
            place = float(value)
        except ValueError:
            raise InputError(f"--zero is {name}={value}; give a number, as in X_mm=0") from None
        if unit not in ("mm", "deg"):
            raise InputError(f"--zero is {name}={value}; name the axis with its unit, as in X_mm=0 or C_deg=0")
        found[axis] = radians(place) if unit == "deg" else place
    return found
