"""How numbers are written for people. The only place where anything is rounded, and only on paper."""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import Decimal
from math import floor, isfinite, log10

from elastogeo.estimate import Estimate

UNKNOWN = "not known"
_PLAIN = (1e-3, 1e6)
"""Magnitudes from the first to below the second are written without an exponent."""
_SHARPEST = 1e-9
"""A relative uncertainty below this says more of the arithmetic than of the machine; the value keeps ten digits."""
_LEAST_PROBABILITY, _SURE = 1e-4, 0.1

_PREFIXES = {
    "mm": ((1.0, "mm"), (1e3, "µm"), (1e6, "nm"), (1e9, "pm"), (1e12, "fm")),
    "s": ((1.0, "s"), (1e3, "ms"), (1e6, "µs")),
    "rad": ((1.0, "rad"), (1e3, "mrad"), (1e6, "µrad"), (1e9, "nrad"), (1e12, "prad")),
}


@dataclass(frozen=True, slots=True)
class DisplayUnit:
    """A unit to show values in.

    Attributes
    ----------
    name : str
    factor : float
        A value in the unit of the house times this is the value in this unit.
    """

    name: str
    factor: float


def display_unit(unit: str, magnitude: float) -> DisplayUnit:
    """The unit in which a value of this magnitude reads well: nm/N for 6e-5 mm/N, µm/m for 1e-4 mm/mm.

    Parameters
    ----------
    unit : str
        Of the house: `mm/N`, `rad/(N mm)`, `mm/mm^2`, ...
    magnitude : float
        In `unit`; zero or unknown keeps the unit.
    """
    head, slash, rest = unit.partition("/")
    factor = 1.0
    if rest.startswith("mm"):
        factor = 1000.0 ** int(rest.partition("^")[2] or 1)
        rest = rest.removeprefix("m")
    below = written_unit(slash + rest)
    if head not in _PREFIXES or not isfinite(magnitude) or magnitude == 0:
        return DisplayUnit(head + below, factor)
    steps = _PREFIXES[head]
    step, prefixed = next((s for s in steps if abs(magnitude) * factor * s[0] >= 1.0), steps[-1])
    return DisplayUnit(prefixed + below, factor * step)


def written_unit(unit: str) -> str:
    """A unit as it is set in print: `rad/(N·mm)`, `mm/mm²`."""
    return unit.replace("N mm", "N·mm").replace("^2", "²").replace("^3", "³")


def significant(value: float | None, digits: int = 3) -> str:
    """A number with so many significant digits, trailing zeros kept: `43.7`, `0.140`, `1.20e-07`."""
    if value is None or not isfinite(value):
        return UNKNOWN
    if value == 0:
        return "0"
    text = f"{value:.{digits - 1}e}"
    return f"{Decimal(text):f}" if _is_plain(abs(value)) else text


def value_with_uncertainty(value: float, uncertainty: float) -> str:
    """A value and its uncertainty to two significant digits, the value to the same place (JCGM 100, 7.2.6).

    Examples
    --------
    >>> value_with_uncertainty(61.8983, 0.0314)
    '61.898 ± 0.031'
    >>> value_with_uncertainty(6.18983e-5, 3.14e-8)
    '(6.1898 ± 0.0031)e-05'
    >>> value_with_uncertainty(-0.0001, 0.02)
    '0.000 ± 0.020'
    """
    value, uncertainty = float(value), float(uncertainty)
    if not isfinite(value):
        return UNKNOWN
    if not isfinite(uncertainty) or uncertainty < 0:
        return f"{significant(value, 4)} ± {UNKNOWN}"
    if uncertainty <= _SHARPEST * abs(value):
        return f"{significant(value, 10)} ± {f'{uncertainty:.1e}' if uncertainty else '0'}"
    if not uncertainty:
        return "0 ± 0"
    largest = max(abs(value), uncertainty)
    power = 0 if _is_plain(largest) else floor(log10(largest))
    half = Decimal(f"{uncertainty:.1e}").scaleb(-power)
    place = Decimal(1).scaleb(int(half.as_tuple().exponent))
    number = f"{Decimal(repr(value)).scaleb(-power).quantize(place):zf} ± {half:f}"
    return f"({number})e{power:+03d}" if power else number


def said_estimate(estimate: Estimate) -> str:
    """An estimate as `value ± U` with U of 95 %."""
    return value_with_uncertainty(estimate.value, estimate.expanded())


def whole_percent(share: float) -> str:
    """A share in whole percent: `100` only of what is all, `0` only of what is none.

    Examples
    --------
    >>> [whole_percent(share) for share in (0.0, 0.001, 0.5, 0.999, 1.0)]
    ['0', '1', '50', '99', '100']
    """
    return f"{share if share in (0.0, 1.0) else min(max(round(100 * share), 1), 99) / 100:.0%}".removesuffix("%")


def probability(p_value: float) -> str:
    """A probability in words of two digits: `0.46`, `0.0012`, `< 0.0001`."""
    if not isfinite(p_value):
        return UNKNOWN
    return "< 0.0001" if p_value < _LEAST_PROBABILITY else significant(p_value, 2) if p_value < _SURE else f"{p_value:.2f}"


def p_said(p_value: float) -> str:
    """A probability as a sentence has it: `p = 0.46`, `p < 0.0001`."""
    said = probability(p_value)
    return f"p {said}" if said.startswith("<") else f"p = {said}"


def pretty(text: str) -> str:
    """Numbers as they are set in print: a true minus sign, powers of ten."""
    text = re.sub(r"(?<![\d.])1e([+-])(\d+)", lambda m: f"10{_raised(m[1], m[2])}", text)
    text = re.sub(r"e([+-])(\d+)", lambda m: f" × 10{_raised(m[1], m[2])}", text)
    return re.sub(r"(?<![A-Za-z])-(?=[\d ])", "−", text)


def micro(text: str) -> str:
    """A sentence with its `um` as µm."""
    return re.sub(r"(?<=\d )um\b", "µm", text)


def _raised(sign: str, digits: str) -> str:
    raised = digits.lstrip("0").translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return ("⁻" if sign == "-" else "") + raised


def _is_plain(magnitude: float) -> bool:
    return _PLAIN[0] <= magnitude < _PLAIN[1]
