"""What a design can and cannot distinguish.

Everything is decided on columns scaled to unit length, so that no unit decides a rank. A column is *null* when it produces
no reading; columns are *proportional* when they always produce the same trace but for its size; any other dependence is
an exact combination of the *retained* columns. Retaining is by name, in the caller's order of preference, and never silent:
for every retained parameter the result says what it stands for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError, RankError, several
from elastogeo.estimate.factor import Array, Factor

RANK_TOLERANCE = 1e-8
"""A unit column whose distance from the span of the retained ones is smaller counts as dependent on them."""

NULL_TOLERANCE = 1e-12
"""A column this much shorter than it would be if nothing cancelled counts as null: it is rounding error."""


@dataclass(frozen=True, slots=True, eq=False)
class Confounding(ByValue):
    """What the observations can distinguish.

    Attributes
    ----------
    labels : tuple of str
        All p parameters that were asked for.
    retained : tuple of str
        The r parameters that represent all others, in the order of `labels`.
    null : tuple of str
        Parameters that produce no reading.
    groups : tuple of tuple of str
        Parameters whose traces are proportional, by first member; single ones included, null ones not.
    combinations : array, shape (r, p)
        The retained parameter k stands for `sum_j combinations[k, j] p_j`, exactly.
    condition_raw, condition_scaled : float
        Condition number of the retained columns as they are, and scaled to unit length.
    singular_values : array, shape (r,)
        Of the scaled retained columns, greatest first.
    weakest : array, shape (r,)
        Combination of the scaled retained parameters that the observations see least.
    tolerance : float
        The relative tolerance of the decision.
    """

    labels: tuple[str, ...]
    retained: tuple[str, ...]
    null: tuple[str, ...]
    groups: tuple[tuple[str, ...], ...]
    combinations: Array
    condition_raw: float
    condition_scaled: float
    singular_values: Array
    weakest: Array
    tolerance: float

    @property
    def rank(self) -> int:
        """How many parameters, or combinations of them, the observations determine."""
        return len(self.retained)

    def stands_for(self, label: str) -> dict[str, float]:
        """The exact combination that a retained parameter represents: coefficient by name, itself first."""
        row = self.combinations[self.retained.index(label)]
        terms = {name: float(c) for name, c in zip(self.labels, row, strict=True) if c}
        return {label: terms.pop(label), **terms}


def confounding(
    factor: Factor,
    preference: Sequence[str] | None = None,
    ceilings: Array | None = None,
    tolerance: float = RANK_TOLERANCE,
) -> Confounding:
    """Find null columns, proportional groups, linear dependencies, and the retained set.

    Parameters
    ----------
    factor : Factor
        Of p columns.
    preference : sequence of str, optional
        Labels in the order in which they are to be retained; those not named come last, in the factor's order.
    ceilings : array, shape (p,), optional
        The length that each column would have if nothing cancelled, to tell a null column from rounding error. Without
        it only a column of zeros is null.
    tolerance : float
        Relative tolerance on scaled columns.

    Returns
    -------
    Confounding

    Raises
    ------
    RankError
        If no column produces a reading.
    InputError
        If a preferred label is unknown.
    """
    norms = factor.column_norms
    alive = norms > (0.0 if ceilings is None else NULL_TOLERANCE * ceilings)
    if not alive.any():
        raise RankError(f"none of the parameters {several(factor.labels)} changes any reading of this test")
    scaled = factor.R[:, alive] / norms[alive]
    names = [label for label, is_alive in zip(factor.labels, alive, strict=True) if is_alive]
    kept = _retained(scaled, _order(factor.labels, names, preference), tolerance)

    retained = scaled[:, kept]
    U, singular_values, Vt = np.linalg.svd(retained, full_matrices=False)
    coefficients = Vt.T @ ((U.T @ scaled) / singular_values[:, np.newaxis])
    coefficients[np.abs(coefficients) < tolerance] = 0.0
    combinations = np.zeros((len(kept), len(norms)))
    combinations[:, alive] = coefficients * norms[alive] / norms[alive][kept][:, np.newaxis]
    combinations[:, np.flatnonzero(alive)[kept]] = np.eye(len(kept))

    return Confounding(
        labels=factor.labels,
        retained=tuple(names[k] for k in kept),
        null=tuple(label for label in factor.labels if label not in names),
        groups=_groups(scaled, names, tolerance),
        combinations=combinations,
        condition_raw=_condition(factor.R[:, np.flatnonzero(alive)[kept]]),
        condition_scaled=float(singular_values[0] / singular_values[-1]),
        singular_values=singular_values,
        weakest=Vt[-1],
        tolerance=tolerance,
    )


def _order(labels: Sequence[str], names: list[str], preference: Sequence[str] | None) -> list[int]:
    preferred = list(dict.fromkeys(preference or ()))
    unknown = [label for label in preferred if label not in labels]
    if unknown:
        raise InputError(f"preferred parameters {several(unknown)} are not among those asked for: {several(labels)}")
    ordered = [label for label in preferred if label in names]
    ordered += [label for label in names if label not in ordered]
    return [names.index(label) for label in ordered]


def _retained(scaled: Array, order: list[int], tolerance: float) -> list[int]:
    """Columns, in the order of the matrix, that are independent of those preferred to them."""
    basis = np.zeros((len(scaled), 0))
    kept: list[int] = []
    for k in order:
        if len(kept) == len(scaled):
            break
        rest = scaled[:, k]
        for _ in range(2):  # the second pass removes what rounding left of the first
            rest = rest - basis @ (basis.T @ rest)
        length = np.linalg.norm(rest)
        if length > tolerance:
            basis = np.column_stack([basis, rest / length])
            kept.append(k)
    return sorted(kept)


def _groups(scaled: Array, names: list[str], tolerance: float) -> tuple[tuple[str, ...], ...]:
    """Names whose unit columns are equal or opposite."""
    groups: list[tuple[str, ...]] = []
    free = list(range(len(names)))
    while free:
        first = scaled[:, free[0]]
        along = first @ scaled[:, free]
        apart = np.linalg.norm(scaled[:, free] - np.outer(first, along), axis=0)
        same = [k for k, distance in zip(free, apart, strict=True) if distance <= tolerance]
        groups.append(tuple(names[k] for k in same))
        free = [k for k in free if k not in same]
    return tuple(groups)


def _condition(matrix: Array) -> float:
    values = np.linalg.svd(matrix, compute_uv=False)
    return float(values[0] / values[-1]) if values[-1] > 0 else float("inf")
