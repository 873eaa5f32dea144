"""The view of what happened to machines and instruments (`elastogeo.events/1`).

machine, kind, year : what was asked for; empty and null: all
years : in which there are any
events : [{number, date, kind, note, who, machine, instrument}], the newest first; `number` is null of a calibration that is
    kept with its instrument
"""

from __future__ import annotations

from collections import Counter

from elastogeo.changes import EventList, KeptEvent
from elastogeo.report.changes.events import event_said
from elastogeo.report.days import date_said, iso_date, short_date
from elastogeo.report.document import document
from elastogeo.report.text import listed
from elastogeo.report.view import Table, View, lines, views

MOST = 500
"""Events in the table; the JSON holds all."""


@lines(KeptEvent)
def kept_event_line(one: KeptEvent) -> str:
    """`4 May 2026, Mill 3: Repair: nut of X replaced (A. Smith)`."""
    of = f", {one.machine}" if one.machine else ""
    return f"{short_date(one.event.date)}{of}: {event_said(one.event)}"


@views(EventList)
def events_view(found: EventList) -> View:
    """What happened, the newest first."""
    entries = [
        {
            "number": one.key,
            "date": iso_date(one.event.date),
            "kind": one.event.kind,
            "note": one.event.note,
            "who": one.event.who,
            "machine": one.machine,
            "instrument": one.event.instrument,
        }
        for one in found.events
    ]
    shown = found.events[:MOST]
    left = len(found.events) - len(shown)
    table = Table(
        ("Date", "Of", "Kind", "What happened", "By"),
        tuple(_row(one) for one in shown),
        words=(0, 1, 2, 3, 4),
        note=f"{left} older events are in the JSON." if left else "",
        name="events",
        keys=tuple(one.machine_key or "" for one in shown),
    )
    asked = {"machine": found.machine, "kind": found.kind, "year": found.year, "years": found.years}
    return View(
        kind="Events",
        title=found.machine or "Events",
        subtitle=f"{len(found.events)} {'event' if len(found.events) == 1 else 'events'}",
        origin="",
        sentence=_answer(found),
        document=document("elastogeo.events/1", {**asked, "events": entries}),
        rows=entries,
        tables=(table,) if shown else (),
    )


def _row(one: KeptEvent) -> tuple[str, ...]:
    event = one.event
    of = one.machine or f"instrument {event.instrument}"
    return short_date(event.date), of, event.kind, event.note, event.who


def _answer(found: EventList) -> str:
    within = f" in {found.year}" if found.year is not None else ""
    of = f" of {found.machine} or the instruments that tested it" if found.machine else ""
    if not found.events:
        what = f"No {found.kind}" if found.kind else "Nothing"
        return f"{what} is written down{within}{of}."
    counts = Counter(one.event.kind for one in found.events)
    kinds = listed(f"{count} {_plural(kind, count)}" for kind, count in counts.most_common())
    last = found.events[0]
    which = last.machine if last.machine and not found.machine else f"instrument {last.event.instrument}"
    where = "" if last.machine and found.machine else f" of {which}"
    what = f"{last.event.kind}{where}{f', {last.event.note}' if last.event.note else ''}"
    return f"{kinds}{within}{of}; the last on {date_said(last.event.date)}: {what}."


def _plural(kind: str, count: int) -> str:
    return kind if count == 1 else f"{kind}es" if kind.endswith("sh") else f"{kind}s"
