"""The rows of a prediction along a path, in words and figures: one place for page, terminal and JSON."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from elastogeo.machine import Array
from elastogeo.prediction import DEVIATION_COMPONENTS, PathPrediction
from elastogeo.report.numbers import UNKNOWN, significant, value_with_uncertainty
from elastogeo.report.text import UM

Numbers = np.ndarray[tuple[int], np.dtype[np.intp]]
NOT_TOLD = "not distinguished"
NOT_ASKED = "none asked for"


@dataclass(frozen=True, slots=True)
class Extreme:
    """The least and greatest deviation of one component along a path, formatted [um]; `at` in mm of the way."""

    component: str
    least: str
    least_at: str
    greatest: str
    greatest_at: str


def main_component(found: PathPrediction) -> int:
    """What is shown first: the normal, if the path has one and it is predicted; else the component that is greatest."""
    if np.isfinite(found.value[:, 3]).any():
        return 3
    known = np.nan_to_num(np.abs(found.value[:, :3])).max(axis=0)
    return int(known.argmax())


def worst_point(found: PathPrediction) -> int | None:
    """The point of the greatest deviation of the main component; None if nothing is predicted."""
    size = np.abs(found.value[:, main_component(found)])
    return int(np.nanargmax(size)) if np.isfinite(size).any() else None


def worst_by_force(found: PathPrediction) -> tuple[int, int] | None:
    """Where the compliance of the machine gives most, as its place among `split_at`, and the component; None if unknown.

    Known it may be where the whole deviation is not: what the tests do not determine is then geometry.
    """
    part = found.parts.get("compliance")
    if part is None or not np.nan_to_num(part.value).any():
        return None
    k = 3 if np.isfinite(part.value[:, 3]).any() else int(np.nan_to_num(np.abs(part.value[:, :3])).max(axis=0).argmax())
    return int(np.nanargmax(np.abs(part.value[:, k]))), k


def said_um(value: float, expanded: float) -> str:
    """A deviation [mm] as micrometres with U; the value alone where there is no interval."""
    if not np.isfinite(value):
        return UNKNOWN
    return value_with_uncertainty(value * UM, expanded * UM) if np.isfinite(expanded) else f"{significant(value * UM)}"


def extremes(found: PathPrediction) -> Iterator[Extreme]:
    """Of each component that is predicted."""
    wide, way = found.expanded, found.path.travelled
    for k, name in enumerate(DEVIATION_COMPONENTS):
        values = found.value[:, k]
        if np.isfinite(values).any():
            low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
            yield Extreme(
                name,
                said_um(values[low], wide[low, k]),
                f"{way[low]:.1f}",
                said_um(values[high], wide[high, k]),
                f"{way[high]:.1f}",
            )


def split_rows(found: PathPrediction) -> tuple[tuple[str, ...], ...]:
    """What each part adds at the worst point, by component."""
    at, by_force = worst_point(found), worst_by_force(found)
    if at is None and by_force is None:
        return ()
    rows: list[tuple[str, ...]] = []
    k_at = int(np.searchsorted(found.split_at, at)) if at is not None else by_force[0] if by_force else 0
    at = int(found.split_at[k_at])
    for name, part in found.parts.items():
        asked = np.nan_to_num(part.value).any() or np.nan_to_num(part.expanded).any()
        cells = (
            (said_um(part.value[k_at, k], part.expanded[k_at, k]) if asked else NOT_ASKED)
            if np.isfinite(part.value[k_at, k])
            else _why(found, at, k)
            for k in range(len(DEVIATION_COMPONENTS))
        )
        rows.append((name, *cells))
    whole = (said_um(found.value[at, k], found.expanded[at, k]) for k in range(len(DEVIATION_COMPONENTS)))
    return (*rows, ("together", *whole))


def _why(found: PathPrediction, at: int, k: int) -> str:
    return NOT_TOLD if found.supported[at, k] else UNKNOWN


def block_rows(found: PathPrediction, most: int = 12) -> tuple[tuple[str, str, str, str], ...]:
    """The blocks of the greatest deviation: block, way, greatest deviation of the main component, force."""
    k, blocks = main_component(found), np.unique(found.path.block)
    if len(blocks) < 2 or worst_point(found) is None:
        return ()
    size = np.nan_to_num(np.abs(found.value[:, k]), nan=-1.0)
    order = np.lexsort((-size, found.path.block))
    firsts = order[np.unique(found.path.block[order], return_index=True)[1]]
    chosen = [k for k in firsts[np.argsort(-size[firsts], kind="stable")][:most] if size[k] >= 0]
    wide, force = found.expanded, np.linalg.norm(found.wrench[:, :3], axis=1)
    return tuple(
        (
            f"{found.path.block[at] + 1}",
            f"{found.path.travelled[at]:.1f}",
            said_um(found.value[at, k], wide[at, k]),
            f"{force[at]:.0f}",
        )
        for at in map(int, chosen)
    )


def thinned_points(values: Array, most: int) -> Numbers:
    """Numbers of the points that are shown of a path: evenly chosen, its extremes among them, shape (k,)."""
    m = len(values)
    if m <= most:
        return np.arange(m)
    even = np.linspace(0, m - 1, most - 2).round().astype(np.intp)
    known = np.isfinite(values)
    ends = [int(np.nanargmin(values)), int(np.nanargmax(values))] if known.any() else []
    return np.unique(np.concatenate([even, np.array(ends, dtype=np.intp)]))
