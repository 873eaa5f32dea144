"""The rule tried out on a series of the store, with the limits and the least changes that it is judged by."""

from __future__ import annotations

from math import isfinite

from sqlalchemy import select

from elastogeo.changes import Rule, RuleTest, try_rule
from elastogeo.history.alarms.judging import judged
from elastogeo.history.alarms.priors import prior_of
from elastogeo.history.names import series_named
from elastogeo.history.store import Store, now, read, schema


def try_rule_of(
    store: Store,
    machine: str,
    series: str = "",
    *,
    alpha: float | None = None,
    interval: float | None = None,
    tests: int = 36,
    machines: int = 2000,
    blunders: float = 0.0,
    correlation: float = 0.0,
) -> RuleTest:
    """False alarms and delay of machines that are simulated from the baseline of a series; nothing is written.

    Parameters
    ----------
    store : Store
    machine, series : str
        By name; the series may be left out where there is one.
    alpha : float, optional
        In place of that of the series.
    interval, tests, machines, blunders, correlation
        As `changes.try_rule` takes them.

    Raises
    ------
    InputError
        If there is no such machine or series, or it has no baseline.
    UnsupportedError
        If its baseline is too short for any alarm.
    """
    with read(store) as connection:
        key = series_named(connection, machine, series).key
        verdict = judged(connection, key, now())
        software = connection.execute(select(schema.series.c.software).where(schema.series.c.id == key)).scalar_one()
        prior = prior_of(connection, key, software, verdict.series)[0] if verdict.baseline is not None else None
    matters = {
        one.name: one.relevance / (abs(one.mean) if one.kind.relative else 1)
        for one in verdict.indicators
        if isfinite(one.relevance)
    }
    return try_rule(
        verdict.series,
        verdict.baseline,
        prior,
        Rule(alpha=verdict.alpha if alpha is None else alpha),
        relevance=matters,
        interval=interval,
        tests=tests,
        machines=machines,
        blunders=blunders,
        correlation=correlation,
    )
