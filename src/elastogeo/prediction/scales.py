"""The size that a parameter is expected to have: the metric in which support is measured, and the stated prior."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import prod

import numpy as np

from elastogeo.machine import Array
from elastogeo.sources import Source

TYPICAL_COMPLIANCE = 5e-6
"""Standard deviation [mm/N] of the prior of a translational joint compliance: 200 N/um."""

TYPICAL_LEVER = 300.0
"""Lever [mm] that carries it to rotations and moments."""

TYPICAL_FORCE = 1000.0
"""Force [N] under which a compliance gives the deviation that geometry is expected to have: 5 um."""

_DEVIATION = TYPICAL_COMPLIANCE * TYPICAL_FORCE
_SPEED, _ACCELERATION = 100.0, 1000.0
_OF = {
    "mm": _DEVIATION,
    "rad": _DEVIATION / TYPICAL_LEVER,
    "s": _DEVIATION / _SPEED,
    "s^2": _DEVIATION / _ACCELERATION,
}
_PER = {
    "N": TYPICAL_FORCE,
    "Nmm": TYPICAL_FORCE * TYPICAL_LEVER,
    "mm": TYPICAL_LEVER,
    "rad": 1.0,
    "mm/s": _SPEED,
    "rad/s": _SPEED / TYPICAL_LEVER,
}


def parameter_scales(sources: Sequence[Source]) -> Array:
    """The scale of each parameter of any kind, shape (p,), in its own unit.

    What it gives is a deviation of 5 um, at 1000 N, over 300 mm or 1 rad, at 100 mm/s: of a compliance 5 nm/N, where a
    rotation is a translation over the lever and a moment a force times it.
    """
    return np.array([_size(source.unit) for source in sources])


def _size(unit: str) -> float:
    """The expected size of a parameter of a unit as error sources write them: `rad/(N mm)/mm^2`, `mm/N s/mm`."""
    whole = re.sub(r" s/(mm|rad)", r"/\1:s", unit.replace("(N mm)", "Nmm"))
    of, *per = whole.split("/")
    return _OF[of] / prod(_power(part.replace(":", "/")) for part in per)


def _power(part: str) -> float:
    base, _, exponent = part.partition("^")
    return float(_PER[base] ** float(exponent or 1.0))
