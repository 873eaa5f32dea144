"""The blocks of a program: what any numerical control can be told, whatever its language."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from elastogeo.machine.quantity import AxisCommands, Feed, Point2, Time

PLANE_AXES: Final = {"XY": ("X", "Y"), "YZ": ("Y", "Z"), "ZX": ("Z", "X")}
"""First and second axis of each plane of ISO 6983 (G17, G19, G18): counter-clockwise goes from the first to the second."""


@dataclass(frozen=True, slots=True)
class Rapid:
    """Go there as fast as the machine can; how the axes go is the control's business.

    Attributes
    ----------
    to : mapping of str to float [mm, rad]
        Axis commands at the end; an axis not named stays.
    """

    to: AxisCommands


@dataclass(frozen=True, slots=True)
class Line:
    """Go there at a feed, every axis in proportion.

    Attributes
    ----------
    to : mapping of str to float [mm, rad]
        Axis commands at the end; an axis not named stays.
    feed : float [mm/s]
        Of the linear axes together; where only rotary axes move, of these together [rad/s].
    """

    to: AxisCommands
    feed: Feed


@dataclass(frozen=True, slots=True)
class Arc:
    """Go there on an arc at a feed; axes out of the plane go along in proportion to the angle.

    Attributes
    ----------
    plane : str
        `XY`, `YZ` or `ZX`.
    to : mapping of str to float [mm, rad]
        Axis commands at the end; an axis not named stays. Where the end in the plane is the start, it is a full circle.
    centre : tuple of 2 float [mm]
        Commands of the plane's first and second axis at the centre.
    sense : int
        +1 counter-clockwise (G3), from the first axis to the second; -1 clockwise (G2).
    feed : float [mm/s]
        Of the linear axes together.
    turns : int
        1 for an arc of a full circle at most; each more is a full circle more.
    """

    plane: str
    to: AxisCommands
    centre: Point2
    sense: int
    feed: Feed
    turns: int = 1


@dataclass(frozen=True, slots=True)
class Dwell:
    """Stand still for a time [s]."""

    seconds: Time


@dataclass(frozen=True, slots=True)
class Stop:
    """Wait until the operator starts again; the message says what to do first."""

    message: str = ""


@dataclass(frozen=True, slots=True)
class Comment:
    """A line for people."""

    text: str


Move = Rapid | Line | Arc
Block = Rapid | Line | Arc | Dwell | Stop | Comment
