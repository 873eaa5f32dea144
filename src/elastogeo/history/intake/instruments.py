"""Instruments by their serial number, and when they were calibrated, until when that holds, with which certificate."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, insert, select, update

from elastogeo.errors import ElastogeoError, InputError, several
from elastogeo.formats import read_calibration
from elastogeo.history.intake.days import Day, day_of
from elastogeo.history.intake.machines import check_name
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import calibration, instrument
from elastogeo.machine import About

_LONGEST = timedelta(days=36_500)


@dataclass(frozen=True, slots=True)
class KnownInstrument:
    """An instrument of the history.

    Attributes
    ----------
    key : int
    serial : str
    kind : str
        `loaded-ball-bar`.
    """

    key: int
    serial: str
    kind: str = ""


def add_instrument(
    store: Store,
    serial: str,
    *,
    who: str,
    kind: str = "",
    calibrated: str = "",
    due: str = "",
    certificate: str = "",
) -> KnownInstrument:
    """Add an instrument, or say more of one that is there, and a calibration of it if a date is given.

    Parameters
    ----------
    store : Store
    serial : str
    who : str
    kind : str
    calibrated, due : str
        Dates; the second may lie in the future.
    certificate : str

    Raises
    ------
    InputError
        If a date is none, the due date is not after the calibration, or a due date or a certificate has no date of
        calibration.
    """
    serial = check_name(serial, "an instrument")
    at = day_of(calibrated, "the date of calibration", now()).at if calibrated else None
    until = _due(due) if due else None
    if at is None and (until or certificate):
        raise InputError("a due date and a certificate are of a calibration; give its date with --calibrated")
    if at is not None and until is not None and until <= at:
        raise InputError(f"the calibration of {calibrated} would be due on {due}, before it was made; correct the dates")
    with write(store) as connection:
        found = _known(connection, serial, kind, who)
        if at is not None:
            _add_calibration(connection, found, at, until, certificate, {}, who)
    return found


def _due(said: str) -> datetime:
    """A due date: it may lie in the future, but not beyond what a person can mean."""
    at = day_of(said, "the due date", datetime.max.replace(tzinfo=UTC) - timedelta(days=1)).at
    if at > now() + _LONGEST:
        raise InputError(
            f"the due date is {said}, more than 100 years from now; leave --due out if the calibration does not run out"
        )
    return at


def instrument_of(
    connection: Connection, about: About, kind: str, files: Iterable[Path], who: str
) -> tuple[int | None, str]:
    """The key of the instrument that a test was made with, kept with the calibrations that the test knows of.

    Parameters
    ----------
    connection : Connection
        Of `write`.
    about : About
        Of the test.
    kind : str
        Of the instrument.
    files : iterable of Path
        Those that the test is read from: calibration files among them count.
    who : str

    Returns
    -------
    int or None
        None where the test says no serial number.
    str
        What could not be kept, and why; empty if nothing.
    """
    if not about.instrument_serial.strip():
        return None, ""
    found = _known(connection, about.instrument_serial.strip(), kind, who)
    note = ""
    if about.instrument_calibrated:
        try:
            at = day_of(about.instrument_calibrated, "instrument_calibrated under [about]", now())
        except InputError:
            note = f"instrument_calibrated is {about.instrument_calibrated!r}, no date: no calibration was noted"
        else:
            _add_calibration(connection, found, at.at, None, "", {}, who)
    for content in _calibrations(files, found.serial):
        _add_calibration(connection, found, content.pop("at"), None, content.pop("certificate"), content, who)
    return found.key, note


def overdue(connection: Connection, key: int, at: datetime) -> datetime | None:
    """When the last calibration of an instrument before a day had run out, if it had."""
    last = connection.execute(
        select(calibration.c.due)
        .where(calibration.c.instrument == key, calibration.c.at <= at)
        .order_by(calibration.c.at.desc(), calibration.c.id.desc())
        .limit(1)
    ).scalar()
    return last if last is not None and last < at else None


def instrument_numbered(connection: Connection, serial: str) -> KnownInstrument:
    """The instrument of a serial number.

    Raises
    ------
    InputError
        If there is none.
    """
    found = _row(connection, serial.strip())
    if found is None:
        serials = list(connection.execute(select(instrument.c.serial).order_by(instrument.c.serial)).scalars())
        there = f"there are: {several(serials)}" if serials else "there is none yet"
        raise InputError(f"the history has no instrument {serial!r}; {there}; add it with: elastogeo history instrument")
    return found


def _calibrations(files: Iterable[Path], serial: str) -> list[dict[str, Any]]:
    """What the calibration files say that have a date, and do not say that they are another instrument's."""
    found = []
    for path in files:
        if path.suffix != ".toml":
            continue
        try:
            document = read_calibration(path)
            day: Day = day_of(document.about.date, str(path), now())
        except ElastogeoError:
            continue  # another document, or one without a date
        if document.about.instrument_serial not in ("", serial):
            continue
        content = {"file": path.name, "name": document.name}
        found.append({"at": day.at, "certificate": document.about.remarks, **content})
    return found


def _known(connection: Connection, serial: str, kind: str, who: str) -> KnownInstrument:
    """The instrument of a serial number, made if it is new."""
    found = _row(connection, serial)
    if found is None:
        row = {"serial": serial, "kind": kind, "made_at": now()}
        key = connection.execute(insert(instrument).values(row).returning(instrument.c.id)).scalar_one()
        audit.record(connection, who, "add instrument", f"instrument {key}", new={"serial": serial, "kind": kind})
        return KnownInstrument(key, serial, kind)
    if kind and not found.kind:
        connection.execute(update(instrument).where(instrument.c.id == found.key).values(kind=kind))
        audit.record(connection, who, "change instrument", f"instrument {found.key}", old={"kind": ""}, new={"kind": kind})
    return found


def _row(connection: Connection, serial: str) -> KnownInstrument | None:
    row = connection.execute(
        select(instrument.c.id, instrument.c.serial, instrument.c.kind).where(instrument.c.serial == serial)
    ).one_or_none()
    return KnownInstrument(*row) if row else None


def _add_calibration(
    connection: Connection,
    of: KnownInstrument,
    at: datetime,
    due: datetime | None,
    certificate: str,
    content: Mapping[str, Any],
    who: str,
) -> None:
    """Keep a calibration, unless one of that day is there that says as much."""
    there = select(calibration.c.due).where(calibration.c.instrument == of.key, calibration.c.at == at)
    if any(due is None or known == due for known in connection.execute(there).scalars()):
        return
    row = {"instrument": of.key, "at": at, "due": due, "certificate": certificate, "content": dict(content), "who": who}
    connection.execute(insert(calibration).values(row))
    said = {"at": at.isoformat(), "due": due and due.isoformat(), "certificate": certificate, **content}
    audit.record(connection, who, "note calibration", f"instrument {of.key}", new=said)
