"""The view of the alarms that wait for somebody, and `elastogeo.alarms/1`, its document.

now : when this was so
alarms : as `alarm` in `elastogeo.alarm/1`
overdue : [{machine, series, due, overdue_days}]
failed : [{channel, address, subject, error, at}], messages of the last week that were given up
simulated : from what the tests are simulated, or null
"""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.changes.alarms import ACKNOWLEDGED, CLOSED, HELD, OPEN, AlarmList, AlarmRow
from elastogeo.report.alarms.words import counted, entry, of_what, over_said
from elastogeo.report.days import date_said, iso_date, simulated_said
from elastogeo.report.document import document
from elastogeo.report.numbers import significant
from elastogeo.report.view import Section, Table, View, views

SCHEMA = "elastogeo.alarms/1"


@views(AlarmList)
def alarm_list_view(result: AlarmList) -> View:
    """All that waits for somebody."""
    tables = tuple(_tables(result))
    rows = [entry(row) for row in result.alarms]
    found = {
        "now": iso_date(result.now),
        "alarms": rows,
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
        subtitle="",
        origin=simulated_said(result.simulated),
        head=(),
        sentence=_answer(result),
        values=(),
        picture=None,
        checks=(),
        document=document(SCHEMA, found),
        rows=rows,
        tables=tables,
        sections=(Section("Alarms", tables=tables),),
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
    after = "The series needs a new baseline." if row.state == CLOSED[0] and not row.instrument else ""
    return f"Alarm {row.number} of {of_what(row)} is {row.state} by {row.who}. {after}".strip()


def _tables(result: AlarmList) -> Iterator[Table]:
    if result.alarms:
        yield Table(
            ("No.", "Of", "State", "Opened", "What", "Confirmed", "Who and why"),
            tuple(_alarm(row) for row in result.alarms),
            words=(1, 2, 3, 4, 5, 6),
            title="Alarms",
        )
    if result.overdue:
        yield Table(
            ("Machine", "Series", "Due", "Overdue [d]"),
            tuple((row.machine, row.series, date_said(row.due), significant(row.overdue, 2)) for row in result.overdue),
            words=(0, 1, 2),
            title="Overdue",
        )
    if result.failed:
        yield Table(
            ("Made", "By", "To", "Message", "Why it did not arrive"),
            tuple((date_said(row.at), row.channel, row.address, row.subject, row.error) for row in result.failed),
            words=(0, 1, 2, 3, 4),
            title="Given up",
        )


def _alarm(row: AlarmRow) -> tuple[str, ...]:
    silent = "" if row.silent_until is None else f"; silent until {date_said(row.silent_until)}"
    what = over_said(row.over) if not row.holds else f"holds back {', '.join(row.holds)}"
    person = f"{row.who}: {row.why}" if row.who else ""
    confirmed = "" if row.instrument else ("by a second test" if row.confirmed else "no")
    of = f"{of_what(row)} (simulated)" if row.simulated else of_what(row)
    return str(row.number), of, f"{row.state}{silent}", date_said(row.opened), what, confirmed, person
