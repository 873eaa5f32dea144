"""What the runs of a test show against what is said of them: a wrong direction, a copied file, one run in another unit.

Only what no ordinary test does is refused: partial arcs, small machines, quiet and unloaded runs all pass.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array
from elastogeo.observe.run import Run

TURNED = 0.9
"""Share of the way that must go in one direction for the angles to show it."""
COARSEST = np.pi / 4
"""Steps [rad] of the angle that are larger leave open which way they went."""
COPIED = 16
"""Different readings that a run must have before an equal one is a copy: coarse readings of a quiet machine do repeat."""
SAME_SPAN = 0.02
"""Relative difference of two arcs of one test, at most, for one to be the other in another unit."""
PER_DEGREE = np.pi / 180


@dataclass(frozen=True, slots=True)
class Mistaken:
    """A unit that is taken for another.

    Attributes
    ----------
    factor : float
        Of the one in the other.
    signals, noises : tuple of 2 float
        Ratios of readings and of their noise that it gives, with decimals cut off or at another force.
    forces : float
        Runs whose forces differ by more than this factor are not compared, nor a loaded one with an unloaded one.
    smaller, larger : str
        What to do with a run whose readings are smaller, or larger.
    """

    factor: float
    signals: tuple[float, float]
    noises: tuple[float, float]
    forces: float
    smaller: str
    larger: str


_IN_MM, _IN_UM, _IN_INCHES = (f"{unit}, name the column radial_{unit}" for unit in ("mm", "um", "in"))

MISTAKEN = (
    Mistaken(25.4, (12.0, 50.0), (6.0, 100.0), 1.5, f"{_IN_INCHES} (inches)", _IN_MM),
    Mistaken(1e3, (10.0, 1e5), (50.0, 5e3), 30.0, f"{_IN_MM} (or radial_m, if the others are mm)", _IN_UM),
    Mistaken(2.54e4, (1e3, 1e6), (5e3, 1.2e5), 30.0, f"{_IN_INCHES} (inches)", _IN_UM),
    Mistaken(1e6, (1e4, 1e8), (1.2e5, 5e6), 30.0, "m, name the column radial_m", _IN_UM),
)
"""Inches among mm, then mm, inches and metres among um. Inches among mm are compared at one force: runs do differ by ten,
but not at one force and in their noise too."""


Size = tuple[float, float]
"""Root mean squares [mm] of a run's readings about their mean, and of their noise (second differences)."""


def turning(angle: Array) -> int:
    """Which way the readings of a run went around: 1 where the angle grows, -1 where it falls, 0 where it does not show.

    Parameters
    ----------
    angle : array, shape (m,) [rad]
        Counted on or begun anew at a full turn.
    """
    step = np.remainder(np.diff(angle) + np.pi, 2 * np.pi) - np.pi
    way = float(np.abs(step).sum())
    if not way or float(np.median(np.abs(step))) > COARSEST:
        return 0
    net = float(step.sum()) / way
    return int(np.sign(net)) if abs(net) > TURNED else 0


def check_runs(runs: Sequence[Run]) -> None:
    """Refuse runs that contradict what is said of them, or each other.

    Parameters
    ----------
    runs : sequence of Run
        As they were read from files.

    Raises
    ------
    InputError
        With the run, what it shows, what is said of it, and what to do.
    """
    _check_copies(runs)
    _check_directions(runs)
    _check_angles(runs)
    _check_sizes(runs)


def _check_copies(runs: Sequence[Run]) -> None:
    """Two runs with the same readings from files of the same content; parts of one file differ in their readings."""
    seen: dict[str, list[Run]] = {}
    for run in runs:
        for first in seen.setdefault(run.sha256, []):
            if run.sha256 and _varied(run) and _is_equal(run, first):
                raise InputError(
                    f"runs {first.name!r} and {run.name!r} hold the same readings: {run.file} has the content of "
                    f"{first.file}; put the right file in place, or remove one of the two runs"
                )
        seen[run.sha256].append(run)


def _is_equal(run: Run, other: Run) -> bool:
    quantities = run.columns.keys()
    return quantities == other.columns.keys() and all(np.array_equal(run.columns[q], other.columns[q]) for q in quantities)


def _varied(run: Run) -> bool:
    """Whether a run holds so many different readings that no second run gives them again."""
    measured = [values for quantity, values in run.columns.items() if quantity not in ("angle", "time")]
    return any(len(np.unique(values)) >= COPIED for values in measured)


def _check_directions(runs: Sequence[Run]) -> None:
    """A stated direction against the order of the angles; growing ones may be a table sorted by angle, which shows none.

    They are none if those of another run fall, if they begin anew within the run, or if a time grows with them.
    """
    ways = {run.name: turning(run.columns["angle"]) for run in runs if "angle" in run.columns}
    falling = any(way < 0 for way in ways.values())
    for run in runs:
        way = ways.get(run.name, 0)
        if way < 0 < run.sense:
            raise InputError(
                f'run {run.name!r} goes clockwise, its angles fall, but the test says sense = "ccw"; write sense = "cw", '
                f"or leave it out"
            )
        if way > 0 > run.sense and (falling or _is_as_it_came(run)):
            shown = "while those of other clockwise runs fall" if falling else "in the order in which they were read"
            raise InputError(
                f"run {run.name!r} goes counter-clockwise, its angles grow {shown}, but the test says "
                f'sense = "cw"; write sense = "ccw", or leave it out'
            )


def _is_as_it_came(run: Run) -> bool:
    """Whether a run shows that it is not sorted by angle: it has a time that grows, or goes past a full turn."""
    time, turned = run.columns.get("time"), np.remainder(run.columns["angle"], 2 * np.pi)
    return (time is not None and bool((np.diff(time) > 0).all())) or bool((np.diff(turned) < -np.pi).any())


def _check_angles(runs: Sequence[Run]) -> None:
    """One run in radians under `angle_deg`; degrees as radians are many turns, which a bar refuses by itself."""
    spans = {run.name: float(np.ptp(run.columns["angle"])) for run in runs if "angle" in run.columns}
    for name, span in spans.items():
        others = [other for key, other in spans.items() if key != name]
        usual = float(np.median(others)) if others else 0.0
        if _is_near(span, usual * PER_DEGREE) or (not others and _is_near(span, 2 * np.pi * PER_DEGREE)):
            raise InputError(
                f"run {name!r} spans {np.rad2deg(span):.4g} degrees"
                + (f", the other runs {np.rad2deg(usual):.4g}" if others else ", a full turn in radians")
                + "; its angles are radians: name the column angle_rad"
            )


def _is_near(span: float, other: float) -> bool:
    return other > 0 and abs(span / other - 1) < SAME_SPAN


def _check_sizes(runs: Sequence[Run]) -> None:
    """One run in another unit than its column says: its signal and its noise are both off by the same factor."""
    sizes = {run.name: size for run in runs if (size := _size(run)) is not None}
    forces = {run.name: abs(run.force or run.pressure or 0.0) for run in runs}
    for name, own in sizes.items():
        for unit in MISTAKEN:
            others = [
                other for key, other in sizes.items() if key != name and _are_alike(forces[name], forces[key], unit.forces)
            ]
            smaller = 2 * sum(_is_apart(own, other, unit) for other in others) > len(others)
            larger = len(others) > 1 and 2 * sum(_is_apart(other, own, unit) for other in others) > len(others)
            if smaller or larger:
                which, advice = ("smaller", unit.smaller) if smaller else ("larger", unit.larger)
                raise InputError(
                    f"run {name!r} has readings about {unit.factor:.15g} times {which} than the other runs, noise included; "
                    f"if they are {advice}"
                )


def _is_apart(size: Size, other: Size, unit: Mistaken) -> bool:
    """Whether signal and noise of a run are to those of another as one unit to the other."""
    limits = (unit.signals, unit.noises)
    return all(one > 0 and low < two / one < high for one, two, (low, high) in zip(size, other, limits, strict=True))


def _size(run: Run) -> Size | None:
    readings = run.columns.get("radial")
    if readings is None or len(readings) < COPIED:
        return None
    return float(np.std(readings)), float(np.sqrt(np.mean(np.diff(readings, 2) ** 2)))


def _are_alike(force: float, other: float, apart: float) -> bool:
    """Whether two forces (or pressures) are within a factor of each other, or both none."""
    return force == other or (other > 0 and 1 / apart < force / other < apart)
