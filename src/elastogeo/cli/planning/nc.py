"""`elastogeo nc`: the programs that move a machine as planned tests want it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, TestPaths

if TYPE_CHECKING:
    from elastogeo.observe import Campaign

_Given = Mapping[str, float | None]


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

    angles = {"start": start_deg, "overshoot": overshoot_deg}
    feeds = {"approach": approach_mm_min, "most_feed": most_feed_mm_min}
    others = {"feed_in": feed_in_mm, "clearance": clearance_mm, "most_radius": most_radius_mm, "decimals": decimals}
    settings = _settings(angles, feeds, others | {"dwell": dwell_s, "change": change_s, "order": order, "zero": zero})
    with screen.progress("reading the tests", quiet=as_json) as step:
        asked = eg.read_campaign(tests, planned=360)
        step("writing the programs")
        rows = list(_written(asked, output, flavour, settings))
    if as_json:
        screen.show_json({"schema": "elastogeo.programs/1", "programs": rows})
        return
    for row in rows:
        screen.say(f"{row['file']}: {row['blocks']} blocks, {row['minutes']:.1f} min at feed without stops and rapid moves")


def _settings(degrees: _Given, mm_min: _Given, as_given: Mapping[str, Any]) -> dict[str, Any]:
    """What was said, in rad, mm, mm/s and s."""
    said = {name: radians(angle) for name, angle in degrees.items() if angle is not None}
    said |= {name: feed / 60 for name, feed in mm_min.items() if feed is not None}
    return said | {name: value for name, value in as_given.items() if value is not None}


def _written(asked: Campaign, output: Path, flavour: str, settings: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """The programs, written, and what is said of each."""
    from elastogeo.formats import programs_of, write_programs

    programs, writing = programs_of(asked, **settings)
    for file, program in zip(write_programs(programs, output, flavour, writing), programs.values(), strict=True):
        moves = program.moves()
        yield {
            "file": str(file),
            "flavour": flavour,
            "blocks": len(program.blocks),
            "axes": list(program.axes),
            "minutes": float(moves.duration.sum() + moves.pause.sum()) / 60,
        }
