"""Options that give a name a value, as in `X_mm=100`: an axis has its unit beside it, so that none is taken for another."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite, nan, radians

from elastogeo.errors import InputError


def named(given: Iterable[str] | None, option: str, example: str) -> dict[str, str]:
    """What an option that may be repeated gives, by name.

    Raises
    ------
    InputError
        If there is no name or no value, or a name comes twice.
    """
    found: dict[str, str] = {}
    for text in given or ():
        name, _, value = (part.strip() for part in text.partition("="))
        if not (name and value):
            raise InputError(f"{option} is {text!r}; give a name and a value, as in {example}")
        if name in found:
            raise InputError(f"{option} gives {name} twice; give it once")
        found[name] = value
    return found


def by_axis(given: Iterable[str] | None, option: str, example: str) -> dict[str, str]:
    """The same of axes, whose unit is part of the name: `X_mm`, `C_deg`.

    Raises
    ------
    InputError
        If a name is no axis, or has not the unit of its axis.
    """
    from elastogeo.machine import LINEAR, ROTARY

    units = dict.fromkeys(LINEAR, "mm") | dict.fromkeys(ROTARY, "deg")
    found = {}
    for name, value in named(given, option, example).items():
        axis, _, unit = name.partition("_")
        if axis not in units:
            raise InputError(f"{option} names {axis!r}, which is no axis; give one with its unit, as in {example}")
        if unit != units[axis]:
            raise InputError(
                f"{option} is '{name}={value}'; name the axis with its unit, {axis}_{units[axis]}, as in {example}"
            )
        found[axis] = value
    return found


def axis_values(given: Iterable[str] | None, option: str, example: str) -> dict[str, float]:
    """Commands of axes [mm, rad], of `X_mm=100` and `C_deg=30`.

    Raises
    ------
    InputError
        As `by_axis`; if a value is no finite number.
    """
    from elastogeo.machine import ROTARY

    found = {}
    for axis, text in by_axis(given, option, example).items():
        try:
            value = float(text)
        except ValueError:
            value = nan
        if not isfinite(value):
            raise InputError(f"{option} of {axis} is {text!r}; give a number, as in {example}")
        found[axis] = radians(value) if axis in ROTARY else value
    return found
