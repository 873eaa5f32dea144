"""The view of two tests of a history that are held against each other."""

from __future__ import annotations

from elastogeo.changes import (
    Comparable,
    ComparedTest,
    ComparedTests,
    IndicatorDifference,
    ParameterDifference,
    SettingDifference,
)
from elastogeo.report.changes.compared.answers import advice_of, answer_of, badge_of
from elastogeo.report.changes.compared.circles import circle_pictures, levels_of
from elastogeo.report.changes.compared.document import compare_json
from elastogeo.report.changes.compared.rows import indicator_table, parameter_table
from elastogeo.report.changes.compared.settings import setting_name, settings_table
from elastogeo.report.changes.words import shown_unit, title_of
from elastogeo.report.days import iso_date, origin_said, short_date
from elastogeo.report.document import document
from elastogeo.report.numbers import pretty, said_estimate
from elastogeo.report.view import KeyValue, Section, Table, View, lines, said, views

_KEY_VALUES = 5


@lines(ComparedTest)
def compared_test_line(one: ComparedTest) -> str:
    """`test 12, 4 May 2026: circle in May`."""
    return f"test {one.key}, {short_date(one.date)}: {one.name}"


@lines(IndicatorDifference)
def indicator_difference_line(one: IndicatorDifference) -> str:
    """`Stiffness X: −5.61 N/µm, beyond the scatter`."""
    beside = {True: ", within the scatter", False: ", beyond the scatter", None: ""}[one.within]
    value = _key_value(one)
    return f"{value.name}: {value.value} {value.unit}{beside}"


@lines(ParameterDifference)
def parameter_difference_line(one: ParameterDifference) -> str:
    """`C_XXX: 1.26e-05 ± 0.03e-05 mm/N`."""
    return f"{one.difference.name}: {said_estimate(one.difference.change)} {one.difference.unit}"


@lines(SettingDifference)
def setting_difference_line(one: SettingDifference) -> str:
    """`radius [mm]: 150 before, 100 after`."""
    return f"{setting_name(one.name)}: {one.before} before, {one.after} after"


@views(ComparedTests)
def compared_view(result: ComparedTests) -> View:
    """What changed between two tests, and whether it is more than tests of this machine scatter."""
    whole = compare_json(result)
    pictures = circle_pictures(result)
    others = list(zip(levels_of(result), pictures, strict=True))[1:] if pictures else []
    tables = tuple(one for one in (indicator_table(result), parameter_table(result), settings_table(result)) if one)
    beyond = [one for one in result.indicators if one.within is not True]
    return View(
        kind="Comparison",
        title=result.after.machine if not result.refusal else "Two tests",
        subtitle=f"{short_date(result.before.date)} → {short_date(result.after.date)}",
        origin=_origin(result),
        head=(("Before", _head(result.before)), ("After", _head(result.after))),
        sentence=answer_of(result),
        values=tuple(_key_value(one) for one in beyond[:_KEY_VALUES]),
        picture=pictures[0] if pictures else None,
        checks=said(result.verdict),
        document=whole,
        rows=whole["parameters"] or whole["indicators"],
        tables=tables,
        sections=tuple(Section(f"Circles at {force:g} N", pictures=(one,)) for force, one in others),
        badge=badge_of(result),
        advice=advice_of(result),
    )


@views(Comparable)
def comparable_view(found: Comparable) -> View:
    """The tests of a machine, of which two may be compared."""
    entries = [{"test": one.key, "date": iso_date(one.date), "name": one.name, "series": one.recipe} for one in found.tests]
    rows = tuple((short_date(one.date), one.name, one.recipe) for one in found.tests)
    keys = tuple(one.key for one in found.tests)
    return View(
        kind="Tests",
        title=found.machine,
        subtitle=f"{len(rows)} {'test' if len(rows) == 1 else 'tests'}",
        origin="",
        sentence="Choose two tests to compare."
        if len(rows) > 1
        else "This machine has one test; a second one is needed to compare.",
        document=document("elastogeo.comparable/1", {"machine": found.machine, "tests": entries}),
        rows=entries,
        tables=(Table(("date", "test", "series"), rows, words=(0, 1, 2), name="tests", keys=keys),),
    )


def _key_value(one: IndicatorDifference) -> KeyValue:
    unit = shown_unit(one.kind.unit)
    return KeyValue(title_of(one.name), pretty(said_estimate(one.change.scaled(unit.factor))), unit.name, "change")


def _head(one: ComparedTest) -> str:
    return f"{one.machine}, test {one.key} of {short_date(one.date)}: {one.name}; {one.recipe}"


def _origin(result: ComparedTests) -> str:
    """What is not measured, said once."""
    kinds = {one.origin: one.from_what for one in (result.before, result.after) if one.origin != "measured"}
    return "; ".join(origin_said(kind, what or kind) for kind, what in kinds.items())
