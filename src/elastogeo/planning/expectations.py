"""What chosen tests will tell, from their readings alone: of each parameter, and of any functional of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from elastogeo.estimate import Confounding, Factor, confounding
from elastogeo.identification import retaining_order
from elastogeo.machine import Array
from elastogeo.observe import MachineTest
from elastogeo.planning.information import Unknowns
from elastogeo.planning.rank import counted, decomposed
from elastogeo.planning.result import ALONE, IN_A_SUM, UNSEEN, Expectation

NO_READING = 1e-10
"""Columns this much shorter than the longest, in scaled parameters, are rounding error."""


def expectations(
    rows: Array, asked: Unknowns, tests: Sequence[MachineTest], prefer: Sequence[str] = ()
) -> tuple[Expectation, ...]:
    """What the tests will tell of each parameter, in the order of the parameters.

    Parameters
    ----------
    rows : array, shape (m, p)
        Of all tests, whitened, in scaled parameters.
    asked : Unknowns
    tests : sequence of MachineTest
        They tell which axes move, and so what is retained.
    prefer : sequence of str
        Parameters to retain before others.
    """
    lengths = np.linalg.norm(rows, axis=0)
    seen = np.where(lengths > NO_READING * lengths.max(initial=0.0), rows, 0.0)
    found = _told_apart(seen, asked, tests, prefer)
    uncertainty = data_uncertainty(seen, found.combinations * asked.scales)
    return tuple(_expectations(found, uncertainty, asked))


def data_uncertainty(rows: Array, functionals: Array) -> Array:
    """Standard uncertainty of functionals that the readings support, shape (m,), in scaled parameters.

    The part of a functional that no reading sees counts as known: **it is for supported ones only.**
    """
    values, turns = decomposed(rows)
    rank = counted(values)
    return np.asarray(np.linalg.norm(functionals @ turns[:rank].T / values[:rank], axis=1))


def weak_directions(rows: Array) -> int:
    """How many of the directions that readings determine they know worse than the expected size, 1 in scaled parameters."""
    values, _ = decomposed(rows)
    return int(np.sum(values[: counted(values)] < 1.0))


def _told_apart(seen: Array, asked: Unknowns, tests: Sequence[MachineTest], prefer: Sequence[str]) -> Confounding:
    spans = [np.ptp(run.commands, axis=0) for test in tests for run in test.observations()[:1]]
    order = retaining_order(asked.sources, asked.machine, spans, prefer)
    triangle = np.zeros((len(asked.sources) + 1,) * 2)
    R = np.linalg.qr(seen / asked.scales, mode="r")
    triangle[: len(R), :-1] = R
    return confounding(Factor(asked.names, triangle, len(seen)), order)


def _expectations(found: Confounding, uncertainty: Array, asked: Unknowns) -> Iterator[Expectation]:
    terms = np.count_nonzero(found.combinations, axis=1)
    for k, source in enumerate(asked.sources):
        sums = np.flatnonzero(found.combinations[:, k])
        known, stands_for, u = UNSEEN, {}, None
        if len(sums):
            own = found.retained.index(source.name) if source.name in found.retained else int(sums[np.argmin(terms[sums])])
            known = ALONE if terms[own] == 1 and source.name == found.retained[own] and len(sums) == 1 else IN_A_SUM
            stands_for, u = found.stands_for(found.retained[own]), float(uncertainty[own])
        yield Expectation(source.name, source.unit, source.meaning, known, stands_for, u, float(asked.scales[k]))
