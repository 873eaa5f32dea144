"""The sentence of a signed value: what it means for the axis, on whichever branch that is."""

from __future__ import annotations

from elastogeo.report.numbers import display_unit, significant
from elastogeo.sources import Sign

_SENTENCES = {
    "gain": ("{axis} travels {size} too far", "{axis} travels {size} too short"),
    "bow": (
        "the path of {axis} bends towards +{other} at both ends",
        "the path of {axis} bends towards -{other} at both ends",
    ),
    "squareness": (
        "the angle between +{axis} and +{other} is {size} less than 90°",
        "the angle between +{axis} and +{other} is {size} more than 90°",
    ),
    "backlash": ("{axis} falls {size} short when it reverses", "{axis} overshoots by {size} when it reverses"),
    "spike": (
        "{axis} is late by up to {size} right after it reverses",
        "{axis} jumps ahead by {size} right after it reverses",
    ),
    "lag": ("{axis} lags its command by {size}", "{axis} leads its command by {size}"),
    "acceleration": (
        "{axis} falls {size} short while it accelerates",
        "{axis} overshoots by {size} while it accelerates",
    ),
}
_SHIFT = "{axis} shifts by {size} towards {way}{other} when it turns back from + to -"
_TURN = "{axis} turns by {size} about {way}{other} when it turns back from + to -"
_ABOUT = dict(zip("ABC", "XYZ", strict=True))


def sign_sentence(sign: Sign, value: float, unit: str) -> str:
    """What a value says of its axis: `X falls 8.0 µm short when it reverses`.

    Parameters
    ----------
    sign : Sign
        Of the error source.
    value : float
        Of its parameter.
    unit : str
        Of the house: `mm`, `mm/mm`, `s`.

    Returns
    -------
    str
        Without a full stop; empty for a value of zero.
    """
    positive = sign.factor * value > 0
    if not value:
        return ""
    if sign.kind == "play":
        sentence, other = (_TURN, _ABOUT[sign.other]) if sign.other in _ABOUT else (_SHIFT, sign.other.lower())
        return sentence.format(axis=sign.axis, size=_size(value, unit), other=other, way="+" if positive else "-")
    sentence = _SENTENCES[sign.kind][0 if positive else 1]
    return sentence.format(axis=sign.axis, other=_named(sign), size=_size(value, unit))


def _named(sign: Sign) -> str:
    """A second axis by its letter, a direction in lower case."""
    return sign.other if sign.kind == "squareness" else sign.other.lower()


def _size(value: float, unit: str) -> str:
    """The size of a value with two digits, in the unit in which it reads well."""
    if unit.startswith("s"):
        factor, name = 1e3 if unit == "s" else 1.0, "ms" if unit == "s" else "mm per mm/s²"
        return f"{significant(abs(value) * factor, 2)} {name}"
    shown = display_unit(unit, abs(value))
    return f"{significant(abs(value) * shown.factor, 2)} {shown.name}"
