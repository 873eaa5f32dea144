"""The view of the alarms that wait for somebody, and `elastogeo.alarms/1`, its document.

now : when this was so
alarms, closed : as `alarm` in `elastogeo.alarm/1`; those that were closed lately, where they are asked for
overdue : [{machine, series, due, overdue_days}]
failed : [{channel, address, subject, error, at}], messages of the last week that were given up
silences : [{machine, until, at, who, why}], machines of which nothing is sent, where they are asked for
simulated : from what the tests are simulated, or null
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from elastogeo.changes.alarms import ACKNOWLEDGED, CLOSED, HELD, OPEN, AlarmList, AlarmRow
from elastogeo.report.alarms.words import (
    change_said,
    counted,
    entry,
    marked,
    of_what,
    person_said,
    points_said,
    since_said,
    sure_said,
)
from elastogeo.report.days import date_said, iso_date, simulated_said
from elastogeo.report.document import document
from elastogeo.report.numbers import significant
from elastogeo.report.view import Section, Table, View, views

SCHEMA = "elastogeo.alarms/1"


@views(AlarmList)
def alarm_list_view(result: AlarmList) -> View:
    """All that waits for somebody."""
    tables = tuple(_tables(result))
    rows = [entry(row) for row in (*result.alarms, *result.closed)]
    found = {
        "now": iso_date(result.now),
        "alarms": [entry(row) for row in result.alarms],
        "closed": [entry(row) for row in result.closed],
        "silences": [
            {"machine": one.machine, "until": iso_date(one.until), "at": iso_date(one.at), "who": one.who, "why": one.why}
            for one in result.silences
        ],
        "overdue": [
            {"machine": row.machine, "series": row.series, "due": iso_date(row.due), "overdue_days": row.overdue}
            for row in result.overdue
        ],
        "failed": [
            {
                "channel": row.channel,
                "address": row.address,
                "subject": row.subject,
                "error": row.error,
                "at": iso_date(row.at),
            }
            for row in result.failed
        ],
        "simulated": result.simulated or None,
    }
    return View(
        kind="Alarms",
        title=date_said(result.now),
        origin=simulated_said(result.simulated),
        sentence=_answer(result),
        document=document(SCHEMA, found),
        rows=rows,
        tables=tables,
        sections=tuple(_sections(result)),
    )


def _answer(result: AlarmList) -> str:
    if result.alarms and all(row.state in CLOSED for row in result.alarms):
        return " ".join(_closed(row) for row in result.alarms)
    if result.acted:
        return " ".join(
            f"Alarm {row.number} of {of_what(row)} is {row.state} by {row.who}; it stays open." for row in result.alarms
        )
    states = [row.state for row in result.alarms if row.state not in CLOSED]
    parts = [f"{counted(len(states), 'alarm')} {'is' if len(states) < 2 else 'are'} open"]
    beside = [(OPEN, "that nobody has acknowledged"), (ACKNOWLEDGED, "acknowledged"), (HELD, "held back")]
    named = [f"{states.count(state)} {words}" for state, words in beside if state in states]
    if named:
        parts[0] += f" ({', '.join(named)})"
    late = len(result.overdue)
    parts.append(f"{counted(late, 'test')} {'is' if late < 2 else 'are'} overdue")
    if result.failed:
        parts.append(f"{counted(len(result.failed), 'message')} did not arrive")
    text = ", ".join(parts)
    return f"{text[:1].upper()}{text[1:]}."


def _closed(row: AlarmRow) -> str:
    follows = "The series needs a new baseline." if row.state == CLOSED[0] else "The series keeps its baseline."
    after = "" if row.instrument else follows
    return f"Alarm {row.number} of {of_what(row)} is {row.state} by {row.who}. {after}".strip()


def _tables(result: AlarmList) -> Iterator[Table]:
    if result.alarms:
        yield Table(
            ("No.", "Of", "State", "What", "Since", "How sure", "Who and why"),
            tuple(_alarm(row) for row in result.alarms),
            words=(1, 2, 3, 4, 5, 6),
            title="Alarms",
        )
    yield from _beside(result)


def _sections(result: AlarmList) -> Iterator[Section]:
    """The page: alarms by their state, those of one machine together, then what else waits."""
    groups = (("Open", OPEN), ("Acknowledged", ACKNOWLEDGED), ("Held back under an instrument", HELD))
    for title, state in groups:
        rows = [row for row in result.alarms if row.state == state]
        if rows:
            yield Section(title, tables=(_of_page(state, rows),))
    if result.closed:
        yield Section("Closed lately", tables=(_of_page("closed", result.closed),))
    for table in _beside(result):
        yield Section(table.title, tables=(replace(table, title=""),))


def _of_page(name: str, rows: Iterable[AlarmRow]) -> Table:
    first: dict[str, int] = {}
    for place, row in enumerate(rows := list(rows)):
        first.setdefault(row.machine or row.instrument, place)
    ordered = sorted(rows, key=lambda row: first[row.machine or row.instrument])
    return Table(
        ("State", "Machine", "Series", "What", "Since", "How sure", "Points to", "Who and why", "Beside"),
        tuple(
            (
                marked(row.state),
                row.machine or f"Instrument {row.instrument}",
                row.series,
                _capital(change_said(row)),
                since_said(row),
                sure_said(row),
                points_said(row),
                f"{person_said(row)}{f' ({date_said(row.at)})' if row.who else ''}",
                _held_said(row),
            )
            for row in ordered
        ),
        words=tuple(range(9)),
        name=name,
        keys=tuple(row.number for row in ordered),
    )


def _held_said(row: AlarmRow) -> str:
    """What else holds of it: silent, held back, simulated."""
    parts = (
        "" if row.silent_until is None else f"nothing is sent until {date_said(row.silent_until)}",
        "" if row.held_by is None else f"held back under alarm {row.held_by} of the instrument",
        "simulated" if row.simulated and "simulated" not in row.series else "",
    )
    return "; ".join(part for part in parts if part)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _beside(result: AlarmList) -> Iterator[Table]:
    """What waits beside the alarms."""
    if result.overdue:
        yield Table(
            ("Machine", "Series", "Due", "Overdue [d]"),
            tuple((row.machine, row.series, date_said(row.due), significant(row.overdue, 2)) for row in result.overdue),
            words=(0, 1, 2),
            title="Overdue",
            name="overdue",
        )
    if result.silences:
        yield Table(
            ("Machine", "Nothing is sent until", "Who", "Why"),
            tuple((one.machine, date_said(one.until), one.who, one.why) for one in result.silences),
            words=(0, 1, 2, 3),
            title="Silent machines",
            name="silences",
            keys=tuple(one.machine_key for one in result.silences),
        )
    if result.failed:
        yield Table(
            ("Made", "By", "To", "Message", "Why it did not arrive"),
            tuple((date_said(row.at), row.channel, row.address, row.subject, row.error) for row in result.failed),
            words=(0, 1, 2, 3, 4),
            title="Given up",
            name="failed",
        )


def _alarm(row: AlarmRow) -> tuple[str, ...]:
    silent = "" if row.silent_until is None else f"; silent until {date_said(row.silent_until)}"
    of = f"{of_what(row)} (simulated)" if row.simulated else of_what(row)
    what = "; points to ".join(part for part in (change_said(row), points_said(row)) if part)
    return str(row.number), of, f"{row.state}{silent}", what, since_said(row), sure_said(row), person_said(row)
