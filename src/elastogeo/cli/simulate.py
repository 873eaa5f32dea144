"""`elastogeo simulate`: the run files that a test would give on a machine whose parameters are known."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elastogeo.cli.options import AsJson, TestPath


def simulate(
    test: TestPath,
    simulation: Annotated[Path, typer.Argument(help="A simulation file: true values, seed, poses, imperfections.")],
    as_json: AsJson = False,
) -> None:
    """Write the run files that a test names, simulated.

    The parameters are those of a simulation file. No existing file is touched.

    \b
    Example:
      elastogeo simulate my-test my-test/simulation.toml
    """
    from elastogeo.cli import screen
    from elastogeo.formats import poses_of, read_simulation, read_test, write_runs
    from elastogeo.sources import simulate as simulated

    truth = read_simulation(simulation)
    with screen.progress("simulating", quiet=as_json) as step:
        planned = read_test(test, poses_of(truth), truth.setup)
        result = simulated(planned, truth.values, truth.imperfection, truth.seed, truth.exact)
        step("writing the runs")
        written = write_runs(test, result, truth.seed)
    if as_json:
        screen.show_json({"schema": "elastogeo.simulated/1", "seed": truth.seed, "files": [str(path) for path in written]})
    else:
        screen.say(f"{len(written)} simulated runs written beside {written[0]}")
