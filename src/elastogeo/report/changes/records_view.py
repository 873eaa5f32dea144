"""The views of what a history keeps and computes again: recomputed series, plans with their dates, campaigns."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from math import isfinite

from elastogeo.changes import (
    DUE,
    NOT_ASKED,
    OVERDUE,
    Differing,
    DueDate,
    KeptPlan,
    KeptPlans,
    Recomputed,
    RecomputedTest,
)
from elastogeo.report.days import days_said, iso_date, short_date
from elastogeo.report.document import document, verdict_entries
from elastogeo.report.numbers import significant
from elastogeo.report.text import listed
from elastogeo.report.view import Table, View, lines, said, views

_PLAN_HEADS = ("number", "machine", "plan", "tests", "minutes", "state")
_DIGITS = 4
_SHOWN = 20
"""Entries that differ, and tests, that a table shows before it counts the rest."""


@lines(Differing)
def differing_line(one: Differing) -> str:
    """`parameters[3].value: 61.92 is now 61.93`."""
    return f"{one.path}: {one.old} is now {one.new}"


@lines(RecomputedTest)
def recomputed_line(one: RecomputedTest) -> str:
    """`test 12, circle in May: the same bits`."""
    return f"test {one.test}, {one.name}: {_outcome(one)}"


@lines(KeptPlan)
def plan_line(plan: KeptPlan) -> str:
    """`spring, Mill 3: due 12 May 2026`."""
    return f"{plan.name}, {plan.machine}: {plan_standing(plan)}"


@views(Recomputed)
def recomputed_view(result: Recomputed) -> View:
    """Whether the raw records say again what is kept, and which charts count with a new version now."""
    rows = tuple(
        (one.series, str(one.test), one.name, one.before or "none", _outcome(one)) for one in _worst_first(result.tests)
    )
    more = len(rows) - _SHOWN
    tables = [
        Table(
            ("series", "test", "name", "computed before by", "now"),
            rows[:_SHOWN],
            words=(0, 2, 3, 4),
            note=f"{more} more tests, no worse than these." if more > 0 else "",
        )
    ]
    apart = [(one, entry) for one in result.tests for entry in one.differing if one.is_compared]
    if apart:
        tables.append(
            Table(
                ("test", "entry", "kept", "now"),
                tuple((str(one.test), entry.path, entry.old, entry.new) for one, entry in apart[:_SHOWN]),
                words=(1, 2, 3),
                title="What differs",
                note=f"{len(apart) - _SHOWN} more entries differ." if len(apart) > _SHOWN else "",
            )
        )
    return View(
        kind="Recomputation",
        title=result.store,
        subtitle=f"{len(result.tests)} tests",
        origin="",
        sentence=_answer(result),
        checks=said(result.verdict),
        document=document(
            "elastogeo.recomputation/1",
            {
                "store": result.store,
                "tests": [asdict(one) for one in result.tests],
                "switched": {name: list(versions) for name, versions in result.switched.items()},
                "verdict": verdict_entries(result.verdict),
            },
        ),
        rows=[asdict(one) for one in result.tests],
        tables=tuple(tables) if rows else (),
        notes=tuple(
            f"{name} was computed by elastogeo {old}, and counts with {new} now."
            for name, (old, new) in result.switched.items()
        ),
    )


@views(KeptPlans)
def plans_view(result: KeptPlans) -> View:
    """Which plans are to be done, the most urgent first."""
    entries = [
        {
            "number": plan.key,
            "machine": plan.machine,
            "name": plan.name,
            "tests": plan.tests,
            "minutes": plan.minutes,
            "due": iso_date(plan.due.at),
            "state": "done" if plan.done_at is not None else plan.due.state,
            "overdue_days": plan.due.overdue,
            "done": iso_date(plan.done_at),
        }
        for plan in result.plans
    ]
    rows = tuple(
        (str(plan.key), plan.machine, plan.name, listed(plan.tests), _minutes(plan), plan_standing(plan))
        for plan in result.plans
    )
    keys = tuple(plan.key for plan in result.plans)
    return View(
        kind="Plans",
        title=result.store,
        subtitle=f"{len(result.plans)} plans",
        origin="",
        sentence=_plans_answer(result),
        document=document("elastogeo.plans/1", {"now": iso_date(result.now), "plans": entries}),
        rows=entries,
        tables=(Table(_PLAN_HEADS, rows, words=(1, 2, 3, 5), name="plans", keys=keys),) if rows else (),
    )


def _answer(result: Recomputed) -> str:
    if not result.tests and not result.switched:
        return "There is nothing to compute again: the history holds no test."
    parts = list(_parts(result))
    return f"{'; '.join(parts)[:1].upper()}{'; '.join(parts)[1:]}."


def _parts(result: Recomputed) -> Iterator[str]:
    compared = [one for one in result.tests if one.is_compared]
    if compared:
        same, close = (
            sum(one.same_bits for one in compared),
            sum(not one.same_bits and not one.differing for one in compared),
        )
        yield f"{same} of {len(compared)} tests came out the same to the last bit"
        if close:
            yield f"{close} in all but last digits, as another platform may"
        if len(compared) - same - close:
            yield f"{len(compared) - same - close} differ"
    mended = sum(one.mended for one in result.tests)
    if mended:
        yield f"{mended} that could not be analysed before can be now"
    if result.switched:
        yield f"{len(result.switched)} series {'counts' if len(result.switched) == 1 else 'count'} with a new version"


def _outcome(one: RecomputedTest) -> str:
    if one.mended:
        return "can be analysed now"
    if not one.before:
        return one.error or "analysed for the first time"
    if one.same_bits:
        return f"the same error: {one.error}" if one.error else "the same bits"
    if not one.differing:
        return "the same but for last digits"
    largest = max((entry.relative for entry in one.differing if isfinite(entry.relative)), default=0.0)
    by = f", by up to {significant(100 * largest, 2)} %" if largest else ""
    count = len(one.differing)
    return f"{count} {'entry differs' if count == 1 else 'entries differ'}{by}"


def _worst_first(tests: tuple[RecomputedTest, ...]) -> list[RecomputedTest]:
    return sorted(tests, key=lambda one: (not (one.is_compared and one.differing), not one.error, one.same_bits))


def plan_standing(plan: KeptPlan) -> str:
    """Until when it is to be done, or when it was: `due 12 May 2026, the grace runs`."""
    if plan.done_at is not None:
        return f"done {short_date(plan.done_at)}"
    return _due_said(plan.due)


def _due_said(due: DueDate) -> str:
    if due.state == NOT_ASKED:
        return "no date"
    if due.state == OVERDUE:
        return f"overdue by {days_said(due.overdue)} (was due {short_date(due.at)})"
    return f"due {short_date(due.at)}" + (", the grace runs" if due.state == DUE else "")


def _minutes(plan: KeptPlan) -> str:
    return "" if plan.minutes is None else f"{plan.minutes:.0f}"


def _plans_answer(result: KeptPlans) -> str:
    open_ = [plan for plan in result.plans if plan.done_at is None]
    late = [plan for plan in open_ if plan.due.is_late]
    if not open_:
        return "No plan is open."
    if late:
        named = listed(tuple(f"{plan.name} ({plan.machine})" for plan in late[:3]))
        return f"{len(late)} of {len(open_)} open plans {'is' if len(late) == 1 else 'are'} overdue: {named}."
    return f"{len(open_)} {'plan is' if len(open_) == 1 else 'plans are'} open, none overdue."
