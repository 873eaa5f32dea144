"""Units at the boundary: one table of spellings, each with its dimension and its factor to the internal unit.

Inside, all is mm, rad, N, N mm, s, mm/s and what follows from them (inertia in N mm s^2, mass in N s^2/mm); pressure is
in bar, current in A, voltage in V, temperature in degC. Percent of a rated value stay percent.
A factor is a ratio of two exact numbers, so that 35 um becomes the double nearest to 0.035 mm. Nothing is rounded.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from elastogeo.errors import FormatError
from elastogeo.machine import LINEAR, ROTARY, Array


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: `internal value = value * multiply / divide`.

    Attributes
    ----------
    dimension : str
        What it measures: `length`, `angle`, `force`, ...
    multiply, divide : float
        The ratio of this unit to the internal unit of its dimension.
    """

    dimension: str
    multiply: float = 1.0
    divide: float = 1.0


PERCENT = "percent"
"""Dimension of a current, torque or force that a drive gives as a share of its rated value."""

_MICROMETRE, _DEGREE, _CELSIUS = Unit("length", 1, 1e3), Unit("angle", pi, 180), Unit("temperature")
_MM_S, _MM_MIN, _M_MIN = Unit("feed"), Unit("feed", 1, 60), Unit("feed", 1e3, 60)
_MM_S2, _M_S2 = Unit("acceleration"), Unit("acceleration", 1e3)
_RAD_S, _RPM = Unit("angular rate"), Unit("angular rate", pi, 30)

#: Every spelling of a unit that is understood. Upper and lower case differ: `nm` is a length, `Nm` a moment.
UNITS: Mapping[str, Unit] = MappingProxyType(
    {
        "mm": Unit("length"),
        "um": _MICROMETRE,
        "µm": _MICROMETRE,  # U+00B5, the micro sign
        "μm": _MICROMETRE,  # U+03BC, the Greek letter
        "nm": Unit("length", 1, 1e6),
        "m": Unit("length", 1e3),
        "in": Unit("length", 25.4),
        "rad": Unit("angle"),
        "mrad": Unit("angle", 1, 1e3),
        "urad": Unit("angle", 1, 1e6),
        "µrad": Unit("angle", 1, 1e6),
        "μrad": Unit("angle", 1, 1e6),
        "deg": _DEGREE,
        "°": _DEGREE,
        "arcsec": Unit("angle", pi, 648_000),
        "N": Unit("force"),
        "kN": Unit("force", 1e3),
        "N_mm": Unit("moment"),
        "N mm": Unit("moment"),
        "Nmm": Unit("moment"),
        "N_m": Unit("moment", 1e3),
        "N m": Unit("moment", 1e3),
        "Nm": Unit("moment", 1e3),
        "bar": Unit("pressure"),
        "kPa": Unit("pressure", 1, 100),
        "MPa": Unit("pressure", 10),
        "N_mm2": Unit("stress"),
        "N/mm2": Unit("stress"),
        "N/mm^2": Unit("stress"),
        "kN_mm2": Unit("stress", 1e3),
        "GPa": Unit("stress", 1e3),
        "s": Unit("time"),
        "ms": Unit("time", 1, 1e3),
        "min": Unit("time", 60),
        "mm_s": _MM_S,
        "mm/s": _MM_S,
        "mm_min": _MM_MIN,
        "mm/min": _MM_MIN,
        "m_min": _M_MIN,
        "m/min": _M_MIN,
        "m_s": Unit("feed", 1e3),
        "m/s": Unit("feed", 1e3),
        "mm_s2": _MM_S2,
        "mm/s2": _MM_S2,
        "mm/s^2": _MM_S2,
        "m_s2": _M_S2,
        "m/s2": _M_S2,
        "m/s^2": _M_S2,
        "rad_s": _RAD_S,
        "rad/s": _RAD_S,
        "rad_s2": Unit("angular acceleration"),
        "rad/s2": Unit("angular acceleration"),
        "rad/s^2": Unit("angular acceleration"),
        "deg_s2": Unit("angular acceleration", pi, 180),
        "deg/s2": Unit("angular acceleration", pi, 180),
        "deg/s^2": Unit("angular acceleration", pi, 180),
        "deg_s": Unit("angular rate", pi, 180),
        "deg/s": Unit("angular rate", pi, 180),
        "rpm": _RPM,
        "1/min": _RPM,
        "Hz": Unit("frequency"),
        "kg": Unit("mass", 1, 1e3),
        "kg_m2": Unit("inertia", 1e3),
        "kg_cm2": Unit("inertia", 1, 10),
        "N_mm_s2": Unit("inertia"),
        "N_m_s": Unit("damping", 1e3),
        "N_mm_s": Unit("damping"),
        "A": Unit("current"),
        "mA": Unit("current", 1, 1e3),
        "V": Unit("voltage"),
        "C": _CELSIUS,
        "degC": _CELSIUS,
        "°C": _CELSIUS,
        "%": Unit(PERCENT),
    }
)

#: Units of a clock in a second, in the spellings of data loggers.
PER_SECOND: Mapping[str, float] = MappingProxyType(
    {"s": 1.0, "sec": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6, "μs": 1e6, "ns": 1e9, "min": 1 / 60}
)

_POSITION = ("length", "angle")
_VELOCITY = ("feed", "angular rate")
#: The dimensions that a quantity of this name may have; a name that is not here may have any unit, or none.
QUANTITIES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        **dict.fromkeys(("radial", "radius", "length", "displacement", "x", "y", "z"), ("length",)),
        **dict.fromkeys(("engagement", "ball", "roller"), ("length",)),
        **dict.fromkeys(("position", "command", "scale", "reading", "deviation", "error", "target"), _POSITION),
        **dict.fromkeys(("angle", "a", "b", "c"), ("angle",)),
        "velocity": _VELOCITY,
        "acceleration": ("acceleration", "angular acceleration"),
        **dict.fromkeys(("moment", "torque"), ("moment",)),
        **{name: (name,) for name in ("force", "pressure", "time", "feed", "current", "voltage", "temperature")},
    }
)

_LINEAR_AXIS = {"position": "length", "command": "length", "velocity": "feed", "acceleration": "acceleration"}
_ROTARY_AXIS = {
    "position": "angle",
    "command": "angle",
    "velocity": "angular rate",
    "acceleration": "angular acceleration",
}
_RATED = ("current", "torque", "force")
_BRACKETED = re.compile(r"(?P<name>[^\[(]+)[\[(](?P<unit>[^\[\]()]*)[\])]")
_NUMBERED = re.compile(r"_[xyzabcuvw]|_?\d{1,3}")


def split_unit(header: str) -> tuple[str, str]:
    """Split a column header into the name of its quantity and its unit.

    `angle_deg`, `angle [deg]` and `Angle (deg)` all give `("angle", "deg")`. The name is given in lower case with
    underscores for blanks; the unit is `""` when the header has none (`level`, `level [-]`).

    Raises
    ------
    FormatError
        If the header is empty, or the unit in its brackets is not one of `UNITS`.
    """
    text = header.strip()
    bracketed = _BRACKETED.fullmatch(text)
    if bracketed:
        name, unit = bracketed["name"].strip(), bracketed["unit"].strip()
        if unit in ("", "-", "1"):
            unit = ""
        elif unit not in UNITS:
            raise FormatError(f"the unit {unit[:40]!r} of column {text[:60]!r} is not known: use {spellings()}")
    elif any(bracket in text for bracket in "[]()"):
        raise FormatError(f"the column header {text[:60]!r} cannot be understood: write for example 'radial [um]'")
    else:
        parts = text.split("_")
        tails = ("_".join(parts[-2:]) if len(parts) > 2 else "", parts[-1] if len(parts) > 1 else "")
        unit = next((tail for tail in tails if tail in UNITS), "")
        name = text[: -len(unit) - 1] if unit else text
    quantity = "_".join(name.lower().split()).strip("_")
    if not quantity:
        raise FormatError(f"the column header {text[:60]!r} names no quantity: write for example 'radial_um'")
    return quantity, unit


def check_unit(quantity: str, unit: str, *, percent: bool = False) -> None:
    """Check that a quantity of the field comes with a unit, and with one of its own dimension.

    Parameters
    ----------
    quantity, unit : str
    percent : bool
        Whether a current, torque or force may be given in percent of its rated value.

    Raises
    ------
    FormatError
        If `quantity` (such as `force`, `force_x`, `force2`) has no unit, or one of another dimension.
    """
    expected = dimensions_of(quantity)
    if not expected or (unit and UNITS[unit].dimension in expected) or (percent and unit == "%" and is_rated(quantity)):
        return
    known = " or ".join(f"{quantity}_{spelling}" for spelling in _of(expected) if spelling.isascii())
    arrived = f"has the unit {unit} ({UNITS[unit].dimension})" if unit else "has no unit"
    raise FormatError(f"column {quantity!r} {arrived}: write {known}")


def dimensions_of(quantity: str) -> tuple[str, ...]:
    """The dimensions that a quantity (`force`, `force_x`, `force2`) may have; none for one that may have any.

    The position, command, velocity and acceleration of a linear axis (`position_x`) are lengths, those of a rotary axis
    (`position_c`) angles (ISO 841).
    """
    kind, _, axis = quantity.rpartition("_")
    of_axis = _LINEAR_AXIS if axis.upper() in LINEAR else _ROTARY_AXIS if axis.upper() in ROTARY else {}
    if kind in of_axis:
        return (of_axis[kind],)
    return next((dimensions for name, dimensions in QUANTITIES.items() if _is_named(quantity, name)), ())


def is_rated(quantity: str) -> bool:
    """Whether a drive may give a quantity (`current_x`) in percent of its rated value."""
    return any(_is_named(quantity, name) for name in _RATED)


def to_internal(values: ArrayLike, unit: str) -> Array:
    """Convert values from `unit` to the internal unit of its dimension (a new array of the same shape).

    Raises
    ------
    FormatError
        If the unit is not one of `UNITS` (`""`, no unit, is).
    """
    scale = _unit(unit)
    with np.errstate(over="ignore", under="ignore"):
        return np.asarray(values, dtype=np.float64) * scale.multiply / scale.divide


def from_internal(values: ArrayLike, unit: str) -> Array:
    """Convert values from the internal unit of its dimension to `unit` (a new array of the same shape).

    Raises
    ------
    FormatError
        If the unit is not one of `UNITS` (`""`, no unit, is).
    """
    scale = _unit(unit)
    with np.errstate(over="ignore", under="ignore"):
        return np.asarray(values, dtype=np.float64) * scale.divide / scale.multiply


def spellings() -> str:
    """All unit spellings, by dimension, for an error message."""
    dimensions = dict.fromkeys(unit.dimension for unit in UNITS.values())
    return "; ".join(f"{dimension}: {', '.join(_of((dimension,)))}" for dimension in dimensions)


def _unit(unit: str) -> Unit:
    if unit == "":
        return Unit("number")
    if unit not in UNITS:
        raise FormatError(f"the unit {unit[:40]!r} is not known: use {spellings()}")
    return UNITS[unit]


def _of(dimensions: tuple[str, ...]) -> list[str]:
    return [name for name, unit in UNITS.items() if unit.dimension in dimensions]


def _is_named(quantity: str, name: str) -> bool:
    if not quantity.startswith(name):
        return False
    rest = quantity[len(name) :]
    return not rest or (len(name) > 1 and _NUMBERED.fullmatch(rest) is not None)
