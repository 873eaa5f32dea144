"""What a chart of an indicator shows: its time, its values, its limits, and where its words find room."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite

import numpy as np

from elastogeo.changes import ChangeVerdict, IndicatorState
from elastogeo.report.changes.points import ASIDE, Point

_AHEAD = 0.3
"""Of the time shown, how far a drift is drawn beyond the last test, at most."""
_REACH = 0.6
"""Of the range that the tests take, within which a limit is drawn; one further off is named at the edge."""


def time_shown(verdict: ChangeVerdict, one: IndicatorState, points: Sequence[Point]) -> tuple[float, float]:
    """From when to when [d]: all tests, the events among them, and the drift that goes on, with a little room."""
    at = [point.date for point in points] or [verdict.now]
    first, last = min(at), max(at)
    inside = [event.date for event in verdict.events if event.date >= first]
    last = max([last, *(day for day in inside if day <= verdict.now)])
    span = max(last - first, 7.0)
    if one.drift is not None:
        wanted = one.drift.limit_at_interval[1] if one.drift.limit_at is not None else last
        last += min(max(wanted - last, 0.12 * span), _AHEAD * span) if isfinite(wanted) else _AHEAD * span
    return first - 0.03 * span, last + 0.03 * span


def values_shown(one: IndicatorState, points: Iterable[Point], below: float = 0.2) -> tuple[float, float]:
    """From which to which value, in the unit of the kind, with room for letters `below`, a share of them.

    What is expected and limits nearby are shown; a test that is set aside may lie outside.
    """
    stands = [point.value for point in points if isfinite(point.value) and point.mark != ASIDE]
    places = [point.place for point in points]
    expected = one.expected[places]
    every = [*stands, *expected[np.isfinite(expected)].tolist()]
    if isfinite(one.mean):
        every.append(one.mean)
    every = every or [point.value for point in points if isfinite(point.value)] or [0.0]
    low, high = min(every), max(every)
    span = (high - low) or abs(high) or 1.0
    for wall in walls_of(one):
        if low - _REACH * span <= wall <= high + _REACH * span:
            low, high = min(low, wall), max(high, wall)
    span = (high - low) or abs(high) or 1.0
    return low - below * span, high + 0.07 * span


def walls_of(one: IndicatorState) -> list[float]:
    """What the indicator must not pass: its tolerance, and what its drift runs into."""
    walls = [one.lower, one.upper, *([] if one.drift is None else [one.drift.limit])]
    return list(dict.fromkeys(wall for wall in walls if isfinite(wall)))


def wall_said(one: IndicatorState, wall: float) -> str:
    """What a limit is: `tolerance`, or from when on a change matters."""
    return "tolerance" if wall in (one.lower, one.upper) else "matters from"


def apart(wanted: Sequence[float]) -> list[float]:
    """Places at least one line from each other, as near to those that are wanted as may be; they come in order."""
    placed: list[list[float]] = []
    for at in wanted:
        placed.append([at])
        while len(placed) > 1 and _middle(placed[-1]) - _middle(placed[-2]) < (len(placed[-1]) + len(placed[-2])) / 2:
            placed[-2:] = [placed[-2] + placed[-1]]
    return [_middle(group) + k - (len(group) - 1) / 2 for group in placed for k in range(len(group))]


def rows_of_letters(days: Iterable[float], apart_by: float, rows: int) -> list[int | None]:
    """In which row the letter of each event lies, so that none covers another; none where there is no room for it."""
    last = [-np.inf] * rows
    found: list[int | None] = []
    for day in days:
        row = next((k for k in range(rows) if day - last[k] >= apart_by), None)
        if row is not None:
            last[row] = day
        found.append(row)
    return found


def _middle(group: Sequence[float]) -> float:
    return sum(group) / len(group)
