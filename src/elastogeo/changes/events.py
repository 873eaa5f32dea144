"""What happened to a machine or an instrument between its tests, and what became of an alarm: said beside the charts."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Event(Part):
    """A repair, a parameter edit, a move, a crash, a calibration, a note: it explains, it changes no verdict.

    Attributes
    ----------
    kind : str
    date : float [d]
        Since 1970-01-01 UTC.
    note : str
    who : str
    instrument : str
        Serial number of the instrument it happened to; empty if it was the machine.
    """

    kind: str
    date: float
    note: str
    who: str = ""
    instrument: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class OpenAlarm(Part):
    """An alarm that no person has closed.

    Attributes
    ----------
    opened : float [d]
    acknowledged : float or None [d]
        Since when a person knows of it as it is; None if nobody does.
    who, why : str
        Of that person; empty if nobody acknowledged it.
    held_by : str
        Serial number of the instrument whose alarm holds it back; empty if none does.
    number : int or None
        By which a person names it; None outside a history.
    """

    opened: float
    acknowledged: float | None = None
    who: str = ""
    why: str = ""
    held_by: str = ""
    number: int | None = None
