"""A series of the store as the charts want it: its tests in their order, with what each says of a few named indicators.

Only analyses by the software version that the series counts with are looked at, so a chart never mixes versions. A test
that could not be analysed stands in the series without a number; one that this version has not analysed yet does not.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
from sqlalchemy import Connection, Select, and_, func, select

from elastogeo.changes import KINDS, MOST, Kind, Series, Signatures
from elastogeo.errors import InputError
from elastogeo.history.store.schema import analysis, baseline, indicator, instrument, machine, series, set_aside, test
from elastogeo.machine import Array

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
_DAY = timedelta(days=1)
_NO_NUMBER = float("nan")

SHARE = 0.5
"""An indicator is one of the series if this share of the tests that decide determines it."""


@dataclass(frozen=True, slots=True)
class _Told:
    """What the tests of a series say, an entry an indicator of a test: `tests` are places in the series."""

    tests: np.ndarray[Any, Any]
    names: list[str]
    kinds: dict[str, str]
    value: Array
    standard_uncertainty: Array


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
    told = _told(connection, counting, {row.analysis: k for k, row in enumerate(rows)})
    aside = asides_of(connection, key)
    chosen = baseline_tests(connection, key)
    decides = np.array([row.id in chosen if chosen else row.id not in aside for row in rows], dtype=bool)
    made = _series(f"{head.machine}: {head.name}", rows, told, _names(told, decides), aside)
    deciding = [row.analysis for row, one in zip(rows, decides, strict=True) if one]
    return replace(made, machine=head.machine, signatures=_signatures(connection, deciding))


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


def _told(connection: Connection, counting: Any, place: Mapping[int, int]) -> _Told:
    """What the tests say, in the order of the tests; `place` of each by its analysis."""
    asked = (
        select(indicator.c.analysis, indicator.c.name, indicator.c.kind, indicator.c.value, indicator.c.standard_uncertainty)
        .join(counting, counting.c.analysis == indicator.c.analysis)
        .order_by(indicator.c.id)
    )
    rows = connection.execute(asked).all()
    analyses, names, kinds, values, uncertainties = zip(*rows, strict=True) if rows else ((),) * 5
    tests = np.array([place[one] for one in analyses], dtype=int)
    order = np.argsort(tests, kind="stable")
    return _Told(
        tests[order],
        [names[k] for k in order],
        dict(zip(names, kinds, strict=True)),
        np.array(values, dtype=float)[order],
        np.array(uncertainties, dtype=float)[order],
    )


def _names(told: _Told, decides: np.ndarray[Any, Any]) -> dict[str, str]:
    """The kinds of the indicators of the series by their names, in their order."""
    counts = Counter(name for name, one in zip(told.names, decides[told.tests], strict=True) if one)
    common = [name for name, count in counts.most_common() if count >= SHARE * decides.sum()]
    return {name: told.kinds[name] for name in common[:MOST]}


def _series(name: str, rows: Sequence[Any], told: _Told, names: Mapping[str, str], aside: set[int]) -> Series:
    place = {row.id: k for k, row in enumerate(rows)}
    column = {called: k for k, called in enumerate(names)}
    columns = np.array([column.get(called, -1) for called in told.names], dtype=int)
    watched = columns >= 0
    at = told.tests[watched], columns[watched]
    value, uncertainty = np.full((2, len(rows), len(names)), np.nan)
    value[at], uncertainty[at] = told.value[watched], told.standard_uncertainty[watched]
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
        simulated="\n".join(dict.fromkeys(row.from_what for row in rows if row.origin == "simulated")),
    )


def _kind(name: str) -> Kind:
    if name not in KINDS:
        raise InputError(f"this version knows no indicators of the kind {name!r}; run elastogeo history recompute")
    return KINDS[name]
