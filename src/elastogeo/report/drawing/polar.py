"""Deviations around a circle, magnified, as plain shapes: what a page draws of a circular test. No matplotlib."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil

import numpy as np

from elastogeo.machine import Array
from elastogeo.report.drawing.magnified import Scale, around
from elastogeo.report.drawing.plots import Band, Circle, Line, Place, Shape, Text
from elastogeo.report.text import UM

DIRECTIONS = {1: "blue", -1: "orange"}
"""Kind of a trace by its direction: counter-clockwise and clockwise."""
SENSES = {1: "CCW", -1: "CW"}

_MARGIN = 22.0
"""Room about the rings [px], for the names of the axes."""
_MANY = 100
"""A trace is thinned as one of so many: a page is small."""
_ARROW_AT, _ARROW = np.radians(135.0), np.radians(11.0)
_VALUES_AT = np.radians(67.5)
_LETTERS = 15.0
"""Height [px] that a written value takes: where rings are closer, only some are written."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A square that holds magnified deviations.

    Attributes
    ----------
    scale : Scale
    size : float [px]
    """

    scale: Scale
    size: float

    @property
    def per_unit(self) -> float:
        """Pixels of a unit of the scale."""
        return (self.size / 2 - _MARGIN) / self.scale.limit

    def place(self, x: float, y: float) -> Place:
        """A point of the plane [as the scale has it] in pixels."""
        return self.size / 2 + x * self.per_unit, self.size / 2 - y * self.per_unit

    def ring(self, deviation: float) -> float:
        """Radius [px] of a deviation [mm]."""
        return (self.scale.radius + deviation * self.scale.magnification) * self.per_unit


def ring_shapes(frame: Frame, axes: Sequence[str] = ()) -> Iterator[Shape]:
    """The nominal circle, a ring every division with its value, and the directions of the plane."""
    scale, middle = frame.scale, frame.size / 2
    reach = frame.size / 2 - _MARGIN
    for k in range(scale.inner, scale.outer + 1):
        kind, width = ("soft", 1.2) if k == 0 else ("line", 1.0)
        yield Circle(middle, middle, frame.ring(k * scale.division), kind, width=width)
    names = [f"+{axes[0]}", f"+{axes[1]}", f"−{axes[0]}", f"−{axes[1]}"] if axes else ["0°", "90°", "180°", "270°"]
    for k, name in enumerate(names):
        x, y = ((1, 0), (0, -1), (-1, 0), (0, 1))[k]
        yield Line(((middle, middle), (middle + x * reach, middle + y * reach)), "line")
        anchor = ("start", "middle", "end", "middle")[k]
        yield Text(middle + x * (reach + 4), middle + y * (reach + 11) + 4, name, anchor, "soft")
    apart = ceil(_LETTERS / (scale.division * scale.magnification * frame.per_unit))
    for k in (k for k in range(scale.inner, scale.outer + 1) if k % apart == 0):
        r = frame.ring(k * scale.division)
        text = f"{k * scale.division * UM:+g}".replace("-", "−") if k else "0 µm"
        yield Text(middle + r * np.cos(_VALUES_AT), middle - r * np.sin(_VALUES_AT) + 4, text, "middle", "soft")


def trace_line(
    frame: Frame, angle: Array, deviation: Array, kind: str, width: float = 1.6, dashes: tuple[float, ...] = ()
) -> Line:
    """A trace [rad], [mm] about the nominal circle."""
    x, y = around(angle, deviation, frame.scale, _MANY)
    points = tuple(frame.place(float(a), float(b)) for a, b in zip(x, y, strict=True))
    return Line(points, kind, width, dashes)


def direction_arrow(frame: Frame, sense: int) -> Iterator[Shape]:
    """Outside the rings, which way a trace goes."""
    outside = frame.scale.limit * (1.02 if sense > 0 else 1.055)
    angles = _ARROW_AT + sense * np.linspace(-_ARROW, _ARROW, 9)
    points = [frame.place(outside * float(np.cos(a)), outside * float(np.sin(a))) for a in angles]
    yield Line(tuple(points), DIRECTIONS[sense], 1.8)
    tip, along = np.array(points[-1]), np.subtract(points[-1], points[-2])
    along = along / (np.hypot(*along) or 1.0)
    across = np.array([-along[1], along[0]])
    corners = (tip + 7 * along, tip + 4 * across, tip - 4 * across)
    yield Band(tuple((float(x), float(y)) for x, y in corners), DIRECTIONS[sense])


def magnified_note(scale: Scale) -> str:
    """What a ring means, and how much deviations are magnified."""
    return f"One ring is {scale.division * UM:g} µm; deviations are magnified {scale.magnification:g} times."
