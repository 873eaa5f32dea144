"""Circles of a ball bar: planes, tilted planes, rotary axes held or turning, everywhere in the volume."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from elastogeo.errors import PathError
from elastogeo.machine import Array, Point
from elastogeo.observe import BallBar, Circle, LoadedBallBar, MachineTest, Question, Run
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.clearance import Flags, longest_arc
from elastogeo.planning.offers.means import Means, minutes
from elastogeo.planning.offers.proposal import Draft, proposes

LEAST_ARC = np.deg2rad(120.0)
"""Of a circle that the spindle and the post leave free."""

_KINDS = ("plane", "plane held", "tilted held", "turning", "turning")
"""What is drawn, each as often."""

_MOST_TURN = 0.5
"""How far an axis that does not turn endlessly goes per angle of the circle, at most."""

MakeSetup = Callable[[Circle, Means, Point], LoadedBallBar | BallBar]


@proposes("loaded-ball-bar")
def loaded_circles(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """Circles at every force level."""
    return _circles(means, random, "circle", lambda circle, m, tool: LoadedBallBar(circle, m.feed, tool), means.forces)


@proposes("ball-bar")
def circles(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """Circles without load, both ways."""
    return _circles(means, random, "free-circle", lambda circle, m, tool: BallBar(circle, m.feed, tool), ())


def _circles(
    means: Means, random: np.random.Generator, word: str, make: MakeSetup, forces: tuple[float, ...]
) -> Iterator[Draft]:
    """The three planes in the middle with each tool, then random ones without end."""
    for tool in means.tool_points:
        for plane in ("XY", "YZ", "ZX"):
            middle = {axis: sum(means.travel(axis)) / 2 for axis in means.linear}
            yield _draft(means, Circle(means.radii[-1], plane, middle), tool, word, make, forces)
    while True:
        tool = means.tool_points[random.integers(len(means.tool_points))]
        yield _draft(means, _drawn(means, random), tool, word, make, forces)


def _drawn(means: Means, random: np.random.Generator) -> Circle:
    """A random circle, which the machine may or may not be able to make."""
    radius = float(means.radii[random.integers(len(means.radii))])
    kinds = [kind for kind in _KINDS if (means.rotary and means.turnable) or kind in ("plane", "tilted held")]
    kinds = [kind for kind in kinds if means.turning or kind != "turning"]
    kind = kinds[random.integers(len(kinds))]
    plane = _tilted(random) if kind == "tilted held" or random.random() < 1 / 4 else _plane(random)
    place = means.somewhere(random, radius, random.uniform(0.2, 1.0) if kind == "turning" else 1.0)
    rotary = means.turned(random) if means.rotary and kind != "plane" else {}
    circle = Circle(radius, plane, place | rotary)
    return _turning(means, random, circle) if kind == "turning" else circle


def _turning(means: Means, random: np.random.Generator, circle: Circle) -> Circle:
    """The same with one rotary axis or all of them moving along, the bar going around or keeping its direction."""
    axes = means.turnable if random.random() < 1 / 3 else (means.turnable[random.integers(len(means.turnable))],)
    centre, turn = dict(circle.centre), {}
    for axis in axes:
        low, high = means.machine.joints[means.machine.index(axis)].travel
        if high - low >= 4 * np.pi:
            turn[axis] = float(random.choice([-1.0, 1.0]))
            continue
        span = min(_MOST_TURN, (high - low) / (2 * np.pi)) * random.uniform(0.4, 1.0)
        turn[axis] = float(span)
        centre[axis] = float(random.uniform(low, high - 2 * np.pi * span))
    return replace(
        circle,
        centre=centre,
        rotary_turn=turn,
        bar_turn=float(random.integers(2)),
        bar_start=float(random.uniform(0, 2 * np.pi)),
        in_workpiece=bool(random.random() < 1 / 4),
    )


def _draft(means: Means, circle: Circle, tool: Point, word: str, make: MakeSetup, forces: tuple[float, ...]) -> Draft:
    """The candidate of a circle: all of it, or the arc that is free; None if that is too short or out of the travel."""
    setup = make(circle, means, tool)
    angle = np.linspace(0.0, 2 * np.pi, means.readings, endpoint=False)
    try:
        seen = setup.observe(means.machine, _run("free", angle, forces[0] if forces else None))
    except PathError:
        return None
    if not means.within(seen.commands):
        return None
    free = means.clearance.free(means.machine, seen)
    # a motion of a rotary axis need not close: an arc of it does not go around the end
    first, count = _unbroken(free) if circle.rotary_turn else longest_arc(free)
    arc = 2 * np.pi * count / means.readings
    if arc < LEAST_ARC:
        return None
    if count < means.readings:
        angle = angle[first] + np.linspace(0.0, arc - 2 * np.pi / means.readings, means.readings)
    runs = [_run(f"{force:g} N", angle, force) for force in forces] or [_run(s, angle, None, s) for s in ("ccw", "cw")]
    test = MachineTest(word, means.machine, setup, tuple(runs), Question(("compliance",) if forces else ()))
    return Candidate(word, test, minutes(len(runs), arc * circle.radius, means.feed))


def _unbroken(free: Flags) -> tuple[int, int]:
    """First reading and length of the longest unbroken part that does not go around the end."""
    edges = np.diff(np.concatenate([[0], free.astype(int), [0]]))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    if not len(starts):
        return 0, 0
    best = int(np.argmax(ends - starts))
    return int(starts[best]), int(ends[best] - starts[best])


def _run(name: str, angle: Array, force: float | None, way: str = "ccw") -> Run:
    sense = -1 if way == "cw" else 1
    return Run(name, {"angle": angle[::sense], "radial": np.zeros(len(angle))}, force=force, sense=sense)


def _plane(random: np.random.Generator) -> str:
    return ("XY", "YZ", "ZX")[random.integers(3)]


def _tilted(random: np.random.Generator) -> tuple[Point, Point]:
    """Two orthogonal directions, at random."""
    frame, _ = np.linalg.qr(random.standard_normal((3, 3)))
    first, second = (tuple(float(part) for part in frame[:, k]) for k in range(2))
    return (first[0], first[1], first[2]), (second[0], second[1], second[2])
