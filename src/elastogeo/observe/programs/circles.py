"""The program of a test on a circle: feed in, overshoot, the circle that is read, overshoot, feed out, for every run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import ceil, pi, radians

import numpy as np

from elastogeo.machine import (
    PLANE_AXES,
    PROGRAM_AXES,
    Arc,
    Array,
    Block,
    Comment,
    Dwell,
    Line,
    Machine,
    Stop,
    follow,
)
from elastogeo.observe.circle import Circle
from elastogeo.observe.procedure import Procedure, change_of_level, ordered
from elastogeo.observe.programs.poses import approach, axis_words, movable, retreat
from elastogeo.observe.run import Run

PART_OVERSHOOT = radians(2.0)
"""Overshoot beside a part of a circle, and where rotary axes turn along, by default."""

FULL = 0.98
"""Share of a turn, a reading's step included, from which a run is a full circle."""

_SAME = 1e-9
_SAMPLES = 721
_TURN = radians(1.0)


@dataclass(frozen=True, slots=True)
class CircleTest:
    """What the program of a test on a circle needs to know.

    Attributes
    ----------
    machine : Machine
    circle : Circle
    feed : float [mm/s]
        Along the circle, of a run that names none.
    tool : array, shape (3,) [mm], or None
        As of `follow`.
    title : str
        Of the instrument, for the operator.
    set_up : tuple of str
        What the operator sets up first, in words.
    put_in : str
        What the operator does when the machine stands outside the circle, in words.
    """

    machine: Machine
    circle: Circle
    feed: float
    tool: Array | None
    title: str
    set_up: tuple[str, ...] = ()
    put_in: str = ""


def circle_blocks(test: CircleTest, runs: Sequence[Run], procedure: Procedure) -> list[Block]:
    """The blocks of all runs of a test on a circle, each with the radius of its engagement.

    Raises
    ------
    PathError
        If the linear axes cannot reach the path, or an axis would leave its travel.
    """
    made = [_Way(test, run, procedure) for run in ordered(runs, procedure.order)]
    blocks: list[Block] = [*_heading(test, procedure), *approach(test.machine, made[0].outside(made[0].begin), procedure)]
    if test.put_in:
        blocks.append(Stop(test.put_in))
    last: _Way | None = None
    for way in made:
        blocks.append(Comment(f"run {way.run.name}, {'counter-clockwise' if way.run.sense > 0 else 'clockwise'}"))
        if last is not None:
            blocks += last.back_to(way)
        change = change_of_level(way.run, None if last is None else last.run)
        if change:
            blocks.append(Stop(change) if procedure.change is None else Comment(change))
            blocks += [Dwell(procedure.change)] if procedure.change else []
        blocks += way.blocks()
        last = way
    assert last is not None
    blocks += [Stop("take the instrument out"), *retreat(test.machine, last.outside(last.end), procedure)]
    return blocks


def _heading(test: CircleTest, procedure: Procedure) -> Iterator[Block]:
    circle = test.circle
    plane = circle.plane if isinstance(circle.plane, str) else "tilted"
    yield Comment(f"{test.title}, plane {plane}, radius {circle.radius:.6g} mm")
    at = {axis: circle.centre.get(axis, 0.0) for axis in movable(test.machine)}
    yield Comment(f"centre of the workpiece ball where the tool ball is at {axis_words(at)}")
    yield Comment("work offset: every axis zero where the machine file counts from")
    for line in test.set_up:
        yield Comment(line)
    yield Comment(
        f"feed in from {procedure.feed_in:g} mm outside, Z {procedure.clearance:g} mm up on the way there, check both"
    )
    yield Stop("spindle locked, way free, tool ball not in its cup")


class _Way:
    """The way of one run, by the angle of its readings."""

    def __init__(self, test: CircleTest, run: Run, procedure: Procedure) -> None:
        self.test, self.run, self.procedure = test, run, procedure
        self.path = replace(test.circle, radius=test.circle.radius - (run.engagement or 0.0))
        self.rate = (run.feed or test.feed) / self.path.radius
        low, high, full = _read(run, test.circle, procedure)
        whole = pi if full and not test.circle.rotary_turn else PART_OVERSHOOT
        over = whole if procedure.overshoot is None else procedure.overshoot
        reads = (low, high)[:: run.sense]
        self.begin, self.end = reads[0] - run.sense * over, reads[1] + run.sense * over
        self.angles = [self.begin, *reads, self.end] if over else list(reads)

    def blocks(self) -> Iterator[Block]:
        """From outside to outside."""
        feed = self.procedure.approach
        if self.procedure.feed_in or self.run.engagement:
            yield Line(self.at(self.path, self.begin), feed)
        for number, (one, other) in enumerate(zip(self.angles, self.angles[1:], strict=False)):
            if len(self.angles) > 2 and number == 1:
                yield Comment(f"readings of run {self.run.name}")
            yield from self.along(self.path, one, other)
        if self.procedure.feed_in or self.run.engagement:
            yield Line(self.outside(self.end), feed)

    def back_to(self, other: _Way) -> Iterator[Block]:
        """Outside of the circle, from the end of this run to the beginning of another."""
        to = other.begin
        if not self.test.circle.rotary_turn:
            to -= 2 * pi * round((to - self.end) / (2 * pi))
        if abs(to - self.end) > _SAME:
            yield from self.along(self.outer, self.end, to)

    @property
    def outer(self) -> Circle:
        """The circle from which runs begin."""
        return replace(self.test.circle, radius=self.test.circle.radius + self.procedure.feed_in)

    def outside(self, angle: float) -> dict[str, float]:
        """Commands of every axis outside of the circle."""
        return self.at(self.outer, angle)

    def at(self, path: Circle, angle: float) -> dict[str, float]:
        """Commands of every axis at an angle."""
        return self._named(self._positions(path, np.array([angle]))[0])

    def along(self, path: Circle, one: float, other: float) -> Iterator[Block]:
        """From one angle to another, by an arc where the axes make one, else by lines."""
        arc = _arc_of(self.test.machine, path, self.test.tool)
        feed = self.rate * self.path.radius
        if arc is None:
            yield from self._lines(path, one, other)
            return
        plane, centre, sense = arc
        way = abs(other - one) * abs(path.bar_turn)
        turns = max(ceil(way / (2 * pi) - _SAME), 1)
        goes = sense * (1 if (other - one) * path.bar_turn > 0 else -1)
        yield Arc(plane, self.at(path, other), centre, goes, feed, turns)

    def _lines(self, path: Circle, one: float, other: float) -> Iterator[Block]:
        dense = self._positions(path, np.linspace(one, other, _SAMPLES))
        step = abs(other - one) / (_SAMPLES - 1)
        linear = [k for k, axis in enumerate(self.test.machine.axes) if axis in "XYZ"]
        bend = float(np.linalg.norm(np.diff(dense[:, linear], n=2, axis=0), axis=1).max()) / step**2
        rotary = max((abs(turn) for turn in path.rotary_turn.values()), default=0.0)
        most = min((8 * self.procedure.chord / bend) ** 0.5 if bend else np.inf, _TURN / rotary if rotary else np.inf)
        count = max(ceil(abs(other - one) / most), 1)
        places = self._positions(path, np.linspace(one, other, count + 1))
        time = abs(other - one) / count / self.rate
        moves = np.diff(places, axis=0)
        length = np.linalg.norm(moves[:, linear], axis=1)
        turned = np.linalg.norm(np.delete(moves, linear, axis=1), axis=1)
        feeds = np.where(length > 0, length, turned) / time
        for place, feed in zip(places[1:], feeds.tolist(), strict=True):
            yield Line(self._named(place), feed)

    def _positions(self, path: Circle, angle: Array) -> Array:
        return follow(self.test.machine, path.centre, path.motion(angle, self.rate), self.test.tool).position

    def _named(self, row: Array) -> dict[str, float]:
        return {axis: float(v) for axis, v in zip(self.test.machine.axes, row, strict=True) if axis in PROGRAM_AXES}


def start_angle(circle: Circle, procedure: Procedure) -> float:
    """Where the readings of a full circle begin [rad]."""
    if procedure.start is not None:
        return procedure.start
    return 1.5 * pi if circle.plane == "ZX" else pi


def _read(run: Run, circle: Circle, procedure: Procedure) -> tuple[float, float, bool]:
    """Least and greatest angle of the readings of a run, and whether they go all around.

    Where rotary axes turn along, an angle and the same a turn later are two poses: they begin where the run says.
    """
    start = start_angle(circle, procedure)
    angle = run.columns.get("angle")
    if angle is None or not len(angle):
        return start, start + 2 * pi, True
    low, span = float(angle.min()), float(np.ptp(angle))
    if span * (1 + 1 / max(len(angle) - 1, 1)) < FULL * 2 * pi:
        return low, low + span, False
    if circle.rotary_turn and procedure.start is None:
        start = low
    return start, start + 2 * pi, True


def _arc_of(machine: Machine, circle: Circle, tool: Array | None) -> tuple[str, tuple[float, float], int] | None:
    """Plane, centre and sense of the arc that the axis commands make; None where they make no arc of a plane.

    With the rotary axes held, the commands are affine in the displacement: `c + a cos + b sin`. They are an arc where a and
    b are of one length, at right angles, and within two axes.
    """
    if circle.rotary_turn or not circle.bar_turn:
        return None
    angle = np.array([0.0, pi / 2, pi]) / circle.bar_turn - circle.bar_start / circle.bar_turn
    one, quarter, half = follow(machine, circle.centre, circle.motion(angle, 1.0), tool).position
    centre = (one + half) / 2
    a, b = one - centre, quarter - centre
    close = 1e-9 * circle.radius
    if abs(np.linalg.norm(a) - np.linalg.norm(b)) > close or abs(a @ b) > close * circle.radius:
        return None
    for plane, axes in PLANE_AXES.items():
        if not set(axes) <= set(machine.axes):
            continue
        first, second = (machine.index(axis) for axis in axes)
        rest = np.delete(np.abs(np.stack([a, b])), [first, second], axis=1)
        if rest.max(initial=0.0) <= close:
            turn = a[first] * b[second] - a[second] * b[first]
            return plane, (float(centre[first]), float(centre[second])), 1 if turn > 0 else -1
    return None
