"""A section through a map as a plain drawing: stiffness in colour with numbered contours, grey where nothing is known.

`static/map.js` of the pages draws the same from the same numbers when the direction is turned.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import floor, isfinite, log10

import numpy as np
from numpy.typing import NDArray

from elastogeo.machine import Array
from elastogeo.prediction import MapSection
from elastogeo.report.document import UM
from elastogeo.report.drawing.plots import Band, Line, Mark, Place, Plot, Shape, Text
from elastogeo.report.numbers import pretty

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 640.0, 62.0, 26.0, 34.0, 48.0
HEIGHTS = (220.0, 520.0)
"""Least and greatest height of the field [px]."""
CELLS = 10
"""Cells of colour between two places."""
LINES = 2
"""Steps of a contour between two places."""
COLOURS = 8
"""Kinds `s0` (softest) to `s7`."""
MOST_LEVELS = 7

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Frame:
    """Where the field lies [px], and what it spans [mm]."""

    x: tuple[float, float]
    y: tuple[float, float]
    height: float

    def across(self, value: float) -> float:
        """The x of a command."""
        return LEFT + (value - self.x[0]) / (self.x[1] - self.x[0]) * (WIDTH - LEFT - RIGHT)

    def up(self, value: float) -> float:
        """The y of a command."""
        return TOP + (self.y[1] - value) / (self.y[1] - self.y[0]) * self.height


def frame_of(section: MapSection) -> Frame:
    """The field in true proportion, as far as that can be looked at."""
    across, up = section.along
    ratio = float(np.ptp(up) / np.ptp(across))
    return Frame(
        (float(across[0]), float(across[-1])),
        (float(up[0]), float(up[-1])),
        float(np.clip(ratio * (WIDTH - LEFT - RIGHT), *HEIGHTS)),
    )


def frame_json(section: MapSection) -> dict[str, float]:
    """Where the field lies, for those who draw it again [px], and how fine."""
    return {
        "width": WIDTH,
        "left": LEFT,
        "right": RIGHT,
        "top": TOP,
        "height": frame_of(section).height,
        "cells": CELLS,
        "lines": LINES,
        "colours": COLOURS,
        "levels": MOST_LEVELS,
    }


def levels_of(stiffness: Array) -> list[float]:
    """Round numbers [N/um] between the least and the greatest: where the contours run, and the colours change."""
    known = stiffness[np.isfinite(stiffness)]
    if not len(known) or np.ptp(known) <= 1e-9 * abs(known).max():
        return []
    low, high = float(known.min()), float(known.max())
    power = 10.0 ** floor(log10((high - low) / MOST_LEVELS))
    step = next(one * power for one in (1, 2, 5, 10, 20) if (high - low) / (one * power) <= MOST_LEVELS)
    return [k * step for k in range(floor(low / step) + 1, floor(high / step) + 1) if low < k * step < high]


def section_plot(section: MapSection, alternative: str) -> Plot:
    """The drawing."""
    frame = frame_of(section)
    field = section.stiffness / UM
    levels = levels_of(field)
    shapes: list[Shape] = [*_cells(section, field, levels, frame), *_resting(section, frame)]
    shapes += _contours(section, field, levels, frame)
    shapes += [*_axes(section, frame), *_marks(section, frame)]
    return Plot(WIDTH, TOP + frame.height + BOTTOM, tuple(shapes), alternative)


def colour(value: float, levels: list[float]) -> str:
    """The kind of a value: by how many levels lie below it."""
    if not isfinite(value):
        return "untold"
    below = sum(level <= value for level in levels)
    return f"s{round(below * (COLOURS - 1) / max(len(levels), 1))}" if levels else f"s{COLOURS // 2}"


def refined(field: Array, steps: int, ends: bool) -> Array:
    """A field between its places: linear where all four corners are known, else that of the nearest place.

    With `ends` at the places and `steps - 1` points between them, else at the middles of `steps` cells between two.
    """
    a, b = (_points(count, steps, ends) for count in field.shape)
    i, j = (np.minimum(one.astype(int), count - 2) for one, count in zip((a, b), field.shape, strict=True))
    p, q = (a - i)[:, np.newaxis], (b - j)[np.newaxis]
    corner = {(m, n): field[np.ix_(i + m, j + n)] for m in (0, 1) for n in (0, 1)}
    linear = (1 - p) * ((1 - q) * corner[0, 0] + q * corner[0, 1]) + p * ((1 - q) * corner[1, 0] + q * corner[1, 1])
    nearest = field[np.ix_(i + (a - i >= 0.5), j + (b - j >= 0.5))]
    return np.where(np.isfinite(linear), linear, nearest)


def _points(count: int, steps: int, ends: bool) -> Array:
    """In places of the field."""
    if ends:
        return np.arange((count - 1) * steps + 1) / steps
    return (np.arange((count - 1) * steps) + 0.5) / steps


def _cells(section: MapSection, field: Array, levels: list[float], frame: Frame) -> Iterator[Shape]:
    """Rows of cells, as many together as have one colour."""
    fine = refined(field, CELLS, ends=False)
    x = [frame.across(value) for value in _edges(section.along[0])]
    y = [frame.up(value) for value in _edges(section.along[1])]
    for j in range(fine.shape[1]):
        kinds = [colour(value, levels) for value in fine[:, j].tolist()]
        first = 0
        for i in range(1, len(kinds) + 1):
            if i == len(kinds) or kinds[i] != kinds[first]:
                yield Band(((x[first], y[j]), (x[i], y[j]), (x[i], y[j + 1]), (x[first], y[j + 1])), kinds[first])
                first = i


def _edges(along: Array) -> Array:
    return np.interp(np.arange((len(along) - 1) * CELLS + 1) / CELLS, np.arange(len(along)), along)


def _resting(section: MapSection, frame: Frame) -> Iterator[Shape]:
    """A dot on each place that rests on an assumption."""
    across, up = section.along
    for i, j in np.argwhere(section.resting):
        yield Mark(frame.across(float(across[i])), frame.up(float(up[j])), "paper", "circle", 1.8)


def _contours(section: MapSection, field: Array, levels: list[float], frame: Frame) -> Iterator[Shape]:
    fine = refined(field, LINES, ends=True)
    across, up = (np.interp(_points(len(one), LINES, True), np.arange(len(one)), one) for one in section.along)
    for level in levels:
        chains = _chained(list(_segments(fine, level)))
        lines = [tuple((frame.across(_at(across, a)), frame.up(_at(up, b))) for a, b in chain) for chain in chains]
        yield from (Line(line, "contour") for line in lines)
        if lines:
            x, y = _middle(max(lines, key=len))
            yield Text(x, y + 4, level_said(level), "middle", "contour")


def level_said(level: float) -> str:
    """A contour's number: 12, 12.5, 0.35."""
    return pretty(f"{level:.6g}")


def _middle(line: tuple[Place, ...]) -> Place:
    return line[len(line) // 2]


def _at(along: Array, place: float) -> float:
    return float(np.interp(place, np.arange(len(along)), along))


def _segments(field: Array, level: float) -> Iterator[tuple[Place, Place]]:
    """Where the field is at the level: straight pieces across the cells whose corners are all known."""
    for i in range(field.shape[0] - 1):
        for j in range(field.shape[1] - 1):
            ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            values = [float(field[at]) for at in ring]
            if not all(map(isfinite, values)):
                continue
            cut = []
            for k in range(len(ring)):
                a, b = values[k], values[(k + 1) % 4]
                if (a < level) != (b < level):
                    t = (level - a) / (b - a)
                    (i0, j0), (i1, j1) = ring[k], ring[(k + 1) % 4]
                    cut.append((i0 + t * (i1 - i0), j0 + t * (j1 - j0)))
            yield from ((cut[k], cut[k + 1]) for k in range(0, len(cut) - 1, 2))


def _chained(segments: list[tuple[Place, Place]]) -> list[list[Place]]:
    """Pieces that meet as lines."""
    chains: list[list[Place]] = []
    while segments:
        chain = list(segments.pop())
        grown = True
        while grown:
            grown = False
            for k, (a, b) in enumerate(segments):
                ends = {
                    "a0": _same(a, chain[0]),
                    "b0": _same(b, chain[0]),
                    "a1": _same(a, chain[-1]),
                    "b1": _same(b, chain[-1]),
                }
                if not any(ends.values()):
                    continue
                other = b if ends["a0"] or ends["a1"] else a
                chain = [other, *chain] if ends["a0"] or ends["b0"] else [*chain, other]
                del segments[k]
                grown = True
                break
        chains.append(chain)
    return chains


def _same(one: Place, other: Place) -> bool:
    return abs(one[0] - other[0]) < 1e-9 and abs(one[1] - other[1]) < 1e-9


def _axes(section: MapSection, frame: Frame) -> Iterator[Shape]:
    bottom, right = TOP + frame.height, WIDTH - RIGHT
    yield Line(((LEFT, TOP), (LEFT, bottom), (right, bottom), (right, TOP), (LEFT, TOP)), "line")
    for value in _ticks(*frame.x):
        x = frame.across(value)
        yield Line(((x, bottom), (x, bottom + 5)), "line")
        yield Text(x, bottom + 20, level_said(value), "middle")
    for value in _ticks(*frame.y):
        y = frame.up(value)
        yield Line(((LEFT - 5, y), (LEFT, y)), "line")
        yield Text(LEFT - 8, y + 4, level_said(value), "end")
    yield Text((LEFT + right) / 2, bottom + 42, f"{section.axes[0]} [mm]", "middle")
    yield Text(4, TOP - 16, f"{section.axes[1]} [mm]")


def _ticks(low: float, high: float) -> list[float]:
    low, high = min(low, high), max(low, high)
    power = 10.0 ** floor(log10((high - low) / 5))
    step = next(one * power for one in (1, 2, 5, 10, 20) if (high - low) / (one * power) <= 6)
    return [k * step for k in range(-floor(-low / step), floor(high / step) + 1)]


def _marks(section: MapSection, frame: Frame) -> Iterator[Shape]:
    for spot, shape in ((section.softest, "down"), (section.stiffest, "up")):
        if spot is not None:
            x, y = (
                frame_at(spot.commands[axis]) for axis, frame_at in zip(section.axes, (frame.across, frame.up), strict=True)
            )
            yield Mark(x, y, "ink", shape, 5.0)
