"""What a fleet leads to expect of the scatter between tests: frozen with the baseline, so that no limit moves by itself.

Only baselines count that were set before the one of the series: whoever sets a later one moves nobody's limit. What was
found is kept in the state of the series, under the baseline and the software version that it was found for.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from sqlalchemy import Connection, func, select

from elastogeo.changes import KINDS, Prior, Series, fleet_prior
from elastogeo.history.store.schema import analysis, baseline, indicator, series, series_state

LEAST = 3
"""Machines with the same indicator, below which all indicators of its kind are looked at."""


KeptPrior = dict[str, Any] | None
"""What is kept of a prior: its numbers, and the baseline, version and indicators that they were found for."""


def prior_of(connection: Connection, key: int, software: str, made: Series) -> tuple[Prior | None, KeptPrior]:
    """The scatter that other machines lead to expect, and what is kept of it; none where the series has no baseline.

    Where fewer than three other machines have an indicator it is NaN: the kind's own reproducibility holds there.

    Parameters
    ----------
    connection : Connection
    key : int
        Of the series.
    software : str
        That it counts with.
    made : Series
    """
    own = connection.scalar(select(func.max(baseline.c.id)).where(baseline.c.series == key))
    if own is None:
        return None, None
    of = [own, software, *made.indicators]
    state = connection.scalar(select(series_state.c.verdict).where(series_state.c.series == key))
    kept = (state or {}).get("prior")
    if kept and kept["of"] == of:
        return _prior(kept["deviation"], kept["degrees_of_freedom"]), kept
    found = _absolute(_fleet(connection, key, own, made), made, own_mean(connection, own, made))
    numbers = {name: [number(one) for one in getattr(found, name)] for name in ("deviation", "degrees_of_freedom")}
    return found, {"of": of, **numbers}


def number(value: float) -> float | None:
    """As JSON has it: none for what is no number."""
    return float(value) if math.isfinite(value) else None


def own_mean(connection: Connection, key: int, made: Series) -> np.ndarray[Any, Any]:
    """The mean of a baseline by indicator, which a relative scatter is a share of."""
    tests = {str(one) for one in connection.scalar(select(baseline.c.tests).where(baseline.c.id == key)) or ()}
    rows = [k for k, name in enumerate(made.tests) if name in tests and not made.aside[k]]
    values = made.value[rows]
    known = np.isfinite(values)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(known, values, 0.0).sum(axis=0) / known.sum(axis=0))


def _prior(deviation: Iterable[float | None], freedom: Iterable[float | None]) -> Prior:
    def numbers(given: Iterable[float | None]) -> np.ndarray[Any, Any]:
        return np.array([math.nan if one is None else one for one in given], dtype=float)

    return Prior(numbers(freedom), numbers(deviation))


def _absolute(relative: Prior, made: Series, mean: np.ndarray[Any, Any]) -> Prior:
    scale = np.array([abs(m) if kind.relative else 1.0 for kind, m in zip(made.kinds, mean, strict=True)])
    return Prior(relative.degrees_of_freedom, relative.deviation * scale)


@dataclass(frozen=True, slots=True)
class _Scatter:
    """Of one indicator of one baseline; relative where its kind is."""

    name: str
    kind: str
    deviation: float
    degrees_of_freedom: float


def _fleet(connection: Connection, key: int, before: int, made: Series) -> Prior:
    """Of the baselines of other series that were set earlier: of the same indicator, else of all of its kind."""
    found = [one for rows in _baselines(connection, key, before) for one in _scatters(rows)]
    columns = []
    for name, kind in zip(made.indicators, made.kinds, strict=True):
        alike = [one for one in found if one.kind == kind.name]
        named = [one for one in alike if one.name == name]
        columns.append(named if len(named) >= LEAST else alike)
    most = max((len(column) for column in columns), default=0)
    deviation, freedom = np.full((2, most, len(columns)), math.nan)
    for k, column in enumerate(columns):
        deviation[: len(column), k] = [one.deviation for one in column]
        freedom[: len(column), k] = [one.degrees_of_freedom for one in column]
    return fleet_prior(deviation, freedom)


def _baselines(connection: Connection, key: int, before: int) -> Iterator[Sequence[Any]]:
    """Of each such baseline what its tests say of each indicator, by the software version that its series counts with."""
    last = (
        select(func.max(baseline.c.id)).where(baseline.c.id < before, baseline.c.series != key).group_by(baseline.c.series)
    )
    bases = connection.execute(
        select(baseline.c.tests, series.c.software)
        .join(series, series.c.id == baseline.c.series)
        .where(baseline.c.id.in_(last))
        .order_by(baseline.c.id)
    ).all()
    for base in bases:
        counting = (
            select(func.max(analysis.c.id))
            .where(analysis.c.test.in_(base.tests), analysis.c.software == base.software)
            .group_by(analysis.c.test)
        )
        yield connection.execute(
            select(indicator.c.name, indicator.c.kind, indicator.c.value).where(indicator.c.analysis.in_(counting))
        ).all()


def _scatters(rows: Sequence[Any]) -> Iterator[_Scatter]:
    values: dict[tuple[str, str], list[float]] = {}
    for row in rows:
        values.setdefault((row.name, row.kind), []).append(row.value)
    for (name, kind), told in values.items():
        if len(told) < 2 or kind not in KINDS:
            continue
        mean, deviation = float(np.mean(told)), float(np.std(told, ddof=1))
        scale = abs(mean) if KINDS[kind].relative else 1.0
        if deviation > 0 and scale > 0:
            yield _Scatter(name, kind, deviation / scale, len(told) - 1.0)
