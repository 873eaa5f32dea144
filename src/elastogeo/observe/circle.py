"""The circular path of a ball bar test, on any plane, with rotary axes held or turning."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import MM_OR_RAD, Angle, Array, AxisCommands, Length, Motion
from elastogeo.observe.setup import SetupFact

Direction = tuple[float, float, float]

PLANES: dict[str, tuple[Direction, Direction]] = {
    "XY": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "YZ": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "ZX": ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)),
}
"""First and second direction of each plane; the angle counts from the first to the second (ISO 230-4)."""


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle about the workpiece ball, on which the angle of the readings counts.

    Attributes
    ----------
    radius : float [mm]
    plane : str or pair of 3-vectors
        `XY`, `YZ`, `ZX`, or the two orthogonal directions of a tilted plane.
    centre : mapping of str to float [mm, rad]
        Axis commands at the centre; an axis not named is at zero. Held rotary axes are named here.
    in_workpiece : bool
        Whether the plane is fixed to the (turning) workpiece rather than to the foundation.
    bar_turn : float
        How far the bar turns per angle of the reading: 1 for a circular path, 0 if it is the rotary axes that move.
    bar_start : float [rad]
        Angle of the bar where the readings' angle is zero.
    rotary_turn : mapping of str to float
        How far each moving rotary axis turns per angle of the reading.
    """

    radius: Length
    plane: str | tuple[Direction, Direction] = "XY"
    centre: AxisCommands = field(default_factory=dict)
    in_workpiece: bool = False
    bar_turn: float = 1.0
    bar_start: Angle = 0.0
    rotary_turn: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse a circle without radius or plane."""
        if not self.radius > 0:
            raise InputError(f"the radius of the circle is {self.radius:g} mm, it must be positive")
        plane_directions(self.plane)

    def motion(self, angle: Array, rate: float) -> Motion:
        """Where the tool is commanded to go at these angles, shape (m,) [rad], turning at `rate` [rad/s]."""
        first, second = plane_directions(self.plane)
        bar = self.bar_start + self.bar_turn * angle
        cosine, sine = self.radius * np.cos(bar), self.radius * np.sin(bar)
        speed = self.bar_turn * rate
        displacement = _combined(cosine, first, sine, second)
        return Motion(
            displacement=displacement,
            rate=_combined(cosine, speed * second, sine, -speed * first),
            acceleration=-(speed**2) * displacement,
            rotary={a: self.centre.get(a, 0.0) + turn * angle for a, turn in self.rotary_turn.items()},
            rotary_rate={axis: turn * rate for axis, turn in self.rotary_turn.items()},
            in_workpiece=self.in_workpiece,
        )


def circle_parameters(circle: Circle, loaded: bool) -> tuple[str, ...]:
    """What to ask of readings on a circle where nobody asks: compliance, geometry and location if loaded, else faults."""
    if isinstance(circle.plane, str) and not circle.rotary_turn:
        return (f"{'loaded' if loaded else 'ball-bar'}-{circle.plane.lower()}",)
    turning = "".join(circle.rotary_turn)
    geometry = ("E_[XYZ][XYZ][12]", "E_[ABC](0*)[XYZ]", *(f"E_[XYZ](*){axis}" for axis in turning))
    return (f"C_[XYZABC][XYZABC][XYZ{turning}]", *geometry) if loaded else geometry


def circle_facts(circle: Circle, feed: float) -> tuple[SetupFact, ...]:
    """What a reader wants to know of a circle: plane, radius, centre, feed [mm/s], and what turns along."""
    return (
        SetupFact("plane", circle.plane),
        SetupFact("radius", circle.radius, "mm"),
        SetupFact("centre", circle.centre, MM_OR_RAD),
        SetupFact("feed", feed, "mm_s"),
        *([SetupFact("rotary turn", circle.rotary_turn)] if circle.rotary_turn else []),
    )


def plane_directions(plane: str | tuple[Direction, Direction]) -> tuple[Array, Array]:
    """The two orthogonal unit directions of a plane.

    Raises
    ------
    InputError
        If the plane has no such name, or the directions are zero or not orthogonal.
    """
    if isinstance(plane, str):
        if plane not in PLANES:
            raise InputError(
                f"there is no plane {plane!r}; there are {', '.join(PLANES)}, or two directions of a tilted one"
            )
        return np.array(PLANES[plane][0]), np.array(PLANES[plane][1])
    first, second = (np.array(direction, dtype=float) for direction in plane)
    lengths = np.linalg.norm(first), np.linalg.norm(second)
    if not all(lengths) or abs(first @ second) > 1e-9 * lengths[0] * lengths[1]:
        raise InputError(f"the two directions of a plane must be orthogonal, got {plane}")
    return first / lengths[0], second / lengths[1]


def _combined(a: Array, first: Array, b: Array, second: Array) -> Array:
    """`a first + b second`, shape (m, 3), Fortran order."""
    return np.asarray((np.column_stack([first, second]) @ np.stack([a, b])).T)
