"""The view of what a search found: a table for each kind."""

from __future__ import annotations

from elastogeo.changes import FOUND_KINDS, Found, FoundEntry
from elastogeo.report.days import iso_date, short_date
from elastogeo.report.document import document
from elastogeo.report.text import listed
from elastogeo.report.view import Table, View, lines, views


@lines(FoundEntry)
def found_line(entry: FoundEntry) -> str:
    """`tests: circle in May (Mill 3 · ball bar)`."""
    return f"{entry.kind}: {entry.name}{f' ({entry.about})' if entry.about else ''}"


@views(Found)
def found_view(found: Found) -> View:
    """All that is shown of a search."""
    whole = document(
        "elastogeo.found/1",
        {
            "words": found.words,
            "more": found.more,
            "entries": [
                {
                    "kind": entry.kind,
                    "id": entry.key,
                    "name": entry.name,
                    "about": entry.about,
                    "machine": entry.machine,
                    "date": iso_date(entry.date),
                }
                for entry in found.entries
            ],
        },
    )
    return View(
        kind="Search",
        title="Search",
        origin="",
        sentence=_sentence(found),
        document=whole,
        rows=whole["entries"],
        tables=tuple(_table(found, kind) for kind in FOUND_KINDS if any(entry.kind == kind for entry in found.entries)),
    )


def _sentence(found: Found) -> str:
    if not found.words:
        return "Write what a machine, a series, a test, an instrument or an event is called, or a part of it."
    if not found.entries:
        return "Nothing is called so. Try fewer words, or a part of one."
    counts = {kind: sum(entry.kind == kind for entry in found.entries) for kind in FOUND_KINDS}
    said = (_counted(kind, count, kind in found.more) for kind, count in counts.items() if count)
    return f"Found: {listed(said)}."


def _counted(kind: str, count: int, more: bool) -> str:
    one = kind if kind == "series" else kind.removesuffix("s")
    return f"{'more than ' if more else ''}{count} {one if count == 1 else kind}"


def _table(found: Found, kind: str) -> Table:
    every = [entry for entry in found.entries if entry.kind == kind]
    dated = any(entry.date is not None for entry in every)
    rows = tuple((entry.name, entry.about, *([short_date(entry.date)] if dated else ())) for entry in every)
    return Table(
        ("name", "about", *(["date"] if dated else [])),
        rows,
        words=(0, 1, 2),
        title=f"{kind[:1].upper()}{kind[1:]}",
        note=f"These are the first {len(rows)}; write more words to see others." if kind in found.more else "",
        name=kind,
        keys=tuple(_place(entry) for entry in every),
    )


def _place(entry: FoundEntry) -> str | int:
    """What its page is called by: its own key, of a series and of an event that of its machine with its own."""
    if entry.kind == "series":
        return f"{entry.machine}?series={entry.key}"
    return entry.key if entry.kind != "events" else entry.machine or ""
