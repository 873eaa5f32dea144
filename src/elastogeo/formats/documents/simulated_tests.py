"""A test of which the runs are simulated: from its folder and a simulation file to readings, in memory or as run files."""

from __future__ import annotations

from pathlib import Path

from elastogeo.formats.documents.machine_tests import read_test, read_test_document
from elastogeo.formats.documents.simulations import Simulation, poses_of, read_simulation, write_runs
from elastogeo.observe import MachineTest
from elastogeo.sources import simulate as simulated

SIMULATION = "simulation.toml"


def simulate(path: str | Path, simulation: str | Path | Simulation | None = None, write: bool = False) -> MachineTest:
    """The test of a folder with simulated readings in its runs.

    Parameters
    ----------
    path : str or Path
        A folder that holds a `test.toml`, or such a file. Its run files need not exist.
    simulation : str, Path or Simulation, optional
        True values, seed, poses, imperfections; by default the `simulation.toml` beside the test.
    write : bool
        Whether to write the run files that the test names. No file that is there is touched.

    Returns
    -------
    MachineTest
        Marked as simulated.

    Raises
    ------
    FormatError
        If a document is not what it must be, or a run file that is to be written is there already.
    SelectionError
        If the machine has no such parameter as the simulation names.
    """
    path = Path(path)
    if simulation is None:
        simulation = read_test_document(path)[0].with_name(SIMULATION)
    truth = simulation if isinstance(simulation, Simulation) else read_simulation(simulation)
    planned = read_test(path, poses_of(truth), truth.setup)
    test = simulated(planned, truth.values, truth.imperfection, truth.seed, truth.exact, truth.centre)
    if write:
        write_runs(path, test, truth.seed)
    return test
