"""A series of the store as the charts want it: its tests in their order, with what each says of a few named indicators.

Only analyses by the software version that the series counts with are looked at, so a chart never mixes versions. A test
that could not be analysed stands in the series without a number; one that this version has not analysed yet does not.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
from sqlalchemy import Connection, Select, and_, func, select

from elastogeo.changes import KINDS, MOST, Kind, Series, Signatures
from elastogeo.errors import InputError
from elastogeo.history.store.schema import analysis, baseline, indicator, instrument, machine, series, set_aside, test

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
_DAY = timedelta(days=1)
_NO_NUMBER = float("nan")

SHARE = 0.5
"""An indicator is one of the series if this share of the tests that decide determines it."""


def days(at: datetime) -> float:
    """A point in time as `changes` counts it: days since 1970-01-01 UTC."""
    return (at - _EPOCH) / _DAY


def instant(at: float) -> datetime:
    """The point in time that a number of days since 1970-01-01 UTC is."""
    return _EPOCH + at * _DAY


def series_of(connection: Connection, key: int) -> Series:
    """The tests of a series as the charts want them.

    Its indicators are those that at least half of the tests of its baseline determine (without a baseline: of all tests
    that are not set aside), the commonest first, then in the order in which the first of these tests names them; eight at
    most. A baseline is frozen, and so are analyses: tests that come later never change what is watched.

    Parameters
    ----------
    connection : Connection
        Of `read` or `write`.
    key : int
        Of the series.

    Returns
    -------
    Series
        Its tests go by their keys, as text; `repeats` points to a test of the series.

    Raises
    ------
    InputError
        If there is no such series.
    """
    head = connection.execute(
        select(series.c.name, series.c.software, machine.c.name.label("machine"))
        .join(machine, machine.c.id == series.c.machine)
        .where(series.c.id == key)
    ).one_or_none()
    if head is None:
        raise InputError(f"there is no series {key}; `elastogeo history list` shows those that there are")
    counting = _counting(key, head.software)
    rows = connection.execute(_tests(key, counting)).all()
    told = connection.execute(
        select(indicator.c.analysis, indicator.c.name, indicator.c.kind, indicator.c.value, indicator.c.standard_uncertainty)
        .join(counting, counting.c.analysis == indicator.c.analysis)
        .order_by(indicator.c.id)
    ).all()
    aside = asides_of(connection, key)
    deciding = baseline_tests(connection, key) or {row.id for row in rows} - aside
    names = _names(told, {row.analysis: row.id for row in rows}, deciding)
    made = _series(f"{head.machine}: {head.name}", rows, told, names, aside)
    return replace(
        made,
        machine=head.machine,
        signatures=_signatures(connection, [row.analysis for row in rows if row.id in deciding]),
    )


def baseline_tests(connection: Connection, key: int) -> set[int]:
    """Keys of the tests that the baseline of a series is made of, the one that was set last; empty if none was set."""
    found = connection.execute(
        select(baseline.c.tests).where(baseline.c.series == key).order_by(baseline.c.id.desc()).limit(1)
    ).scalar_one_or_none()
    return set(found or ())


def asides_of(connection: Connection, key: int) -> set[int]:
    """Keys of the tests of a series that are set aside: what was said last of each counts."""
    said = (
        select(set_aside.c.test, set_aside.c.aside)
        .join(test, test.c.id == set_aside.c.test)
        .where(test.c.series == key)
        .order_by(set_aside.c.id)
    )
    last = {row.test: row.aside for row in connection.execute(said)}
    return {found for found, is_aside in last.items() if is_aside}


def _signatures(connection: Connection, analyses: Sequence[int]) -> Signatures | None:
    """How faults move the indicators: of the first of these analyses that says it, since one test of a series serves."""
    known = select(analysis.c.id).where(analysis.c.id.in_(analyses), analysis.c.signatures.is_not(None))
    there = set(connection.execute(known).scalars())
    first = next((key for key in analyses if key in there), None)
    if first is None:
        return None
    kept = select(analysis.c.signatures).where(analysis.c.id == first)
    return Signatures.of_document(connection.execute(kept).scalar_one())


def _counting(key: int, software: str) -> Any:
    """Of each test the last analysis by this software version."""
    return (
        select(func.max(analysis.c.id).label("analysis"), analysis.c.test.label("test"))
        .join(test, test.c.id == analysis.c.test)
        .where(and_(test.c.series == key, analysis.c.software == software))
        .group_by(analysis.c.test)
        .subquery("counting")
    )


def _tests(key: int, counting: Any) -> Select[Any]:
    return (
        select(
            test.c.id,
            counting.c.analysis,
            test.c.at,
            test.c.temperature,
            test.c.repeats,
            test.c.origin,
            test.c.from_what,
            instrument.c.serial,
        )
        .join(counting, counting.c.test == test.c.id)
        .outerjoin(instrument, instrument.c.id == test.c.instrument)
        .where(test.c.series == key)
        .order_by(test.c.at, test.c.id)
    )


def _names(told: Iterable[Any], tests: Mapping[int, int], deciding: set[int]) -> dict[str, str]:
    """The kinds of the indicators of the series by their names, in their order; `tests` by analysis, as they were made."""
    place = {found: k for k, found in enumerate(tests)}
    kinds: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for row in sorted(told, key=lambda row: place[row.analysis]):
        if tests[row.analysis] in deciding:
            kinds.setdefault(row.name, row.kind)
            counts[row.name] += 1
    enough = SHARE * len(deciding.intersection(tests.values()))
    common = [name for name in kinds if counts[name] >= enough]
    return {name: kinds[name] for name in sorted(common, key=lambda name: -counts[name])[:MOST]}


def _series(name: str, rows: Sequence[Any], told: Iterable[Any], names: Mapping[str, str], aside: set[int]) -> Series:
    place = {row.id: k for k, row in enumerate(rows)}
    by_analysis = {row.analysis: k for k, row in enumerate(rows)}
    column = {called: k for k, called in enumerate(names)}
    value, uncertainty = np.full((2, len(rows), len(names)), np.nan)
    for row in told:
        if row.name in column:
            at = by_analysis[row.analysis], column[row.name]
            value[at] = row.value
            uncertainty[at] = _NO_NUMBER if row.standard_uncertainty is None else row.standard_uncertainty
    return Series(
        name=name,
        indicators=tuple(names),
        kinds=tuple(_kind(kind) for kind in names.values()),
        tests=tuple(str(row.id) for row in rows),
        date=np.array([days(row.at) for row in rows], dtype=float),
        value=value,
        standard_uncertainty=uncertainty,
        temperature=np.array([_NO_NUMBER if row.temperature is None else row.temperature for row in rows], dtype=float),
        repeats=np.array([place.get(row.repeats, -1) for row in rows], dtype=int),
        aside=np.array([row.id in aside for row in rows], dtype=bool),
        instruments=tuple(row.serial or "" for row in rows),
        simulated="; ".join(dict.fromkeys(row.from_what for row in rows if row.origin == "simulated")),
    )


def _kind(name: str) -> Kind:
    if name not in KINDS:
        raise InputError(f"this version knows no indicators of the kind {name!r}; run elastogeo history recompute")
    return KINDS[name]
