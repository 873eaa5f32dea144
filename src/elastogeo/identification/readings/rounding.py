"""Rounding that repeats share: what does not average out over runs (JCGM 100, F.2.2.1).

A reading that is rounded to a step q is off by q/sqrt(12). Where runs repeat a path they repeat its rounding as well, but
for what their scatter dithers: two repeats that scatter by s before they are rounded have errors of the covariance

    v = q^2 / (2 pi^2) sum_k exp(-4 pi^2 k^2 s^2 / q^2) / k^2,

which is q^2/12 without any scatter and nothing from s = q/2 on (Widrow and Kollar, Quantization Noise, 2008). The scatter
between runs does not show it. It enters as what it is, waves of the reading itself, of known amplitude and unknown phase:
where the reading hardly changes along the path, neighbours are rounded alike, and that counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from elastogeo.estimate import Influence, minimum_norm
from elastogeo.identification.influences import Effect
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems, merged
from elastogeo.machine import Array

ROUNDING = "rounding that repeats share"

HARMONICS = 5
"""Waves of the rounding error that are counted: 89 % of its variance where nothing dithers it, all where anything does."""

NOTHING = 0.05
"""Amplitude left by the scatter, as a share, below which a wave is none."""

LOOKED_AT = 2000
"""Readings of a run from which its step is found."""

FEWEST_VALUES = 5
"""Different readings without which a step may be chance."""

WHOLE = 1e-3
"""Share of a step by which readings may miss its multiples."""

SAME_PATH = 0.05
"""Share of its extent by which a path may differ, on average, from one that it repeats."""

_SIGMA = np.linspace(0.0, 1.0, 401)
"""Scatter over step for which the variance of rounded repeats is tabulated."""


def rounding_effects(systems: Systems, resolution: float | None) -> Iterator[Effect]:
    """The rounding that repeats of a test share; nothing where no run repeats another, or scatter dithers it.

    Parameters
    ----------
    systems : Systems
    resolution : float or None [mm]
        As stated with the test; a coarser step that the readings show counts instead.
    """
    step = max(found_step(systems.runs) or 0.0, resolution or 0.0)
    if not step:
        return
    values = minimum_norm(merged(systems.runs))
    model = _Model(values)
    left = {run.name: amplitude for run, amplitude in _dithered_runs(systems.runs, values, step)}
    for k in range(1, HARMONICS + 1):
        shares = {run.name: left.get(run.name, 0.0) ** (k * k) for run in systems.runs}
        if max(shares.values()) < NOTHING:
            return
        known = Influence(ROUNDING, step / (np.sqrt(2.0) * np.pi * k), "normal")
        for wave in (np.cos, np.sin):
            yield Effect(known, np.zeros(len(shares)), partial(_wave, wave, 2 * np.pi * k / step, shares, model))


class _Model:
    """The reading as the model has it, before it was rounded: of the run that was asked for last it is kept."""

    def __init__(self, values: Array) -> None:
        self._values, self._name, self._reading = values, "", np.zeros(0)

    def __call__(self, run: RunSystem) -> Array:
        if run.name != self._name:
            self._name, self._reading = run.name, _recorded(run) - (run.reading - run.design @ self._values)
        return self._reading


def _wave(wave: Callable[[Array], Array], turns: float, shares: Mapping[str, float], model: _Model, run: RunSystem) -> Array:
    """One wave of the rounding error along a run."""
    share = shares[run.name]
    return np.asarray(share * wave(turns * model(run))) if share else np.zeros(run.readings)


def _dithered_runs(runs: Sequence[RunSystem], values: Array, step: float) -> Iterator[tuple[RunSystem, float]]:
    """Every run that another repeats, with what their scatter leaves of the first wave."""
    for group in _repeats(runs):
        left = [_beside_the_model(run, values) for run in group]
        aligned = np.array([_drawn_out(one, len(left[0])) for one in left])
        amplitude = _dithered(float(np.var(aligned, axis=0, ddof=1).mean()), step)
        yield from ((run, amplitude) for run in group)


def found_step(runs: Sequence[RunSystem]) -> float | None:
    """The step [mm or rad] of which all recorded readings are multiples; None if they show none."""
    seen = np.unique(np.concatenate([_recorded(run)[:LOOKED_AT] for run in runs]))
    rounding = 16 * np.finfo(float).eps * float(np.abs(seen).max(initial=0.0))
    apart = np.diff(seen)
    apart = apart[apart > rounding]
    if len(apart) < FEWEST_VALUES - 1:
        return None
    times = apart / apart.min()
    if np.abs(times - np.round(times)).max() > WHOLE:
        return None
    return float(apart.sum() / np.round(times).sum())


def _recorded(run: RunSystem) -> Array:
    return run.observations.reading + run.observations.correction


def _beside_the_model(run: RunSystem, values: Array) -> Array:
    """What a run has beside the parameters that all runs share: its residuals and its own set-up, shape (m,)."""
    return run.reading - run.design @ values + run.own @ run.set_up(run.factor.labels, values)


def _repeats(runs: Sequence[RunSystem]) -> list[list[RunSystem]]:
    """Runs that repeat each other: the same force level on the same path, in the same order."""
    groups: list[list[RunSystem]] = []
    for run in runs:
        for group in groups:
            if group[0].force == run.force and _same_path(group[0], run):
                group.append(run)
                break
        else:
            groups.append([run])
    return [group for group in groups if len(group) > 1]


def _same_path(one: RunSystem, other: RunSystem) -> bool:
    for quantity in ("commands", "wrench"):
        path, again = getattr(one.observations, quantity), getattr(other.observations, quantity)
        extent = np.ptp(path, axis=0).max() or np.abs(path).max()
        if np.abs(path - _drawn_out(again, len(path))).mean(axis=0).max() > SAME_PATH * extent:
            return False
    return True


def _drawn_out(values: Array, count: int) -> Array:
    """As many of the values of a run, in their order, as another run has."""
    return values if len(values) == count else values[np.linspace(0, len(values) - 1, count).round().astype(int)]


def _dithered(variance: float, step: float) -> float:
    """What the scatter leaves of the amplitude of the first wave, from the variance of rounded repeats."""
    left, k = np.exp(-2 * (np.pi * _SIGMA) ** 2), np.arange(1, 50)[:, np.newaxis]
    shared = np.sum(left ** (2 * k**2) / k**2, axis=0) / (2 * np.pi**2)
    return float(np.interp(variance / step**2, _SIGMA**2 + shared[0] - shared, left))
