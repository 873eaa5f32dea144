"""The view of the rule tried out: false alarms first, then how soon each change is found, in tests and in days."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from math import isfinite
from typing import Any

from elastogeo.changes import DRIFT, FaultFound, Kind, RuleTest
from elastogeo.report.changes.words import shown_unit, size_said, title_of
from elastogeo.report.days import days_said
from elastogeo.report.document import document
from elastogeo.report.numbers import significant, whole_percent
from elastogeo.report.view import KeyValue, Section, Table, View, lines, views

_NAMED = 5


@lines(FaultFound)
def fault_line(one: FaultFound) -> str:
    """`stiffness X, step of 2 standard deviations: within 5 tests on 87 %`."""
    return (
        f"{one.indicator}, {one.shape} of {significant(one.deviations, 2)} standard deviations: within 5 tests on "
        f"{whole_percent(one.soon)} %"
    )


@views(RuleTest)
def rules_view(result: RuleTest) -> View:
    """False alarms of machines that do not change, and delays of those that do."""
    low, high = (100 * end for end in result.interval95)
    rate = significant(100 * result.false_alarms, 2)
    span = days_said(result.tests * result.interval)
    return View(
        kind="Rule tried out",
        title=result.name or "Any machine",
        subtitle=f"{len(result.indicators)} indicators, a baseline of {result.baseline} tests, alpha {result.rule.alpha:g}",
        origin=f"Simulated: machines that scatter by {result.simulated}.",
        sentence=(
            f"Of {result.machines} simulated machines that do not change, {rate} % alarm at least once in {result.tests} "
            f"tests ({span}). {_slowest(result)}"
        ),
        values=(
            KeyValue(
                f"False alarms in {result.tests} tests", rate, "%", f"of the machines, 95 %: {low:.1f} to {high:.1f} %"
            ),
            KeyValue("Repeats asked for", significant(result.repeats, 2), "", "of each such machine, in as many tests"),
            KeyValue("Interval", significant(result.interval, 3), "days", "between tests"),
        ),
        document=_document(result),
        rows=_faults(result),
        tables=(_table(result),),
        notes=tuple(_notes(result)),
        sections=(Section("What was simulated", tuple(_simulated(result))),),
    )


def _slowest(result: RuleTest) -> str:
    """How soon the least certain indicator shows a step of twice what matters."""
    steps = [one for one in result.faults if one.shape != DRIFT]
    if not steps:
        return ""
    sizes = {name: sorted(one.size for one in steps if one.indicator == name) for name in result.indicators}
    middle = [one for one in steps if one.size == sizes[one.indicator][len(sizes[one.indicator]) // 2]]
    slowest = min(middle, key=lambda one: one.soon)
    return (
        f"A step of {_size(result, slowest)} of {slowest.indicator}, the one that is found latest, is an alarm within 5 "
        f"tests on {whole_percent(slowest.soon)} % of the machines."
    )


def _table(result: RuleTest) -> Table:
    rows = tuple(
        (
            title_of(one.indicator),
            one.shape,
            _size(result, one),
            significant(one.deviations, 2),
            whole_percent(one.soon),
            *(_delay(result, tests) for tests in (one.median, one.most)),
        )
        for one in result.faults
    )
    return Table(
        ("indicator", "change", "size", "deviations", "in 5 tests [%]", "half found after", "90 % found after"),
        rows,
        words=(0, 1, 2),
        title="How soon a change is found",
        note="Deviations: the size in standard deviations between tests. Counted from the first test after the change on.",
    )


def _kind(result: RuleTest, name: str) -> Kind:
    return result.kinds[result.indicators.index(name)]


def _size(result: RuleTest, one: FaultFound) -> str:
    kind = _kind(result, one.indicator)
    unit = shown_unit(kind.unit)
    size = f"{size_said(100 * one.size)} %" if kind.relative else f"{size_said(one.size * unit.factor)} {unit.name}"
    return f"{size} a year" if one.shape == DRIFT else size


def _delay(result: RuleTest, tests: float) -> str:
    """`2 tests, 60 days`."""
    if not isfinite(tests):
        return f"not in {result.tests} tests"
    return f"{tests:.0f} test{'' if tests == 1 else 's'}, {days_said(tests * result.interval)}"


def _notes(result: RuleTest) -> Iterator[str]:
    if result.name:
        beyond = f"{len(result.over)} beyond a limit" if result.over else "none beyond a limit"
        last = ", ".join(result.over[-_NAMED:])
        yield f"Recorded after the baseline: {result.judged} tests, {beyond}{f' (the last: {last})' if last else ''}."
    yield (
        "Seasons that no thermometer saw, tests that resemble the one before, and scatter with heavy tails make more false "
        "alarms than this; `--correlation` and `--blunders` try two of them."
    )


def _simulated(result: RuleTest) -> Iterator[str]:
    yield f"{result.machines} machines; their standard deviation and mean are drawn, as uncertain as they are."
    yield (
        f"{significant(100 * result.blunders, 2)} % of the tests have a blunder of six standard deviations in one "
        "indicator; a repeat draws it anew."
        if result.blunders
        else "No test has a blunder."
    )
    yield f"Correlation of one test with the next: {result.correlation:g}."


def _document(result: RuleTest) -> dict[str, Any]:
    """Values in `unit`, or as a share where `relative`; tests are null where too few machines find it."""
    low, high = result.interval95
    return document(
        "elastogeo.rules/1",
        {
            "series": result.name,
            "simulated": result.simulated,
            "rule": asdict(result.rule),
            "baseline_tests": result.baseline,
            "interval_days": result.interval,
            "tests": result.tests,
            "machines": result.machines,
            "blunders": result.blunders,
            "correlation": result.correlation,
            "false_alarms": result.false_alarms,
            "false_alarms95": [low, high],
            "repeats": result.repeats,
            "indicators": [
                {"name": name, "kind": kind.name, "unit": kind.unit, "relative": kind.relative, "relevance": float(least)}
                for name, kind, least in zip(result.indicators, result.kinds, result.relevance, strict=True)
            ],
            "faults": _faults(result),
            "recorded": {"tests": result.judged, "over": list(result.over)} if result.name else None,
        },
    )


def _faults(result: RuleTest) -> list[dict[str, Any]]:
    return [
        asdict(one) | {end: value if isfinite(value := getattr(one, end)) else None for end in ("median", "most")}
        for one in result.faults
    ]
