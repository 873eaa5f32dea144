"""`elastogeo new`: a folder for a test of one's own."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def new(
    folder: Annotated[Path, typer.Argument(help="Folder to make; it must not exist.")],
    machine: Annotated[str, typer.Option(help="A shipped machine, or a machine file.")] = "hermle_c50",
    force: Annotated[list[float] | None, typer.Option(help="Force level [N]; may be repeated.")] = None,
    repeats: Annotated[int, typer.Option(help="Runs at each level.", min=1)] = 1,
) -> None:
    """Make a folder for a test of your own.

    It holds a commented test.toml for a loaded ball bar, and a simulation.toml to try it with.

    \b
    Example:
      elastogeo new my-test --force 36 --force 364 --force 742
      elastogeo simulate my-test my-test/simulation.toml
      elastogeo identify my-test
    """
    from elastogeo.cli import screen
    from elastogeo.formats import new_test

    written = new_test(folder, machine, tuple(force or (36.0, 238.0, 490.0, 742.0)), repeats)
    screen.say(f"Made {written}. Put the run files where it says, or simulate them, then: elastogeo identify {folder}")
