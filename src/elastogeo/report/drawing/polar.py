"""Deviations around a circle, magnified, as plain shapes: what a page draws of a circular test. No matplotlib."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, cos, sin

import numpy as np

from elastogeo.machine import Array
from elastogeo.report.drawing.magnified import Scale, around
from elastogeo.report.drawing.plots import Band, Circle, Line, Place, Shape, Text
from elastogeo.report.text import UM

DIRECTIONS = {1: "blue", -1: "orange"}
"""Kind of a trace by its direction: counter-clockwise and clockwise."""
SENSES = {1: "CCW", -1: "CW"}

_MANY = 100
"""A trace is thinned as one of so many: a page is small."""
_ARROW_AT, _ARROW = np.radians(135.0), np.radians(11.0)
_VALUES_AT = float(np.radians(67.5))
"""Angle [rad] at which the rings are labelled."""
_LETTERS = 15.0


@dataclass(frozen=True, slots=True)
class Frame:
    """A drawing that holds magnified deviations about its middle.

    Attributes
    ----------
    scale : Scale
    width, height : float [px]
    margin : float [px]
        Room about all that is drawn, for the names of the axes.
    """

    scale: Scale
    width: float
    height: float
    margin: float = 22.0

    @property
    def middle(self) -> Place:
        """The centre of the circle [px]."""
        return self.width / 2, self.height / 2

    @property
    def reach(self) -> float:
        """Radius that holds all that is drawn [px]."""
        return min(self.middle) - self.margin

    @property
    def per_unit(self) -> float:
        """Pixels of a unit of the scale."""
        return self.reach / self.scale.limit

    def place(self, x: float, y: float) -> Place:
        """A point of the plane [as the scale has it] in pixels, to a hundredth: what is kept of a drawing stays small."""
        across, down = self.middle
        return round(across + x * self.per_unit, 2), round(down - y * self.per_unit, 2)

    def ring(self, deviation: float) -> float:
        """Radius [px] of a deviation [mm]."""
        return (self.scale.radius + deviation * self.scale.magnification) * self.per_unit

    def at(self, angle: float, deviation: float) -> Place:
        """Where a deviation [mm] at an angle [rad] is drawn [px]."""
        radius = self.scale.radius + deviation * self.scale.magnification
        return self.place(radius * cos(angle), radius * sin(angle))


def ring_shapes(frame: Frame, axes: Sequence[str] = (), letters: float = _LETTERS) -> Iterator[Shape]:
    """The nominal circle, a ring every division with its value, and the directions of the plane.

    Parameters
    ----------
    frame : Frame
    axes : sequence of str
        Names of the two directions of the plane; angles are written where they are not known.
    letters : float [px]
        Height that a written value takes: where rings are closer, only some are written.
    """
    scale, (across, down), reach = frame.scale, frame.middle, frame.reach
    for k in range(scale.inner, scale.outer + 1):
        kind, width = ("soft", 1.2) if k == 0 else ("line", 1.0)
        yield Circle(across, down, frame.ring(k * scale.division), kind, width=width)
    names = [f"+{axes[0]}", f"+{axes[1]}", f"−{axes[0]}", f"−{axes[1]}"] if axes else ["0°", "90°", "180°", "270°"]
    for k, name in enumerate(names):
        x, y = ((1, 0), (0, -1), (-1, 0), (0, 1))[k]
        yield Line(((across, down), (across + x * reach, down + y * reach)), "line")
        anchor = ("start", "middle", "end", "middle")[k]
        yield Text(across + x * (reach + 4), down + y * (reach + 11) + 4, name, anchor, "soft")
    apart = ceil(letters / (scale.division * scale.magnification * frame.per_unit))
    for k in (k for k in range(scale.inner, scale.outer + 1) if k % apart == 0):
        right, low = frame.at(_VALUES_AT, k * scale.division)
        text = f"{k * scale.division * UM:+g}".replace("-", "−") if k else "0 µm"
        yield Text(right, low + 4, text, "middle", "soft")


def trace_line(
    frame: Frame,
    angle: Array,
    deviation: Array,
    kind: str,
    width: float = 1.6,
    dashes: tuple[float, ...] = (),
    traces: int = _MANY,
) -> Line:
    """A trace [rad], [mm] about the nominal circle, thinned as one of so many `traces`."""
    x, y = around(angle, deviation, frame.scale, traces)
    return Line(tuple(frame.place(float(a), float(b)) for a, b in zip(x, y, strict=True)), kind, width, dashes)


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
