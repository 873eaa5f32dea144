"""The concentric circles that enclose a path: about the centre of least separation, of least squares, or of the set-up."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.machine import Array

Centre = Literal["minimum-zone", "least-squares", "set-up"]
Step = Callable[[Array, Array, Array], Array]

MAX_GAP = math.radians(10.0)
"""A circle is full if no two neighbouring readings are farther apart."""
LEAST_ARC = math.pi
"""A centre needs an arc of at least this: a shorter one does not hold it from all sides, and G would come out too small."""

_STEPS = 50
_ADDED = 50


@dataclass(frozen=True, slots=True)
class Path:
    """Where the tool went in one run.

    Attributes
    ----------
    angle : array, shape (m,) [rad]
        From the centre of the test, in any order, over any number of turns.
    radial : array, shape (m,) [mm]
        Distance from the centre less the nominal radius (what a ball bar reads).

    Raises
    ------
    InputError
        If the shapes differ, there are fewer than three readings, or one is no finite number.
    """

    angle: Array
    radial: Array

    def __post_init__(self) -> None:
        angle, radial = np.asarray(self.angle, dtype=np.float64), np.asarray(self.radial, dtype=np.float64)
        if angle.ndim != 1 or angle.shape != radial.shape or len(angle) < 3:
            raise InputError(
                f"a path needs angle and radial of one length from 3 on, got shapes {angle.shape}, {radial.shape}"
            )
        if not (np.isfinite(angle).all() and np.isfinite(radial).all()):
            raise InputError("a path has an angle or a radial reading that is no finite number; take the reading out")
        object.__setattr__(self, "angle", angle)
        object.__setattr__(self, "radial", radial)


@dataclass(frozen=True, slots=True)
class EnclosedPath:
    """A path between two concentric circles.

    Attributes
    ----------
    centre : tuple of 2 float [mm]
        Their centre, from the centre of the test.
    radial : float [mm]
        Mean distance of the path from that centre less the nominal radius.
    separation : float [mm]
        Difference of their radii.
    f_max, f_min : float [mm]
        Greatest and least distance of the path from that centre less the nominal radius.
    """

    centre: tuple[float, float]
    radial: float
    separation: float
    f_max: float
    f_min: float


def arc_of(angle: Array) -> float:
    """The arc [rad] that readings at these angles, shape (m,) [rad], cover: the full turn less their widest gap.

    A full circle (no gap over `MAX_GAP`) gives exactly `2 pi`.
    """
    sorted_angle = np.sort(np.mod(angle, math.tau))
    gap = float(np.max(np.diff(sorted_angle, append=sorted_angle[0] + math.tau)))
    return math.tau if gap <= MAX_GAP * (1 + 1e-9) else math.tau - gap


def enclosed(paths: Sequence[Path], radius: float, centre: Centre) -> EnclosedPath:
    """The circles that enclose one path, or several together.

    Parameters
    ----------
    paths : sequence of Path
    radius : float [mm]
        Nominal radius of the test.
    centre : {"minimum-zone", "least-squares", "set-up"}

    Returns
    -------
    EnclosedPath

    Raises
    ------
    UnsupportedError
        If a centre is to be found on an arc of less than `LEAST_ARC`.
    InputError
        If the radius is not above zero, a path leaves it by more than half of it, or the centre has another name.

    Notes
    -----
    Distances are exact, not to first order in the eccentricity: the linear problem (least squares, or for the minimum zone
    the Chebyshev problem `min h, |d_i - u_i . c - r| <= h` as a linear programme) is solved again about each centre it
    finds, `d_i` the distance and `u_i` the direction of the path's point i, until the centre stands still.
    Means and squares are over the path, not over its readings: each counts for the arc between it and its neighbours, so
    that an overshoot, or a first and last reading at one place, do not count twice. All paths count the same.
    """
    if not (math.isfinite(radius) and radius > 0):
        raise InputError(f"the nominal radius is {radius!r} mm; it must be above zero")
    if not all(np.all(np.abs(path.radial) < radius / 2) for path in paths):
        raise InputError("radial readings are of the size of the nominal radius; they must be deviations from it, in mm")
    steps = {"minimum-zone": _minimum_zone_step, "least-squares": _least_squares_step, "set-up": None}
    if centre not in steps:
        raise InputError(f"the centre {centre!r} is not known; choose one of {', '.join(steps)}")
    points = [(radius + p.radial)[:, None] * np.column_stack([np.cos(p.angle), np.sin(p.angle)]) for p in paths]
    found = np.zeros(2)
    step = steps[centre]
    if step is not None:
        _check_arc(paths, centre)
        found = _found(points, radius, step)
    distance, _, weight = _about(points, found)
    highest, lowest = float(distance.max()), float(distance.min())
    return EnclosedPath(
        centre=(float(found[0]), float(found[1])),
        radial=float(weight @ (distance - radius)),
        separation=highest - lowest,
        f_max=highest - radius,
        f_min=lowest - radius,
    )


def _check_arc(paths: Sequence[Path], centre: Centre) -> None:
    arc = arc_of(np.concatenate([path.angle for path in paths]))
    if arc < LEAST_ARC:
        raise UnsupportedError(
            f"the {centre} centre needs an arc of {math.degrees(LEAST_ARC):.0f} deg or more, the path covers "
            f"{math.degrees(arc):.4g} deg; take the set-up's centre"
        )


def _weights(angle: Array) -> Array:
    """The share of the path that each reading stands for, shape (m,), of sum 1."""
    turned = np.mod(angle, math.tau)
    order = np.argsort(turned)
    gaps = np.diff(turned[order], append=turned[order[0]] + math.tau)
    gaps[gaps > MAX_GAP * (1 + 1e-9)] = 0.0
    weight = np.empty(len(angle))
    weight[order] = gaps + np.roll(gaps, 1)
    total = weight.sum()
    return weight / total if total > 0 else np.full(len(angle), 1.0 / len(angle))


def _about(points: Sequence[Array], centre: Array) -> tuple[Array, Array, Array]:
    """Distance, direction, shape (m, 2), and share of the paths, of all points as seen from a centre."""
    offsets = [those - centre for those in points]
    weights = [_weights(np.arctan2(offset[:, 1], offset[:, 0])) for offset in offsets]
    offset = np.concatenate(offsets)
    distance = np.hypot(offset[:, 0], offset[:, 1])
    return distance, offset / distance[:, None], np.concatenate(weights) / len(weights)


def _found(points: Sequence[Array], radius: float, step: Step) -> Array:
    """The centre at which `step` makes no more difference, shape (2,)."""
    centre, last = np.zeros(2), math.inf
    for _ in range(_STEPS):
        move = step(*_about(points, centre))
        size = float(np.hypot(move[0], move[1]))
        if not size < last / 2:
            break
        centre, last = centre + move, size
        if size <= np.finfo(float).eps * radius:
            break
    return centre


def _least_squares_step(distance: Array, direction: Array, weight: Array) -> Array:
    """Weighted least squares of `d_i = u_i . c + r`: c, shape (2,)."""
    root = np.sqrt(weight)
    design = np.column_stack([direction, np.ones(len(distance))]) * root[:, None]
    solution: Array = np.linalg.lstsq(design, (distance - distance.mean()) * root, rcond=None)[0]
    return solution[:2]


def _minimum_zone_step(distance: Array, direction: Array, _weight: Array) -> Array:
    """Chebyshev's `min h, |d_i - u_i . c - r| <= h`: c, shape (2,).

    Solved on the readings that stand out, to which those that the solution leaves outside are added until there are none:
    the solution is that of all readings.
    """
    from scipy.optimize import linprog

    scale = float(np.ptp(distance))
    if scale == 0.0:
        return np.zeros(2)
    value = (distance - distance.mean()) / scale
    design = np.column_stack([direction, np.ones(len(distance))])
    kept = _outstanding(value, direction)
    while True:
        rows, sides = design[kept], value[kept]
        limit = -np.ones((len(kept), 1))
        solved = linprog(
            [0.0, 0.0, 0.0, 1.0],
            A_ub=np.block([[rows, limit], [-rows, limit]]),
            b_ub=np.concatenate([sides, -sides]),
            bounds=[(None, None)] * 3 + [(0.0, None)],
            method="highs",
        )
        if solved.x is None:
            raise UnsupportedError("no circles enclose the path; its readings are not those of one circle")
        outside = np.abs(value - design @ solved.x[:3]) - solved.x[3]
        outside[kept] = 0.0
        worst = np.argsort(outside)[-_ADDED:]
        worst = worst[outside[worst] > 1e-9]
        if not len(worst):
            return np.asarray(solved.x[:2] * scale)
        kept = np.concatenate([kept, worst])


def _outstanding(value: Array, direction: Array) -> Array:
    """Indices of the highest and the lowest reading in each of 36 sectors."""
    sector = np.floor((np.arctan2(direction[:, 1], direction[:, 0]) + math.pi) / math.radians(10.0))
    order = np.lexsort([value, sector])
    first = np.flatnonzero(np.diff(sector[order], prepend=-1.0))
    return np.unique(np.concatenate([order[first], order[np.append(first[1:], len(order)) - 1]]))
