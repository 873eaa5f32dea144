"""Two tests of one series against each other: is their difference more than tests of the unchanged machine differ by?"""

from __future__ import annotations

from math import inf, isfinite

import numpy as np

from elastogeo.changes.charts import warmth_and_scatter
from elastogeo.changes.records.compared import WITHIN_SCATTER, IndicatorDifference
from elastogeo.changes.references import Reference
from elastogeo.changes.series import Series
from elastogeo.estimate import Estimate, coverage_factor
from elastogeo.identification import SIGNIFICANT, Check
from elastogeo.machine import Array


def indicator_differences(
    series: Series, before: str, after: str, reference: Reference | None = None
) -> tuple[IndicatorDifference, ...]:
    """How the indicators of a series differ between two of its tests, the surest change first.

    Parameters
    ----------
    series : Series
    before, after : str
        Two of its tests.
    reference : Reference, optional
        Of its baseline; without it nothing is expected.

    Notes
    -----
    Expected of an unchanged machine is b (T2 - T1) +- t s sqrt(v1 + v2 + (T2 - T1)^2 / S), with the slope b of the
    temperature, the scatter s between tests, and the variance v of each test in units of s^2 (at least 1), all as the charts
    have them; t of Student at 1 - 0.05 / (2 q) for q indicators (Bonferroni).

    Raises
    ------
    ValueError
        If a test is not of the series.
    """
    rows = [series.tests.index(before), series.tests.index(after)]
    value, own = series.value[rows], series.standard_uncertainty[rows]
    shown = np.isfinite(value).all(axis=0)
    limits = _expected(reference, series.temperature[rows], own, int(shown.sum())) if reference is not None else None
    found = []
    for k in np.flatnonzero(shown):
        u = float(np.hypot(*own[:, k])) if np.isfinite(own[:, k]).all() else inf
        limit = None if limits is None or not np.isfinite(limits[:, k]).all() else (float(limits[0, k]), float(limits[1, k]))
        change = Estimate(float(value[1, k] - value[0, k]), u)
        one, other = map(float, value[:, k])
        found.append(IndicatorDifference(series.indicators[k], series.kinds[k], one, other, change, limit))
    return tuple(sorted(found, key=lambda one: -one.surety))


def _expected(reference: Reference, temperature: Array, own: Array, count: int) -> Array:
    """Between which changes nothing has changed, shape (2, q)."""
    warm, scatter = warmth_and_scatter(reference, temperature, own)
    warmer = warm[1] - warm[0]
    variance = scatter.sum(axis=0) + warmer**2 / reference.spread
    factor = coverage_factor(reference.degrees_of_freedom, 1 - SIGNIFICANT / max(count, 1))
    half = factor * reference.deviation * np.sqrt(variance)
    return np.array([reference.slope * warmer - half, reference.slope * warmer + half])


def within_scatter(differences: tuple[IndicatorDifference, ...]) -> Check | None:
    """Whether two tests differ by no more than tests of the unchanged machine; None without a baseline."""
    judged = [one for one in differences if one.within is not None]
    if not judged:
        return None
    beyond = [one for one in judged if not one.within]
    facts = {
        "judged": len(judged),
        "beyond": [(one.name, one.change.value, _share(one)) for one in beyond],
        "kinds": [one.kind.name for one in beyond],
    }
    return Check(WITHIN_SCATTER, not beyond, facts)


def _share(one: IndicatorDifference) -> float | None:
    """The change as a share of what it was, where that is how its kind is told."""
    return one.change.value / abs(one.before) if one.kind.relative and one.before and isfinite(one.before) else None
