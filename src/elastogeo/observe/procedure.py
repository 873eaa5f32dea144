"""What a program does around the readings of a test: settings with a default, because no standard fixes them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

from elastogeo.errors import InputError
from elastogeo.machine import Angle, Feed, Length, Rate, Time
from elastogeo.observe.run import Run

ORDERS = ("listed", "counter-clockwise first", "by level")


@dataclass(frozen=True, slots=True)
class Procedure:
    """What a program does around the readings.

    Attributes
    ----------
    start : float or None [rad]
        Angle at which the readings of a full circle begin and end; None for 180 degrees, in ZX for 270: there the bar lies
        level, towards the negative end of an axis.
    overshoot : float or None [rad]
        That the circle goes on before and after the readings; None for 180 degrees around a full circle of linear axes, and
        2 degrees beside a part of one, or where rotary axes turn along.
    feed_in : float [mm]
        Outside of the circle, where every run begins and ends.
    approach : float [mm/s]
        Feed of radial and vertical moves near the set-up.
    feed : float [mm/s]
        Of moves between readings, for instruments whose set-up names none.
    rotary_feed : float [rad/s]
        The same of rotary axes.
    clearance : float [mm]
        Along Z, away from the workpiece, at which the machine comes to the set-up; less where its travel ends.
    change : float or None [s]
        To wait while the level of the load changes; None stops the program until the operator goes on.
    dwell : float [s]
        At every pose that is read at standstill.
    poses : int
        Poses of each motion of rotary axes (of a full turn) that are read at standstill, where the run does not list its
        own; 0 goes on without a halt.
    overrun : float [mm]
        That a linear axis passes the last target, to come back to it from the other side.
    overrun_angle : float [rad]
        The same of a rotary axis.
    order : str
        Of the runs: as `listed`, `counter-clockwise first`, or `by level`: all of one level together.
    chord : float [mm]
        By which lines may leave a circle that the control's arcs cannot make.
    between : float [mm]
        By which lines may leave the path between two poses.
    """

    start: Angle | None = None
    overshoot: Angle | None = None
    feed_in: Length = 1.5
    approach: Feed = 5.0
    feed: Feed = 1000.0 / 60
    rotary_feed: Rate = pi / 18
    clearance: Length = 50.0
    change: Time | None = None
    dwell: Time = 3.0
    poses: int = 36
    overrun: Length = 5.0
    overrun_angle: Angle = pi / 60
    order: str = "listed"
    chord: Length = 0.0002
    between: Length = 0.005

    def __post_init__(self) -> None:
        """Refuse what no machine can do."""
        if self.order not in ORDERS:
            raise InputError(f"the order of the runs is {self.order[:40]!r}; write one of {', '.join(ORDERS)}")
        if self.overshoot is not None and not 0 <= self.overshoot <= 2 * pi:
            raise InputError(
                f"the overshoot is {self.overshoot:.4g} rad; it must be 0 to a full turn: is it degrees given as radians?"
            )
        if self.start is not None and not abs(self.start) <= 2 * pi:
            raise InputError(
                f"the start angle is {self.start:.4g} rad; it must be within a full turn: is it degrees given as radians?"
            )
        positive = ("approach", "feed", "rotary_feed", "chord", "between")
        for name in (*positive, "feed_in", "clearance", "dwell", "poses", "overrun", "overrun_angle"):
            value = getattr(self, name)
            if not 0 <= value < float("inf") or (name in positive and not value):
                least = "above" if name in positive else "at least"
                raise InputError(f"{name} of the procedure is {value:g}; it must be a number, {least} 0")
        if self.change is not None and not 0 <= self.change < 1e6:
            raise InputError(f"the change of the load takes {self.change:g} s; give 0 to 1000000 s, or none to stop")


def ordered(runs: Sequence[Run], order: str) -> list[Run]:
    """The runs in the order in which they are made."""
    if order == "counter-clockwise first":
        return sorted(runs, key=lambda run: -run.sense)
    if order == "by level":
        levels = list(dict.fromkeys(map(_level, runs)))
        return sorted(runs, key=lambda run: levels.index(_level(run)))
    return list(runs)


def change_of_level(run: Run, last: Run | None) -> str:
    """What the operator sets before a run, in words; empty where it is as before."""
    if last is not None and _level(run) == _level(last):
        return ""
    if run.pressure is not None:
        return f"set the pressure to {run.pressure:g} bar"
    if run.force is not None:
        return f"set the force to {run.force:g} N"
    return ""


def _level(run: Run) -> tuple[float | None, float | None, float | None]:
    return run.force, run.pressure, run.engagement
