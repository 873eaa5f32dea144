"""The rows of the parameter table in words and figures: one place for the page and the command line."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from elastogeo.identification import Identification, Parameter
from elastogeo.report.numbers import DisplayUnit, display_unit, significant, value_with_uncertainty

UM = 1000.0
MICRO = 1e6
MOST_TERMS = 6
"""Terms of a sum that are written where there is little room; the folded sections and the JSON hold all."""
UNTOLD = "compliance and geometry, not distinguished"
"""What is said of a parameter that stands for a sum of both: none of its members may be named the cause."""
_SAME = 1e-6
"""Coefficients this close to one are written without a number."""


@dataclass(frozen=True, slots=True)
class ParameterRow:
    """One identified parameter, formatted.

    Attributes
    ----------
    name : str
        The combination instead, where compliance and geometry are not distinguished: no single name is right then.
    value, unit : str
        The value is `value ± U`, where U is half the 95 % interval, in `unit`; the value alone where there is none.
    peak_to_peak, share_percent : str
        Of its part of the trace at the highest force, with the sign of the value, in the unit of the readings.
    stands_for : str
        The combination it represents: `C_XXX + C_XXY`.
    meaning : str
    """

    name: str
    value: str
    unit: str
    peak_to_peak: str
    share_percent: str
    stands_for: str
    meaning: str


def parameter_rows(result: Identification) -> tuple[ParameterRow, ...]:
    """The rows of the parameter table, in the order of the result."""
    shown, read = display_units(result), reading_unit(result)
    return tuple(
        ParameterRow(
            name=label(p),
            value=said_value(p, shown[p.name]),
            unit=shown[p.name].name,
            peak_to_peak=significant(p.peak_to_peak * read.factor),
            share_percent=f"{100 * p.share:.1f}" if p.axis or p.share else "",
            stands_for=combination(p.stands_for),
            meaning=p.meaning if p.separated else UNTOLD,
        )
        for p in result.parameters
    )


def reading_unit(result: Identification, test: str = "") -> DisplayUnit:
    """The unit in which readings are shown, those of one test or of all: microradians where all are angles."""
    parts = [part for part in result.tests if test in ("", part.name)]
    return DisplayUnit("µrad", MICRO) if parts and all(part.angular for part in parts) else DisplayUnit("µm", UM)


def said_value(parameter: Parameter, unit: DisplayUnit) -> str:
    """`value ± U`, U half the 95 % interval; the value alone where there is none."""
    if parameter.expanded is None:
        return significant(parameter.value * unit.factor)
    return value_with_uncertainty(parameter.value * unit.factor, parameter.expanded * unit.factor)


def label(parameter: Parameter) -> str:
    """What a parameter is shown under: its name, or the whole sum where compliance and geometry are not distinguished."""
    return parameter.name if parameter.separated else combination(parameter.stands_for, MOST_TERMS)


def labels(result: Identification) -> dict[str, str]:
    """What each parameter is shown under, by its name."""
    return {p.name: label(p) for p in result.parameters}


def all_separated(result: Identification) -> bool:
    """Whether compliance and geometry are distinguished in everything that was identified."""
    return all(p.separated for p in result.parameters)


def display_units(result: Identification) -> dict[str, DisplayUnit]:
    """The unit in which each parameter is shown, by its name; parameters of one kind share theirs, to compare."""
    return shared_units((p.name, p.unit, p.reach) for p in result.parameters)


def shared_units(values: Iterable[tuple[str, str, float]]) -> dict[str, DisplayUnit]:
    """The unit to show each of some values in, by name; values of one unit share theirs.

    Parameters
    ----------
    values : iterable of (name, unit, magnitude)
    """
    values = list(values)
    largest: dict[str, float] = {}
    for _, unit, value in values:
        largest[unit] = max(largest.get(unit, 0.0), abs(value))
    return {name: display_unit(unit, largest[unit]) for name, unit, _ in values}


def combination(terms: Mapping[str, float], most: int = 0) -> str:
    """A labelled linear combination: `C_XXX + C_XXY - 0.5 C_YYX`.

    Parameters
    ----------
    terms : mapping of str to float
        Coefficients by name.
    most : int
        Terms to write before the others are counted; 0 for all.
    """
    if most and len(terms) > most + 1:
        return f"{combination(dict(list(terms.items())[:most]))} + {len(terms) - most} more terms"
    text = ""
    for name, coefficient in terms.items():
        sign = "-" if coefficient < 0 else "+"
        size = abs(coefficient)
        factor = "" if abs(size - 1) < _SAME else f"{significant(size, 4)} "
        text += f" {sign} {factor}{name}" if text else f"{'-' if coefficient < 0 else ''}{factor}{name}"
    return text


def in_micrometres(length: float, digits: int = 3) -> str:
    """A length [mm] as a number of micrometres."""
    return significant(length * UM, digits)


def listed(names: Iterable[str]) -> str:
    """Names in a sentence: `C_XXX, C_XYX and C_YYY`."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
