"""What happened to the machines and instruments of a history."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.changes.events import Event
from elastogeo.result import Part, Result

EVENT_KINDS = ("repair", "parameter edit", "move", "crash", "calibration", "note")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class KeptEvent(Part):
    """An event with what it happened to.

    Attributes
    ----------
    key : int or None
        None of a calibration that is kept with its instrument.
    event : Event
        Its `instrument` is empty if it happened to a machine.
    machine : str
        Empty if it happened to an instrument.
    machine_key : int or None
    """

    key: int | None
    event: Event
    machine: str = ""
    machine_key: int | None = None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class EventList(Result):
    """The events of a history.

    Attributes
    ----------
    store : str
    machine, kind : str
        Of which machine, of which kind alone; empty: of all.
    year : int or None
        Of which alone.
    events : tuple of KeptEvent
        The newest first.
    years : tuple of int
        In which there are any, whatever was asked for, the newest first.
    """

    store: str
    machine: str
    kind: str
    year: int | None
    events: tuple[KeptEvent, ...]
    years: tuple[int, ...]
