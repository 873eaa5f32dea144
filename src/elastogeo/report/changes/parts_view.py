"""The parts of change detection in one line each."""

from __future__ import annotations

from math import isfinite

from elastogeo.changes import (
    Cause,
    ChangePoint,
    Drift,
    DueDate,
    Event,
    Indicator,
    IndicatorState,
    InstrumentMove,
    MachineRow,
    OpenAlarm,
    Step,
)
from elastogeo.report.changes.answers import component_said
from elastogeo.report.changes.events import event_said
from elastogeo.report.changes.words import change_interval_said, change_said, marked, shown_unit, to_place_of, value_said
from elastogeo.report.days import date_said, days_said
from elastogeo.report.numbers import significant, whole_percent
from elastogeo.report.text import listed
from elastogeo.report.view import lines


@lines(Indicator)
def indicator_line(one: Indicator) -> str:
    """`stiffness X = 16.10 N/µm, u = 0.03`."""
    shown = shown_unit(one.kind.unit)
    u = one.standard_uncertainty * shown.factor
    said = f"{one.name} = {to_place_of(one.value * shown.factor, u)} {shown.name}"
    return f"{said}, u = {significant(u, 2)}" if isfinite(u) else f"{said}, no uncertainty"


@lines(IndicatorState)
def state_line(one: IndicatorState) -> str:
    """`stiffness X: ■ alarm, 14.31 N/µm, −11 % (95 %: −13 to −10 %)`."""
    now = f", {value_said(one, one.now)} {shown_unit(one.kind.unit).name}" if isfinite(one.now) else ""
    change = f", {change_said(one)} (95 %: {change_interval_said(one)})" if isfinite(one.change) else ""
    return f"{one.name}: {marked(one.state)}{now}{change}"


@lines(Step)
def step_line(step: Step) -> str:
    """`test 12, 11 June 2026: ◆ suspect, backlash Y at 1.3 of its limit`."""
    at = f", {step.first} at {significant(step.ratio, 2)} of its limit" if step.first else ", nothing determined"
    return f"{step.test}, {date_said(step.date)}: {marked(step.state)}{at}"


@lines(ChangePoint)
def change_point_line(point: ChangePoint) -> str:
    """`changed between 12 May 2026 and 11 June 2026`."""
    low, high = point.interval
    return f"changed by {date_said(point.date)} (95 %: {date_said(low)} to {date_said(high)})"


@lines(Drift)
def drift_line(drift: Drift) -> str:
    """A slope in the unit of its indicator, which it does not know."""
    low, high = drift.interval
    return f"{significant(drift.per_year)} a year (95 %: {significant(low)} to {significant(high)}), {drift.tests} tests"


@lines(Cause)
def cause_line(cause: Cause) -> str:
    """`the X guideway: 91 % likely, explains 97 % of the changes`."""
    likely, explained = whole_percent(cause.score), whole_percent(cause.share)
    return f"{component_said(cause.component)}: {likely} % likely, explains {explained} % of the changes"


@lines(InstrumentMove)
def move_line(move: InstrumentMove) -> str:
    """`instrument 0042: 3 machines moved alike`."""
    return f"instrument {move.instrument}: {len(move.machines)} machines moved alike ({listed(move.machines)})"


@lines(MachineRow)
def machine_line(row: MachineRow) -> str:
    """`Hermle C50 no. 3: ■ alarm since 11 June 2026`."""
    return f"{row.machine}: {marked(row.state)}{f' since {date_said(row.since)}' if row.since is not None else ''}"


@lines(Event)
def event_line(event: Event) -> str:
    """`14 April 2025: Repair: spindle serviced`."""
    return f"{date_said(event.date)}: {event_said(event)}"


@lines(OpenAlarm)
def alarm_line(alarm: OpenAlarm) -> str:
    """`open since 11 June 2026, not acknowledged`."""
    known = "not acknowledged" if alarm.acknowledged is None else f"acknowledged by {alarm.who}"
    return f"open since {date_said(alarm.opened)}, {known}"


@lines(DueDate)
def due_line(due: DueDate) -> str:
    """`overdue by 12 days, due 24 September 2026`."""
    late = f" by {days_said(due.overdue)}" if due.is_late else ""
    return f"{due.state}{late}{f', {date_said(due.at)}' if due.at is not None else ''}"
