"""`elastogeo nc`: the programs that move a machine as planned tests want it."""

from __future__ import annotations

from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, TestPaths

if TYPE_CHECKING:
    from elastogeo.machine import Program


def nc(
    tests: TestPaths,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="File to write; for several tests a folder, which gets a file for each.")
    ],
    flavour: Annotated[str, typer.Option(help="iso (Fanuc and others), linuxcnc, sinumerik, heidenhain.")] = "iso",
    start_deg: Annotated[
        float | None, typer.Option(help="Angle at which a full circle is read first; else 180, in ZX 270.")
    ] = None,
    overshoot_deg: Annotated[
        float | None, typer.Option(help="Before and after the readings; else 180 around a full circle, 2 beside a part.")
    ] = None,
    feed_in_mm: Annotated[float, typer.Option(help="Outside of the circle, where every run begins and ends.")] = 1.5,
    approach_mm_min: Annotated[float, typer.Option(help="Feed near the set-up.")] = 300.0,
    clearance_mm: Annotated[float, typer.Option(help="Along Z, at which the machine comes to the set-up.")] = 50.0,
    order: Annotated[str, typer.Option(help="Of the runs: listed, counter-clockwise first, by level.")] = "listed",
    change_s: Annotated[
        float | None, typer.Option(help="To wait while the load changes; else the program stops for the operator.")
    ] = None,
    dwell_s: Annotated[float, typer.Option(help="At every pose that is read at standstill.")] = 3.0,
    zero: Annotated[str, typer.Option(help="Work offset to call.")] = "G54",
    decimals: Annotated[int | None, typer.Option(help="Of mm and degrees; else as the flavour states.")] = None,
    most_feed_mm_min: Annotated[float | None, typer.Option(help="Refuse a faster feed.")] = None,
    most_radius_mm: Annotated[float | None, typer.Option(help="Refuse a greater circle.")] = None,
    as_json: AsJson = False,
) -> None:
    """Write the numerical control programs of planned tests.

    Feed in, overshoot, circles in the directions of the runs, dwells at targets, stops for the operator. The test needs no
    readings yet. Commands beyond the travel of an axis are refused.

    \b
    Example:
      elastogeo new my-test --instrument ball-bar
      elastogeo nc my-test --flavour linuxcnc -o my-test.ngc
    """
    from elastogeo.cli import screen
    from elastogeo.formats import programs_of, write_programs

    given = {
        "start": None if start_deg is None else radians(start_deg),
        "overshoot": None if overshoot_deg is None else radians(overshoot_deg),
        "change": change_s,
        "decimals": decimals,
        "most_feed": None if most_feed_mm_min is None else most_feed_mm_min / 60,
        "most_radius": most_radius_mm,
    }
    settings: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    settings |= {"feed_in": feed_in_mm, "approach": approach_mm_min / 60, "clearance": clearance_mm, "order": order}
    settings |= {"dwell": dwell_s, "zero": zero}
    with screen.progress("reading the tests", quiet=as_json) as step:
        asked = eg.read_campaign(tests, planned=360)
        step("writing the programs")
        programs, writing = programs_of(asked, **settings)
        written = write_programs(programs, output, flavour, writing)
    rows = [_row(file, flavour, program) for file, program in zip(written, programs.values(), strict=True)]
    if as_json:
        screen.show_json({"schema": "elastogeo.programs/1", "programs": rows})
        return
    for row in rows:
        screen.say(f"{row['file']}: {row['blocks']} blocks, {row['minutes']:.1f} min at feed without stops and rapid moves")


def _row(file: Path, flavour: str, program: Program) -> dict[str, Any]:
    """What is said of a program that was written."""
    moves = program.moves()
    return {
        "file": str(file),
        "flavour": flavour,
        "blocks": len(program.blocks),
        "axes": list(program.axes),
        "minutes": float(moves.duration.sum() + moves.pause.sum()) / 60,
    }
