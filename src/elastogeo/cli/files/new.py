"""`elastogeo new`: a folder for a test of one's own."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg


def new(
    folder: Annotated[Path, typer.Argument(help="Folder to make; it must not exist.")],
    instrument: Annotated[
        str,
        typer.Option(
            help="ball-bar, loaded-ball-bar, ball-roller, static-force, displacement-probes, sensor-frame; drive for logs."
        ),
    ] = "loaded-ball-bar",
    machine: Annotated[str, typer.Option(help="A shipped machine, or a machine file.")] = "",
    force: Annotated[list[float] | None, typer.Option(help="Force level [N]; may be repeated.")] = None,
    engagement: Annotated[
        list[float] | None, typer.Option(help="Engagement of a ball-roller [um]; may be repeated.")
    ] = None,
    repeats: Annotated[int, typer.Option(help="Runs at each level and in each direction.", min=0)] = 0,
) -> None:
    """Make a folder for a test of your own.

    It holds a commented test.toml for the instrument, and a simulation.toml to try it with.

    \b
    Example:
      elastogeo new my-test --instrument ball-bar
      elastogeo simulate my-test my-test/simulation.toml
      elastogeo identify my-test
    """
    from elastogeo.cli import screen

    written = eg.new_test(folder, machine, force or (), repeats, instrument, [e / 1000 for e in engagement or ()])
    if instrument == "drive":
        screen.say(f"Made {written}. Put the logs where it says, then: elastogeo drive {folder}")
    else:
        screen.say(f"Made {written}. Put the run files where it says, or simulate them, then: elastogeo identify {folder}")
