"""A model with its errors: over all readings, at left-out runs and at left-out force levels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.identification.model_choice.comparison import SEARCHED, Comparison
from elastogeo.identification.model_choice.evidence import weights_by_order
from elastogeo.identification.model_choice.families import Family
from elastogeo.identification.model_choice.result import Candidate
from elastogeo.identification.model_choice.shapes import Mask, Shapes
from elastogeo.machine import Array

_DETERMINED = 1e-9
"""Least eigenvalue of `I - H` of a group of runs whose others determine the model."""


@dataclass(frozen=True, slots=True, eq=False)
class _Least:
    """Least squares of a model on the shapes."""

    Q: Array
    left: Array

    @classmethod
    def of(cls, shapes: Shapes, labels: Sequence[str]) -> _Least:
        Q = np.linalg.qr(shapes.of(labels))[0]
        return cls(Q, shapes.reading - Q @ (Q.T @ shapes.reading))

    def without(self, rows: Mask) -> float | None:
        """Sum of squared errors of rows that are predicted from all others; None if these do not determine the model."""
        own = self.Q[rows]
        values, vectors = np.linalg.eigh(np.eye(len(own)) - own @ own.T)
        if not len(values) or values[0] <= _DETERMINED:
            return None
        return float(np.sum((vectors.T @ self.left[rows] / values) ** 2))


def fit(chosen: Comparison, family: Family, p_value: float, sufficient: bool, asked: Candidate | None = None) -> Candidate:
    """A model with its errors.

    Parameters
    ----------
    chosen : Comparison
    family : Family
        What it has besides.
    p_value : float
        Of what it lacks.
    sufficient : bool
    asked : Candidate, optional
        The model as asked, to which its errors are compared.
    """
    labels, shapes = [*chosen.model, *family.added], chosen.shapes
    least, readings, rest = _Least.of(shapes, labels), shapes.readings, shapes.rest
    runs = _left_out(shapes, least, [(k,) for k in range(len(rest))])
    levels = _left_out(shapes, least, [group for _, group in chosen.levels])
    errors: Array | None = None
    if levels is not None:
        of_level = [(rest[list(group)].sum(), readings[list(group)].sum()) for _, group in chosen.levels]
        errors = np.array([np.sqrt((e + more) / count) for e, (more, count) in zip(levels, of_level, strict=True)])
    ratios: Array | None = None
    if asked is not None and errors is not None and asked.level_errors:
        ratios = np.log(np.array(asked.level_errors) / errors)
    owners = tuple(chosen.owners[label.removesuffix(SEARCHED)] for label in family.added)

    def rmse(squares: float) -> float:
        return float(np.sqrt((squares + rest.sum()) / readings.sum()))

    return Candidate(
        name=family.name,
        places=tuple(dict.fromkeys(chosen.places[name] for names in owners for name in names)),
        added=family.added,
        stands_for=owners,
        values=tuple(map(float, _values(shapes, labels)[len(chosen.model) :])),
        exponent=family.exponent,
        parameters=len(chosen.model) + family.parameters,
        rmse=rmse(float(np.sum(least.left**2))),
        left_out_run=None if runs is None else rmse(float(runs.sum())),
        left_out_level=None if levels is None else rmse(float(levels.sum())),
        level_errors=() if errors is None else tuple(map(float, errors)),
        log_ratio=None if ratios is None else float(ratios.mean()),
        log_ratio_uncertainty=None if ratios is None else float(ratios.std(ddof=1) / np.sqrt(len(ratios))),
        p_value=p_value,
        sufficient=sufficient,
    )


def _values(shapes: Shapes, labels: Sequence[str]) -> Array:
    """Parameters, orders weighed by their scatter."""
    weights = weights_by_order(shapes, labels)
    values = np.linalg.lstsq(shapes.of(labels) * weights[:, np.newaxis], shapes.reading * weights, rcond=None)[0]
    return np.asarray(values / shapes.lengths_of(labels))


def _left_out(shapes: Shapes, least: _Least, groups: Sequence[Sequence[int]]) -> Array | None:
    """Sum of squared errors of each group of runs, predicted from all others; None if they do not determine the model."""
    squares = [least.without(np.isin(shapes.run, group)) for group in groups]
    return None if any(square is None for square in squares) else np.array(squares, dtype=float)
