"""The tables of two tests that are held against each other, each row with its bar."""

from __future__ import annotations

from math import isfinite

from elastogeo.changes import ComparedTests, IndicatorDifference, ParameterDifference
from elastogeo.identification import SIGNIFICANT
from elastogeo.report.changes.compared.bars import indicator_bars, parameter_bars
from elastogeo.report.changes.words import shown_unit, title_of, to_place_of
from elastogeo.report.numbers import (
    DisplayUnit,
    display_unit,
    pretty,
    probability,
    said_estimate,
    significant,
    value_with_uncertainty,
)
from elastogeo.report.text import MOST_TERMS, combination
from elastogeo.report.view import Table


def indicator_table(result: ComparedTests) -> Table | None:
    """The indicators, the surest change first; bold what is beyond the scatter of the machine."""
    if not result.indicators:
        return None
    judged = bool(result.baseline)
    note = (
        f"Unchanged: by how much two tests differ while nothing changes, by the scatter of the {result.baseline} tests of "
        f"the baseline and by their temperatures, with 95 % for all indicators together."
        if judged
        else ""
    )
    return Table(
        ("indicator", "before", "after", "change", *(("unchanged", "scatter") if judged else ())),
        tuple(_indicator_row(one, judged) for one in result.indicators),
        words=(0, 5),
        title="What changed, against the scatter of the machine" if judged else "What changed",
        note=note,
        strong=tuple(k for k, one in enumerate(result.indicators) if one.within is False),
        name="indicators",
        keys=tuple(one.name for one in result.indicators),
        sparks=indicator_bars(result.indicators),
    )


def _indicator_row(one: IndicatorDifference, judged: bool) -> tuple[str, ...]:
    unit = shown_unit(one.kind.unit)
    step = _step(one) * unit.factor
    change = to_place_of(one.change.value * unit.factor, step)
    sign = "+" if one.change.value > 0 and any(digit in change for digit in "123456789") else ""
    share = 100 * one.change.value / abs(one.before) if one.kind.relative and one.before else None
    percent = "" if share is None else f" ({to_place_of(share, 100 * _step(one) / abs(one.before))} %)"
    row = (
        title_of(one.name),
        to_place_of(one.before * unit.factor, step),
        to_place_of(one.after * unit.factor, step),
        f"{sign}{change} {unit.name}{percent}",
    )
    if not judged:
        return row
    if one.expected is None:
        return (*row, "not known", "")
    low, high = (to_place_of(end * unit.factor, step) for end in one.expected)
    return (*row, f"{low} to {high}", "within" if one.within else "beyond")


def _step(one: IndicatorDifference) -> float:
    """To which place a value is worth writing: half of what is expected, or the uncertainty by the two tests."""
    if one.expected is not None:
        return (one.expected[1] - one.expected[0]) / 4
    half = one.change.expanded() if one.change.known else 0.0
    return half if isfinite(half) and half > 0 else abs(one.before) / 100


def parameter_table(result: ComparedTests) -> Table | None:
    """The parameters, the surest change first: the same numbers as `elastogeo compare`."""
    if not result.parameters:
        return None
    largest: dict[str, float] = {}
    for one in result.parameters:
        found = one.difference
        ends = (abs(found.before), abs(found.after), *map(abs, found.change.interval()))
        largest[found.unit] = max(largest.get(found.unit, 0.0), *ends)
    level = SIGNIFICANT / len(result.parameters)
    note = "p: how often such a change, or a greater one, would come about if nothing changed; the number of them counts."
    return Table(
        ("parameter", "before", "after", "change ± U (95 %)", "unit", "p", "changed"),
        tuple(
            _parameter_row(one, display_unit(one.difference.unit, largest[one.difference.unit]), level)
            for one in result.parameters
        ),
        words=(0, 4, 6),
        title="What the two tests say of each parameter",
        note=note,
        strong=tuple(k for k, one in enumerate(result.parameters) if one.difference.p_value < level),
        name="parameters",
        sparks=parameter_bars(result.parameters),
    )


def _parameter_row(one: ParameterDifference, unit: DisplayUnit, level: float) -> tuple[str, ...]:
    found = one.difference
    before, after = (
        pretty(_end(value, interval, unit))
        for value, interval in zip((found.before, found.after), one.intervals, strict=True)
    )
    return (
        found.name if one.separated else combination(one.stands_for, MOST_TERMS),
        before,
        after,
        pretty(said_estimate(found.change.scaled(unit.factor))),
        unit.name,
        pretty(probability(found.p_value)),
        "yes" if found.p_value < level else "no",
    )


def _end(value: float, interval: tuple[float, float] | None, unit: DisplayUnit) -> str:
    if interval is None:
        return significant(value * unit.factor)
    return value_with_uncertainty(value * unit.factor, (interval[1] - interval[0]) / 2 * unit.factor)
