"""The linear system of one run: its factor, and its rows, which are held or made again.

Rows of many tests would fill the memory, so that of several tests the factors are kept alone. What else a result takes from
the readings is made test by test: observed anew, held while it is looked at, and let go.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.estimate import Factor, factor_blocks, select
from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations
from elastogeo.sources import Source, design_rows

OWN_TOLERANCE = 1e-9
"""Relative length below which a combination of a run's set-up columns is none."""

ABSORBED = 1e-12
"""Share of a column that is left by rounding when the run's own set-up explains all of it."""


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """What is held of the readings of a run.

    Attributes
    ----------
    observations : Observations
        As observed; nothing is subtracted.
    own : array, shape (m, k)
        Columns of the run's own set-up.
    rows : array, shape (m, q + 1)
        `[A | y]`, less the reference's if one is subtracted (Eqs. 4.26, 4.27), less what the run's own set-up explains.
    labels : tuple of str, length q
        Of these columns.
    """

    observations: Observations
    own: Array
    rows: Array
    labels: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Recipe:
    """How the rows of a run are made again.

    Attributes
    ----------
    observe : callable
        Observes the run.
    sources : tuple of Source
        That act in its test.
    own : tuple of Source
        Of the run's own set-up.
    machine : Machine
    """

    observe: Callable[[], Observations]
    sources: tuple[Source, ...]
    own: tuple[Source, ...]
    machine: Machine


@dataclass(frozen=True, slots=True, eq=False)
class RunSystem:
    """The linear system of one run.

    Attributes
    ----------
    name : str
        Of the run; of several tests with that of the test before it.
    force : float [N]
        Of its level, less the reference's if one is subtracted (Eq. 4.27).
    readings : int
    factor : Factor
        Of the rows, each with the root of its weight.
    aside : array, shape (k, p + 1)
        How much of the columns of the run's own set-up the rows held.
    set_up_names : tuple of str, length k
        Of the run's own set-up.
    spans : array, shape (axes,) [mm, rad]
        By how much the command of each axis changes within the run.
    angular : bool
        Whether its readings, or some of them, are angles.
    collinear : float
        As in `Observations`.
    test : str
        Name of the test.
    weights : array, shape (m,), or None
        Of the readings, where outliers count less; None if all count one.
    precision : float
        What a reading of its test counts against those of other tests: one over its variance, 1 on the average of all.
    held : Held or None
        The rows, if they are held.
    recipe : Recipe or None
        How they are made again, if not all are held.
    """

    name: str
    force: float
    readings: int
    factor: Factor
    aside: Array
    set_up_names: tuple[str, ...]
    spans: Array
    angular: bool
    collinear: float
    test: str = ""
    weights: Array | None = None
    precision: float = 1.0
    held: Held | None = None
    recipe: Recipe | None = None

    @property
    def observations(self) -> Observations:
        """As observed; nothing is subtracted."""
        return self._held(()).observations if self.recipe is None or self.held else self.recipe.observe()

    @property
    def own(self) -> Array:
        """Columns of the run's own set-up, shape (m, k)."""
        return self._held(()).own

    @property
    def rows(self) -> Array:
        """`[A | y]` of all columns of the factor, shape (m, p + 1)."""
        return self._held(self.factor.labels).rows

    @property
    def reading(self) -> Array:
        """The readings that the model is to explain, shape (m,) [mm or rad]."""
        return self._held(()).rows[:, -1]

    @property
    def design(self) -> Array:
        """Change of each reading per unit of each parameter, shape (m, p)."""
        return self.design_of(self.factor.labels)

    @property
    def counted(self) -> Array | float:
        """What each reading counts, shape (m,), or one number for all: its weight times the precision of its test."""
        return self.precision if self.weights is None else self.precision * self.weights

    def design_of(self, labels: Sequence[str]) -> Array:
        """Columns of the design for these parameters, shape (m, len(labels))."""
        held = self._held(labels)
        return held.rows[:, [held.labels.index(label) for label in labels]]

    def holding(self, labels: Sequence[str]) -> RunSystem:
        """The same run, of whose rows these columns are held, or more."""
        return replace(self, held=self._held(labels))

    def read_again(self, observations: Observations) -> RunSystem:
        """The same run, whose rows are all held, with the readings of other observations at the same poses."""
        assert self.held is not None
        reading = observations.reading[:, np.newaxis]
        own = own_part(self.own, reading, self.weights)
        rows, aside = self.rows.copy(order="F"), self.aside.copy()
        rows[:, -1:], aside[:, -1:] = reading - self.own @ own, own
        factor = replace(factor_blocks(self.factor.labels, [rows.copy(order="F")]), rows=self.factor.rows)
        return replace(self, held=replace(self.held, observations=observations, rows=rows), aside=aside, factor=factor)

    def of_labels(self, labels: Sequence[str]) -> RunSystem:
        """The same run with these columns alone."""
        at = [self.factor.labels.index(label) for label in labels]
        return replace(self, factor=select(self.factor, labels), aside=self.aside[:, [*at, -1]])

    def set_up(self, labels: Sequence[str], values: Array) -> Array:
        """The run's own set-up, shape (k,) [mm], if the parameters have these values."""
        chosen = self.aside[:, [self.factor.labels.index(label) for label in labels]]
        return np.asarray(self.aside[:, -1] - chosen @ values)

    def without_own(self, columns: Array) -> Array:
        """Other columns of the run, shape (m, q), less what its own set-up explains of them."""
        return columns - self.own @ own_part(self.own, columns, self.weights)

    def _held(self, labels: Sequence[str]) -> Held:
        """What is held, if these columns are among it; else it is made again with them."""
        if self.held is not None and (self.recipe is None or set(labels) <= set(self.held.labels)):
            return self.held
        assert self.recipe is not None
        seen, sources, own = self.recipe.observe(), self.recipe.sources, self.recipe.own
        acting = [source for source in sources if source.name in labels]
        made = design_rows([*acting, *own], self.recipe.machine, seen)
        rows = np.zeros((len(made), len(labels) + 1), order="F")
        rows[:, [*(labels.index(source.name) for source in acting), -1]] = made[:, [*range(len(acting)), -1]]
        columns, at = _moving(made[:, len(acting) : -1]), [self.factor.labels.index(label) for label in labels]
        return Held(seen, columns, taken_off(rows, columns, self.aside[:, [*at, -1]]), tuple(labels))


def run_system(
    labels: Sequence[str], run: Observations, force: float, rows: Array, own: Array, names: tuple[str, ...], test: str
) -> RunSystem:
    """The system of a run, with its rows held; its own set-up, shape (m, k), is projected out of them."""
    own = _moving(own)
    aside = own_part(own, rows)
    left = taken_off(rows, own, aside)
    return RunSystem(
        name=run.run,
        force=force,
        readings=len(run),
        factor=_factor_of(labels, left, own),
        aside=aside,
        set_up_names=names,
        spans=np.ptp(run.commands, axis=0),
        angular=bool(run.direction[:, 3:].any()),
        collinear=run.collinear,
        test=test,
        held=Held(run, own, left, tuple(labels)),
    )


def without_still(runs: Iterable[RunSystem], hold: bool) -> tuple[RunSystem, ...]:
    """The runs of a test without what of their own set-up moves no reading of any; their rows held, or not."""
    found: list[RunSystem] = []
    moving: set[int] = set()
    for run in runs:
        moving |= set(np.flatnonzero(run.own.any(axis=0)))
        found.append(run if hold else replace(run, held=None))
    return tuple(_of_set_up(run, sorted(moving)) for run in found)


def _of_set_up(run: RunSystem, kept: Sequence[int]) -> RunSystem:
    """The run with some of the columns of its own set-up: the others are zero."""
    if len(kept) == len(run.set_up_names):
        return run
    held = None if run.held is None else replace(run.held, own=run.held.own[:, kept])
    return replace(run, aside=run.aside[kept], set_up_names=tuple(run.set_up_names[k] for k in kept), held=held)


def with_precision(run: RunSystem, precision: float) -> RunSystem:
    """The same run whose readings count so much against those of other tests."""
    factor = replace(run.factor, triangle=run.factor.triangle * np.sqrt(precision / run.precision))
    return replace(run, factor=factor, precision=precision)


def reweighted(run: RunSystem, weights: Array) -> RunSystem:
    """The same run, whose rows are all held, with a weight for each reading, shape (m,); its own set-up is found anew."""
    assert run.held is not None
    more = own_part(run.own, run.rows, weights)
    rows, root = run.rows - run.own @ more, np.sqrt(run.precision * weights)[:, np.newaxis]
    factor = _factor_of(run.factor.labels, rows * root, run.own * root)
    return replace(run, held=replace(run.held, rows=rows), aside=run.aside + more, weights=weights, factor=factor)


def own_part(own: Array, columns: Array, weights: Array | None = None) -> Array:
    """How much of a run's own set-up, shape (m, k), is in columns, shape (m, q): least squares, shape (k, q).

    Of set-up columns that the run cannot distinguish the smallest values, of one that moves no reading none.
    """
    if not own.shape[1]:
        return np.zeros((0, columns.shape[1]))
    root = np.ones(len(own)) if weights is None else np.sqrt(weights)
    return np.asarray(np.linalg.lstsq(own * root[:, np.newaxis], columns * root[:, np.newaxis], rcond=OWN_TOLERANCE)[0])


def taken_off(rows: Array, own: Array, aside: Array) -> Array:
    """Rows `[A | y]` less so much of a run's own set-up; a column of which only rounding is left is none."""
    left = np.asfortranarray(rows - own @ aside)
    left[:, :-1][:, np.linalg.norm(left[:, :-1], axis=0) <= ABSORBED * np.linalg.norm(rows[:, :-1], axis=0)] = 0.0
    return np.asarray(left)


def _moving(own: Array) -> Array:
    """Columns of a set-up, zero where only rounding moves a reading."""
    still = np.linalg.norm(own, axis=0) <= OWN_TOLERANCE * np.sqrt(len(own))
    return np.asarray(np.where(still, 0.0, own))


def _factor_of(labels: Sequence[str], rows: Array, own: Array) -> Factor:
    """Factor of rows from which a run's own set-up is projected out: so many readings less."""
    factor = factor_blocks(labels, [rows.copy(order="F")])
    spent = int(np.linalg.matrix_rank(own, tol=OWN_TOLERANCE * np.sqrt(len(own)))) if own.shape[1] else 0
    return replace(factor, rows=factor.rows - spent)
