"""The directions that any of the candidates sees: candidates, prior and what is asked for, projected on them once.

Everything is in scaled parameters, whose prior has unit standard deviation in every direction (the stated prior: every
parameter has a standard deviation of its scale). What no candidate sees keeps its prior whatever is chosen.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.machine import Array
from elastogeo.planning.rank import row_space

Numbers = np.ndarray[tuple[int], np.dtype[np.intp]]

LENGTHS = (6, 10, 20, 40)
"""Numbers of rows at which a stack ends: what is stacked is filled with zeros, which cost as much as rows."""


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """Candidates with much the same number of rows.

    Attributes
    ----------
    numbers : array, shape (n,) of int
        Of the candidates.
    rows : array, shape (n, q, r)
        Short ones are filled with zeros.
    """

    numbers: Numbers
    rows: Array


@dataclass(frozen=True, slots=True, eq=False)
class Space:
    """The row space of all candidates, and each candidate in it.

    Attributes
    ----------
    basis : array, shape (p, r)
        Orthonormal, in scaled parameters.
    rows : tuple of array, shape (q, r)
        Of each candidate, whitened.
    stacks : tuple of Stack
        The same, those of much the same length together.
    kept : array, shape (r, r)
        Information of the tests that were made already.
    prior_information : float
        Of every direction: 1 for the stated prior.
    """

    basis: Array
    rows: tuple[Array, ...]
    stacks: tuple[Stack, ...]
    kept: Array
    prior_information: float = 1.0

    @property
    def rank(self) -> int:
        """Directions that all candidates and the tests already made see together."""
        return int(self.basis.shape[1])

    @property
    def prior(self) -> Array:
        """Information of the stated prior and the tests that were made, shape (r, r)."""
        return self.prior_information * np.eye(self.rank) + self.kept

    def projected(self, functionals: Array) -> tuple[Array, Array]:
        """Functionals in scaled parameters, shape (m, p), in the space, shape (m, r), and the variance outside it, (m,)."""
        inside = functionals @ self.basis
        outside = np.sum((functionals - inside @ self.basis.T) ** 2, axis=1)
        return inside, np.asarray(outside)


def space_of(candidates: Sequence[Array], kept: Sequence[Array]) -> Space:
    """The space of candidates.

    Parameters
    ----------
    candidates, kept : sequence of array, shape (q, p)
        What each tells, as `whitened` gives it.

    Raises
    ------
    UnsupportedError
        If none tells anything.
    """
    every = np.vstack([*candidates, *kept])
    basis = row_space(every)
    if not basis.shape[1]:
        raise UnsupportedError(
            "none of the candidates tells anything of a compliance: it takes an instrument that loads the machine, at two "
            "force levels at the same poses"
        )
    known = np.vstack([*kept, np.zeros((1, len(basis)))]) @ basis
    rows = tuple(own @ basis for own in candidates)
    return Space(basis, rows, tuple(_stacked(rows)), known.T @ known)


def _stacked(rows: Sequence[Array]) -> Iterator[Stack]:
    lengths = np.array([len(own) for own in rows])
    longer = [most for most in LENGTHS if most < lengths.max()]
    for above, most in pairwise([-1, *longer, int(lengths.max())]):
        numbers = np.flatnonzero((lengths > above) & (lengths <= most))
        if len(numbers):
            filled = np.zeros((len(numbers), int(lengths[numbers].max()), rows[0].shape[1]))
            for k, number in enumerate(numbers):
                filled[k, : lengths[number]] = rows[int(number)]
            yield Stack(numbers, filled)
