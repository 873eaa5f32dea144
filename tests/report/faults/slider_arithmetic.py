"""What a page computes from the columns of its sliders, in plain Python: the arithmetic of `what-if.js`, step for step.

Apart from the program: the minimum zone by an exchange of four readings (Stiefel 1959), where the program solves linear
programmes.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, hypot, radians, sin, tau
from typing import Any

import numpy as np

GAP = radians(10.0) * (1 + 1e-9)


def corrected(run: dict[str, Any], factors: Sequence[float]) -> list[float]:
    """What would be measured with so much of each cause [um]."""
    parts = zip(run["columns"], factors, strict=True)
    left = list(run["measured"])
    for column, factor in parts:
        for i, value in enumerate(column):
            left[i] -= (1 - factor) * value
    return left


def circular_deviation(run: dict[str, Any], radial: Sequence[float], radius: float) -> float:
    """G [um]: two concentric circles of least difference enclose the path."""
    distance = _settled(run, radial, radius, _minimum_zone)
    return max(distance) - min(distance)


def radial_deviation(run: dict[str, Any], radial: Sequence[float], radius: float) -> tuple[float, float]:
    """F least and greatest [um], about the least-squares centre."""
    distance = _settled(run, radial, radius, _least_squares)
    return min(distance) - 1000 * radius, max(distance) - 1000 * radius


def _settled(run: dict[str, Any], radial: Sequence[float], radius: float, step: Any) -> list[float]:
    points = [
        ((1000 * radius + r) * cos(radians(deg)), (1000 * radius + r) * sin(radians(deg)))
        for deg, r in zip(run["deg"], radial, strict=True)
    ]
    centre, last = (0.0, 0.0), float("inf")
    while True:
        seen = [(x - centre[0], y - centre[1]) for x, y in points]
        distance = [hypot(x, y) for x, y in seen]
        angle = [atan2(y, x) for x, y in seen]
        move = step(distance, [(cos(a), sin(a)) for a in angle], _weights(angle))
        size = hypot(*move)
        if not size < last / 2 or size < 1e-9:
            return distance
        centre, last = (centre[0] + move[0], centre[1] + move[1]), size


def _weights(angle: Sequence[float]) -> list[float]:
    turned = [a % tau for a in angle]
    order = sorted(range(len(turned)), key=turned.__getitem__)
    gaps = [(turned[order[(k + 1) % len(order)]] - turned[i]) % tau for k, i in enumerate(order)]
    gaps = [0.0 if gap > GAP else gap for gap in gaps]
    weight = [0.0] * len(angle)
    for k, i in enumerate(order):
        weight[i] = gaps[k] + gaps[k - 1]
    return weight


def _least_squares(distance: Sequence[float], direction: Sequence[tuple[float, float]], weight: Sequence[float]) -> Any:
    design = np.array([(x, y, 1.0) for x, y in direction])
    w = np.array(weight)[:, None]
    return np.linalg.solve(design.T @ (w * design), design.T @ (w[:, 0] * np.array(distance)))[:2]


def _minimum_zone(distance: Sequence[float], direction: Sequence[tuple[float, float]], _weight: Sequence[float]) -> Any:
    count = len(distance)
    middle = sum(distance) / count
    value = [d - middle for d in distance]
    chosen = [0, count // 4, count // 2, 3 * count // 4]
    x, h = _fitted(chosen, value, direction)
    for _ in range(200):
        left = [v - u[0] * x[0] - u[1] * x[1] - x[2] for v, u in zip(value, direction, strict=True)]
        worst = max(range(count), key=lambda i: abs(left[i]))
        if abs(left[worst]) <= h + 1e-9:
            break
        trials = [[worst, *chosen[:k], *chosen[k + 1 :]] for k in range(4)]
        chosen = max(trials, key=lambda four: _fitted(four, value, direction)[1])
        x, h = _fitted(chosen, value, direction)
    return x[:2]


def _fitted(four: Sequence[int], value: Sequence[float], direction: Sequence[tuple[float, float]]) -> Any:
    """The centre, radius and half width of the zone of four readings."""
    rows = [(*direction[i], 1.0) for i in four]
    share = [(-1) ** k * float(np.linalg.det([row for j, row in enumerate(rows) if j != k])) for k in range(4)]
    total = sum(map(abs, share))
    if total < 1e-15:
        return np.zeros(3), -1.0
    h = sum(s * value[i] for s, i in zip(share, four, strict=True)) / total
    out = max(range(4), key=lambda k: abs(share[k]))
    kept = [k for k in range(4) if k != out]
    sides = [value[four[k]] - (1 if share[k] >= 0 else -1) * h for k in kept]
    return np.linalg.solve([rows[k] for k in kept], sides), abs(h)
