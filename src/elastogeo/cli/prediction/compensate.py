"""`elastogeo compensate`: the compensation files of a control, and what is left of the errors after them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, Parameters, Report, TestPaths
from elastogeo.errors import InputError


def compensate(
    tests: TestPaths,
    parameters: Parameters = None,
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

    Of positioning tests the means by target are written; of other tests, or with --parameter, the parameters that they
    determine together. Only what is greater than its uncertainty is written; the rest is named.

    \b
    Examples:
      elastogeo compensate axis-x axis-y --control linuxcnc --output for-the-control
      elastogeo compensate ball-bar --control sinumerik-cec
    """
    from elastogeo.cli import screen

    with screen.progress("reading the runs", quiet=as_json) as step:
        read = [eg.read_test(test) for test in tests] if not parameters else []
        by_target = bool(read) and all(test.instrument == "positioning" for test in read)
        asked = None if by_target else eg.read_campaign(tests)
        step("evaluating")
        results = (
            [eg.identify(asked, parameters=parameters)]
            if asked is not None
            else [eg.evaluate_positioning(test) for test in read]
        )
        found = eg.compensate(*results, control=control, settings=_pairs(setting, "--set", "type=1"), zero_at=_zeros(zero))
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
