"""Simulation files: the true parameters, the instrument's imperfections and the poses of a simulated test, as TOML.

Simulated runs are written as run files, and only where no file is yet.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.documents.machine_tests import ReadRun, read_test_document
from elastogeo.formats.run_files import RunFormat, run_formats
from elastogeo.formats.text.table import Table
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.formats.text.units import dimensions_of, from_internal
from elastogeo.formats.text.whole_files import write_whole
from elastogeo.machine import Angle, Array, AxisCommands
from elastogeo.observe import Imperfection, MachineTest, Run

_FILE_UNIT = {"angle": "deg", "length": "um", "time": "s", "current": "A", "force": "N"}
_DIGITS = 9
"""Decimals that a simulated instrument writes, in the units of its file: far below anything it could resolve."""

SCHEMA = "elastogeo.simulation/1"


@dataclass(frozen=True, slots=True)
class Simulation:
    """How a test is simulated.

    Attributes
    ----------
    schema : str
    values : mapping of str to float
        True parameters by name, in their own units (mm, N, rad).
    seed : int
    readings : int
        Of every run.
    start, end : float [rad]
        Of the angle of the readings; the end itself is not read.
    exact : bool
        By exact products of transforms, or to first order.
    imperfection : Imperfection
    setup : mapping of str to any
        Entries of the test's table `setup` that are otherwise in truth: the friction of a drive, the length of a bar.
    centre : mapping of str to float [mm, rad]
        Axis commands from which polynomials of the true values count, if not from the test's own centre: the same in all
        tests of one simulated machine.
    """

    schema: str
    values: Mapping[str, float]
    seed: int = 0
    readings: int = 1000
    start: Angle = 0.0
    end: Angle = 2 * np.pi
    exact: bool = True
    imperfection: Imperfection = field(default_factory=Imperfection)
    setup: Mapping[str, Any] = field(default_factory=dict)
    centre: AxisCommands = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse a simulation of nothing."""
        if self.readings < 1 or self.start == self.end:
            raise InputError(
                f"a simulation needs readings along an arc, got {self.readings} from start to end {self.end:g} rad"
            )

    def angle(self) -> Array:
        """Angles of the readings of a run, shape (readings,) [rad]."""
        return self.start + (self.end - self.start) * np.arange(self.readings) / self.readings


def read_simulation(path: str | Path) -> Simulation:
    """Read a simulation file.

    Raises
    ------
    FormatError
        If it is no such document.
    """
    table = read_document(Path(path))
    check_schema(table, SCHEMA, str(path))
    return build(Simulation, table, str(path))


def poses_of(simulation: Simulation) -> ReadRun:
    """The poses at which a simulation reads, for runs that no file holds yet."""
    angle = simulation.angle()
    columns = {"angle": angle, "radial": np.zeros(len(angle))}
    return lambda path: Table(columns, {}, str(path))


def write_runs(path: Path, test: MachineTest, seed: int) -> tuple[Path, ...]:
    """Write simulated runs to the run files that a test names.

    Parameters
    ----------
    path : Path
        Of the test: its folder or file.
    test : MachineTest
        The simulated one.
    seed : int
        Goes into the files' metadata.

    Returns
    -------
    tuple of Path

    Raises
    ------
    FormatError
        If one of the files is there already, cannot be written, or ends like no writable format: nothing is written then.
    """
    file, document = read_test_document(path)
    targets = [file.parent / run.file for run in document.runs]
    there = [target for target in targets if target.exists()]
    if there:
        raise FormatError(f"{there[0]} is there already, and {len(there) - 1} more; a recorded run is never overwritten")
    contents = [
        _content(run, _format_of(target), seed, test.setup.file_units)
        for run, target in zip(test.runs, targets, strict=True)
    ]
    return write_whole(dict(zip(targets, contents, strict=True)))


def _format_of(target: Path) -> RunFormat:
    for run_format in run_formats().values():
        if run_format.suffix == target.suffix and run_format.write is not None:
            return run_format
    raise FormatError(f"{target}: no format that elastogeo writes ends in {target.suffix!r}; name it .csv or .parquet")


def _content(run: Run, run_format: RunFormat, seed: int, units: Mapping[str, str]) -> bytes:
    columns = {}
    for quantity, values in run.columns.items():
        unit = units.get(quantity)
        if unit is None:
            unit = "mm" if quantity.startswith("position") else _FILE_UNIT[dimensions_of(quantity)[0]]
        columns["_".join(filter(None, [quantity, unit]))] = np.round(from_internal(values, unit), _DIGITS)
    if run_format.write is None:
        raise FormatError(f"the format {run_format.name} cannot be written; name the run file .csv or .parquet")
    metadata = {"simulated": f"elastogeo, seed {seed}", "truth": truth_text(run.truth), "run": run.name}
    return run_format.write(columns, {key: text for key, text in metadata.items() if text})


def truth_text(truth: Mapping[str, float]) -> str:
    """True parameters as a run file says them: `C_XXX=6.19e-05 E_XX1=-0.00013`, in their own units (mm, N, rad)."""
    return " ".join(f"{name}={float(value)!r}" for name, value in truth.items())
