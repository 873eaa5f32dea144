"""The traces of all runs as coefficients on few shapes, in which models are compared.

Every run is projected on harmonics along its readings; of these only the ones that the model can move matter. What a run is
left with are some ten numbers, whose noise may be of any size, order by order, and which are the only thing that counts as
independent: one run from another, never one reading from another.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array

ORDERS = 8
"""Highest order of the harmonics. What goes beyond counts as one order more."""

BEYOND = ORDERS + 1

MOVED = 0.05
"""Share of a column of the model below which it does not move a shape."""

ROUNDING = 1e-9
"""Share of its ceiling that is the rounding error of a column that moves nothing."""

DEPENDENT = 1e-6
"""Share of a harmonic below which it is none beside those before it."""

Integers = np.ndarray[tuple[int], np.dtype[np.int64]]
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]


@dataclass(frozen=True, slots=True, eq=False)
class Shapes:
    """All runs, shape by shape.

    Attributes
    ----------
    labels : tuple of str, length q
        Of the columns.
    columns : array, shape (n, q)
        Of unit length where they are not zero.
    lengths : array, shape (q,)
        By which they were divided.
    reading : array, shape (n,) [mm or rad]
    run, order : array of int, shape (n,)
        To which run a row belongs, and which order it is.
    rest : array, shape (runs,)
        Sum of squares of each run that no model can move.
    readings : array, shape (runs,)
        How many readings each run has.
    """

    labels: tuple[str, ...]
    columns: Array
    lengths: Array
    reading: Array
    run: Integers
    order: Integers
    rest: Array
    readings: Array

    def of(self, labels: Sequence[str]) -> Array:
        """Some of the columns, shape (n, len(labels))."""
        return self.columns[:, [self.labels.index(label) for label in labels]]

    def lengths_of(self, labels: Sequence[str]) -> Array:
        """By what some of the columns were divided, shape (len(labels),)."""
        return self.lengths[[self.labels.index(label) for label in labels]]

    def with_columns(self, labels: Sequence[str], columns: Array) -> Shapes:
        """More columns, shape (n, len(labels)), of any length; one of a name that is there takes its place."""
        lengths = np.linalg.norm(columns, axis=0)
        lengths = np.where(lengths > 0, lengths, 1.0)
        kept = [k for k, label in enumerate(self.labels) if label not in labels]
        return replace(
            self,
            labels=(*(self.labels[k] for k in kept), *labels),
            columns=np.column_stack([self.columns[:, kept], columns / lengths]),
            lengths=np.concatenate([self.lengths[kept], lengths]),
        )

    def without(self, runs: Sequence[int]) -> Shapes:
        """The same less some of the runs."""
        kept = [k for k in range(len(self.rest)) if k not in runs]
        rows = np.isin(self.run, kept)
        return replace(
            self,
            columns=self.columns[rows],
            reading=self.reading[rows],
            run=np.searchsorted(kept, self.run[rows]),
            order=self.order[rows],
            rest=self.rest[kept],
            readings=self.readings[kept],
        )


def shapes_of(
    systems: Systems,
    retained: Sequence[str],
    offers: Sequence[str],
    blocks: Sequence[Array],
    ceilings: Array,
    angular: bool,
) -> Shapes:
    """The runs of a test on their shapes.

    Parameters
    ----------
    systems : Systems
    retained : sequence of str, length p
    offers : sequence of str, length q
        Labels of more columns.
    blocks : sequence of array, shape (m, q)
        These columns, one block per run.
    ceilings : array, shape (q,)
        Length that each of them would have if nothing cancelled.
    angular : bool
        Whether the readings count along an angle; else the shapes are cosines over the readings in their order.
    """
    parts = [_projected(run, retained, block, angular) for run, block in zip(systems.runs, blocks, strict=True)]
    stacked = np.vstack([part for part, _, _ in parts])
    run = np.concatenate([np.full(len(part), k) for k, (part, _, _) in enumerate(parts)])
    order = np.concatenate([orders for _, orders, _ in parts])
    lengths = np.linalg.norm(stacked[:, :-1], axis=0)
    none = lengths <= ROUNDING * np.concatenate([np.zeros(len(retained)), ceilings])
    lengths = np.where(none, 1.0, lengths)
    columns = np.where(none, 0.0, stacked[:, :-1] / lengths)
    moved = np.zeros(len(stacked), dtype=bool)
    for k in range(len(parts)):
        model = np.abs(columns[run == k, : len(retained)])
        moved[run == k] = (model > MOVED * np.linalg.norm(model, axis=0).clip(np.finfo(float).tiny)).any(axis=1)
    kept = np.bincount(run[moved], stacked[moved, -1] ** 2, len(parts))
    rest = np.array([square for _, _, square in parts]) - kept
    return Shapes(
        labels=(*retained, *offers),
        columns=columns[moved],
        lengths=lengths,
        reading=stacked[moved, -1],
        run=run[moved],
        order=order[moved],
        rest=rest.clip(0.0),
        readings=np.array([float(run.factor.rows) for run in systems.runs]),
    )


def _projected(run: RunSystem, retained: Sequence[str], block: Array, angular: bool) -> tuple[Array, Integers, float]:
    """Rows `[A | more | y]` on the shapes of one run, the order of each, and the sum of squares of the readings."""
    basis, orders = _harmonics(run.observations.pose if angular else None, run.readings)
    root = np.ones(run.readings) if run.weights is None else np.sqrt(run.weights)
    size = np.linalg.norm(basis, axis=0)
    more = run.without_own(np.column_stack([basis, block])) * root[:, np.newaxis]
    model, reading = run.design_of(retained) * root[:, np.newaxis], run.reading * root
    ceilings = np.concatenate([size, np.linalg.norm(model, axis=0)])
    Q, kept = _basis(np.column_stack([more[:, : len(orders)], model]), ceilings)
    orders = np.concatenate([orders, np.full(model.shape[1], BEYOND)])[np.array(kept)]
    return Q.T @ np.column_stack([model, more[:, len(basis[0]) :], reading]), orders, float(reading @ reading)


def _basis(columns: Array, ceilings: Array) -> tuple[Array, list[int]]:
    """An orthonormal basis that takes the columns in their order, and which of them are more than those before."""
    basis = np.empty((len(columns), min(columns.shape)), order="F")
    free: list[int] = []
    for k, ceiling in enumerate(ceilings):
        before = basis[:, : len(free)]
        left = columns[:, k] - before @ (before.T @ columns[:, k])
        left = left - before @ (before.T @ left)
        size = float(np.linalg.norm(left))
        if size > DEPENDENT * ceiling and len(free) < basis.shape[1]:
            basis[:, len(free)] = left / size
            free.append(k)
    return basis[:, : len(free)], free


def _harmonics(angle: Array | None, count: int) -> tuple[Array, Integers]:
    """Shapes along the readings of a run, shape (m, k), and their orders."""
    if angle is None:
        steps = np.pi * (np.arange(count) + 0.5) / count
        return np.cos(np.outer(steps, np.arange(2 * ORDERS + 1))), np.arange(2 * ORDERS + 1)
    waves = [wave(order * angle) for order in range(1, ORDERS + 1) for wave in (np.cos, np.sin)]
    return np.column_stack([np.ones_like(angle), *waves]), np.repeat(np.arange(ORDERS + 1), [1, *[2] * ORDERS])
