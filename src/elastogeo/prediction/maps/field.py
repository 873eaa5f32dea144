"""The compliance at the tool over a grid of linear axes: with all others standing it is a quadratic of their commands.

Each lever is linear in the commands, and C_t = J C J^T has two of them. So what C_t asks of the parameters anywhere on the
grid is a combination of ten functionals, and half a million places cost little more than ten. **Nothing is approximated.**
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from elastogeo.machine import Array
from elastogeo.prediction.knowledge import Knowledge, Predicted, Span, narrow
from elastogeo.prediction.maps.places import Grid
from elastogeo.prediction.support import SUPPORTED
from elastogeo.prediction.tool_compliances import TRANSLATION, entry_rows, weights_of

BLOCK = 20_000
"""Places at a time: what bounds the memory."""


@dataclass(frozen=True, slots=True)
class Quadratic:
    """The elements of C_t that a force shows, over a grid.

    Attributes
    ----------
    middle, half : array, shape (d,) [mm]
        Commands are scaled to -1 to 1.
    powers : array, shape (b, d)
        Of the commands, in each term.
    rows : array, shape (b, 6, p)
        What each term asks of the parameters, for the elements of `TRANSLATION`.
    """

    middle: Array
    half: Array
    powers: Array
    rows: Array

    def terms(self, commands: Array) -> Array:
        """The terms, shape (m, b), at commands of the axes of the grid, shape (m, d)."""
        scaled = (commands - self.middle) / self.half
        return np.asarray(np.prod(scaled[:, np.newaxis] ** self.powers, axis=2))


def quadratic(knowledge: Knowledge, grid: Grid, tool: Array) -> Quadratic:
    """The elements of C_t over a grid, from the 3^d places in its middle and at its ends.

    Raises
    ------
    UnsupportedError
        If no compliance was asked for, or one changes with force, feed or travel.
    """
    middle = np.array([(one[0] + one[-1]) / 2 for one in grid.along])
    half = np.array([abs(one[-1] - one[0]) / 2 or 1.0 for one in grid.along])
    moving = [len(one) > 1 for one in grid.along]
    nodes = np.array(list(product(*((-1.0, 0.0, 1.0) if moves else (0.0,) for moves in moving))))
    powers = [power for power in product(*(range(3) if moves else range(1) for moves in moving)) if sum(power) <= 2]
    commands = np.tile(grid.stands, (len(nodes), 1))
    commands[:, list(grid.columns)] = middle + half * nodes
    asked = entry_rows(knowledge, commands, tool, TRANSLATION)
    design = np.prod(nodes[:, np.newaxis] ** np.array(powers, dtype=float), axis=2)
    rows = np.linalg.lstsq(design, asked.reshape(len(nodes), -1), rcond=None)[0]
    return Quadratic(middle, half, np.array(powers, dtype=float), rows.reshape(len(powers), *asked.shape[1:]))


@dataclass(frozen=True, slots=True)
class Field:
    """Compliance along a direction over a grid of m places, counted through; see `Predicted`.

    `direction`, shape (m, 3), is what was asked for, or the softest at each place: NaN where that is not determined;
    `independent` says how many functionals of the parameters all places are made of.
    """

    predicted: Predicted
    direction: Array
    independent: int = 0


def field_over(knowledge: Knowledge, grid: Grid, tool: Array, direction: Array | None, prior: bool) -> Field:
    """The compliance along a direction, or the softest at each place, over a grid.

    Parameters
    ----------
    knowledge : Knowledge
    grid : Grid
    tool : array, shape (3,) [mm]
    direction : array, shape (3,), or None
        Unit vector in the foundation; None for the softest of each place.
    prior : bool
        Whether what is not supported is given by the stated prior.
    """
    found = quadratic(knowledge, grid, tool)
    flat = found.rows.reshape(-1, found.rows.shape[-1])
    span = knowledge.span.of(flat if direction is None else weights_of(direction, TRANSLATION) @ found.rows)
    parts = []
    for first in range(0, grid.size, BLOCK):
        places = np.arange(first, min(first + BLOCK, grid.size))
        terms = found.terms(grid.commands(places)[:, list(grid.columns)])
        parts.append(_along(span, terms, direction, prior) if direction is not None else _softest(span, terms, prior))
    predicted = Predicted.joined([part.predicted for part in parts])
    return Field(predicted, np.vstack([part.direction for part in parts]), int(np.linalg.matrix_rank(span.over)))


def _along(span: Span, terms: Array, direction: Array, prior: bool) -> Field:
    return Field(span.predict(terms, prior), np.tile(direction, (len(terms), 1)))


def _softest(span: Span, terms: Array, prior: bool) -> Field:
    """The greatest principal compliance of each place, its U to first order; nothing where an element is not supported."""
    values = terms @ span.value.reshape(terms.shape[1], -1)
    matrices = np.empty((len(terms), 3, 3))
    for k, (i, j) in enumerate(TRANSLATION):
        matrices[:, i, j] = matrices[:, j, i] = values[:, k]
    vectors = np.linalg.eigh(matrices)[1][:, :, -1]
    greatest = np.argmax(np.abs(vectors), axis=1)
    vectors *= np.sign(np.take_along_axis(vectors, greatest[:, np.newaxis], axis=1))
    coefficients = terms[:, :, np.newaxis] * weights_of(vectors, TRANSLATION)[:, np.newaxis]
    found = span.predict(coefficients.reshape(len(terms), -1), prior)
    share = np.max([_unsupported(span, terms, k) for k in range(len(TRANSLATION))], axis=0)
    whole = share < SUPPORTED
    nothing = ~(whole | prior)
    blank = {name: np.where(nothing, np.nan, getattr(found, name)) for name in ("value", "standard_uncertainty")}
    degrees = np.where(nothing, np.nan, found.degrees_of_freedom)
    vectors[nothing] = np.nan
    predicted = Predicted(blank["value"], blank["standard_uncertainty"], degrees, whole, share, found.prior_share)
    return Field(predicted, vectors)


def _unsupported(span: Span, terms: Array, element: int) -> Array:
    """The share of one element at each place that no test sees."""
    chosen = np.zeros((len(terms), terms.shape[1], len(TRANSLATION)))
    chosen[:, :, element] = terms
    return span.unsupported(chosen.reshape(len(terms), -1))


def given_over(knowledge: Knowledge, grid: Grid, tool: Array, directions: Array, values: Array) -> tuple[Array, Array]:
    """The compliance along a direction at each place, shape (m, 3), by given values of the parameters, shape (p,).

    Returns
    -------
    tuple of array, shape (m,) [mm/N]
        It, and the root of the sum of squares of what each parameter brings.
    """
    found = quadratic(knowledge, grid, tool)
    brought = (found.rows * values).reshape(-1, len(values))
    whole, apart = brought.sum(axis=1), narrow(brought)
    parts = []
    for first in range(0, grid.size, BLOCK):
        places = np.arange(first, min(first + BLOCK, grid.size))
        terms = found.terms(grid.commands(places)[:, list(grid.columns)])
        weights = weights_of(directions[places], TRANSLATION)
        coefficients = (terms[:, :, np.newaxis] * weights[:, np.newaxis]).reshape(len(places), -1)
        parts.append(np.column_stack([coefficients @ whole, np.linalg.norm(coefficients @ apart, axis=1)]))
    both = np.vstack(parts)
    return both[:, 0], both[:, 1]
