"""Of a positioning test (ISO 230-2): scale, reversal, systematic deviation of the axis."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf, isfinite, sqrt

import numpy as np

from elastogeo.changes.indicators.register import indicates
from elastogeo.changes.kinds import KINDS
from elastogeo.changes.series import Indicator
from elastogeo.identification import PositioningResults


@indicates(PositioningResults)
def of_a_positioning_test(result: PositioningResults) -> tuple[Indicator, ...]:
    """Reversal, scale and systematic deviation, where the axis was read along itself."""
    return tuple(_read_along(result)) if result.along else tuple(_read_across(result))


def _read_along(result: PositioningResults) -> Iterator[Indicator]:
    kind = "angular " if result.angular else ""
    yield from _value(result, "mean B", f"{kind}backlash", f"backlash {result.axis}", -1.0)
    slope = _slope(result)
    if slope is not None and not result.rotary:
        yield Indicator(f"scale {result.axis}", KINDS["scale"], *slope)
    yield from _systematic(result, f"{kind}positioning", f"systematic deviation {result.axis}")


def _read_across(result: PositioningResults) -> Iterator[Indicator]:
    kind, called = ("angular positioning", "angular deviation") if result.angular else ("straightness", "straightness")
    yield from _systematic(result, kind, f"{called} {result.axis}")


def _systematic(result: PositioningResults, kind: str, called: str) -> Iterator[Indicator]:
    """E of both directions of approach, else of the one that was run, which is another value and has another name."""
    for name, side in (("E", ""), ("E+", "+"), ("E-", "-")):
        if name in result.values:
            yield from _value(result, name, kind, called + side)
            return


def _value(result: PositioningResults, name: str, kind: str, called: str, sign: float = 1.0) -> Iterator[Indicator]:
    found = result.values.get(name)
    if found is not None and np.isfinite(found.value):
        u = inf if found.estimate is None else sqrt(max(found.estimate.standard_uncertainty**2 - found.measurement**2, 0.0))
        yield Indicator(called, KINDS[kind], sign * found.value, u)


def _slope(result: PositioningResults) -> tuple[float, float] | None:
    """Of the mean deviations over the targets, and its standard deviation by the approaches; None if there are not two."""
    found = result.targets
    read = found.count > 0
    both = read.all(axis=1)
    shown = both if both.any() else read.any(axis=1)
    if np.sum(shown) < 2:
        return None
    off = found.target[shown] - found.target[shown].mean()
    weight, sides = off / float(off @ off), np.sum(read[shown], axis=1)
    middle = np.sum(np.where(read, found.mean, 0.0)[shown], axis=1) / sides
    scatter = np.where(read, found.deviation**2 / np.maximum(found.count, 1.0), 0.0)[shown]
    u = float(np.sqrt(weight**2 @ (np.sum(scatter, axis=1) / sides**2)))
    return float(weight @ middle), u if isfinite(u) else inf
