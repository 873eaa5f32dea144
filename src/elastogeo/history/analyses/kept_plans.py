"""Plans of tests: kept with a date until which they are to be done, and done by a person who says so."""

from __future__ import annotations

import json
from collections.abc import Mapping
from datetime import UTC, date, datetime, time, timedelta
from math import isfinite
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from elastogeo.changes import KeptPlan, due_on
from elastogeo.errors import FormatError, InputError
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import machine, plan

SCHEMA = "elastogeo.plan/1"
_LONGEST = 36_500  # days, a hundred years: beyond it a date may be none of the calendar


def keep_plan(
    store: Store,
    owner: int,
    name: str,
    document: Mapping[str, Any],
    due: datetime | None = None,
    grace: float = 7.0,
    who: str = "",
) -> int:
    """Keep a plan for a machine.

    Parameters
    ----------
    store : Store
    owner : int
        Key of the machine.
    name : str
        That no other plan of the machine has.
    document : mapping
        `elastogeo.plan/1`, as `elastogeo plan --json` prints it: `eg.plan(...).to_dict()`.
    due : datetime, optional
        With its zone; until when it is to be done.
    grace : float [d]
        After which it is overdue.
    who : str
        For the audit trail.

    Returns
    -------
    int
        Its key.

    Raises
    ------
    InputError
        If this is no plan, a date has no zone, the machine has a plan of this name, or there is no such machine.
    """
    if document.get("schema") != SCHEMA or not isinstance(document.get("tests"), list):
        arrived = document.get("schema") or "a document without a schema"
        raise InputError(f"this is {arrived}, not a plan ({SCHEMA}); print one: elastogeo plan ... --json")
    _check_tests(document)
    if not name.strip():
        raise InputError("the plan has no name; give it one that the machine's other plans do not have")
    if not (isfinite(grace) and grace >= 0):
        raise InputError(f"the grace is {grace:g} days; give zero or more")
    if due is not None and due.tzinfo is None:
        raise InputError(f"the due date {due} has no time zone; write 2026-05-01T00:00+00:00, or give it one")
    if grace > _LONGEST:
        raise InputError(f"the grace is {grace:g} days; give at most {_LONGEST}")
    if due is not None and abs(due - now()) > timedelta(days=_LONGEST):
        raise InputError(f"the due date {due:%Y-%m-%d} is more than 100 years from now; correct it")
    with write(store) as connection:
        called = connection.execute(select(machine.c.name).where(machine.c.id == owner)).scalar_one_or_none()
        if called is None:
            raise InputError(f"there is no machine {owner}; `elastogeo history list` shows those that there are")
        if connection.execute(select(plan.c.id).where(plan.c.machine == owner, plan.c.name == name)).first():
            raise InputError(f"{called} has a plan {name!r} already; give this one another name")
        row = {"machine": owner, "name": name, "made_at": now(), "due": due, "grace_days": grace, "document": dict(document)}
        key = int(connection.execute(insert(plan).values(**row).returning(plan.c.id)).scalar_one())
        new = {"machine": called, "name": name, "due": None if due is None else due.isoformat(), "grace_days": grace}
        audit.record(connection, who, "keep plan", f"plan {key}", new=new)
    return key


def _check_tests(document: Mapping[str, Any]) -> None:
    """Refuse a plan that could be kept and never shown."""
    for number, one in enumerate(document["tests"], 1):
        if not (isinstance(one, Mapping) and isinstance(one.get("name"), str)):
            raise InputError(f"test {number} of the plan has no name; print a whole plan: elastogeo plan ... --json")
    minutes = document.get("minutes")
    if minutes is not None and (isinstance(minutes, bool) or not isinstance(minutes, int | float)):
        raise InputError(f"the plan takes {minutes!r} minutes; give a number, or print it anew: elastogeo plan ... --json")


def finish_plan(store: Store, key: int, who: str, why: str = "") -> None:
    """Say that a plan was done; from then on it is not due.

    Raises
    ------
    InputError
        If there is no such plan, or it is done already.
    """
    with write(store) as connection:
        row = connection.execute(select(plan.c.name, plan.c.done_at).where(plan.c.id == key)).one_or_none()
        if row is None:
            raise InputError(f"there is no plan {key}; `elastogeo history plan` lists them")
        if row.done_at is not None:
            raise InputError(f"plan {row.name!r} was done on {row.done_at:%Y-%m-%d} already")
        done = now()
        connection.execute(update(plan).where(plan.c.id == key).values(done_at=done))
        audit.record(connection, who, "finish plan", f"plan {key}", {"done_at": None}, {"done_at": done.isoformat()}, why)


def plans(connection: Connection, at: datetime, of: int | None = None) -> tuple[KeptPlan, ...]:
    """The plans of a machine, or of all: overdue first, then by their date; those without one and the done ones last.

    Parameters
    ----------
    connection : Connection
    at : datetime
        When this is asked.
    of : int, optional
        Key of a machine.
    """
    asked = select(plan, machine.c.name.label("owner")).join(machine, machine.c.id == plan.c.machine).order_by(plan.c.id)
    rows = connection.execute(asked if of is None else asked.where(plan.c.machine == of))
    found = [_kept(row, days(at)) for row in rows]
    return tuple(sorted(found, key=_urgency))


def _kept(row: Row[Any], at: float) -> KeptPlan:
    due = None if row.due is None or row.done_at is not None else days(row.due)
    return KeptPlan(
        key=row.id,
        machine=row.owner,
        name=row.name,
        made_at=days(row.made_at),
        due=due_on(due, row.grace_days, at),
        done_at=None if row.done_at is None else days(row.done_at),
        tests=tuple(one["name"] for one in row.document["tests"]),
        minutes=row.document.get("minutes"),
        document=row.document,
    )


def _urgency(one: KeptPlan) -> tuple[bool, bool, float]:
    return one.done_at is not None, one.due.at is None, one.due.at or 0.0


def read_plan(file: Path) -> dict[str, Any]:
    """A plan as `elastogeo plan --json` printed it to a file.

    Raises
    ------
    FormatError
        If it cannot be opened, or is no JSON object.
    """
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise FormatError(f"{file}: cannot be opened ({error.strerror}); check the path") from None
    except ValueError as error:
        raise FormatError(f"{file}: is no JSON ({error}); write it with: elastogeo plan ... --json > {file.name}") from None
    if not isinstance(found, dict):
        raise FormatError(f"{file}: holds no JSON object; write it with: elastogeo plan ... --json > {file.name}")
    return found


def due_date(text: str) -> datetime | None:
    """A due date as a person writes it; of a day without a time its noon, without a zone UTC; None of an empty text.

    Raises
    ------
    InputError
        If it is no date.
    """
    if not text.strip():
        return None
    try:
        day = date.fromisoformat(text.strip())
        return datetime.combine(day, time(12), UTC)
    except ValueError:
        pass
    try:
        at = datetime.fromisoformat(text.strip())
    except ValueError:
        raise InputError(f"the due date is {text!r}; write 2026-05-01, or 2026-05-01T14:30+02:00") from None
    return at if at.tzinfo is not None else at.replace(tzinfo=UTC)
