"""The view of one alarm with all that happened to it, and `elastogeo.kept-alarm/1`, its document.

now : when this was so
alarm : as in `elastogeo.alarm/1`
steps : [{state, at, who, why, test, over}]
messages : [{step, channel, address, state, made, sent, tries, error}]; of a web address the host only
simulated : from what the tests are simulated, or null
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict

from elastogeo.changes.alarms import ACKNOWLEDGED, CLOSED, HELD, OPEN, RELEASED, WORSE, AlarmMessage, AlarmStep, KeptAlarm
from elastogeo.report.alarms.words import (
    change_said,
    entry,
    marked,
    of_what,
    over_said,
    points_said,
    since_said,
    sure_said,
)
from elastogeo.report.days import date_said, iso_date, moment_said, simulated_said
from elastogeo.report.document import document
from elastogeo.report.view import Badge, Section, Table, View, lines, views

SCHEMA = "elastogeo.kept-alarm/1"
_HAPPENED = {
    OPEN: "opened",
    WORSE: "became worse",
    HELD: "held back: the instrument's own alarm is open",
    RELEASED: "counts again: the instrument is not the cause",
    ACKNOWLEDGED: "acknowledged",
}


@lines(AlarmStep)
def step_line(step: AlarmStep) -> str:
    """`11 June 2026: acknowledged by A. Miller: nut is ordered`."""
    by = f" by {step.who}" if step.who else ""
    return f"{date_said(step.at)}: {_HAPPENED.get(step.state, step.state)}{by}{f': {step.why}' if step.why else ''}"


@lines(AlarmMessage)
def message_line(message: AlarmMessage) -> str:
    """`mail to anna@example.com: sent 11 Jun 2026 08:30 UTC`."""
    return f"{message.channel} to {message.address}: {_became(message)}"


@views(KeptAlarm)
def kept_alarm_view(result: KeptAlarm) -> View:
    """One alarm: how it stands, what is to be done, what happened to it, who was told."""
    row = result.row
    steps = Table(
        ("When", "What", "By", "Why", "Test", "How far off"),
        tuple(
            (
                moment_said(step.at),
                _HAPPENED.get(step.state, step.state),
                step.who or "the charts",
                step.why,
                "" if step.test is None else str(step.test),
                over_said(step.over),
            )
            for step in result.steps
        ),
        words=tuple(range(6)),
        name="steps",
        keys=tuple("" if step.test is None else step.test for step in result.steps),
    )
    messages = Table(
        ("When", "Of what", "By", "To", "What became of it"),
        tuple(
            (moment_said(one.made), _HAPPENED.get(one.step, one.step), one.channel, one.address, _became(one))
            for one in result.messages
        ),
        words=tuple(range(5)),
        name="messages",
    )
    rows = [asdict(step) | {"at": iso_date(step.at)} for step in result.steps]
    found = {
        "now": iso_date(result.now),
        "alarm": entry(row),
        "steps": rows,
        "messages": [asdict(one) | {"made": iso_date(one.made), "sent": iso_date(one.sent)} for one in result.messages],
        "simulated": row.simulated or None,
    }
    return View(
        kind="Alarm",
        title=f"Alarm {row.number}",
        subtitle=of_what(row),
        origin=simulated_said(row.simulated),
        head=tuple(
            (label, text)
            for label, text in (
                ("Opened", date_said(row.opened)),
                ("Changed", since_said(row)),
                ("How sure", sure_said(row)),
            )
            if text
        ),
        sentence=_answer(result),
        document=document(SCHEMA, found),
        rows=rows,
        tables=(steps, messages) if result.messages else (steps,),
        sections=(
            Section("What happened", tables=(steps,)),
            Section(
                "Who was told",
                () if result.messages else ("Nobody was told of it: messages are sent of what live tests show.",),
                tables=(messages,) if result.messages else (),
            ),
        ),
        badge=_badge(result),
        advice=tuple(_advice(result)),
    )


def _badge(result: KeptAlarm) -> Badge:
    row = result.row
    if row.state in CLOSED:
        return Badge("●", f"{row.state[:1].upper()}{row.state[1:]} on {date_said(row.at)}", "good")
    words = {OPEN: "Open, not acknowledged", ACKNOWLEDGED: "Open, acknowledged", HELD: "Open, held back"}
    return Badge(marked(row.state)[:1], words[row.state], "bad" if row.state == OPEN else "care")


def _answer(result: KeptAlarm) -> str:
    row = result.row
    of = of_what(row)
    points = points_said(row)
    said = f"{of[:1].upper()}{of[1:]}: {change_said(row)}{f'; points to {points}' if points else ''}."
    return f"{said} {row.who} closed it: {row.why}." if row.state in CLOSED else said


def _advice(result: KeptAlarm) -> Iterator[str]:
    row = result.row
    if row.state in CLOSED:
        return
    if row.state == ACKNOWLEDGED:
        yield f"{row.who} knows of it since {date_said(row.at)}: {row.why}."
    if row.held_by is not None:
        yield f"Check the instrument first: this alarm goes with alarm {row.held_by}."
    if row.silent_until is not None:
        yield f"Nothing is sent of this machine until {date_said(row.silent_until)}."


def _became(message: AlarmMessage) -> str:
    if message.sent is not None:
        return f"sent {moment_said(message.sent)}"
    if message.state == "waiting":
        return f"waits; not taken yet: {message.error}" if message.error else "waits to be sent"
    return f"given up: {message.error}" if message.error else "given up"
