"""What a person wants of one indicator of a series: between which values it must stay, and from when on a change matters."""

from __future__ import annotations

from math import isfinite

from sqlalchemy import Connection, insert, select

from elastogeo.changes import KINDS, Kind, Tolerance
from elastogeo.errors import InputError, several
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import analysis, indicator, test, tolerance


def set_tolerance(store: Store, key: int, name: str, wanted: Tolerance, *, who: str, why: str) -> Tolerance:
    """Set what is wanted of an indicator, in place of what was; all None takes it back.

    Parameters
    ----------
    store : Store
    key : int
        Of the series.
    name : str
        Of the indicator.
    wanted : Tolerance
        In the unit of the kind.
    who, why : str

    Raises
    ------
    InputError
        If the series has no such indicator, the limits are crossed or no numbers, or no reason is given.
    """
    if not why.strip():
        raise InputError("a tolerance is set for a reason that others can read later; give one with --why")
    _check(name, wanted)
    row = {"lower": wanted.lower, "upper": wanted.upper, "relevance": wanted.relevance}
    with write(store) as connection:
        kind_of(connection, key, name)
        old = tolerance_of(connection, key, name)
        if old == wanted:
            return wanted
        connection.execute(
            insert(tolerance).values(series=key, indicator=name, set_at=now(), who=who, why=why.strip(), **row)
        )
        before = {"lower": old.lower, "upper": old.upper, "relevance": old.relevance}
        subject = f"series {key}, {name}"
        audit.record(connection, who, "set tolerance", subject, old=before, new=row, why=why.strip())
    return wanted


def tolerance_of(connection: Connection, key: int, name: str) -> Tolerance:
    """What is wanted of an indicator as it was said last."""
    row = connection.execute(
        select(tolerance.c.lower, tolerance.c.upper, tolerance.c.relevance)
        .where(tolerance.c.series == key, tolerance.c.indicator == name)
        .order_by(tolerance.c.id.desc())
        .limit(1)
    ).one_or_none()
    return Tolerance() if row is None else Tolerance(row.lower, row.upper, row.relevance)


def kind_of(connection: Connection, key: int, name: str) -> Kind:
    """The kind of an indicator that tests of a series determine.

    Raises
    ------
    InputError
        If none does; the message names those that are determined.
    """
    known = indicators(connection, key)
    if name not in known:
        there = several(tuple(known)) if known else "none yet"
        raise InputError(f"the series has no indicator {name!r}; it has: {there}")
    return KINDS[known[name]]


def indicators(connection: Connection, key: int) -> dict[str, str]:
    """The kinds of what the tests of a series determine, by name."""
    found = connection.execute(
        select(indicator.c.name, indicator.c.kind)
        .join(analysis, analysis.c.id == indicator.c.analysis)
        .join(test, test.c.id == analysis.c.test)
        .where(test.c.series == key)
        .distinct()
        .order_by(indicator.c.name)
    )
    return {row.name: row.kind for row in found}


def _check(name: str, wanted: Tolerance) -> None:
    given = {"lower": wanted.lower, "upper": wanted.upper, "relevance": wanted.relevance}
    for what, value in given.items():
        if value is not None and not isfinite(value):
            raise InputError(f"the {what} of {name} is {value}; give a number")
    if wanted.lower is not None and wanted.upper is not None and wanted.lower >= wanted.upper:
        raise InputError(f"{name} must stay between {wanted.lower:g} and {wanted.upper:g}: no value does; exchange them")
    if wanted.relevance is not None and wanted.relevance < 0:
        raise InputError(f"the least change of {name} that matters is {wanted.relevance:g}; give zero or more")
