"""How the deflection of a machine goes with the force: a line, a parabola, a contact that stiffens, and a path.

    reading = path + c_1 F                   constant
    reading = path + c_1 F + c_2 F^2         linear in the force
    reading = path + c_1 F + h F^a           contact, 0.3 < a < 0.95, one exponent for all directions

in every direction by itself. What is the same at every force is the path's, so **a deflection that is complete before the
least engagement is in the path**: no law tells the two apart. Which law the data support is decided by predicting every
engagement from the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc, stdtrit

from elastogeo.identification.rollers.curves import Curves
from elastogeo.machine import Array

EXPONENTS = (0.3, 0.95)
"""Within which the exponent of a contact is searched; at 1 it is a constant compliance."""

WORTH_HAVING = 0.01
"""A law that lowers the error at left-out engagements by less than this share is not worth its parameters."""

MISFIT = 0.01
"""p value below which the engagements do not follow a law."""

SURE = 0.95
"""One-sided level of confidence of a better prediction."""


@dataclass(frozen=True, slots=True, eq=False)
class Law:
    """A law, fitted in k directions.

    Attributes
    ----------
    name : str
    powers : tuple of float
        Of the force.
    coefficients : array, shape (powers + 1, k)
        Of the powers, the path last [mm/N^power].
    variance : array, shape (k,) [mm^2]
        Of a reading about the law.
    degrees_of_freedom : int
    """

    name: str
    powers: tuple[float, ...]
    coefficients: Array
    variance: Array
    degrees_of_freedom: int

    @property
    def path(self) -> Array:
        """What the path is off in each direction, shape (k,) [mm]: the same at every force."""
        return np.asarray(self.coefficients[-1])

    def compliance(self, force: Array) -> Array:
        """Compliance at forces, shape of the forces (.., k) [mm/N]: the slope of the deflection."""
        powers = np.array(self.powers)[:, np.newaxis]
        slopes = (self.coefficients[:-1] * powers)[:, np.newaxis, :] * force[np.newaxis] ** (powers[..., np.newaxis] - 1.0)
        return np.asarray(slopes.sum(axis=0))


@dataclass(frozen=True, slots=True)
class LawScore:
    """A law in the comparison.

    Attributes
    ----------
    name : str
    exponent : float or None
        Of a contact.
    rmse : float [mm]
        Over all points.
    left_out : float [mm]
        Root mean square error at engagements that were predicted from the others.
    better : bool
        Whether it predicts them better than the constant compliance, surely (one-sided 95 % over the engagements).
    """

    name: str
    exponent: float | None
    rmse: float
    left_out: float
    better: bool


@dataclass(frozen=True, slots=True)
class LawChoice:
    """The laws that were compared, and the one that the engagements support.

    Attributes
    ----------
    scores : tuple of LawScore
        Empty if the engagements are too few to leave one out.
    supported : str
    alike : tuple of str
        Laws beside it that these engagements do not distinguish from it: better than the constant, and not surely worse.
    misfit : float or None
        p value of the supported law's misfit at the means of the engagements, against the scatter of their runs; None
        where nothing is left to judge it by.
    misfit_size : float [mm]
        Root mean square of what the law leaves of these means.
    """

    scores: tuple[LawScore, ...]
    supported: str
    alike: tuple[str, ...]
    misfit: float | None
    misfit_size: float

    @property
    def follows(self) -> bool:
        """Whether the engagements may follow the supported law: its misfit is no greater than their scatter explains."""
        return self.misfit is None or self.misfit >= MISFIT


def fit_law(curves: Curves, name: str, powers: Sequence[float], change: int | None = None) -> Law:
    """Fit a law in every direction, as recorded or with one of the changes of the curves."""
    force, reading = points(curves, change)
    coefficients = _solved(force, reading, powers)
    left = reading - _predicted(force, coefficients, powers)
    freedom = len(force) - len(coefficients)
    variance = np.sum(left**2, axis=0) / freedom if freedom > 0 else np.full(force.shape[1], np.nan)
    return Law(name, tuple(powers), coefficients, variance, freedom)


def points(curves: Curves, change: int | None = None) -> tuple[Array, Array]:
    """Force and reading of every run and direction, as recorded or with one of the changes of the curves."""
    if change is None:
        return curves.force, curves.reading
    moved = curves.changes[change]
    return curves.force + moved.force, curves.reading + moved.reading


def choose_law(curves: Curves) -> tuple[Law, LawChoice]:
    """The law that the engagements of a test support: the simplest that none surely beats by a gain worth having."""
    constant = fit_law(curves, "constant", (1.0,))
    if len(curves.levels) < 4:
        misfit, size = _misfit(curves, constant)
        return constant, LawChoice((), "constant", (), misfit, size)
    exponent = _exponent(curves)
    laws = {
        "constant": constant,
        "linear": fit_law(curves, "linear", (1.0, 2.0)),
        "contact": fit_law(curves, "contact", (1.0, exponent)),
    }
    errors = {name: _left_out(curves, law.powers) for name, law in laws.items()}
    scores = tuple(
        LawScore(
            name,
            exponent if name == "contact" else None,
            float(np.sqrt(np.mean((curves.reading - _predicted(curves.force, law.coefficients, law.powers)) ** 2))),
            float(np.sqrt(np.mean(errors[name]))),
            name != "constant" and _surely(errors["constant"], errors[name]),
        )
        for name, law in laws.items()
    )
    best = min(scores, key=lambda score: (not score.better, score.left_out)) if any(s.better for s in scores) else scores[0]
    rivals = [score.name for score in scores if score.better and score.name != best.name]
    alike = tuple(name for name in rivals if not _surely(errors[name], errors[best.name]))
    misfit, size = _misfit(curves, laws[best.name])
    return laws[best.name], LawChoice(scores, best.name, alike, misfit, size)


def within_levels(curves: Curves, compliance: Array) -> tuple[Array, int]:
    """Variance of a point about the mean of its engagement, shape (k,) [mm^2], along the curve; its degrees of freedom."""
    rest = curves.reading - compliance * curves.force
    left = rest - curves.mean(rest)[curves.level]
    freedom = len(rest) - len(curves.levels)
    return (np.sum(left**2, axis=0) / freedom if freedom > 0 else np.full(rest.shape[1], np.nan)), freedom


def _surely(one: Array, other: Array) -> bool:
    """Whether the other predicts the engagements better: mean log ratio of the errors, one-sided t, and worth having."""
    gain = np.log(one / other) / 2
    least = gain.mean() - stdtrit(len(gain) - 1, SURE) * gain.std(ddof=1) / np.sqrt(len(gain))
    return bool(least > 0 and np.sqrt(np.mean(other)) < (1 - WORTH_HAVING) * np.sqrt(np.mean(one)))


def _left_out(curves: Curves, powers: Sequence[float]) -> Array:
    """Mean square error of the points of each engagement, predicted from all others, shape (levels,) [mm^2]."""
    errors = []
    for n in range(len(curves.levels)):
        out: NDArray[np.bool_] = curves.level == n
        coefficients = _solved(curves.force[~out], curves.reading[~out], powers)
        errors.append(np.mean((curves.reading[out] - _predicted(curves.force[out], coefficients, powers)) ** 2))
    return np.array(errors)


def _exponent(curves: Curves) -> float:
    """The exponent of the least residual sum of squares over all directions."""
    from scipy.optimize import minimize_scalar

    def left(exponent: float) -> float:
        powers = (1.0, exponent)
        coefficients = _solved(curves.force, curves.reading, powers)
        return float(np.sum((curves.reading - _predicted(curves.force, coefficients, powers)) ** 2))

    return float(minimize_scalar(left, bounds=EXPONENTS, method="bounded", options={"xatol": 1e-4}).x)


def _columns(force: Array, powers: Sequence[float]) -> Array:
    """Design of every direction, shape (k, r, powers + 1)."""
    return np.stack([*(force.T**power for power in powers), np.ones(force.T.shape)], axis=-1)


def _solved(force: Array, reading: Array, powers: Sequence[float]) -> Array:
    """Coefficients of a law by least squares in each direction, shape (powers + 1, k); columns scaled."""
    design = _columns(force, powers)
    norms = np.linalg.norm(design, axis=1, keepdims=True)
    found = np.linalg.pinv(design / norms) @ reading.T[..., np.newaxis]
    return np.asarray(found[..., 0].T / norms[:, 0].T)


def _predicted(force: Array, coefficients: Array, powers: Sequence[float]) -> Array:
    return np.asarray(np.einsum("krp,pk->rk", _columns(force, powers), coefficients))


def _misfit(curves: Curves, law: Law) -> tuple[float | None, float]:
    """p value and size [mm] of what a law leaves of the means of the engagements, against the scatter of their runs."""
    left = curves.reading - _predicted(curves.force, law.coefficients, law.powers)
    means = curves.mean(left)
    size = float(np.sqrt(np.mean(means**2)))
    free = len(curves.levels) - len(law.coefficients)
    variance, freedom = within_levels(curves, law.compliance(curves.force))
    if free < 1 or freedom < 1:
        return None, size
    runs = np.bincount(curves.level)[:, np.newaxis]
    ratio = float(np.sum(runs * means**2) / free / np.sum(variance))
    return float(fdtrc(free, freedom, ratio)), size
