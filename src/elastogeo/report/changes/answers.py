"""The answer of a verdict in sentences: whether the machine has changed, since when, what it points to, what to do next."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, isfinite

from elastogeo.changes import (
    ALARM,
    DRIFT,
    DUE,
    NEVER_TESTED,
    NO_BASELINE,
    OVERDUE,
    STEADY,
    SUSPECT,
    WATCH,
    ChangeVerdict,
    Drift,
    IndicatorState,
    Rule,
    as_suspected,
)
from elastogeo.report.changes.words import (
    change_interval_said,
    least_said,
    predicate,
    shown_unit,
    size_said,
    title_of,
    value_said,
)
from elastogeo.report.days import date_said, days_said, month_said
from elastogeo.report.text import listed

_LIKELY = 1 / 3
"""Of the likeliest component's score: below it a component is not named in the answer."""
_MOST_NAMED = 3
_EXPLAINED = 0.5
"""Of the changes, below which a component is not said to be their cause."""


def machine_of(verdict: ChangeVerdict) -> str:
    """What the verdict is about: the machine, or the series where no machine is named."""
    return verdict.series.machine or verdict.series.name


def series_said(verdict: ChangeVerdict) -> str:
    """The series without the name of its machine before it."""
    return verdict.series.name.removeprefix(f"{verdict.series.machine}: ")


def least_baseline() -> int:
    """Tests of a baseline from which on there are alarms."""
    return Rule().least_baseline


def worst_of(verdict: ChangeVerdict) -> IndicatorState | None:
    """The indicator to look at first: the one furthest off, else the first; none where there is none."""
    if verdict.changed:
        return verdict.changed[0]
    seen = as_suspected(verdict)
    if seen is not None:
        return verdict[seen.name]
    named = [step.first for step in verdict.steps if step.first][-1:]
    by_state = [one for state in (SUSPECT, WATCH) for one in verdict.indicators if one.state == state]
    last = [verdict[name] for name in named if name in verdict]
    return next(iter((*by_state, *last, *verdict.indicators)), None)


def sentence_of_change(verdict: ChangeVerdict) -> str:
    """The answer in one sentence."""
    machine = machine_of(verdict)
    if verdict.state == ALARM and verdict.changed:
        return _alarm(verdict, machine)
    if verdict.state == SUSPECT:
        return _suspect(verdict, machine)
    if verdict.state == NO_BASELINE:
        tests = len(verdict.series)
        there = "no test yet" if not tests else f"{tests} test{'' if tests == 1 else 's'} and no baseline to judge by"
        return f"{machine} has {there}: whether it has changed cannot be said."
    if verdict.state == WATCH:
        return _watch(verdict, machine)
    judged = _standing(verdict)
    if not judged:
        return f"{machine} has a baseline of {_of_baseline(verdict)}, and no test since that could show a change."
    show = "the one test since shows" if judged == 1 else f"{judged} tests since show"
    return f"{machine} is as its baseline shows it: {show} no change, {_within(verdict)}."


def _within(verdict: ChangeVerdict) -> str:
    """How many indicators are within their limits, and which have none to be within."""
    number = len(verdict.indicators)
    judged = sum(one.state == STEADY for one in verdict.indicators)
    if judged == number:
        return "its indicator is within its limits" if number == 1 else f"all {number} indicators are within their limits"
    said = [f"{judged} of {number} indicators {'is within its' if judged == 1 else 'are within their'} limits"]
    for one in verdict.indicators:
        tests = _tests_of(verdict, one)
        if one.state == WATCH:
            said.append(f"{one.name} is only watched: its baseline has {tests} test{'' if tests == 1 else 's'}")
        elif one.state != STEADY:
            said.append(f"{one.name} has no baseline")
    return "; ".join(said)


def _standing(verdict: ChangeVerdict) -> int:
    """Judged tests that still say how the machine is: none before a false alarm was closed, none that a repeat replaced."""
    cleared = () if verdict.baseline is None else verdict.baseline.cleared
    last = verdict.steps[-1].date if verdict.steps else verdict.now
    start = max((at for at in cleared if at <= max(verdict.now, last)), default=-inf)
    return sum(step.date >= start and not step.replaced for step in verdict.steps)


def _tests_of(verdict: ChangeVerdict, one: IndicatorState) -> int:
    """Tests of the baseline that determine an indicator, without those set aside."""
    if verdict.baseline is None:
        return 0
    series, own = verdict.series, set(verdict.baseline.tests)
    value = series.value[:, series.indicators.index(one.name)]
    rows = zip(series.tests, series.aside, value, strict=True)
    return sum(test in own and not out and isfinite(shown) for test, out, shown in rows)


def points_to(verdict: ChangeVerdict) -> tuple[str, ...]:
    """The components that the changed set points to, the likeliest first, of those that are alike the first one.

    None where no component explains the changes.
    """
    causes = [cause for cause in verdict.causes if cause.share >= _EXPLAINED]
    if not causes:
        return ()
    likely = [cause for cause in causes if cause.score >= _LIKELY * causes[0].score]
    named: list[str] = []
    for cause in likely:
        if not any(cause.component in other.alike for other in likely if other.component in named):
            named.append(cause.component)
    return tuple(dict.fromkeys(named))[:_MOST_NAMED]


def component_said(component: str) -> str:
    """A component in a sentence: `the X guideway`, `the squareness of X and Y`, `the spindle side`."""
    noun, _, axes = component.rpartition(" ")
    if noun == "rotary axis":
        return f"the {axes} axis"
    if noun and axes.isupper() and len(axes) == 1:
        return f"the {axes} {noun}"
    if noun and axes.isupper() and len(axes) == 2:
        return f"the {noun} of {axes[0]} and {axes[1]}"
    return f"the {component}"


def cannot_tell(verdict: ChangeVerdict) -> tuple[str, ...]:
    """What the series cannot tell, a sentence for each set of components: of what it points to, else of all."""
    pointed = set(points_to(verdict))
    groups = [group for group in verdict.cannot_tell if not pointed or pointed & set(group)]
    return tuple(f"This series cannot tell {_from(group)}." for group in groups if len(group) > 1)


def next_action(verdict: ChangeVerdict) -> str:
    """What to do next, in one sentence."""
    if verdict.state == ALARM:
        return _after_alarm(verdict)
    if verdict.state == SUSPECT:
        by = f" by {date_said(verdict.repeat_by)}" if date_said(verdict.repeat_by) else ""
        return (
            f"Repeat the test{by}, the same day if possible: only a repeat that moves the same way confirms a change. "
            f"Without one it becomes an alarm that nothing confirmed."
        )
    if verdict.state == NO_BASELINE:
        missing = least_baseline() - len(verdict.series)
        more = f"make {missing} more test{'' if missing == 1 else 's'}, then " if missing > 0 else ""
        return f"{_capital(more)}{'set' if more else 'Set'} a baseline of {least_baseline()} tests or more."
    if verdict.state == WATCH and _is_short(verdict):
        return f"Set a baseline of {least_baseline()} tests or more: below that no limit can be kept."
    return due_said(verdict)


def due_said(verdict: ChangeVerdict) -> str:
    """When to test next; empty where no test is asked for."""
    due = verdict.due
    if due is None:
        return ""
    if due.state == NEVER_TESTED:
        return "Make the first test."
    if due.state == OVERDUE:
        return f"Test now: it was due on {date_said(due.at)}, and is overdue by {days_said(due.overdue)}."
    if due.state == DUE:
        return f"Test now: it was due on {date_said(due.at)}."
    return f"Test again on {date_said(due.at)}." if due.at is not None else ""


def advice(verdict: ChangeVerdict) -> tuple[str, ...]:
    """What goes with the answer on the first screen: what else changed, what cannot be told, what to do next."""
    return tuple(filter(None, (*_beside(verdict), *cannot_tell(verdict)[:2], _next(verdict))))


def drift_said(one: IndicatorState, drift: Drift) -> str:
    """How fast, and when a limit is reached if it goes on."""
    shown = shown_unit(one.kind.unit)
    speed = f"{'−' if drift.per_year < 0 else '+'}{size_said(abs(drift.per_year) * shown.factor)} {shown.name} a year"
    if not isfinite(drift.limit):
        return f"It drifts by {speed}."
    limit = f"{'tolerance' if drift.limit_is == 'tolerance' else 'least change that matters'}"
    at = f"{limit}, {value_said(one, drift.limit)} {shown.name}"
    if drift.limit_at is None:
        return f"It drifts by {speed} and has passed its {at}."
    early, late = drift.limit_at_interval
    until = month_said(late) if isfinite(late) else "no end that can be said"
    when = f"{month_said(drift.limit_at)} ({month_said(early)} to {until})"
    return f"It drifts by {speed} and reaches its {at}, in {when} if it goes on."


def _next(verdict: ChangeVerdict) -> str:
    action = next_action(verdict)
    return f"Next: {action[:1].lower()}{action[1:]}" if action else ""


def _alarm(verdict: ChangeVerdict, machine: str) -> str:
    worst = verdict.changed[0]
    point = worst.change_point or verdict.change_point
    since = f" since {date_said(point.date)}" if point is not None else ""
    goes_on = ", and it goes on" if worst.drift is not None and worst.shape == DRIFT else ""
    said = f"{machine} {predicate(worst)} than its baseline" if _compares(worst) else f"{machine} {predicate(worst)}"
    said = f"{said} (95 %: {change_interval_said(worst, signed=False)}){since}{goes_on}"
    named = points_to(verdict)
    if named:
        alike = ", or to what this series cannot tell from it" if _alike(verdict, named) else ""
        return f"{said}; this points to {_either(named)}{alike}."
    return f"{said}." if not verdict.causes else f"{said}; no single component explains it."


def _alike(verdict: ChangeVerdict, named: tuple[str, ...]) -> bool:
    """Whether the one component that is named has others that this series cannot tell from it."""
    return len(named) == 1 and any(named[0] in group and len(group) > 1 for group in verdict.cannot_tell)


def _compares(one: IndicatorState) -> bool:
    """Whether the sentence of its change says softer, stiffer, more or less, and wants a than."""
    return one.kind.name in ("stiffness", "backlash") or one.name == one.kind.name


def _suspect(verdict: ChangeVerdict, machine: str) -> str:
    seen = as_suspected(verdict)
    at = next((step.date for step in verdict.steps if step.test == verdict.waiting), verdict.since)
    test = f"the test of {date_said(at)}" if date_said(at) else "the last test"
    if seen is None or not isfinite(seen.change):
        return f"{machine} may have changed: {test} is suspect."
    return f"{machine} may have changed: by {test} it {predicate(seen)}. One test is no alarm."


def _watch(verdict: ChangeVerdict, machine: str) -> str:
    if _is_short(verdict):
        return (
            f"{machine} is only watched: a baseline of {_of_baseline(verdict)} says too little of how its tests "
            f"scatter for an alarm."
        )
    worst = worst_of(verdict)
    if worst is None or worst.drift is None:
        return f"{machine} is watched: {worst.name if worst else 'an indicator'} moves within its limits."
    return f"{machine} drifts in {worst.name}, within its limits. {drift_said(worst, worst.drift)}"


def _is_short(verdict: ChangeVerdict) -> bool:
    return _baseline_tests(verdict) < least_baseline()


def _baseline_tests(verdict: ChangeVerdict) -> int:
    """Of the indicator that the baseline determines most often."""
    return max((_tests_of(verdict, one) for one in verdict.indicators), default=0)


def _of_baseline(verdict: ChangeVerdict) -> str:
    tests = _baseline_tests(verdict)
    return f"{tests} test{'' if tests == 1 else 's'}"


def _beside(verdict: ChangeVerdict) -> Iterator[str]:
    """What else the alarm says: what changed too, how fast, what does not fit."""
    if verdict.alarm is not None and verdict.alarm.held_by:
        yield (
            f"The alarm is held back: other machines moved alike with instrument {verdict.alarm.held_by}, which may be what "
            f"changed."
        )
    worst = worst_of(verdict)
    if verdict.changed and worst is not None and abs(worst.change) < worst.relevance:
        least = least_said(worst)
        yield f"By now the change is smaller than what matters, {least}; the alarm stays until a person closes it."
    others = [one.name for one in verdict.changed[1:]]
    if others:
        yield f"{title_of(listed(others))} changed too."
    if verdict.changed and verdict.changed[0].drift is not None and verdict.changed[0].shape == DRIFT:
        yield drift_said(verdict.changed[0], verdict.changed[0].drift)
    named = points_to(verdict)
    against = next((cause.against for cause in verdict.causes if named and cause.component == named[0]), ())
    if against:
        yield f"Not as {component_said(named[0])} alone would have it: {listed(against)}."


def _after_alarm(verdict: ChangeVerdict) -> str:
    named = points_to(verdict)
    look = f"look at {_either(named)}" if named else "look at the machine"
    if not verdict.is_confirmed:
        return f"Repeat the test, since nothing has confirmed the change; then {look}, or close the alarm as false."
    known = verdict.alarm
    if known is not None and known.held_by:
        return (
            f"Check instrument {known.held_by} and close its own alarm: as repaired once it is right again, as "
            f"false if it was right. This alarm goes with it."
        )
    if known is not None and known.acknowledged is None:
        which = "the alarm" if known.number is None else f"alarm {known.number}"
        return f"Acknowledge {which} and {look}; after the repair close it with a new baseline, or close it as false."
    by = f" {known.who} acknowledged it on {date_said(known.acknowledged)}." if known is not None and known.who else ""
    return f"{_capital(look)}; after the repair close the alarm with a new baseline, or close it as false.{by}"


def _either(components: tuple[str, ...]) -> str:
    *first, last = map(component_said, components)
    return f"{', '.join(first)} or {last}" if first else last


def _from(group: tuple[str, ...]) -> str:
    first, *others = map(component_said, group)
    return f"{first} from {', '.join(others[:-1])} or {others[-1]}" if len(others) > 1 else f"{first} from {others[0]}"


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
