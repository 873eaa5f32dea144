"""The words of change detection: states with their marks, units of indicators, what a change means."""

from __future__ import annotations

from math import floor, isfinite, log10

from elastogeo.changes import ALARM, NO_BASELINE, OVERDUE, STEADY, SUSPECT, WATCH, IndicatorState, Kind
from elastogeo.errors import InputError
from elastogeo.report.numbers import UNKNOWN, DisplayUnit, display_unit, pretty, significant

MARKS = {ALARM: "■", SUSPECT: "◆", WATCH: "▲", OVERDUE: "◷", STEADY: "●", NO_BASELINE: "–"}
"""A shape for each state, so that none is told by its colour alone."""
TONES = {ALARM: "bad", SUSPECT: "care", WATCH: "care", OVERDUE: "care", STEADY: "good", NO_BASELINE: "none"}

_UNITS = {
    "N/mm": DisplayUnit("N/µm", 1e-3),
    "mm": DisplayUnit("µm", 1e3),
    "mm/mm": DisplayUnit("µm/m", 1e6),
    "rad": DisplayUnit("µrad", 1e6),
}
_MORE = {True: "more", False: "less"}


def marked(state: str) -> str:
    """A state in words and shape: `■ alarm`."""
    return f"{MARKS[state]} {state}"


def shown_unit(unit: str) -> DisplayUnit:
    """The unit in which an indicator is shown, always the same: charts of one kind can be compared."""
    return _UNITS.get(unit) or display_unit(unit, 0.0)


def taken(
    kind: Kind, lower: float | None = None, upper: float | None = None, matters: float | None = None
) -> tuple[float | None, float | None, float | None]:
    """A tolerance as a person says it, in the unit shown (what matters in % where the kind is relative), as it is kept."""
    shown = shown_unit(kind.unit)
    unit = shown.factor
    share = 100.0 if kind.relative else unit
    if lower is not None and upper is not None and lower > upper:
        raise InputError(f"{kind.name} must stay between {lower:g} and {upper:g} {shown.name}: no value does; exchange them")
    if matters is not None and matters < 0:
        of = "%" if kind.relative else shown.name
        raise InputError(f"the least change of {kind.name} that matters is {matters:g} {of}; give zero or more")
    return (
        None if lower is None else lower / unit,
        None if upper is None else upper / unit,
        None if matters is None else matters / share,
    )


def title_of(name: str) -> str:
    """The name of an indicator as a title: `Stiffness X`."""
    return name[:1].upper() + name[1:]


def to_place_of(value: float, step: float) -> str:
    """A value to the decimal place that a step in it needs: with two digits of the step.

    Examples
    --------
    >>> to_place_of(14.3127, 0.21), to_place_of(0.5, 0.0), to_place_of(float("nan"), 1.0)
    ('14.31', '0.500', 'not known')
    """
    if not isfinite(value):
        return UNKNOWN
    if not (isfinite(step) and step > 0):
        return pretty(significant(value))
    places = max(1 - floor(log10(step)), 0)
    text = f"{value:.{places}f}"
    return text.replace("-", "−") if float(text) else text.removeprefix("-")


def value_said(one: IndicatorState, value: float, digits_of: float | None = None) -> str:
    """A value of an indicator in its unit on paper, to the place that its scatter between tests needs."""
    shown = shown_unit(one.kind.unit)
    return to_place_of(value * shown.factor, (one.deviation if digits_of is None else digits_of) * shown.factor)


def change_said(one: IndicatorState) -> str:
    """A change with its sign and unit, to the place that its interval needs: `−11.4 %`, `+1.61 µm`."""
    if not isfinite(one.change):
        return UNKNOWN
    factor, unit = _scale(one)
    half = (max(one.change_interval) - min(one.change_interval)) / 2
    number = to_place_of(one.change * factor, half * factor)
    rises = one.change > 0 and any(digit in number for digit in "123456789")
    return f"{'+' if rises else ''}{number} {unit}"


def change_interval_said(one: IndicatorState, signed: bool = True) -> str:
    """The 95 % interval of a change: `−13 to −10 %`; without signs the size of a change whose side is said: `10 to 13 %`."""
    low, high = sorted(one.change_interval)
    if not (isfinite(low) and isfinite(high)):
        return UNKNOWN
    if not signed and high < 0:
        low, high = -high, -low
    factor, unit = _scale(one)
    step = (high - low) / 2 * factor
    return f"{to_place_of(low * factor, step)} to {to_place_of(high * factor, step)} {unit}"


def off_said(one: IndicatorState, off: float) -> str:
    """By how much one test is off, with its sign: `−3.5 %`, `+0.42`, to the place that the scatter between tests needs."""
    factor, unit = _scale(one)
    said = to_place_of(off * factor, one.deviation * factor)
    sign = "+" if off > 0 and any(digit in said for digit in "123456789") else ""
    return f"{sign}{said}{' %' if unit == '%' else ''}"


def predicate(one: IndicatorState) -> str:
    """What a change makes of the machine: `is 11 % softer in X`, `has 2.1 µm more backlash in Y`."""
    return changed(one.name, one.kind.name, one.change, " ".join(_size(one, one.change)))


def changed(name: str, kind: str, change: float, size: str) -> str:
    """The same of an indicator of this name and kind, where the size of the change is said already."""
    up, where = change > 0, name.removeprefix(kind).removeprefix(" difference").strip()
    if kind == "stiffness" and where.startswith("at "):
        return f"is {size} {'stiffer' if up else 'softer'} {where}"
    if kind == "stiffness" and where:
        return f"is {size} {'stiffer' if up else 'softer'} in {where}"
    if kind == "squareness" and len(where) == 2:
        return f"shows the angle between {where[0]} and {where[1]} {size} {'smaller' if up else 'larger'}"
    if kind == "scale" and "difference" in name and len(where) == 2:
        return f"travels {size} {'further' if up else 'less far'} in {where[0]} against {where[1]}"
    if kind == "scale" and where:
        return f"travels {size} {'further' if up else 'less far'} in {where}"
    if kind == "straightness" and " in " in where:
        axis, _, across = where.partition(" in ")
        return f"bends {size} more towards {'+' if up else '−'}{across} along {axis}"
    if kind == "straightness" and where:
        return f"is {size} {'less' if up else 'more'} straight along {where}"
    if kind == "backlash" and where:
        return f"has {size} {_MORE[up]} backlash in {where}"
    noun, _, axis = name.rpartition(" ")
    if noun and len(axis) == 1 and axis.isupper():
        return f"has {size} {_MORE[up]} {noun} in {axis}"
    return f"has {size} {_MORE[up]} {name}"


def _size(one: IndicatorState, change: float) -> tuple[str, str]:
    """The size of a change, and its unit."""
    factor, unit = _scale(one)
    return size_said(abs(change) * factor), unit


def _scale(one: IndicatorState) -> tuple[float, str]:
    """What a change is multiplied by to be shown, and its unit: a share of the mean where the kind is relative."""
    if one.kind.relative and one.mean:
        return 100 / abs(one.mean), "%"
    shown = shown_unit(one.kind.unit)
    return shown.factor, shown.name


def size_said(size: float) -> str:
    """Two digits, none behind the point from ten on: `0.42`, `2.1`, `11`, `130`."""
    return f"{size:.0f}" if size >= 9.95 else significant(size, 2)


def least_said(one: IndicatorState) -> str:
    """Least change of an indicator that matters, with its unit."""
    return " ".join(_size(one, one.relevance))
