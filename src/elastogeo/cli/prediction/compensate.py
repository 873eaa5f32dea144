"""`elastogeo compensate`: the compensation files of a control, and what is left of the errors after them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

import elastogeo as eg
from elastogeo.cli.axis_values import axis_values, named
from elastogeo.cli.options import AsJson, Parameters, Report, TestPaths


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
        list[str] | None,
        typer.Option(help="Where the error of an axis counts as zero, as in X_mm=0; of a program its zero (G54)."),
    ] = None,
    program: Annotated[
        Path | None, typer.Option(help="NC program whose points are moved, instead of files of the control.")
    ] = None,
    cut: Annotated[Path | None, typer.Option(help="Of a program, the cut file: force, tool and holder, workpiece.")] = None,
    flavour: Annotated[str, typer.Option(help="In which the new program is written: iso, linuxcnc, ...")] = "iso",
    report: Report = None,
    as_json: AsJson = False,
) -> None:
    """Write compensation tables or a corrected program.

    It says what is left after them. Of positioning tests the means by target are written; of other tests, or with
    --parameter, the parameters that they determine together. Only what is greater than its uncertainty is written; the
    rest is named.

    \b
    Examples:
      elastogeo compensate axis-x axis-y --control linuxcnc --output for-the-control
      elastogeo compensate ball-bar --control sinumerik-cec
      elastogeo compensate my-campaign --program part.ngc --cut cut.toml --flavour linuxcnc --output corrected
    """
    from elastogeo.cli import screen

    at_zero = axis_values(zero, "--zero", "X_mm=0")
    written: tuple[Path, ...] = ()
    with screen.progress("reading the runs", quiet=as_json) as step:
        result: object
        if program is not None:
            way = eg.read_program(program)
            known = eg.identify(eg.read_campaign(tests), parameters=parameters)
            step("predicting along the path")
            loads = None if cut is None else eg.read_cut(cut)
            moved = result = eg.compensate_path(known, way, loads, zero=at_zero)
            if output and moved.components:
                written = eg.write_program(moved.program, output / program.name, flavour)
        else:
            results = _results(tests, parameters)
            step("evaluating")
            found = result = eg.compensate(
                *results, control=control, settings=named(setting, "--set", "type=1"), zero_at=at_zero
            )
            written = found.write(output) if output and found.files else ()
    if written and not as_json:
        screen.say(f"Files: {', '.join(map(str, written))}")
    screen.show(result, report, as_json)


def _results(tests: list[Path], parameters: list[str] | None) -> list[Any]:
    """What the tests say: positioning tests each for itself, all others together; with parameters, all together."""
    if parameters:
        return [eg.identify(eg.read_campaign(tests), parameters=parameters)]
    single = {path: eg.read_test(path) for path in tests if not _is_campaign(path)}
    positioned = [test for test in single.values() if test.instrument == "positioning"]
    others = [path for path in tests if path not in single or single[path].instrument != "positioning"]
    together = [eg.identify(eg.read_campaign(others))] if others else []
    return [*map(eg.evaluate_positioning, positioned), *together]


def _is_campaign(path: Path) -> bool:
    return path.name == "campaign.toml" or (path / "campaign.toml").exists()
