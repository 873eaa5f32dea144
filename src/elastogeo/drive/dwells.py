"""Where an axis stands, as its record shows: dwells, and the speed that noise and the ringing of a low-pass give it there.

At rest friction takes any value up to that of breaking loose, and the sign of the velocity is that of noise. Two things
show a rest, whatever the axis and its encoder: the path stays within its own noise over a window, or the velocity changes
its sign faster than the band of the record lets a motion turn back. What lasts no longer than two windows is a reversal.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.drive.records import DriveRecord
from elastogeo.machine import Array

WINDOW = 8
"""Samples over which a rest is sought where no low-pass sets the time."""

NOISE = 8.0
"""Range of a window over the standard deviation of its noise, up to which the axis stands in it."""

TURNS = 3
"""Changes of sign within two windows of a low-pass, or one where there is none: no motion in the band of the record turns
back so often."""

SLOW = 0.1
"""Share of the speed of a record (its 95 % quantile) up to which a recorded velocity may be at rest; a motion that is
sampled too slowly changes its sign as noise does."""

LASTING = 2.0
"""Windows that a rest lasts at least."""

SHOWN = 0.995
"""Quantile of the speeds at rest that gives the least speed: not their maximum, which one bad sample sets."""

_THIRD_DIFFERENCE = 1.4826 / np.sqrt(20.0)
"""From the median size of third differences to the standard deviation of white noise."""


@dataclass(frozen=True, slots=True, eq=False)
class Standstill:
    """Where the axis of a record stands.

    Attributes
    ----------
    near : array of bool, shape (m,)
        Samples at rest, and those into which the low-pass of the record carries the rest.
    speed : float [mm/s; rad/s of a rotary axis]
        That noise and ringing show at rest; 0 without a rest.
    """

    near: NDArray[np.bool_]
    speed: float


def standing(time: Array, path: Array, velocity: Array, window: int, turning: int | None = None) -> NDArray[np.bool_]:
    """Whether the axis stands, shape (m,).

    Parameters
    ----------
    time : array, shape (m,) [s]
    path : array, shape (m,) [mm; rad]
        As recorded, not smoothed: a low-pass makes it swing on after a stop.
    velocity : array, shape (m,) [mm/s; rad/s]
        Whose signs are to be trusted or not.
    window : int
        Samples.
    turning : int, optional
        Of a recorded velocity: samples on either side within which its changes of sign count. Default the window, for one
        that went through a low-pass.
    """
    if len(time) < 2 * window + 4:
        return np.zeros(len(time), dtype=bool)
    from scipy.ndimage import maximum_filter1d, minimum_filter1d

    span = maximum_filter1d(path, window) - minimum_filter1d(path, window)
    still = span <= _rest_span(path)
    trembles = _trembles(velocity, turning or window)
    if turning:
        speed = np.abs(velocity)
        slow = maximum_filter1d(speed, 2 * turning + 1) <= SLOW * np.quantile(speed, 0.95)
        still, trembles = still & slow, trembles & slow
    trembles = _widened(trembles, window // 2)
    trembles = ~_widened(~trembles, window // 2)  # without the gaps that chance leaves between changes of sign
    return _lasting(_widened(still, window // 2) | trembles, int(LASTING * window))


def standstill(record: DriveRecord) -> Standstill:
    """Where the axis of a record stands, and how fast it seems to go there."""
    window = window_of(record.step, record.cutoff)
    still = record.standing
    if still is None:
        steps = np.diff(record.time) * (record.velocity[1:] + record.velocity[:-1]) / 2
        still = standing(record.time, np.concatenate([[0.0], np.cumsum(steps)]), record.velocity, window, window // 2)
    settled = 0 if record.cutoff is None else window
    deep = ~_widened(~still, settled)
    speed = float(np.quantile(np.abs(record.velocity[deep]), SHOWN)) if bool(deep.any()) else 0.0
    return Standstill(_widened(still, settled) if still.any() else still, speed)


def window_of(step: float, cutoff: float | None) -> int:
    """Samples of a window: one period of the low-pass, within which its response has died away, or `WINDOW`."""
    return WINDOW if cutoff is None else max(WINDOW, int(np.ceil(1.0 / cutoff / step)))


def _trembles(velocity: Array, window: int) -> NDArray[np.bool_]:
    """Samples with `TURNS` changes of sign within a window on either side, and one at least on each."""
    turns = np.cumsum(np.concatenate([[0], np.sign(velocity[1:]) * np.sign(velocity[:-1]) < 0]))
    at = np.arange(len(turns))
    before = turns - turns[np.maximum(at - window, 0)]
    after = turns[np.minimum(at + window, len(turns) - 1)] - turns
    return np.asarray((before > 0) & (after > 0) & (before + after >= TURNS))


def _rest_span(path: Array) -> float:
    """Range of a window at rest: noise, and one step of the encoder."""
    noise = float(np.median(np.abs(np.diff(path, 3)))) * _THIRD_DIFFERENCE
    steps = np.abs(np.diff(path))
    step = np.min(steps, where=steps > 0, initial=np.inf)
    return float(NOISE * noise + (1.001 * step if np.isfinite(step) else 0.0))


def _widened(mask: NDArray[np.bool_], by: int) -> NDArray[np.bool_]:
    """A mask with so many samples more on each side of all that it holds."""
    if not by or not mask.any():
        return mask
    return np.asarray(np.convolve(mask, np.ones(2 * by + 1), "same") > 0.5)


def _lasting(mask: NDArray[np.bool_], least: int) -> NDArray[np.bool_]:
    """A mask without its stretches of fewer samples."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    kept = np.zeros(len(mask), dtype=bool)
    for first, last in edges.reshape(-1, 2):
        kept[first:last] = last - first >= least
    return kept
