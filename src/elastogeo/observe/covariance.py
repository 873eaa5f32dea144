"""A covariance that came with the readings: a factor of it, in columns of the run files beside them.

A column `u_NAME` is by how much every reading changes for one standard deviation of one influence quantity (JCGM 102). A
column of one name is one quantity in all runs, so that readings of different runs may be correlated. A number at the end
tells quantities of one kind from one another (`u_rounding_01`, `u_rounding_02`): they count together in the budget. What
`u_assumed_...` changes is no measured uncertainty but an assumption, and a result says which values depend on it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from elastogeo.machine import Array
from elastogeo.observe.observations import Observations, ObservedInfluence
from elastogeo.observe.run import Run

UNCERTAIN = "u_"
"""Begins the name of a column of a covariance factor."""

ASSUMED = "assumed "
"""Begins the label of an influence that is an assumption."""


def with_covariance(observations: Sequence[Observations], runs: Sequence[Run]) -> tuple[Observations, ...]:
    """The observations of a test with the covariance that its runs state, as influences.

    A run without a column has none of it.
    """
    columns = {run.name: {name: run.columns[name] for name in run.columns if name.startswith(UNCERTAIN)} for run in runs}
    names = tuple(dict.fromkeys(name for stated in columns.values() for name in stated))
    return tuple(replace(one, influences=(*one.influences, *_influences(one, names, columns))) for one in observations)


def _influences(
    one: Observations, names: Sequence[str], columns: Mapping[str, Mapping[str, Array]]
) -> Iterator[ObservedInfluence]:
    none = np.zeros(len(one))
    for name in names:
        yield ObservedInfluence(_label(name), 1.0, inf, np.zeros((len(one), 6)), columns[one.run].get(name, none))


def _label(name: str) -> str:
    return name.removeprefix(UNCERTAIN).rstrip("0123456789").replace("_", " ").strip()
