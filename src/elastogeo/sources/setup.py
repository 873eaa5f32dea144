"""Set-up errors: where the two balls really sit (E_Xt0, E_Yt0 of Table 5.1), and how long the bar really is.

On a circle in one plane a bar that is too long (`E_R0`) looks exactly like equal gains of both axes, `E_XX1 = E_YY1`: the
confounding report says so, and only a calibrated bar can tell them apart.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from elastogeo.machine import COMPONENTS, ROTARY, Machine, Site
from elastogeo.sources.error_motion import CommandPower
from elastogeo.sources.families import family, named
from elastogeo.sources.location import constant
from elastogeo.sources.source import Source

_POINTS: tuple[tuple[str, Site, str], ...] = (
    ("t", ("tool", ""), "tool"),
    ("w", ("workpiece", ""), "workpiece ball"),
)
_SLOPE = re.compile(r"E_R([XYZUVWABC])1")


@family
def setup_offsets(_: Machine) -> Iterator[Source]:
    """Offsets of tool and workpiece ball in their own carriage's frames."""
    for letter, site, name in _POINTS:
        for d in range(3):
            yield Source(
                name=f"E_{COMPONENTS[d]}{letter}0",
                unit="mm",
                site=site,
                component=d,
                driver=constant,
                meaning=f"offset of the {name} in {COMPONENTS[d].lower()}",
            )
    yield Source("E_R0", "mm", ("reading", ""), 0, constant, "bar longer than nominal, or zero of the sensor")


@named
def slope_of_the_reference(machine: Machine, name: str) -> Source | None:
    """`E_RX1`: what a straight line that straightness of X is measured against lacks in alignment; never listed."""
    match = _SLOPE.fullmatch(name)
    if not match or match[1] not in machine.axes:
        return None
    axis = match[1]
    unit = f"mm/{'rad' if axis in ROTARY else 'mm'}"
    return Source(name, unit, ("reading", ""), 0, CommandPower(axis, 1), f"slope of the reference along {axis}")
