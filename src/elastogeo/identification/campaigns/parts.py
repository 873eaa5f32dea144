"""What each test of a campaign tells alone, what it adds, and what only all of them together tell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.estimate import RANK_TOLERANCE, Array, Factor, merge, select
from elastogeo.identification.systems import Systems, merged

Truth = NDArray[np.bool_]

UNKNOWN = 1e-6
"""Length of the part of a unit parameter that readings do not see, from which on they do not determine it."""

NULL = 1e-12
"""Length of a column of some tests as a share of that of all, below which it is rounding error."""


@dataclass(frozen=True, slots=True)
class TestPart:
    """What one test adds to what all tests say.

    Attributes
    ----------
    name : str
        Of the test in the campaign.
    runs, readings : int
    forces : tuple of float [N]
        Its levels, increasing.
    rmse : float [mm or rad]
        Of its readings against the estimate from all tests.
    scatter : float or None [mm or rad]
        Standard deviation of one of its readings about its own best fit: it decides what they count. None of one test.
    angular : bool
        Whether it reads angles.
    rank : int
        How many combinations it determines alone.
    alone : tuple of str
        Parameters of the result that it determines alone, each for what it stands for.
    rank_so_far : int
        How many combinations it determines with the tests before it.
    adds : tuple of str
        Parameters of the result that the tests before it do not determine, and with it do.
    """

    name: str
    runs: int
    readings: int
    forces: tuple[float, ...]
    rmse: float
    scatter: float | None
    angular: bool
    rank: int
    alone: tuple[str, ...]
    rank_so_far: int
    adds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """What one test, planned or run, adds to those before it.

    Attributes
    ----------
    name : str
    rank, rank_so_far : int
        How many combinations it determines alone, and with the tests before it.
    alone, adds : tuple of str
        Retained parameters, each for what it stands for, that it determines alone, and that only now are determined.
    """

    name: str
    rank: int
    rank_so_far: int
    alone: tuple[str, ...]
    adds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Shares:
    """How the tests of a campaign share in what it tells.

    Attributes
    ----------
    labels : tuple of str, length r
        The retained parameters.
    ranks, ranks_so_far : tuple of int
        One per test: alone, and with the tests before it.
    alone, so_far : array of bool, shape (tests, r)
        Whether the test determines the parameter alone, and with the tests before it.
    information : array, shape (tests, r)
        1 less the variance with all tests over that without this one: 1 where only this test determines the parameter.
    """

    labels: tuple[str, ...]
    ranks: tuple[int, ...]
    ranks_so_far: tuple[int, ...]
    alone: Truth
    so_far: Truth
    information: Array

    @property
    def together(self) -> tuple[str, ...]:
        """What no test determines alone."""
        return self.named(~np.logical_or.reduce(self.alone))

    def named(self, known: Truth) -> tuple[str, ...]:
        """The parameters at which an array of truth values, shape (r,), is true."""
        return tuple(label for label, is_known in zip(self.labels, known, strict=True) if is_known)

    def steps(self, tests: Sequence[str]) -> tuple[Step, ...]:
        """What each test adds to those before it."""
        return tuple(
            Step(name, self.ranks[k], self.ranks_so_far[k], self.named(self.alone[k]), self.adds(k))
            for k, name in enumerate(tests)
        )

    def adds(self, k: int) -> tuple[str, ...]:
        """What test k determines with the tests before it and they do not."""
        return self.named(self.so_far[k] & ~self.so_far[k - 1] if k else self.so_far[k])


def shares_of(systems: Systems, labels: Sequence[str]) -> Shares:
    """How the tests share in what is known of the retained parameters.

    Every column is a combination of the retained ones, so that a test determines what a parameter stands for exactly if it
    determines it among the retained ones alone.
    """
    tests = [select(merged(systems.of(test).runs), labels) for test in systems.tests]
    norms = merge(*tests).column_norms
    variance = _variances(tests, norms)[0]
    alone = [_variances([test], norms) for test in tests]
    so_far = [_variances(tests[: k + 1], norms) for k in range(len(tests))]
    without = [_variances([*tests[:k], *tests[k + 1 :]], norms)[0] for k in range(len(tests))]
    return Shares(
        labels=tuple(labels),
        ranks=tuple(rank for _, rank in alone),
        ranks_so_far=tuple(rank for _, rank in so_far),
        alone=np.array([np.isfinite(found) for found, _ in alone]),
        so_far=np.array([np.isfinite(found) for found, _ in so_far]),
        information=np.array([_share(variance, found) for found in without]),
    )


def _share(variance: Array, without: Array) -> Array:
    """1 less the variance with all tests over that without one."""
    return 1.0 - np.divide(variance, without, out=np.zeros_like(variance), where=np.isfinite(without))


def _variances(tests: Sequence[Factor], norms: Array) -> tuple[Array, int]:
    """Variance of each scaled parameter, shape (r,), infinite where the tests do not determine it; and their rank."""
    if not tests:
        return np.full(len(norms), np.inf), 0
    R = merge(*tests).R
    own = np.linalg.norm(R, axis=0)
    alive = own > NULL * norms
    found = np.full(len(norms), np.inf)
    if not alive.any():
        return found, 0
    _, sizes, Vt = np.linalg.svd(R[:, alive] / own[alive])
    seen = sizes > RANK_TOLERANCE * sizes[0]
    hidden = np.linalg.norm(Vt[~seen], axis=0)
    variance = np.sum((Vt[seen].T / sizes[seen]) ** 2, axis=1) * (norms[alive] / own[alive]) ** 2
    found[alive] = np.where(hidden > UNKNOWN, np.inf, variance)
    return found, int(seen.sum())
