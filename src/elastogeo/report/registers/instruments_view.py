"""The views of instruments, with `elastogeo.instruments/1` and `elastogeo.instrument/1`, their documents.

instruments : [{number, serial, kind, calibrated, due, overdue_days, certificate, tests, machines, last_test, alarm,
    calibrations}], those whose calibration has run out first; `calibrations`: [{at, due, certificate, who}], the last first
instrument : the same of one
tests : [{number, name, machine, series, at, expired}]; `expired`: the calibration had run out when it was made
alarms : [{number, state, at}]
events : [{at, kind, note, who}]
simulated : from what the tests are simulated, or null
"""

from __future__ import annotations

from dataclasses import asdict

from elastogeo.changes import (
    NOT_ASKED,
    OVERDUE,
    Calibration,
    InstrumentRecord,
    KeptInstrument,
    KeptInstruments,
    TestWith,
)
from elastogeo.report.days import date_said, days_said, iso_date, short_date, simulated_said
from elastogeo.report.document import document
from elastogeo.report.text import listed
from elastogeo.report.view import Badge, Section, Table, View, lines, views

SOON = 30.0
"""Days before which a calibration is said to run out soon."""
_MACHINES = 4


@lines(Calibration)
def calibration_line(one: Calibration) -> str:
    """`1 March 2026, holds until 1 March 2027, certificate 4711`."""
    until = f", holds until {date_said(one.due)}" if one.due is not None else ""
    return f"{date_said(one.at)}{until}{f', certificate {one.certificate}' if one.certificate else ''}"


@lines(KeptInstrument)
def instrument_line(one: KeptInstrument) -> str:
    """`B-202, loaded-ball-bar: calibration ran out 12 days ago`."""
    return f"{one.serial}{f', {one.kind}' if one.kind else ''}: {_standing(one, None)}"


@lines(TestWith)
def test_line(one: TestWith) -> str:
    """`test 12, 11 June 2026: Mill 3, XY 150`."""
    return (
        f"test {one.key}, {date_said(one.at)}: {one.machine}, {one.series}{'; not calibrated then' if one.expired else ''}"
    )


@views(KeptInstruments)
def instruments_view(result: KeptInstruments) -> View:
    """All instruments, those whose calibration has run out first."""
    entries = [_entry(one) for one in result.instruments]
    table = Table(
        ("Instrument", "Type", "Calibration", "Calibrated", "Due", "Certificate", "Tests", "Machines", "Alarm"),
        tuple(
            (
                one.serial,
                one.kind.replace("-", " "),
                _marked(one, result.now),
                short_date(one.calibrations[0].at) if one.calibrations else "",
                short_date(one.due.at),
                one.calibrations[0].certificate if one.calibrations else "",
                str(one.tests),
                _machines(one.machines),
                "" if one.alarm is None else f"■ alarm {one.alarm}",
            )
            for one in result.instruments
        ),
        words=(0, 1, 2, 3, 4, 5, 7, 8),
        title="Instruments",
        name="instruments",
        keys=tuple(one.key for one in result.instruments),
    )
    return View(
        kind="Instruments",
        title=result.store,
        origin=simulated_said(result.simulated),
        sentence=_answer(result),
        document=document(
            "elastogeo.instruments/1",
            {"now": iso_date(result.now), "instruments": entries, "simulated": result.simulated or None},
        ),
        rows=[{name: value for name, value in entry.items() if name != "calibrations"} for entry in entries],
        tables=(table,) if entries else (),
        sections=(Section("Instruments", tables=(table,)),) if entries else (),
    )


@views(InstrumentRecord)
def instrument_view(result: InstrumentRecord) -> View:
    """One instrument: its calibrations, its alarms, what was tested with it."""
    one = result.instrument
    calibrations = Table(
        ("Calibrated", "Holds until", "Certificate", "Entered by"),
        tuple((date_said(c.at), date_said(c.due) or "not said", c.certificate, c.who) for c in one.calibrations),
        words=(0, 1, 2, 3),
        name="calibrations",
    )
    tests = Table(
        ("Date", "Machine", "Series", "Test", "Calibration then"),
        tuple((short_date(t.at), t.machine, t.series, t.name, "had run out" if t.expired else "") for t in result.tests),
        words=(0, 1, 2, 3, 4),
        name="tests",
        keys=tuple(t.key for t in result.tests),
        note=f"The last {len(result.tests)} of {one.tests}." if len(result.tests) < one.tests else "",
    )
    alarms = Table(
        ("Alarm", "State", "Opened"),
        tuple((f"Alarm {number}", state, date_said(at)) for number, state, at in result.alarms),
        words=(0, 1, 2),
        name="alarms",
        keys=tuple(number for number, _, _ in result.alarms),
    )
    events = Table(
        ("Date", "What", "Note", "Who"),
        tuple((short_date(e.date), e.kind, e.note, e.who) for e in result.events),
        words=(0, 1, 2, 3),
        name="events",
    )
    rows = [asdict(t) | {"at": iso_date(t.at)} for t in result.tests]
    found = {
        "now": iso_date(result.now),
        "instrument": _entry(one),
        "tests": rows,
        "alarms": [{"number": number, "state": state, "at": iso_date(at)} for number, state, at in result.alarms],
        "simulated": result.simulated or None,
        "events": [{"at": iso_date(e.date), "kind": e.kind, "note": e.note, "who": e.who} for e in result.events],
    }
    named = (("Calibrations", calibrations), ("Alarms", alarms), ("Tests", tests), ("Events", events))
    return View(
        kind="Instrument",
        title=one.serial,
        subtitle=one.kind,
        origin=simulated_said(result.simulated),
        head=(
            ("Tests", str(one.tests)),
            ("Last test", date_said(one.last_test)),
            ("Machines", listed(one.machines) if one.machines else ""),
        ),
        sentence=f"{_capital(_standing(one, result.now))}.",
        document=document("elastogeo.instrument/1", found),
        rows=rows,
        tables=tuple(table for _, table in named if table.rows),
        sections=tuple(Section(title, tables=(table,)) for title, table in named if table.rows),
        badge=_badge(result),
    )


def _entry(one: KeptInstrument) -> dict[str, object]:
    last = one.calibrations[0] if one.calibrations else None
    return {
        "number": one.key,
        "serial": one.serial,
        "kind": one.kind or None,
        "calibrated": None if last is None else iso_date(last.at),
        "due": iso_date(one.due.at),
        "overdue_days": one.due.overdue,
        "certificate": None if last is None else last.certificate or None,
        "tests": one.tests,
        "machines": list(one.machines),
        "last_test": iso_date(one.last_test),
        "alarm": one.alarm,
        "calibrations": [
            {"at": iso_date(c.at), "due": iso_date(c.due), "certificate": c.certificate or None, "who": c.who}
            for c in one.calibrations
        ],
    }


def _standing(one: KeptInstrument, now: float | None) -> str:
    """How its calibration stands, in words."""
    if not one.calibrations:
        return "no calibration is known"
    if one.due.state == OVERDUE:
        return f"calibration ran out {days_said(one.due.overdue)} ago"
    if one.due.state == NOT_ASKED or one.due.at is None:
        return f"calibrated {date_said(one.calibrations[0].at)}, without a due date"
    if now is not None and one.due.at - now <= SOON:
        return f"calibration runs out in {days_said(one.due.at - now)}"
    return f"calibrated until {date_said(one.due.at)}"


def _marked(one: KeptInstrument, now: float) -> str:
    mark = {"bad": "■", "care": "▲", "none": "–", "good": "●"}[_tone(one, now)]
    return f"{mark} {_standing(one, now)}"


def _tone(one: KeptInstrument, now: float) -> str:
    if not one.calibrations or one.due.at is None:
        return "none"
    if one.due.state == OVERDUE:
        return "bad"
    return "care" if one.due.at - now <= SOON else "good"


def _badge(result: InstrumentRecord) -> Badge:
    if result.instrument.alarm is not None:
        return Badge("■", f"Alarm {result.instrument.alarm} of this instrument is open", "bad")
    mark, _, text = _marked(result.instrument, result.now).partition(" ")
    return Badge(mark, _capital(text), _tone(result.instrument, result.now))


def _answer(result: KeptInstruments) -> str:
    if not result.instruments:
        return "No instrument is known; enter one, or import a test that says the serial number of its own."
    tones = [_tone(one, result.now) for one in result.instruments]
    parts = [f"{len(tones)} {'instrument' if len(tones) == 1 else 'instruments'}"]
    words = (("bad", "out of calibration"), ("care", "to be calibrated within a month"), ("none", "without a due date"))
    parts += [f"{tones.count(tone)} {said}" for tone, said in words if tone in tones]
    alarms = sum(one.alarm is not None for one in result.instruments)
    if alarms:
        parts.append(f"{alarms} in alarm")
    return f"{', '.join(parts)}."


def _machines(names: tuple[str, ...]) -> str:
    more = len(names) - _MACHINES
    return ", ".join(names[:_MACHINES]) + (f" and {more} more" if more > 0 else "")


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
