"""Curves through the loading branches of a static test: polynomials, for loads of both signs one on each side of zero."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import Estimate, factor_blocks, solve
from elastogeo.identification.static_tests.loading_branches import Branch
from elastogeo.machine import Array

HIGHEST_DEGREE = 5

FEWEST_CYCLES = 3
"""Cycles without which their scatter has hardly more than one degree of freedom: there is no uncertainty then."""


@dataclass(frozen=True, slots=True)
class Shape:
    """The polynomials of a branch: one over the range, or one on each side of zero.

    Attributes
    ----------
    edges : tuple of float [N]
        Where the pieces begin and end.
    degree : int
    """

    edges: tuple[float, ...]
    degree: int

    @property
    def labels(self) -> tuple[str, ...]:
        """Names of the coefficients."""
        return tuple(f"{piece}.{k}" for piece in range(len(self.edges) - 1) for k in range(self.degree + 1))

    def rows(self, force: Array) -> Array:
        """Value of every coefficient's function at forces, shape (m, q); Legendre, as they hardly depend on each other."""
        piece = self.piece_of(force)
        rows = np.zeros((len(force), len(self.labels)))
        for k, (low, high) in enumerate(pairwise(self.edges)):
            inside = piece == k
            columns = slice(k * (self.degree + 1), (k + 1) * (self.degree + 1))
            rows[inside, columns] = legendre.legvander(_scaled(force[inside], low, high), self.degree)
        return rows

    def row(self, force: float, *, slope: bool = False, below: bool = False) -> Array:
        """The functions at one force, shape (q,), or their slopes [1/N]; `below` takes the piece under an edge."""
        piece = int(self.piece_of(np.array([force]))[0]) - (1 if below else 0)
        low, high = self.edges[piece : piece + 2]
        at = float(_scaled(np.array([force]), low, high)[0])
        row = np.zeros(len(self.labels))
        for k in range(self.degree + 1):
            unit = np.eye(self.degree + 1)[k]
            value = legendre.legval(at, legendre.legder(unit)) * 2 / (high - low) if slope else legendre.legval(at, unit)
            row[piece * (self.degree + 1) + k] = value
        return row

    def mean(self) -> Array:
        """The functions' means over the whole range, shape (q,): exact, as only the constant has one."""
        row = np.zeros(len(self.labels))
        for k, (low, high) in enumerate(pairwise(self.edges)):
            row[k * (self.degree + 1)] = (high - low) / (self.edges[-1] - self.edges[0])
        return row

    def piece_of(self, force: Array) -> NDArray[np.intp]:
        """Which piece holds each force, shape (m,)."""
        return np.clip(np.searchsorted(self.edges[1:-1], force, side="right"), 0, len(self.edges) - 2)


@dataclass(frozen=True, slots=True)
class Curves:
    """The fitted curves of all cycles.

    Attributes
    ----------
    shape : Shape
    rising, falling : array, shape (n, q)
        Coefficients, by cycle.
    degrees_of_freedom : float
        Of the scatter of the readings about their curves.
    """

    shape: Shape
    rising: Array
    falling: Array
    degrees_of_freedom: float

    def estimate(self, rising: Array, falling: Array) -> Estimate:
        """A linear function of the curves: its mean over the cycles, and what their scatter says of it.

        Parameters
        ----------
        rising, falling : array, shape (q,)
            Weights of the coefficients.
        """
        values = self.rising @ rising + self.falling @ falling
        count = len(values)
        if count < FEWEST_CYCLES:
            return Estimate(float(values.mean()), inf)
        return Estimate(float(values.mean()), float(values.std(ddof=1) / np.sqrt(count)), float(count - 1))


def fitted_curves(
    force: Array, displacement: Array, cycles: Sequence[tuple[Branch, Branch]], edges: tuple[float, ...]
) -> tuple[Curves, float]:
    """Curves of the degree that describes all cycles best (Akaike's criterion), and the scatter of a reading.

    Raises
    ------
    UnsupportedError
        If a branch has too few readings, or too few forces.
    """
    rising = [_part(force, displacement, up) for up, _ in cycles]
    falling = [_part(force, displacement, down) for _, down in cycles]
    parts = [*rising, *falling]
    highest = min(_supported(part[0], edges) for part in parts)
    if highest < 1:
        few = min(len(part[0]) for part in parts)
        raise UnsupportedError(
            f"a branch has {few} readings, too few or at too few forces for a curve: it takes three readings at two forces "
            f"{'on each side of zero ' if len(edges) > 2 else ''}at least. If the force only trembles, its range is noise"
        )
    candidates = [_score(Shape(edges, degree), parts) for degree in range(1, highest + 1)]
    shape = Shape(edges, 1 + int(np.argmin(candidates)))
    solved = [_solved(shape, *part) for part in parts]
    n = len(cycles)
    values = np.array([found[0] for found in solved])
    left = sum(found[1] for found in solved)
    freedom = sum(len(part[0]) - len(shape.labels) for part in parts)
    return Curves(shape, values[:n], values[n:], float(freedom)), float(np.sqrt(left / freedom))


def _part(force: Array, displacement: Array, branch: Branch) -> tuple[Array, Array]:
    return force[branch.first : branch.last], displacement[branch.first : branch.last]


def _supported(force: Array, edges: tuple[float, ...]) -> int:
    """The highest degree that the forces of a branch support on every piece: fewer than distinct forces, and a spare."""
    piece = Shape(edges, 0).piece_of(force)
    degrees = []
    for k in range(len(edges) - 1):
        inside = force[piece == k]
        distinct = 1 + int(np.sum(np.diff(np.sort(inside)) > 1e-3 * (edges[k + 1] - edges[k]))) if len(inside) else 0
        degrees.append(min(distinct - 1, len(inside) - 2, HIGHEST_DEGREE))
    return min(degrees)


def _solved(shape: Shape, force: Array, displacement: Array) -> tuple[Array, float]:
    """Coefficients, and the residual sum of squares."""
    rows = shape.rows(force)
    found = solve(factor_blocks(shape.labels, [np.asfortranarray(np.column_stack([rows, displacement]))]))
    return found.values, float(np.sum((displacement - rows @ found.values) ** 2))


def _score(shape: Shape, parts: Sequence[tuple[Array, Array]]) -> float:
    """Akaike's criterion, corrected for few readings, over all branches."""
    left, count, used = 0.0, 0, 0
    for part in parts:
        rows = shape.rows(part[0])
        left += float(np.sum((part[1] - rows @ np.linalg.lstsq(rows, part[1], rcond=None)[0]) ** 2))
        count += len(part[0])
        used += len(shape.labels)
    if count - used - 2 <= 0:
        return float("inf")
    rounding = count * (1e-12 * max(float(np.abs(part[1]).max()) for part in parts)) ** 2
    return count * float(np.log((left + rounding) / count + 1e-300)) + 2.0 * used * count / (count - used - 1)


def _scaled(force: Array, low: float, high: float) -> Array:
    """Forces from [low, high] to [-1, 1]."""
    return (2 * force - low - high) / (high - low)
