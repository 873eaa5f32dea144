"""The view of a machine: the verdict of its worst series in full, and how its other series stand."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from elastogeo.changes import ALARM, OVERDUE, ChangeVerdict, MachineRow, MachineState
from elastogeo.report.changes.answers import sentence_of_change, series_said, worst_of
from elastogeo.report.changes.change_view import told
from elastogeo.report.changes.document import answer_entries, change_entries
from elastogeo.report.changes.fleets.rows import row_said
from elastogeo.report.changes.points import points_of
from elastogeo.report.changes.words import MARKS, TONES, marked, predicate, title_of
from elastogeo.report.days import days_said, iso_date, short_date
from elastogeo.report.document import document, verdict_entries
from elastogeo.report.later import Later
from elastogeo.report.text import listed
from elastogeo.report.view import Badge, Section, Table, View, views


@views(MachineState)
def machine_state_view(machine: MachineState) -> View:
    """All that is shown of a machine: that of its worst series, with a table of all."""
    whole = Later(lambda: machine_json(machine))
    if not machine.series:
        return View(
            kind="Machine",
            title=machine.machine,
            subtitle="no tests",
            origin="",
            badge=Badge(MARKS[machine.state], title_of(machine.state), TONES[machine.state]),
            head=(),
            sentence=f"{machine.machine} has no test yet: whether it has changed cannot be said.",
            values=(),
            picture=None,
            checks=(),
            document=whole,
        )
    view = told(machine.series[0], whole)
    several = max(len(machine.series), len(machine.rows)) > 1
    table = _kept_series(machine) if machine.rows else series_table(machine)
    names = {verdict.series.name: series_said(verdict) for verdict in machine.series}
    late = tuple(f"{names.get(name, name)}: overdue by {days_said(days)}." for name, days in machine.overdue.items())
    first = "" if machine.rows else "the worst: "
    count = max(len(machine.series), len(machine.rows))
    return replace(
        view,
        kind="Machine",
        title=machine.machine,
        subtitle=f"{count} series; {first}{series_said(machine.series[0])}" if several else view.subtitle,
        badge=_badge(machine, view),
        advice=(*view.advice, *late) if several else view.advice,
        tables=(table, *view.tables) if several else view.tables,
        sections=(Section("Series", tables=(table,)), *view.sections) if several else view.sections,
    )


def _badge(machine: MachineState, view: View) -> Badge | None:
    if machine.state != OVERDUE:
        return view.badge
    late = days_said(max(machine.overdue.values(), default=0.0))
    return Badge(MARKS[OVERDUE], f"Test overdue by {late}", TONES[OVERDUE])


def series_table(machine: MachineState) -> Table:
    """The series of a machine, the worst first."""
    rows = tuple(
        (
            series_said(verdict),
            marked(verdict.state),
            short_date(verdict.since) if verdict.state == ALARM else "",
            listed(predicate(one) for one in verdict.changed) if verdict.changed else "",
            str(len(verdict.series)),
            short_date(float(verdict.series.date[-1])) if len(verdict.series) else "",
            "" if verdict.due is None else short_date(verdict.due.at),
        )
        for verdict in machine.series
    )
    names = tuple(series_said(verdict) for verdict in machine.series)
    headings = ("series", "state", "since", "", "tests", "last test", "next due")
    return Table(headings, rows, words=(0, 1, 2, 3, 5, 6), title="The worst first", name="series", keys=names)


def _kept_series(machine: MachineState) -> Table:
    """The series of a machine as they were judged last, the worst first; the one that is shown is strong."""
    shown = {series_said(verdict) for verdict in machine.series}
    rows = tuple(
        (row.series, marked(row.state), row_said(row), short_date(row.since), short_date(row.last_test), short_date(row.due))
        for row in machine.rows
    )
    return Table(
        ("series", "state", "", "since", "last test", "next due"),
        rows,
        words=(0, 1, 2, 3, 4, 5),
        title="The worst first",
        strong=tuple(k for k, row in enumerate(machine.rows) if row.series in shown),
        name="series",
        keys=tuple(row.series if row.series_key is None else row.series_key for row in machine.rows),
        tones=tuple(TONES[row.state] for row in machine.rows),
    )


def machine_json(machine: MachineState) -> dict[str, Any]:
    """A machine as a JSON document, `elastogeo.machine/1`: of its worst series what `elastogeo.change/1` says, and more.

    machine, state, open_alarms, held_by : whose; the worst of its series, or `overdue`
    series : [{name, state, since, sentence, tests, last, due, overdue_days}], the worst first; `tests` and the sentence in
        full of those that were judged for this
    verdict : {state, since, sentence, points_to, cannot_tell, next, next_test, checks}
    indicators, chart, causes, alarm, baseline : as in `elastogeo.change/1`
    tests : [{test, series, date, mark, temperature, instrument}] of all series, the newest first
    due : when the next test of any series is due
    """
    worst = machine.series[0] if machine.series else None
    said = {} if worst is None else change_entries(worst)
    answer = {} if worst is None else {**answer_entries(worst), "checks": verdict_entries(worst.verdict)}
    kept = ("simulated", "alarm", "indicators", "chart", "causes", "baseline", "alpha", "judged_at")
    judged = [verdict.due.at for verdict in machine.series if verdict.due is not None]
    due = [at for at in ([row.due for row in machine.rows] or judged) if at is not None]
    return document(
        "elastogeo.machine/1",
        {
            "machine": machine.machine,
            "state": machine.state,
            "open_alarms": machine.open_alarms,
            "held_by": machine.held_by,
            "series": _every_series(machine),
            "verdict": answer,
            **{key: said.get(key, [] if key in ("indicators", "causes") else None) for key in kept},
            "tests": [entry for verdict in machine.series for entry in _tests(verdict)],
            "due": iso_date(min(due, default=None)),
        },
    )


def _every_series(machine: MachineState) -> list[dict[str, Any]]:
    judged = {series_said(verdict): _series(machine, verdict) for verdict in machine.series}
    return [judged.get(row.series) or _kept(row) for row in machine.rows] if machine.rows else list(judged.values())


def _kept(row: MachineRow) -> dict[str, Any]:
    return {
        "name": row.series,
        "state": row.state,
        "since": iso_date(row.since),
        "sentence": row_said(row),
        "tests": None,
        "last": iso_date(row.last_test),
        "due": iso_date(row.due),
        "overdue_days": row.overdue,
    }


def _series(machine: MachineState, verdict: ChangeVerdict) -> dict[str, Any]:
    return {
        "name": series_said(verdict),
        "state": verdict.state,
        "since": iso_date(verdict.since),
        "sentence": sentence_of_change(verdict),
        "tests": len(verdict.series),
        "last": iso_date(float(verdict.series.date[-1])) if len(verdict.series) else None,
        "due": None if verdict.due is None else iso_date(verdict.due.at),
        "overdue_days": machine.overdue.get(verdict.series.name, 0.0),
    }


def _tests(verdict: ChangeVerdict) -> list[dict[str, Any]]:
    one = worst_of(verdict)
    return [
        {
            "test": point.test,
            "series": series_said(verdict),
            "date": iso_date(point.date),
            "mark": point.mark,
            "temperature": point.temperature,
            "instrument": verdict.series.instruments[point.place],
        }
        for point in (() if one is None else points_of(verdict, one)[::-1])
    ]
