"""Velocity and acceleration from an encoder: zero phase, with a chosen cut-off, and a gain that is known at every frequency.

The position is low-passed forward and backward (Butterworth of the second order, so four poles in all and no phase), then
differentiated by the central stencils of five points. The effort that is balanced against the motion must pass the same
low-pass (`smoothed`): then both sides of Eq. 6.6 lose the same part of every frequency, and what is left of the
differentiator's effect on the inertia is that of the stencil alone, `gain(..., 0) / gain(..., 2)`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import ceil, cos, pi, sin, tan

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import InputError
from elastogeo.machine import Array

ORDER = 2
"""Of the Butterworth filter that is run forward and backward."""

JITTER = 0.01
"""Share of the step by which a clock may be off and still count as uniform."""

JUMP = 1.5
"""A step longer than this many steps begins a new segment."""

SETTLING = 1.0
"""Periods of the cut-off from an end of a segment within which its end shows in the filter."""

_VELOCITY = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12
_ACCELERATION = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12
_LEAST = 4 * ORDER + 8
"""Samples without which a segment is not filtered."""


@dataclass(frozen=True, slots=True, eq=False)
class Derivatives:
    """Smoothed position and its derivatives.

    Attributes
    ----------
    position : array, shape (m,) [mm; rad of a rotary axis]
    velocity : array, shape (m,) [mm/s]
    acceleration : array, shape (m,) [mm/s^2]
        NaN, as the other two, in segments that are too short to be filtered.
    step : float [s]
    edge : array of bool, shape (m,)
        Samples so near to an end of their segment that the end shows in them: leave them out.
    """

    position: Array
    velocity: Array
    acceleration: Array
    step: float
    edge: NDArray[np.bool_]


def differentiate(time: Array, position: Array, cutoff: float) -> Derivatives:
    """Velocity and acceleration of a recorded position.

    Parameters
    ----------
    time : array, shape (m,) [s]
        Uniform but for jumps, at which the record is cut.
    position : array, shape (m,) [mm; rad]
    cutoff : float [Hz]
        At which the low-pass, forward and backward, halves the amplitude.

    Returns
    -------
    Derivatives

    Raises
    ------
    InputError
        If the clock is not uniform, a value is not finite, the cut-off is not below half the sampling rate, or no segment
        is long enough to be filtered.
    """
    smooth = smoothed(time, position, cutoff)
    step = _step(time)
    velocity, acceleration = np.full(len(time), np.nan), np.full(len(time), np.nan)
    edge = np.ones(len(time), dtype=bool)
    ends = ceil(SETTLING / cutoff / step)
    for segment in _segments(time, step):
        if np.isnan(smooth[segment]).any():
            continue
        around = np.pad(smooth[segment], 2, mode="reflect", reflect_type="odd")
        velocity[segment] = np.convolve(around, _VELOCITY[::-1], "valid") / step
        acceleration[segment] = np.convolve(around, _ACCELERATION, "valid") / step**2
        edge[segment.start + ends : segment.stop - ends] = False
    return Derivatives(smooth, velocity, acceleration, step, edge)


def smoothed(time: Array, values: Array, cutoff: float) -> Array:
    """Values under the low-pass of `differentiate`, shape (m,): for the effort that is balanced against the motion.

    NaN in segments that are too short to be filtered.

    Raises
    ------
    InputError
        As `differentiate`.
    """
    from scipy.signal import sosfiltfilt  # here, where it is used: it takes half a second to import

    return _by_segment(time, values, cutoff, lambda sos, part: sosfiltfilt(sos, part))


def gain(cutoff: float, step: float, frequency: float, derivative: int = 2) -> float:
    """Gain of the differentiator at a frequency: 1 where it gives the true derivative.

    Parameters
    ----------
    cutoff, frequency : float [Hz]
    step : float [s]
    derivative : int
        0 of the low-pass alone (what `smoothed` leaves of an effort), 1 of the velocity, 2 of the acceleration.

    Returns
    -------
    float
        An inertia that is identified from an effort as it is comes out too large by `1 / gain(..., 2)`; from an effort that
        was `smoothed` alike, by `gain(..., 0) / gain(..., 2)` only.
    """
    check_cutoff(cutoff, step)
    if not 0 <= frequency < 0.5 / step:
        raise InputError(
            f"a record with a sample every {step:g} s says nothing of {frequency:g} Hz; ask below {0.5 / step:g} Hz"
        )
    low_pass = 1.0 / (1.0 + (tan(pi * frequency * step) / _warped(cutoff, step)) ** (2 * ORDER))
    turn = 2 * pi * frequency * step
    if not turn or not derivative:
        return low_pass
    if derivative == 1:
        return low_pass * (8 * sin(turn) - sin(2 * turn)) / (6 * turn)
    return low_pass * (30 - 32 * cos(turn) + 2 * cos(2 * turn)) / (12 * turn**2)


def check_cutoff(cutoff: float, step: float) -> None:
    """Refuse a cut-off that no sampled low-pass can have.

    Raises
    ------
    InputError
    """
    if not 0 < cutoff < 0.5 / step:
        raise InputError(
            f"the cut-off of {cutoff:g} Hz is out of range for a sample every {step:g} s; choose one above 0, below "
            f"half the sampling rate, {0.5 / step:g} Hz"
        )


def _warped(cutoff: float, step: float) -> float:
    """Tangent of the half turn per sample of the design frequency: after both passes the gain at `cutoff` is a half."""
    return tan(pi * cutoff * step)


def _by_segment(time: Array, values: Array, cutoff: float, apply: Callable[[Array, Array], Array]) -> Array:
    if values.shape != time.shape or values.ndim != 1:
        raise InputError(f"{len(time)} times and values of the shape {values.shape} arrived; each sample has one of each")
    step = _step(time)
    if not np.isfinite(values).all():
        where = int(np.argmin(np.isfinite(values)))
        raise InputError(f"sample {where + 1} (at {time[where]:g} s) is no finite number; repair the record or cut it there")
    check_cutoff(cutoff, step)
    sos = _low_pass(cutoff, step)
    result = np.full(len(time), np.nan)
    for segment in _segments(time, step):
        if segment.stop - segment.start >= _LEAST:
            # The line from end to end passes a low-pass unchanged; subtracted, it leaves no transient at the ends.
            line = np.linspace(values[segment][0], values[segment][-1], segment.stop - segment.start)
            result[segment] = line + apply(sos, values[segment] - line)
    if np.isnan(result).all():
        raise InputError(f"no segment of the record has the {_LEAST} samples that the filter needs; record longer")
    return result


@lru_cache(maxsize=16)  # a search filters the same record at every step
def _low_pass(cutoff: float, step: float) -> Array:
    from scipy.signal import butter

    # One pass has 1 / sqrt(2) at its cut-off, two have a half.
    return np.asarray(butter(ORDER, cutoff, fs=1 / step, output="sos"))


def _step(time: Array) -> float:
    """The step of a clock that is uniform but for jumps [s]."""
    steps = np.diff(time)
    if time.ndim != 1 or len(time) < 2 or not np.isfinite(time).all() or (steps <= 0).any():
        raise InputError("a record needs two samples or more, at finite times that increase; sort it and remove doubles")
    step = float(np.median(steps))
    off = np.abs(steps[steps <= JUMP * step] - step)
    if off.max(initial=0.0) > JITTER * step:
        raise InputError(
            f"the clock of the record is not uniform: its step is {step:g} s, give or take {off.max():.3g} s; resample it "
            f"on one clock before it is differentiated"
        )
    return step


def _segments(time: Array, step: float) -> Iterator[slice]:
    """The uniform pieces of a record."""
    cuts = [0, *(np.flatnonzero(np.diff(time) > JUMP * step) + 1).tolist(), len(time)]
    return (slice(first, last) for first, last in pairwise(cuts))
