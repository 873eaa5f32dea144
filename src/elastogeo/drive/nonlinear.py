"""The parameters of the balance that are not linear in the effort: searched outside the linear solve.

Variable projection: for trial values of the smooth speed, the Stribeck speed and the delay, the linear part is solved
exactly; what is searched is the residual that it leaves. A coarse lattice first, then ever smaller steps about its best.
Speeds are searched by ratio, the delay by difference. The steps keep to one lattice, so that the searches without each run
(`leave_one_run_out`) meet at the same points and share their factors; the minimisers of scipy.optimize would not.

A fractional delay interpolates the motion between its samples, never the effort: a smoothed effort would be easier to
predict, and the comparison would flatter the delay. Interpolated motion is averaged motion all the same; `neighbours`
averages without a delay, and whether a delay helps beyond it is the question to ask of a slow log.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from scipy.special import fdtri

from elastogeo.drive.balance import (
    BalanceFit,
    Searched,
    check_alive,
    check_records,
    design_rows,
    factors_of,
    free_labels,
    identify_balance,
    load_names,
    solved,
)
from elastogeo.drive.model import Mask, TorqueModel, usable
from elastogeo.drive.records import DriveRecord
from elastogeo.errors import InputError, RankError
from elastogeo.estimate import Factor, merge
from elastogeo.machine import Array

SEARCHABLE = ("smooth_speed", "stribeck_speed", "delay", "neighbours")
"""What can be searched."""

LONGEST_DELAY = 0.02
"""[s] Of an effort against its motion, or one step if that is longer."""

SLOWEST, FASTEST = 0.05, 0.9
"""Quantiles of the speed between a quarter of the first and the second of which a law of friction is searched."""

_LATTICE = {1: 17, 2: 9, 3: 5}
"""Points of the coarse lattice along each searched parameter, by how many there are."""
_STARTS = 3
"""Of the best points of the lattice, from which the search goes on: there may be several valleys."""
_HALVINGS = 5
_PROFILE = 21
_AGAIN = 3
"""By how many halvings of the step a second search begins nearer, about a known best."""

Point = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Ranges:
    """Within what each parameter is searched, in its own scale: logarithm of a speed, delay as it is."""

    names: tuple[str, ...]
    low: Point
    high: Point
    length_unit: str = "mm"

    def model(self, model: TorqueModel, point: Point) -> TorqueModel:
        """The model at a point."""
        found = {name: self.value(name, at) for name, at in zip(self.names, point, strict=True)}
        return replace(
            model,
            smooth_speed=found.get("smooth_speed", model.smooth_speed),
            stribeck_speed=found.get("stribeck_speed", model.stribeck_speed),
            delay=found.get("delay", model.delay),
            neighbours=found.get("neighbours", model.neighbours),
        )

    @staticmethod
    def value(name: str, at: float) -> float:
        """A parameter from its own scale."""
        return float(np.exp(at)) if name.endswith("_speed") else at


FactorsAt = Callable[[Point], list[Factor]]


@dataclass(frozen=True, slots=True)
class Search:
    """A search that was made: what it needs to be made again with other runs.

    Attributes
    ----------
    ranges : Ranges
    masks : list of array of bool
        Samples used of each record.
    factors_at : callable
        Point -> the factors of the runs.
    best : tuple of float
        The point of the least residual.
    """

    ranges: Ranges
    masks: list[Mask]
    factors_at: FactorsAt
    best: Point


def search_balance(
    records: Sequence[DriveRecord],
    model: TorqueModel,
    searched: Sequence[str],
    known: Mapping[str, float] | None = None,
    chosen: Sequence[Mask] | None = None,
    search: Search | None = None,
) -> BalanceFit:
    """Identify a balance with its parameters that are not linear in the effort.

    Parameters
    ----------
    records, known, chosen
        As in `identify_balance`.
    model : TorqueModel
        Its values of the searched parameters are not used.
    searched : sequence of str
        Some of `SEARCHABLE`.
    search : Search, optional
        That of the same arguments, if it was made already.

    Returns
    -------
    BalanceFit
        Its model at the best values. Its covariance holds what these are uncertain by (their derivative columns are
        solved with the others); `searched` has their intervals from the profile.

    Raises
    ------
    RankError, DegreesOfFreedomError, InputError
        As `identify_balance`.
    """
    known = known or {}
    if not searched:
        return identify_balance(records, model, known, chosen)
    made = search or make_search(records, model, searched, known, chosen)
    fit = identify_balance(records, made.ranges.model(model, made.best), known, made.masks)
    if not fit.separated:
        return replace(fit, searched=_values(made.ranges, made.best, (None,) * len(made.best)))
    return _with_search(fit, records, model, made)


def make_search(
    records: Sequence[DriveRecord],
    model: TorqueModel,
    searched: Sequence[str],
    known: Mapping[str, float] | None = None,
    chosen: Sequence[Mask] | None = None,
) -> Search:
    """Find the searched parameters; arguments and errors as of `search_balance`."""
    known = known or {}
    ranges = ranges_of(records, model, searched)
    masks = shared_masks(records, model, ranges) if chosen is None else list(chosen)
    middle = tuple((low + high) / 2 for low, high in zip(ranges.low, ranges.high, strict=True))
    check_records(records, ranges.model(model, middle), known)
    check_alive(records, masks, model)
    factors_at = factors_cached(records, model, ranges, known, masks)
    return Search(ranges, masks, factors_at, lowest(factors_at, ranges))


def ranges_of(records: Sequence[DriveRecord], model: TorqueModel, searched: Sequence[str]) -> Ranges:
    """Within what the parameters are searched."""
    unknown = [name for name in searched if name not in SEARCHABLE]
    if unknown or len(set(searched)) < len(searched):
        raise InputError(f"cannot search {', '.join(searched)}; name some of {', '.join(SEARCHABLE)}, each once")
    speeds = np.abs(np.concatenate([record.velocity[usable(record, model)] for record in records]))
    speeds = speeds[speeds > 0]
    if not len(speeds):
        slower = "its noise at rest" if model.least_speed is None else f"{model.least_speed:g} {records[0].length_unit}/s"
        raise RankError(f"no sample of axis {records[0].axis} is faster than {slower}: nothing can be searched")
    slow, fast = np.log(np.quantile(speeds, SLOWEST) / 4), np.log(np.quantile(speeds, FASTEST))
    late = max(LONGEST_DELAY, max(record.step for record in records))
    ends = {"delay": (-late, late), "neighbours": (0.0, 0.5)}
    low = tuple(ends.get(name, (float(slow), float(fast)))[0] for name in searched)
    high = tuple(ends.get(name, (float(slow), float(fast)))[1] for name in searched)
    return Ranges(tuple(searched), low, high, records[0].length_unit)


def shared_masks(records: Sequence[DriveRecord], model: TorqueModel, ranges: Ranges) -> list[Mask]:
    """Samples that can be used at every value of the searched parameters, so that all are compared on the same."""
    corners = [ranges.model(model, ranges.low), ranges.model(model, ranges.high)]
    return [usable(record, corners[0]) & usable(record, corners[1]) for record in records]


def factors_cached(
    records: Sequence[DriveRecord], model: TorqueModel, ranges: Ranges, known: Mapping[str, float], masks: Sequence[Mask]
) -> FactorsAt:
    """The factors of the runs at a point, each computed once."""
    labels = free_labels(records, ranges.model(model, ranges.low), known)
    whole, mask = _joined(records), np.concatenate(list(masks))
    ends = np.cumsum([mask.sum() for mask in masks])[:-1]
    cache: dict[Point, list[Factor]] = {}

    def factors_at(point: Point) -> list[Factor]:
        if point not in cache:
            (rows,) = design_rows([whole], ranges.model(model, point), known, [mask])
            cache[point] = factors_of(np.split(rows, ends), labels)
        return cache[point]

    return factors_at


def _joined(records: Sequence[DriveRecord]) -> DriveRecord:
    """All records in one, with gaps between them that no motion is taken across: one pass for all their columns."""
    times, start = [], 0.0
    for record in records:
        times.append(record.time - record.time[0] + start)
        start = float(times[-1][-1]) + 100 * max(r.step for r in records)
    loads = {
        name: np.concatenate([record.disturbance.get(name, np.zeros(len(record.time))) for record in records])
        for name in load_names(records)
    }
    return replace(
        records[0],
        run="all runs",
        time=np.concatenate(times),
        position=np.concatenate([record.position for record in records]),
        velocity=np.concatenate([record.velocity for record in records]),
        acceleration=np.concatenate([record.acceleration for record in records]),
        effort=np.concatenate([record.effort for record in records]),
        disturbance=loads,
        standing=None,  # the masks say which samples count
    )


def lowest(factors_at: FactorsAt, ranges: Ranges, runs: Sequence[int] | None = None, start: Point | None = None) -> Point:
    """The point of the least residual over some of the runs: from a coarse lattice, or from a known point, by halving."""

    def left(point: Point) -> float:
        factors = factors_at(point)
        return residual(factors if runs is None else [factors[k] for k in runs])

    many = _LATTICE[len(ranges.names)]
    steps = [(high - low) / (many - 1) for low, high in zip(ranges.low, ranges.high, strict=True)]
    if start is not None:
        return _descended(start, left, [step / 2**_AGAIN for step in steps], ranges)
    axes = [[low + k * step for k in range(many)] for low, step in zip(ranges.low, steps, strict=True)]
    starts = sorted(product(*axes), key=left)[:_STARTS]
    return min((_descended(start, left, [step / 2 for step in steps], ranges) for start in starts), key=left)


def _descended(start: Point, left: Callable[[Point], float], steps: Sequence[float], ranges: Ranges) -> Point:
    """The point of the least residual near another, by steps that are halved when none of them helps."""
    best, least = start, left(start)
    for halving in range(_HALVINGS):
        improved = True
        while improved:
            improved = False
            for point in _around(best, [step / 2**halving for step in steps], ranges):
                value = left(point)
                if value < least:
                    best, least, improved = point, value, True
    return best


def residual(factors: Sequence[Factor]) -> float:
    """Residual sum of squares of the factors together."""
    return merge(*factors).residual_norm ** 2


def _around(point: Point, steps: Sequence[float], ranges: Ranges) -> list[Point]:
    near = []
    for k, step in enumerate(steps):
        for sign in (-1, 1):
            moved = min(max(point[k] + sign * step, ranges.low[k]), ranges.high[k])
            if moved != point[k]:
                near.append((*point[:k], moved, *point[k + 1 :]))
    return near


def _with_search(fit: BalanceFit, records: Sequence[DriveRecord], model: TorqueModel, made: Search) -> BalanceFit:
    """The fit with what the searched parameters are uncertain by."""
    ranges, best, masks, factors_at = made.ranges, made.best, made.masks, made.factors_at
    inside = [k for k in range(len(best)) if not _at_bound(ranges, best, k)]
    labels = free_labels(records, fit.model, fit.known)
    rows = design_rows(records, fit.model, fit.known, masks)
    slopes = [_slope(records, model, ranges, best, k, fit, masks) for k in inside]
    wider = [np.column_stack([run[:, :-1], *(slope[r] for slope in slopes), run[:, -1]]) for r, run in enumerate(rows)]
    names = (*labels, *(f"law {ranges.names[k]}" for k in inside))
    try:
        joint, counted = solved(wider, names, names)
    except RankError:
        return replace(fit, searched=_values(ranges, best, (None,) * len(best)))
    keep = range(len(labels))
    effect = {}
    plain = joint.residual_std**2 * _white(wider)
    for n, k in enumerate(inside, len(labels)):
        effect[k] = joint.covariance[n, n] / plain[n]
    solution = replace(
        fit.solution,
        covariance=joint.covariance[np.ix_(keep, keep)],
        degrees_of_freedom=joint.degrees_of_freedom[: len(labels)],
    )
    # The residual rises by more than white noise would let it, as the estimate scatters by more than white noise would.
    largest, fewest = max(effect.values(), default=1.0), float(np.min(joint.degrees_of_freedom))
    rise = joint.residual_std**2 * fdtri(1, fewest, 0.95)
    intervals = tuple(_profile(factors_at, ranges, best, k, rise * effect.get(k, largest)) for k in range(len(best)))
    return replace(fit, solution=solution, counted=counted, searched=_values(ranges, best, intervals))


def _white(rows: Sequence[Array]) -> Array:
    """Diagonal of the inverse of `A^T A`, shape (p,)."""
    A = np.concatenate(rows)[:, :-1]
    norms = np.linalg.norm(A, axis=0)
    return np.asarray(np.sum(np.linalg.inv(np.linalg.qr(A / norms, mode="r")) ** 2, axis=1) / norms**2)


def _slope(
    records: Sequence[DriveRecord],
    model: TorqueModel,
    ranges: Ranges,
    best: Point,
    k: int,
    fit: BalanceFit,
    masks: Sequence[Mask],
) -> list[Array]:
    """Derivative of the predicted effort with respect to a searched parameter in its own scale, by central difference."""
    step = (ranges.high[k] - ranges.low[k]) / 40  # wide: a sharp sign jumps as the delayed velocity passes zero
    ends = []
    for sign in (1, -1):
        point = (*best[:k], best[k] + sign * step, *best[k + 1 :])
        rows = design_rows(records, ranges.model(model, point), fit.known, masks)
        # The known part sits in the last column: what is predicted is the free part less that.
        ends.append([run[:, :-1] @ fit.solution.values - run[:, -1] for run in rows])
    return [(up - down) / (2 * step) for up, down in zip(*ends, strict=True)]


def _at_bound(ranges: Ranges, best: Point, k: int) -> bool:
    return best[k] in (ranges.low[k], ranges.high[k])


def _profile(factors_at: FactorsAt, ranges: Ranges, best: Point, k: int, rise: float) -> tuple[float | None, float | None]:
    """Between which values the residual, the other searched ones kept, has not risen by `rise`; None to the end of a range.

    The hull of all such values: with a sharp sign the residual jumps where the delayed velocity changes its sign.
    """
    from scipy.optimize import brentq

    limit = residual(factors_at(best)) + rise
    lattice = np.linspace(ranges.low[k], ranges.high[k], _PROFILE).tolist()

    def above(at: float) -> float:
        return residual(factors_at((*best[:k], float(at), *best[k + 1 :]))) - limit

    inside = [at for at in (*lattice, best[k]) if above(at) <= 0]
    ends: list[float | None] = []
    for edge, outer in (
        (min(inside), max((at for at in lattice if at < min(inside)), default=None)),
        (max(inside), min((at for at in lattice if at > max(inside)), default=None)),
    ):
        crossing = None if outer is None else float(brentq(above, edge, outer, xtol=1e-3 * abs(outer - edge)))
        ends.append(None if crossing is None else ranges.value(ranges.names[k], crossing))
    return ends[0], ends[1]


def _values(
    ranges: Ranges, best: Point, intervals: Sequence[tuple[float | None, float | None] | None]
) -> tuple[Searched, ...]:
    return tuple(
        Searched(
            name=name,
            unit={"delay": "s", "neighbours": ""}.get(name, f"{ranges.length_unit}/s"),
            value=ranges.value(name, best[k]),
            interval=intervals[k] or (None, None),
            at_bound=_at_bound(ranges, best, k),
        )
        for k, name in enumerate(ranges.names)
    )
