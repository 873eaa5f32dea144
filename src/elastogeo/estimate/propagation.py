"""Propagation of uncertainty: to first order (JCGM 100) and by random draws (JCGM 101)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, isfinite

import numpy as np
from scipy.linalg import solve_triangular

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate.factor import Array, Factor
from elastogeo.estimate.solution import solve

BLOCK_TRIALS = 10_000
"""Least trials between two looks at the stability; high coverage needs more (JCGM 101, 7.9.4 b)."""


def first_order(sensitivities: Array, covariance: Array) -> Array:
    """Covariance of the outputs, shape (q, q), by the law of propagation (JCGM 100, 5.2; JCGM 102, 6.2).

    Parameters
    ----------
    sensitivities : array, shape (q, n)
        Change of each output per unit of each input.
    covariance : array, shape (n, n)
        Of the inputs.
    """
    return np.asarray(sensitivities @ covariance @ sensitivities.T)


def draw_estimates(factor: Factor, sigma: float, trials: int, random: np.random.Generator) -> Array:
    """Estimates from repetitions of the same observations with other noise, shape (trials, p).

    Each trial is what readings with independent Gaussian errors would give, all of them solved anew: through the triangle it
    is `R p = z + sigma xi` with p standard normal numbers, whatever the number of readings.

    Parameters
    ----------
    factor : Factor
        Of p columns, all independent.
    sigma : float
        Standard deviation of one reading.
    trials : int
    random : numpy.random.Generator

    Raises
    ------
    InputError
        If sigma is no finite number of at least zero.
    RankError
        If the columns are dependent.
    DegreesOfFreedomError
        If there are no more readings than parameters.
    """
    if not (isfinite(sigma) and sigma >= 0):
        raise InputError(f"the standard deviation of a reading is {sigma:g}, it must be finite and not negative")
    values, norms = solve(factor).values, factor.column_norms
    root = solve_triangular(factor.R / norms, sigma * np.eye(len(norms))) / norms[:, np.newaxis]
    draws = random.standard_normal((trials, len(norms))) @ root.T
    draws += values
    return np.asarray(draws)


def effective_degrees_of_freedom(
    contributions: Array, degrees_of_freedom: Array, labels: Sequence[str] | None = None
) -> Array:
    """Welch-Satterthwaite (JCGM 100, G.2b), shape (q,).

    Parameters
    ----------
    contributions : array, shape (q, n)
        Standard uncertainty that each independent input contributes to each output.
    degrees_of_freedom : array, shape (n,) or (q, n)
        Of the inputs; may be infinite.
    labels : sequence of str, length n, optional
        Inputs of one label have their size from one estimate (the parts of one covariance): together they have its degrees
        of freedom, the least that any of them has, and not each its own.
    """
    if labels is not None:
        kinds = list(dict.fromkeys(labels))
        of_kind = [[k for k, label in enumerate(labels) if label == kind] for kind in kinds]
        degrees = np.broadcast_to(degrees_of_freedom, contributions.shape)
        degrees_of_freedom = np.column_stack([degrees[:, own].min(axis=1) for own in of_kind])
        contributions = np.column_stack([np.linalg.norm(contributions[:, own], axis=1) for own in of_kind])
    total = (contributions**2).sum(axis=1)
    spread = (contributions**4 / degrees_of_freedom).sum(axis=1)
    return np.asarray(np.divide(total**2, spread, out=np.full(len(total), np.inf), where=spread > 0))


@dataclass(frozen=True, slots=True)
class MonteCarlo:
    """What random draws say of q outputs.

    Attributes
    ----------
    mean, standard_uncertainty : array, shape (q,)
    interval : array, shape (q, 2)
        Probabilistically symmetric coverage interval.
    shortest : array, shape (q, 2)
        Shortest coverage interval.
    trials : int
    tolerance : array, shape (q,)
        Numerical tolerance of the standard uncertainty to which the results are stable (JCGM 101, 7.9.2).
    """

    mean: Array
    standard_uncertainty: Array
    interval: Array
    shortest: Array
    trials: int
    tolerance: Array


def monte_carlo(
    outputs: Callable[[np.random.Generator, int], Array],
    coverage: float = 0.95,
    digits: int = 2,
    seed: int = 0,
    most: int = 5_000_000,
) -> MonteCarlo:
    """Draw until the results are stable (adaptive procedure, JCGM 101, 7.9.4).

    Parameters
    ----------
    outputs : callable
        `outputs(random, count)` gives draws of the outputs, shape (count, q).
    coverage : float
    digits : int
        Significant digits of the standard uncertainty that are to be stable.
    seed : int
    most : int
        Trials after which to give up.

    Returns
    -------
    MonteCarlo

    Raises
    ------
    InputError
        If the coverage is no probability, or an output is no finite number.
    UnsupportedError
        If the results are not stable by then.
    """
    if not 0 < coverage < 1:
        raise InputError(f"a coverage probability lies between 0 and 1, got {coverage:g}")
    size = max(BLOCK_TRIALS, ceil(round(100 / (1 - coverage), 6)))
    random = np.random.default_rng(seed)
    blocks: list[Array] = []
    figures: list[Array] = []
    while (len(blocks) + 1) * size <= most:
        block = outputs(random, size)
        if not np.isfinite(block).all():
            wrong = int((~np.isfinite(block)).any(axis=1).sum())
            raise InputError(f"{wrong} of {size} Monte Carlo trials gave an output that is NaN or infinite")
        blocks.append(block)
        low, high = _symmetric(block, coverage)
        figures.append(np.array([block.mean(axis=0), block.std(axis=0, ddof=1), low, high]))
        if len(blocks) < 2:
            continue
        spread = 2 * np.std(figures, axis=0, ddof=1) / np.sqrt(len(figures))
        tolerance = numerical_tolerance(np.mean([figure[1] for figure in figures], axis=0), digits)
        if (spread <= tolerance).all():
            return _summary(np.concatenate(blocks), coverage, tolerance)
    raise UnsupportedError(
        f"after {most} Monte Carlo trials the results are not stable to {digits} digits of the standard uncertainty; "
        f"ask for fewer digits"
    )


def numerical_tolerance(standard_uncertainty: Array, digits: int) -> Array:
    """Half a unit of the last of so many significant digits (JCGM 101, 7.9.2), shape of the uncertainty."""
    positive = np.where(standard_uncertainty > 0, standard_uncertainty, 1.0)
    exponent = np.floor(np.log10(positive)) - (digits - 1)
    return np.where(standard_uncertainty > 0, 0.5 * 10.0**exponent, 0.0)


def _summary(draws: Array, coverage: float, tolerance: Array) -> MonteCarlo:
    ordered = np.sort(draws, axis=0)
    inside = round(coverage * len(ordered))
    widths = ordered[inside:] - ordered[: len(ordered) - inside]
    first = widths.argmin(axis=0)
    outputs = np.arange(ordered.shape[1])
    return MonteCarlo(
        mean=draws.mean(axis=0),
        standard_uncertainty=draws.std(axis=0, ddof=1),
        interval=np.column_stack(_symmetric(draws, coverage)),
        shortest=np.column_stack([ordered[first, outputs], ordered[first + inside, outputs]]),
        trials=len(draws),
        tolerance=tolerance,
    )


def _symmetric(draws: Array, coverage: float) -> tuple[Array, Array]:
    low, high = np.quantile(draws, [(1 - coverage) / 2, (1 + coverage) / 2], axis=0)
    return low, high
