"""Machines of a fleet in one line each, and instruments with which several moved."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from math import isfinite

from elastogeo.changes import (
    ALARM,
    KINDS,
    NO_BASELINE,
    OVERDUE,
    STEADY,
    SUSPECT,
    WATCH,
    FleetState,
    InstrumentMove,
    MachineRow,
)
from elastogeo.report.changes.answers import component_said
from elastogeo.report.changes.words import MARKS, TONES, changed, marked, shown_unit, size_said
from elastogeo.report.days import date_said, days_said, short_date
from elastogeo.report.drawing.plots import Line, Mark, Plot, Shape
from elastogeo.report.numbers import significant
from elastogeo.report.text import listed
from elastogeo.report.view import Table

MOST_ROWS = 100
"""Machines in the table; the JSON holds all."""
_VERBS = ("is ", "has ")


def row_said(row: MachineRow) -> str:
    """What there is to say of a machine, short: `11 % softer in X; points to the X guideway`."""
    parts = [_state_said(row)]
    if row.points_to and row.state == ALARM:
        more = len(row.points_to) - 1
        others = f" or {more} {'other' if more == 1 else 'others'}" if more else ""
        parts.append(f"points to {component_said(row.points_to[0])}{others}")
    if row.overdue > 0:
        parts.append(f"test overdue by {days_said(row.overdue)}")
    if row.held_by:
        parts.append(f"held back under instrument {row.held_by}")
    return "; ".join(part for part in parts if part)


def _state_said(row: MachineRow) -> str:
    moved = change_of(row)
    if row.state == ALARM:
        return moved or "changed"
    if row.state == SUSPECT:
        return f"suspect: {moved}; repeat the test" if moved else "one test is suspect; repeat it"
    words = {NO_BASELINE: "set a baseline", WATCH: f"watched: {moved}" if moved else "watched only", STEADY: "", OVERDUE: ""}
    return words[row.state]


def change_of(row: MachineRow) -> str:
    """Its change without a verb: `11 % softer in X`; empty where none is known."""
    said = predicate_of(row)
    return next((said.removeprefix(verb) for verb in _VERBS if said.startswith(verb)), said)


def predicate_of(row: MachineRow) -> str:
    """What its change makes of the machine: `is 11 % softer in X`; empty where none is known."""
    if not row.indicator or not isfinite(row.change):
        return ""
    kind = KINDS.get(row.kind)
    if kind is not None and kind.relative and row.mean:
        return changed(row.indicator, row.kind, row.change, f"{size_said(100 * abs(row.change / row.mean))} %")
    shown = shown_unit(row.unit)
    return changed(row.indicator, row.kind, row.change, f"{size_said(abs(row.change) * shown.factor)} {shown.name}")


def strip_said(row: MachineRow) -> str:
    """A mark for each indicator, in their order."""
    return "".join(MARKS.get(state, MARKS[NO_BASELINE]) for _, state, _ in row.strip)


def fleet_table(fleet: FleetState, machines: Sequence[MachineRow], first: int = 0) -> Table:
    """Some machines of a fleet, the worst first, from the one at `first` on."""
    shown = machines[first : first + MOST_ROWS]
    rows = tuple(
        (
            row.machine,
            marked(row.state),
            row_said(row),
            short_date(row.since),
            strip_said(row),
            short_date(row.last_test),
            short_date(row.due),
            row.place,
        )
        for row in shown
    )
    return Table(
        ("machine", "state", "", "since", "indicators", "last test", "next due", "place"),
        rows,
        words=(0, 1, 2, 3, 4, 5, 6, 7),
        title="The worst first",
        note=" ".join(_notes(len(fleet.machines), len(machines), first, len(rows))),
        name="machines",
        keys=tuple(row.key if row.key is not None else row.machine for row in shown),
        tones=tuple(TONES[row.state] for row in shown),
        sparks=tuple(strip_plot(row) for row in shown),
    )


def _notes(every: int, fit: int, first: int, shown: int) -> Iterator[str]:
    marks = ", ".join(f"{MARKS[state]} {state}" for state in (ALARM, SUSPECT, WATCH, STEADY, NO_BASELINE))
    yield f"Indicators: {marks}."
    if not fit and every:
        yield "No machine fits what is asked for."
    elif first or shown < fit:
        yield f"Machines {first + 1} to {first + shown} of {fit}; the JSON holds all."


_SHAPES = {ALARM: "square", SUSPECT: "diamond", WATCH: "up", STEADY: "circle"}
_STEP = 13.0
"""From one mark of a strip to the next [px]."""


def strip_plot(row: MachineRow) -> Plot:
    """A mark for each indicator, in their order, each with what it is."""
    marks: list[Shape] = []
    for k, (name, state, ratio) in enumerate(row.strip):
        said = f"{name}: {state}{f', at {significant(ratio, 2)} of its limit' if isfinite(ratio) else ''}"
        x, shape, kind = _STEP * (k + 0.5), _SHAPES.get(state, ""), TONES.get(state, "none")
        if shape:
            marks.append(Mark(x, 8, kind, shape, 4.0, said))
        else:
            marks.append(Line(((x - 4, 8), (x + 4, 8)), "soft", 1.6))
    alike = Counter(state for _, state, _ in row.strip)
    said = ", ".join(f"{count} {state}" for state, count in alike.items())
    return Plot(_STEP * max(len(row.strip), 1), 16, tuple(marks), f"Indicators: {said}" if said else "")


def move_said(move: InstrumentMove) -> str:
    """`3 machines moved alike with instrument 0042 since 3 May 2026 (A, B and C): check the instrument before them.`"""
    since = f" since {date_said(move.since)}" if date_said(move.since) else ""
    what = f" in {listed(move.indicators)}" if move.indicators else ""
    others = f"; {listed(move.others)} did not" if move.others else ""
    return (
        f"{len(move.machines)} machines moved alike{what} with instrument {move.instrument}{since} ({listed(move.machines)})"
        f"{others}: check the instrument before the machines."
    )


def move_table(fleet: FleetState) -> Table | None:
    """The instruments with which several machines moved alike; none where there is none."""
    rows = tuple(
        (move.instrument, short_date(move.since), *map(", ".join, (move.indicators, move.machines, move.others)))
        for move in fleet.instruments
    )
    headings = ("instrument", "since", "indicators", "machines that moved alike", "that did not")
    return Table(headings, rows, words=(0, 1, 2, 3, 4), title="Instruments", name="instruments") if rows else None
