"""What instruments that read displacements share: the columns of a run, simulated readings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.run import Run

MOST_DISPLACEMENT = 5.0
"""Reading [mm] that a test of displacements may have: more is a wrong unit, or no machine tool."""


def recorded(run: Run, columns: Sequence[str], optional: str = "") -> dict[str, Array]:
    """The columns of a run that an instrument needs, all of one length.

    Parameters
    ----------
    run : Run
    columns : sequence of str
    optional : str
        One of them that need not be there.

    Raises
    ------
    InputError
        If one is missing, they differ in length, or there is no reading.
    """
    missing = [name for name in columns if name not in run.columns and name != optional]
    if missing:
        there = ", ".join(run.columns) or "none"
        raise InputError(f"run {run.name!r} lacks the column {', '.join(missing)}; its columns are: {there}")
    found = {name: np.asarray(run.columns[name]) for name in columns if name in run.columns}
    lengths = {name: len(values) for name, values in found.items()}
    if len(set(lengths.values())) > 1:
        said = ", ".join(f"{count} of {name}" for name, count in lengths.items())
        raise InputError(f"run {run.name!r} has {said}; every reading needs one value of each")
    if not max(lengths.values(), default=0):
        raise InputError(f"run {run.name!r} has no reading")
    return found


def check_displacements(run: Run, names: Sequence[str]) -> None:
    """Refuse displacements of a size that only a wrong unit gives.

    Raises
    ------
    InputError
        If one is greater than `MOST_DISPLACEMENT`.
    """
    for name in names:
        most = float(np.abs(run.columns[name]).max())
        if most > MOST_DISPLACEMENT:
            raise InputError(
                f"run {run.name!r}: {name} reaches {most:.4g} mm; are they micrometres given as millimetres, or readings "
                f"whose zero was not subtracted?"
            )


def read_by(imperfection: Imperfection, true: Array, sensors: int, random: np.random.Generator) -> list[Array]:
    """Readings of each sensor, shape (m,) each, with its imperfections, of true readings one sensor after the other.

    Noise and resolution only: eccentricity and residues belong to instruments that turn.
    """
    return [imperfection.noisy(part, random) for part in np.split(true, sensors)]
