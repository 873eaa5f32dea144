"""What happened to a machine or an instrument: it stands on the charts and explains, and changes no verdict by itself."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from sqlalchemy import insert

from elastogeo.errors import InputError
from elastogeo.history.intake.days import day_of
from elastogeo.history.intake.instruments import instrument_numbered
from elastogeo.history.intake.machines import machine_named
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import event

KINDS = ("repair", "parameter edit", "move", "crash", "calibration", "note")


@dataclass(frozen=True, slots=True)
class Happened:
    """An event that was kept.

    Attributes
    ----------
    key : int
    kind : str
    at : datetime
    note : str
    of : str
        The machine, or the instrument.
    """

    key: int
    kind: str
    at: datetime
    note: str
    of: str


def record_event(
    store: Store,
    kind: str,
    note: str,
    *,
    who: str,
    machine: str | None = None,
    instrument: str | None = None,
    at: str = "",
) -> Happened:
    """Keep an event.

    Parameters
    ----------
    store : Store
    kind : str
        `repair`, `parameter edit`, `move`, `crash`, `calibration` or `note`.
    note : str
        What was done, in words.
    who : str
    machine, instrument : str
        Name of the one, or serial number of the other.
    at : str
        When; by default now.

    Raises
    ------
    InputError
        If the kind is none, there is no note, neither or both are named, or the date cannot be.
    """
    kind = kind.strip().replace("-", " ")
    if kind not in KINDS:
        raise InputError(f"{kind!r} is no kind of event; write one of {', '.join(KINDS)}")
    if not note.strip():
        raise InputError("an event needs a note: what was done, as in 'X guideway: carriage 2 replaced'")
    if (machine is None) == (instrument is None):
        raise InputError("an event is of one machine or of one instrument; give --machine NAME or --instrument SERIAL")
    when = day_of(at, "the date of the event", now()).at if at else now()
    with write(store) as connection:
        if machine is not None:
            of = machine_named(connection, machine)
            place, name = {"machine": of.key}, of.name
        else:
            tool = instrument_numbered(connection, str(instrument))
            place, name = {"instrument": tool.key}, f"instrument {tool.serial}"
        row = {**place, "kind": kind, "at": when, "note": note.strip(), "who": who, "made_at": now()}
        key = connection.execute(insert(event).values(row).returning(event.c.id)).scalar_one()
        said = {"of": name, "kind": kind, "at": when.isoformat(), "note": note.strip()}
        audit.record(connection, who, "add event", f"event {key}", new=said)
    return Happened(key, kind, when, note.strip(), name)
