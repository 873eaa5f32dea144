"""Least-squares solutions from a factor, with their covariance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.special import stdtrit

from elastogeo.equality import ByValue
from elastogeo.errors import DegreesOfFreedomError, RankError, several
from elastogeo.estimate.confounding import RANK_TOLERANCE
from elastogeo.estimate.estimate import Estimate
from elastogeo.estimate.factor import Array, Factor, select
from elastogeo.estimate.run_scatter import RunScatter

SOLVABLE = 1e-12
"""Least ratio of singular values of the scaled columns that is solved; below, rounding error decides. Far below the
tolerance of `confounding`, whose retained sets must be solvable however weak a direction of theirs is."""


@dataclass(frozen=True, slots=True)
class Noise:
    """How the errors of the rows belong together: their covariance is `sigma^2 Omega`.

    Attributes
    ----------
    root : array, shape (k, p)
        `root^T root = A^T Omega A`, columns in the order of the factor's labels.
    trace, square : float
        Traces of Omega and of Omega squared.
    """

    root: Array
    trace: float
    square: float


@dataclass(frozen=True, slots=True, eq=False)
class Solution(ByValue):
    """Estimated parameters.

    Attributes
    ----------
    labels : tuple of str
    values : array, shape (p,)
    covariance : array, shape (p, p)
        Of the values.
    degrees_of_freedom : array, shape (p,)
        Of the standard uncertainty of each value.
    residual_std : float
        Estimated standard deviation of one reading.
    scatter : RunScatter or None
        How the runs scatter about it, where its covariance assumes independent runs.
    """

    labels: tuple[str, ...]
    values: Array
    covariance: Array
    degrees_of_freedom: Array
    residual_std: float
    scatter: RunScatter | None = None

    @property
    def standard_uncertainty(self) -> Array:
        """Standard uncertainty of each value, shape (p,) (JCGM 100, 4.2)."""
        return np.sqrt(np.diag(self.covariance))

    def estimate(self, label: str) -> Estimate:
        """One of the values, with what it is worth."""
        at = self.labels.index(label)
        return Estimate(float(self.values[at]), float(np.sqrt(self.covariance[at, at])), float(self.degrees_of_freedom[at]))

    def estimates(self) -> tuple[Estimate, ...]:
        """Each value with what it is worth, in the order of the labels."""
        return tuple(self.estimate(label) for label in self.labels)

    def interval(self, coverage: float = 0.95) -> Array:
        """Coverage intervals, shape (p, 2), by Student's t (JCGM 100, annex G)."""
        half = stdtrit(self.degrees_of_freedom, 0.5 + coverage / 2) * self.standard_uncertainty
        return np.column_stack([self.values - half, self.values + half])


def white_noise(factor: Factor) -> Noise:
    """Independent errors of equal size: Omega is the identity."""
    return Noise(factor.R, float(factor.rows), float(factor.rows))


def solve(
    factor: Factor, labels: Sequence[str] | None = None, noise: Noise | None = None, tolerance: float = SOLVABLE
) -> Solution:
    """Least-squares solution for parameters that the observations determine.

    Parameters
    ----------
    factor : Factor
    labels : sequence of str, optional
        Parameters to solve for, the others being left out of the model (zero); default all.
    noise : Noise, optional
        Covariance structure of the rows; default independent and equal.
    tolerance : float
        Least ratio of singular values of the scaled columns that is solved.

    Returns
    -------
    Solution
        Ordinary least squares; the covariance is that of the estimate under `noise`, scaled by the residuals
        (JCGM 100, H.3 for the white case).

    Raises
    ------
    RankError
        If the columns are dependent: ask `confounding` what can be distinguished.
    DegreesOfFreedomError
        If there are no more readings than parameters.
    """
    noise = white_noise(factor) if noise is None else noise
    labels = factor.labels if labels is None else tuple(labels)
    chosen = select(factor, labels)
    norms = chosen.column_norms
    if not norms.all():
        null = [label for label, norm in zip(labels, norms, strict=True) if not norm]
        raise RankError(f"{several(null)} changes no reading of this test, it cannot be estimated")
    R = chosen.R / norms
    singular_values = np.linalg.svd(R, compute_uv=False)
    if singular_values[-1] <= tolerance * singular_values[0]:
        raise RankError(
            f"the {len(labels)} parameters {several(labels)} are not independent in this test; "
            f"ask for the confounding and solve for its retained set"
        )
    root = noise.root[:, [factor.labels.index(label) for label in labels]] / norms
    projected = solve_triangular(R, root.T, trans="T")
    spread = solve_triangular(R, projected)
    covariance = spread @ spread.T / np.outer(norms, norms)
    freedom = noise.trace - float(np.sum(projected**2))
    count = noise.trace**2 / noise.square - len(labels)
    if freedom <= 0 or count <= 0:
        raise DegreesOfFreedomError(
            f"{factor.rows} readings cannot give {len(labels)} parameters an uncertainty; measure more readings"
        )
    variance = chosen.residual_norm**2 / freedom
    return Solution(
        labels=labels,
        values=solve_triangular(R, chosen.z) / norms,
        covariance=variance * covariance,
        degrees_of_freedom=np.full(len(labels), count),
        residual_std=float(np.sqrt(variance)),
    )


def minimum_norm(factor: Factor, tolerance: float = RANK_TOLERANCE) -> Array:
    """Minimum-norm solution over all parameters, shape (p,), on scaled columns.

    Among the solutions that fit equally well, the one whose scaled parameters are smallest: identical columns share their
    sum equally (Table 4.3). **It is not an estimate of each parameter**: what cannot be distinguished stays untold.
    """
    norms = factor.column_norms
    scale = np.divide(1.0, norms, out=np.zeros_like(norms), where=norms > 0)
    U, s, Vt = np.linalg.svd(factor.R * scale)
    inverse = np.divide(1.0, s, out=np.zeros_like(s), where=s > tolerance * s[0])
    return np.asarray(scale * (Vt.T @ (inverse * (U.T @ factor.z))))
