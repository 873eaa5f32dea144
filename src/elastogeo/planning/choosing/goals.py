"""What a plan is to be good for: a number of the covariance that it would leave, greater for a better plan.

    W = L^-1 B S, with L L^T = I + B S B^T, is what rows B take off a covariance S: S - W^T W.

So the score of adding each of all candidates is a few products for all of them at once.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array

KNOWN = 0.2
"""Standard uncertainty, in scales, at which a parameter counts half as known: `t^2 / (t^2 + u^2)`.

A count of those below it is jagged; the sum of these is smooth, and grows with it."""

SHARP = 12
"""The power mean of variances, of this power, that stands for their greatest while a plan is improved: it has a slope."""


class Goal(ABC):
    """A number of the covariance, in the space of the candidates, that a plan leaves. Greater is better.

    Attributes
    ----------
    name : str
        A constant, as users ask for it.
    """

    name: str = ""

    @abstractmethod
    def score(self, covariance: Array) -> float:
        """Of a covariance, shape (r, r)."""

    @abstractmethod
    def scores(self, covariance: Array, rows: Array) -> Array:
        """Of a covariance with each candidate added, shape (n,); candidates' rows have the shape (n, q, r)."""


def taken_off(covariance: Array, rows: Array) -> tuple[Array, Array]:
    """What each candidate takes off a covariance, W of shape (n, q, r), and the diagonal of its L, shape (n, q)."""
    through = rows @ covariance
    L = np.linalg.cholesky(np.eye(rows.shape[1]) + through @ rows.transpose(0, 2, 1))
    return np.linalg.inv(L) @ through, np.diagonal(L, axis1=1, axis2=2)


@dataclass(frozen=True, slots=True, eq=False)
class Information(Goal):
    """The log determinant of the information (D): all directions, however little one needs them."""

    name = "information"

    def score(self, covariance: Array) -> float:
        """Less the log determinant of the covariance."""
        return -float(np.linalg.slogdet(covariance)[1])

    def scores(self, covariance: Array, rows: Array) -> Array:
        """With each candidate added, shape (n,)."""
        _, diagonal = taken_off(covariance, rows)
        return np.asarray(self.score(covariance) + 2 * np.log(diagonal).sum(axis=1))


@dataclass(frozen=True, slots=True, eq=False)
class Variances(Goal):
    """A goal that is a number of the variances of functionals.

    Attributes
    ----------
    functionals : array, shape (m, r)
        In the space of the candidates.
    outside : array, shape (m,)
        Variance of each that no candidate takes off.
    """

    functionals: Array
    outside: Array

    def variances(self, covariance: Array) -> Array:
        """Of each functional, shape (m,)."""
        inside = np.sum((self.functionals @ covariance) * self.functionals, axis=1)
        return np.asarray(self.outside + inside)

    def score(self, covariance: Array) -> float:
        """Of a covariance."""
        return float(self.of(self.variances(covariance)[np.newaxis])[0])

    def scores(self, covariance: Array, rows: Array) -> Array:
        """With each candidate added, shape (n,)."""
        W, _ = taken_off(covariance, rows)
        less = np.einsum("nqm->nm", (W @ self.functionals.T) ** 2)
        return self.of(np.maximum(self.variances(covariance) - less, 0.0))

    @abstractmethod
    def of(self, variances: Array) -> Array:
        """The number, shape (n,), of variances of shape (n, m)."""


@dataclass(frozen=True, slots=True, eq=False)
class Parameters(Variances):
    """How many parameters become known: the sum of `t^2 / (t^2 + u^2)`, u in scales."""

    name = "parameters"

    def of(self, variances: Array) -> Array:
        """The sum over the parameters, shape (n,)."""
        return np.asarray(np.sum(KNOWN**2 / (KNOWN**2 + variances), axis=1))


@dataclass(frozen=True, slots=True, eq=False)
class MeanVariance(Variances):
    """The mean variance of the functionals (I-optimal)."""

    name = "mean"

    def of(self, variances: Array) -> Array:
        """Less the mean, shape (n,)."""
        return np.asarray(-variances.mean(axis=1))

    def scores(self, covariance: Array, rows: Array) -> Array:
        """With each candidate added, shape (n,): without the variance of each functional."""
        W, _ = taken_off(covariance, rows)
        moment = self.functionals.T @ self.functionals / len(self.functionals)
        return np.asarray(self.score(covariance) + np.einsum("nqr,nqr->n", W @ moment, W))


@dataclass(frozen=True, slots=True, eq=False)
class NearlyWorst(Variances):
    """A power mean of the variances that comes near to their greatest."""

    name = "nearly worst"

    def of(self, variances: Array) -> Array:
        """Less the power mean, shape (n,)."""
        worst = variances.max(axis=1)
        worst = np.where(worst > 0, worst, 1.0)
        return np.asarray(-worst * np.mean((variances / worst[:, np.newaxis]) ** SHARP, axis=1) ** (1 / SHARP))


@dataclass(frozen=True, slots=True, eq=False)
class Worst(Variances):
    """The greatest variance of the functionals (minimax)."""

    name = "workspace"

    def of(self, variances: Array) -> Array:
        """Less the greatest, shape (n,)."""
        return np.asarray(-variances.max(axis=1))
