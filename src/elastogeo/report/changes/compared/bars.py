"""A small bar for each difference, about zero: the change, its interval, and what is expected."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite

from elastogeo.changes import IndicatorDifference, ParameterDifference
from elastogeo.identification import SIGNIFICANT
from elastogeo.report.drawing.plots import Band, Line, Mark, Plot, Shape

WIDTH, HEIGHT = 200.0, 22.0
_LEAST = 1.4
"""Of half a bar: what is expected fills no more than the middle."""

Ends = tuple[float, float]


def indicator_bars(differences: Sequence[IndicatorDifference]) -> tuple[Plot, ...]:
    """Each in halves of what is expected of it, so that all have one scale; without that, of its own uncertainty."""
    rows = []
    for one in differences:
        half = _half(one)
        interval = one.change.interval() if one.change.known else (one.change.value, one.change.value)
        expected = None if one.expected is None else (one.expected[0] / half, one.expected[1] / half)
        value = one.change.value / half
        tone = "soft" if one.within else "care" if one.within is False else "ink"
        rows.append((value, (interval[0] / half, interval[1] / half), expected, tone))
    reach = _reach(abs(end) for value, ends, expected, _ in rows for end in (value, *ends, *(expected or ())))
    return tuple(_bar(value, ends, expected, tone, reach) for value, ends, expected, tone in rows)


def parameter_bars(differences: Sequence[ParameterDifference]) -> tuple[Plot, ...]:
    """Each as what it does to the trace; of readings that are angles in units of its own uncertainty."""
    level = SIGNIFICANT / max(len(differences), 1)
    in_um = all(one.distortion is not None for one in differences)
    rows = []
    for one in differences:
        change = one.difference.change
        scale = one.distortion if in_um and one.distortion is not None else 1 / (change.expanded() or 1.0)
        low, high = change.interval()
        tone = "ink" if one.difference.p_value < level else "soft"
        rows.append((change.value * scale, (low * scale, high * scale), tone))
    reach = _reach((abs(end) for _, ends, _ in rows for end in ends), 0.0)
    return tuple(_bar(value, ends, None, tone, reach) for value, ends, tone in rows)


def _half(one: IndicatorDifference) -> float:
    if one.expected is not None:
        half = (one.expected[1] - one.expected[0]) / 2
    else:
        half = one.change.expanded() if one.change.known else abs(one.change.value)
    return half if isfinite(half) and half > 0 else 1.0


def _reach(sizes: Iterable[float], least: float = _LEAST) -> float:
    """What half of a bar stands for."""
    return max([least, *(1.06 * size for size in sizes if isfinite(size))]) or 1.0


def _bar(value: float, ends: Ends, expected: Ends | None, tone: str, reach: float) -> Plot:
    def x(at: float) -> float:
        return WIDTH / 2 * (1 + max(-1.0, min(1.0, at / reach)))

    middle = HEIGHT / 2
    shapes: list[Shape] = []
    if expected is not None:
        left, right = x(expected[0]), x(expected[1])
        shapes.append(Band(((left, 3.0), (right, 3.0), (right, HEIGHT - 3), (left, HEIGHT - 3))))
    shapes.append(Line(((WIDTH / 2, 0.0), (WIDTH / 2, HEIGHT)), "line"))
    shapes.append(Line(((WIDTH / 2, middle), (x(value), middle)), tone, 5.0))
    shapes.append(Line(((x(ends[0]), middle), (x(ends[1]), middle)), tone, 1.4))
    shapes += [Line(((x(end), middle - 4), (x(end), middle + 4)), tone, 1.4) for end in ends]
    shapes.append(Mark(x(value), middle, tone, "diamond" if tone == "care" else "circle", 3.0))
    return Plot(WIDTH, HEIGHT, tuple(shapes))
