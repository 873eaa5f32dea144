"""Events by letters: the same letter on the chart and in the list."""

from __future__ import annotations

from collections.abc import Iterable

from elastogeo.changes import Event

_ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def lettered(events: Iterable[Event]) -> dict[str, Event]:
    """Events by letter, in the order of time: A to Z, then AA, AB and so on."""
    return {letter(number): event for number, event in enumerate(sorted(events, key=lambda event: event.date))}


def letter(number: int) -> str:
    """The letter of the event of this number, from 0."""
    high, low = divmod(number, len(_ALPHABET))
    return f"{letter(high - 1) if high else ''}{_ALPHABET[low]}"


def event_said(event: Event) -> str:
    """What happened: `Repair: nut of X replaced (A. Smith)`."""
    what = f"{event.kind[:1].upper()}{event.kind[1:]}"
    of = f" of instrument {event.instrument}" if event.instrument else ""
    note = f": {event.note}" if event.note else ""
    return f"{what}{of}{note}{f' ({event.who})' if event.who else ''}"
