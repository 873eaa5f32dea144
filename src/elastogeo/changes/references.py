"""What a test is held against: the mean of the baseline, the scatter between tests, what the temperature does.

The baseline is frozen: a reference that learns from the tests that it judges learns a change as normal.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.changes.priors import Prior, default_prior
from elastogeo.changes.series import Baseline, Series
from elastogeo.equality import ByValue
from elastogeo.errors import InputError, several
from elastogeo.machine import Array

Marks = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]

PER_KELVIN = 0.4
"""What a kelvin is expected to change, in standard deviations between tests, before a baseline has shown it: a season of
5 K moves an indicator by two."""

LEAST_TEMPERATURES = 3
"""Tests of a baseline whose temperature is known, below which temperatures are left out."""


@dataclass(frozen=True, slots=True, eq=False)
class Reference(ByValue):
    """What tests are judged by, of q indicators; further axes before are machines.

    Attributes
    ----------
    mean : array, shape (..., q)
        Of the baseline, at its mean temperature where there is a slope; NaN where no test of it determines the indicator.
    deviation : array, shape (..., q)
        Standard deviation between tests, shrunk to the prior, never below the uncertainty that the tests state.
    degrees_of_freedom : array, shape (..., q)
        Of it.
    count : array, shape (..., q)
        Tests of the baseline that determine the indicator.
    relevance : array, shape (..., q)
        Least change that matters, in the units of the kinds.
    slope : array, shape (..., q) [1/K]
        What a kelvin changes, drawn to 0 by as much as the baseline does not tell it; 0 without temperatures.
    temperature : array, shape (..., q) [degC]
        Mean of the baseline; NaN without temperatures.
    spread : array, shape (..., q) [K^2]
        What the leverage of a temperature rests on: sum of squares about it, and what is known of a slope beforehand.
        Infinite where there is no slope.
    unknown : array, shape (..., q)
        Standard deviation that the temperatures of the baseline made: how far off a test may be without one.
    """

    mean: Array
    deviation: Array
    degrees_of_freedom: Array
    count: Array
    relevance: Array
    slope: Array
    temperature: Array
    spread: Array
    unknown: Array


def reference_of(
    series: Series,
    baseline: Baseline,
    prior: Prior | None = None,
    relevance: Mapping[str, float] | None = None,
) -> Reference:
    """The reference of a series from the tests of its baseline that are not set aside.

    Parameters
    ----------
    series : Series
    baseline : Baseline
    prior : Prior, optional
        Of a fleet; what it does not know (NaN), and all if there is none, is the kind's own.
    relevance : mapping of str to float, optional
        By indicator, in place of the kind's: a share of the mean where the kind is relative, otherwise in its unit.

    Raises
    ------
    InputError
        If the baseline names a test that the series does not have, or the relevance an indicator.
    """
    place = {name: k for k, name in enumerate(series.tests)}
    if lost := [name for name in baseline.tests if name not in place]:
        raise InputError(f"the baseline of {series.name} names tests that the series does not have: {several(lost)}")
    given = dict(relevance or {})
    if lost := sorted(given.keys() - set(series.indicators)):
        raise InputError(f"{series.name} has no indicator {several(lost)}; it has {several(series.indicators)}")
    rows = [place[name] for name in baseline.tests if not series.aside[place[name]]]
    value, u = series.value[rows], series.standard_uncertainty[rows]
    named = zip(series.indicators, series.kinds, strict=True)
    least = np.array([given.get(name, kind.relevance) for name, kind in named])
    relative = np.array([kind.relative for kind in series.kinds], dtype=bool)
    own = default_prior(series.kinds, _mean(value, np.isfinite(value)))
    if prior is not None:
        own = Prior(
            np.where(np.isfinite(prior.degrees_of_freedom), prior.degrees_of_freedom, own.degrees_of_freedom),
            np.where(np.isfinite(prior.deviation), prior.deviation, own.deviation),
        )
    found = reference_from(value, own, u, series.temperature[rows])
    return replace(found, relevance=least * np.where(relative, np.abs(found.mean), 1.0))


def reference_from(
    value: Array, prior: Prior, standard_uncertainty: Array | None = None, temperature: Array | None = None
) -> Reference:
    """The reference from the values of baselines, without a least change that matters.

    Parameters
    ----------
    value : array, shape (..., m, q)
        Of m tests; NaN where a test does not determine an indicator.
    prior : Prior
        In the same units.
    standard_uncertainty : array, shape (..., m, q), optional
        By each test; NaN or infinite where it is not known.
    temperature : array, shape (..., m) [degC], optional
        NaN where it is not known.

    Notes
    -----
    s^2 = (nu0 s0^2 + nu s_b^2) / (nu0 + nu), nu = m - 1; never below the mean u^2.

    The slope b is a regression in which 0 +- `PER_KELVIN` s is one observation more: b = sum(dT dx) / (S + s^2 / b0^2). A
    baseline that saw hot and cold days tells it, one in an even room hardly: a hot day then counts with what it *may* do,
    neither with nothing nor with a slope made of scatter. nu is less by the share of the slope that the baseline tells.
    """
    shown = np.isfinite(value)
    m = np.sum(shown, axis=-2).astype(float)
    mean = _mean(value, shown)
    warm = _temperatures(shown, temperature)
    known = shown & np.isfinite(warm)
    centre = _mean(warm, known)
    off = np.where(known, warm - centre[..., np.newaxis, :], 0.0)
    left = np.where(shown, value - mean[..., np.newaxis, :], 0.0)
    used = np.sum(known, axis=-2) >= LEAST_TEMPERATURES
    seen = np.sum(off**2, axis=-2)
    spread = np.where(used, seen + 1 / PER_KELVIN**2, np.inf)
    product = np.sum(off * left, axis=-2)
    slope = product / spread
    worth = prior.degrees_of_freedom + np.maximum(m - 1 - seen / spread, 0.0)
    variance = (prior.degrees_of_freedom * prior.deviation**2 + np.sum(left**2, axis=-2) - slope * product) / worth
    if standard_uncertainty is not None:
        stated = _mean(standard_uncertainty**2, shown & np.isfinite(standard_uncertainty))
        variance = np.maximum(variance, np.nan_to_num(stated))
    scatter = np.where(used, seen, 0.0) / np.maximum(np.sum(known, axis=-2) - 1, 1)
    return Reference(
        mean=mean,
        deviation=np.sqrt(variance),
        degrees_of_freedom=worth,
        count=m,
        relevance=np.zeros(m.shape),
        slope=slope,
        temperature=np.where(used, centre, np.nan),
        spread=spread,
        unknown=np.sqrt((slope**2 + variance / spread) * scatter),
    )


def _mean(value: Array, shown: Marks) -> Array:
    number = np.sum(shown, axis=-2)
    total = np.sum(np.where(shown, value, 0.0), axis=-2)
    return np.where(number > 0, total / np.maximum(number, 1), np.nan)


def _temperatures(shown: Marks, temperature: Array | None) -> Array:
    """Of each value; NaN where it is not known."""
    if temperature is None:
        return np.full(shown.shape, np.nan)
    return np.broadcast_to(np.asarray(temperature)[..., np.newaxis], shown.shape)
