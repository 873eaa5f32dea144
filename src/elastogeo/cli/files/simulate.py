"""`elastogeo simulate`: the run files that a test would give on a machine whose parameters are known."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

import elastogeo as eg
from elastogeo.cli.options import AsJson, TestPath


def simulate(
    test: TestPath,
    simulation: Annotated[
        Path | None, typer.Argument(help="True values, seed, poses, imperfections; else simulation.toml beside the test.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Write the run files that a test names, simulated.

    The parameters are those of a simulation file. No existing file is touched.

    \b
    Example:
      elastogeo simulate my-test
    """
    from elastogeo.cli import screen
    from elastogeo.formats import run_files_of

    with screen.progress("simulating", quiet=as_json):
        eg.simulate(test, simulation, write=True)
    written = run_files_of(test)
    if as_json:
        screen.show_json({"schema": "elastogeo.simulated/1", "files": [str(path) for path in written]})
    else:
        screen.say(f"{len(written)} simulated runs written beside {written[0]}")
