"""The audit trail: who did what, when, to what, old and new, and why. Rows are only added, each sealed with the one before.

The seal of a row is the SHA-256 of its content and the seal before it; `audit_head` holds the last number and seal, so a
tail that was cut off is noticed. Whoever can write the database can also forge the whole chain from some row on, with its
head: the head that a person noted elsewhere (`elastogeo history audit` prints it) shows that too.
"""

from __future__ import annotations

import getpass
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from elastogeo.errors import StoreError
from elastogeo.history.store.clock import now
from elastogeo.history.store.columns import canonical
from elastogeo.history.store.schema import audit, audit_head

_FIRST = "0" * 64
_MOVES = 500  # broken rows among which it is looked for where one of them stood
_GAP = 500  # numbers missing in a row that are named one by one; a longer gap, by its first
_CONTENT = ("number", "at", "who", "what", "subject", "old", "new", "why", "previous")

CHANGED, MISSING, MOVED, CUT_OFF, HEAD_MISSING = "changed", "missing", "moved", "cut off", "head missing"
"""What can be wrong with the trail."""


@dataclass(frozen=True, slots=True)
class Finding:
    """Something that is wrong with the trail.

    Attributes
    ----------
    number : int
        Of the row.
    fault : str
        One of CHANGED, MISSING, MOVED (it stood at `was`), CUT_OFF (rows from this on), HEAD_MISSING.
    was : int or None
        The number that a moved row had.
    """

    number: int
    fault: str
    was: int | None = None


def login() -> str:
    """Who is logged in on this computer: who does a thing if nobody else is named."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # a container may have no accounts
        return "unknown"


def record(
    connection: Connection, who: str, what: str, subject: str, old: Any = None, new: Any = None, why: str = ""
) -> int:
    """Add a row to the trail, in the caller's transaction.

    Parameters
    ----------
    connection : Connection
        Of `write`: one writer at a time, so the numbers have no gap.
    who, what, subject : str
        `A. Miller`, `set aside`, `test 12`.
    old, new : JSON values, optional
    why : str

    Returns
    -------
    int
        The number of the row.
    """
    for text in (who, what, subject, why):
        _check_text(text)
    head = connection.execute(select(audit_head.c.number, audit_head.c.sha256)).one_or_none()
    number, previous = (head.number + 1, head.sha256) if head else (1, _FIRST)
    row = {
        "number": number,
        "at": now(),
        "who": who,
        "what": what,
        "subject": subject,
        "old": _plain(old),
        "new": _plain(new),
        "why": why,
        "previous": previous,
    }
    seal = _seal(row)
    connection.execute(insert(audit).values(**row, sha256=seal))
    if head:
        connection.execute(update(audit_head).values(number=number, sha256=seal))
    else:
        connection.execute(insert(audit_head).values(id=1, number=number, sha256=seal))
    return number


def identity(connection: Connection) -> str:
    """What no other history has: the seal of the first row; empty without one."""
    return connection.execute(select(audit.c.sha256).order_by(audit.c.number).limit(1)).scalar() or ""


def verify(connection: Connection) -> tuple[Finding, ...]:
    """What is wrong with the trail: nothing, or the rows that were changed, deleted, moved or cut off, by their number.

    Of a gap of more than 500 numbers the first is named only: a number can be raised by any amount.
    """
    missing: list[int] = []
    broken: dict[int, Row[Any]] = {}
    resealed: set[int] = set()
    previous, number = _FIRST, 0
    for row in connection.execute(select(audit).order_by(audit.c.number)):
        gap = range(number + 1, row.number)
        missing += gap if len(gap) <= _GAP else gap[:1]
        if _seal(row._mapping) != row.sha256:
            broken[row.number] = row
        elif row.number == number + 1 and row.previous != previous:
            resealed.add(max(number, 1))  # this row is as it was sealed, so the one before it is not
        previous, number = row.sha256, row.number
    found = [Finding(gone, MISSING) for gone in missing]
    found += [_named(row, [*broken, *missing]) for row in broken.values()]
    found += [Finding(changed, CHANGED) for changed in resealed - set(broken)]
    found += _at_the_end(connection, number, previous, {*broken, *resealed})
    return tuple(sorted(found, key=lambda finding: finding.number))


def _at_the_end(connection: Connection, number: int, seal: str, known: set[int]) -> list[Finding]:
    """What the head says of the last row, which has a number and a seal."""
    head = connection.execute(select(audit_head.c.number, audit_head.c.sha256)).one_or_none()
    if head is None:
        return [Finding(number, HEAD_MISSING)] if number else []
    if head.number > number:
        return [Finding(number + 1, CUT_OFF)]
    return [] if (head.number, head.sha256) == (number, seal) or number in known else [Finding(number, CHANGED)]


def _named(row: Row[Any], places: list[int]) -> Finding:
    """Whether a row that does not fit its seal stood at another place, or was changed."""
    if len(places) <= _MOVES:
        for place in places:
            if place != row.number and _seal({**row._mapping, "number": place}) == row.sha256:
                return Finding(row.number, MOVED, place)
    return Finding(row.number, CHANGED)


def _seal(row: Mapping[Any, Any]) -> str:
    content = {name: row[name] for name in _CONTENT}
    content["at"] = row["at"].astimezone(UTC).isoformat()
    return hashlib.sha256(canonical(content).encode()).hexdigest()


def _plain(value: Any) -> Any:
    """A value as it comes back from the database."""
    return None if value is None else json.loads(canonical(value))


def _check_text(text: str) -> None:
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise StoreError(f"{text!r} is no text that can be kept: {error.reason}") from error
    if "\0" in text:
        raise StoreError(f"{text!r} has a NUL in it, which no text may have")
