"""What is said of two tests that are held against each other."""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.changes import (
    FEW_RUNS,
    NOT_ANALYSED,
    NOTHING_IN_COMMON,
    OTHER_MACHINE,
    ComparedTest,
    ComparedTests,
    IndicatorDifference,
)
from elastogeo.identification import SIGNIFICANT
from elastogeo.report.changes.compared.settings import setting_name
from elastogeo.report.changes.words import changed, shown_unit, size_said
from elastogeo.report.days import date_said, short_date
from elastogeo.report.numbers import p_said
from elastogeo.report.text import listed
from elastogeo.report.view import Badge

MOST_NAMED = 4


def badge_of(result: ComparedTests) -> Badge:
    """Whether something changed, in shape and words."""
    if result.refusal:
        return Badge("–", "Not comparable", "none")
    judged = [one for one in result.indicators if one.within is not None]
    if not judged:
        return Badge("–", "No baseline to judge by", "none")
    beyond = sum(not one.within for one in judged)
    return Badge("▲", f"Changed: {beyond} of {len(judged)}", "care") if beyond else Badge("●", "Within the scatter", "good")


def answer_of(result: ComparedTests) -> str:
    """What changed, in a sentence or two."""
    if result.refusal:
        return _refused(result)
    judged = [one for one in result.indicators if one.within is not None]
    first = _by_scatter(result, judged) if judged else _by_parameters(result)
    return " ".join(part for part in (first, _together(result)) if part)


def advice_of(result: ComparedTests) -> tuple[str, ...]:
    """What must be known beside the answer."""
    return tuple(_advice(result))


def _advice(result: ComparedTests) -> Iterator[str]:
    if result.refusal:
        return
    inside = [setting_name(one.name) for one in result.settings if one.in_recipe]
    if not result.one_recipe:
        by = f", which differ by {listed(inside)}" if inside else ""
        yield (f"The tests are of two recipes{by}: what differs may come from that, and no chart holds them together.")
    elif not result.baseline:
        yield "The series has no baseline: how far tests of this machine scatter while nothing changes is not known."
    if result.unjudged == FEW_RUNS:
        yield (
            "The parameters have no uncertainty by which a change could be judged: repeat the runs, and ask without a "
            "reference level."
        )
    if result.baseline and result.joint is not None and result.joint.significant:
        yield (
            "The uncertainty of two tests holds what scatters within them, not what a new set-up changes: only the scatter "
            "between tests of the baseline tells a change of the machine."
        )


def _refused(result: ComparedTests) -> str:
    before, after = result.before, result.after
    if result.refusal == OTHER_MACHINE:
        return (
            f"These tests are of two machines, {before.machine} and {after.machine}: what differs is no change of one; "
            f"choose two tests of one machine."
        )
    if result.refusal == NOT_ANALYSED:
        return " ".join(_unsaid(one) for one in (before, after) if one.error or not one.software)
    assert result.refusal == NOTHING_IN_COMMON
    return (
        f"These tests determine nothing in common ({before.recipe}; {after.recipe}): choose two tests of one recipe, or "
        f"ask both for the same parameters."
    )


def _unsaid(test: ComparedTest) -> str:
    day = short_date(test.date)
    if test.error:
        return f"The test of {day} says nothing: {test.error.rstrip('.')}."
    return f"The test of {day} was not analysed by the version its chart counts with: run elastogeo history recompute."


def _by_scatter(result: ComparedTests, judged: list[IndicatorDifference]) -> str:
    beyond = [one for one in judged if not one.within]
    rest = len(judged) - len(beyond)
    if not beyond:
        return (
            f"Nothing stands out: all {len(judged)} indicators differ by no more than two tests of "
            f"{result.after.machine} do while nothing changes."
        )
    named = [_predicate(one) for one in beyond[:MOST_NAMED]]
    more = f" and {len(beyond) - MOST_NAMED} more" if len(beyond) > MOST_NAMED else ""
    others = f" The other {rest} differ by no more than tests do while nothing changes." if rest else ""
    return f"Since {date_said(result.before.date)} {result.after.machine} {listed(tuple(named))}{more}.{others}"


def _predicate(one: IndicatorDifference) -> str:
    """`is 25 % softer in X`."""
    if one.kind.relative and one.before:
        size = f"{size_said(100 * abs(one.change.value / one.before))} %"
    else:
        unit = shown_unit(one.kind.unit)
        size = f"{size_said(abs(one.change.value) * unit.factor)} {unit.name}"
    return changed(one.name, one.kind.name, one.change.value, size)


def _by_parameters(result: ComparedTests) -> str:
    if not result.parameters:
        beyond = [one for one in result.indicators if one.surety > 1]
        if not beyond:
            return "No indicator differs by more than the scatter within the two tests."
        named = listed(tuple(_predicate(one) for one in beyond[:MOST_NAMED]))
        return f"By more than the scatter within the two tests, {result.after.machine} {named}."
    names = [one.difference.name for one in result.parameters]
    level = SIGNIFICANT / len(names)
    sure = tuple(one.difference.name for one in result.parameters if one.difference.p_value < level)
    if not sure:
        return "No parameter changed by more than the uncertainty of the two tests."
    more = f" and {len(sure) - MOST_NAMED} more" if len(sure) > MOST_NAMED else ""
    return f"{listed(sure[:MOST_NAMED])}{more} changed by more than the uncertainty of the two tests."


def _together(result: ComparedTests) -> str:
    """The joint probability of all parameters."""
    if result.joint is None:
        return ""
    count, said = len(result.parameters), p_said(result.joint.p_value)
    what = f"The {count} parameters together" if count > 1 else "The parameter"
    if result.joint.significant:
        return f"{what} differ{'' if count > 1 else 's'} by more than the uncertainty of the two tests ({said})."
    return f"{what} differ{'' if count > 1 else 's'} by no more than the uncertainty of the two tests ({said})."
