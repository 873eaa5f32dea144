"""Tracks on a common clock: each channel of a log on its own clock, and its values at the moments that all of them share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.machine import Array

REGULAR = 1e-3
"""How far the steps of a regular clock may be from whole sample times, in sample times: the digits that clocks are written
with cost less, and a velocity changes by as much."""
SAME = 1e-6
"""A moment this near to a sample, in sample times, is that sample's: no clock is kept better."""
MAX_SAMPLES = 20_000_000

_SHOWN = 5


@dataclass(frozen=True, slots=True)
class Track:
    """One quantity on its own clock.

    Attributes
    ----------
    quantity : str
    clock : array, shape (m,) [s]
        Of every sample, with or without a number.
    time, values : array, shape (n,) [s, internal unit]
        Of the samples that have a number.
    step : float [s]
        The median step of the clock.
    angle : bool
        Whether the values are angles.
    percent : bool
        Whether they are percent of a rated value that nobody gave.
    """

    quantity: str
    clock: Array
    time: Array
    values: Array
    step: float
    angle: bool
    percent: bool = False


def unwrapped(track: Track, report: list[str]) -> Track:
    """An angle that starts again after a full turn, made continuous, so that no line is drawn across its jump.

    It starts again if all of it lies within one turn and neighbours are more than half a turn apart.
    """
    jumps = np.abs(np.diff(track.values)) > pi
    if not track.angle or not jumps.any() or np.ptp(track.values) > 2 * pi * (1 + 1e-6):
        return track
    report.append(f"{track.quantity}: passes the end of its turn {int(jumps.sum())} times; made continuous by full turns")
    return replace(track, values=np.unwrap(track.values))


def cut(track: Track, start: float | None, end: float | None, source: str) -> Track:
    """The part from start to end."""
    if start is None and end is None:
        return track
    first, last = -inf if start is None else start, inf if end is None else end
    inside = (track.time >= first) & (track.time <= last)
    if inside.sum() < 2:
        raise FormatError(
            f"{source}: {track.quantity} has {int(inside.sum())} samples from {first:.9g} s to {last:.9g} s; it is recorded "
            f"from {track.time[0]:.9g} s to {track.time[-1]:.9g} s: correct start_s and end_s"
        )
    ticks = track.clock[(track.clock >= first) & (track.clock <= last)]
    return replace(track, clock=ticks, time=track.time[inside], values=track.values[inside])


def common_moments(tracks: Sequence[Track], step: float, bridged: float, source: str) -> Array:
    """The moments of the common clock [s]: those of the slowest track if it is regular and of this step, else new ones.

    Gaps of up to `bridged` are filled with moments.
    """
    first, last = max(t.time[0] for t in tracks), min(t.time[-1] for t in tracks)
    if last < first:
        ends = ", ".join(f"{t.quantity} {t.time[0]:.9g} to {t.time[-1]:.9g} s" for t in tracks[:_SHOWN])
        raise FormatError(f"{source}: the channels were not recorded at the same time ({ends}); take others")
    slowest = max(track.step for track in tracks)
    ticks = next(track.clock for track in tracks if track.step >= slowest * (1 - REGULAR))
    steps = np.diff(ticks)
    whole = np.rint(steps / step)
    regular = (steps > bridged) | ((np.abs(steps / step - whole) <= REGULAR * whole) & (whole >= 1))
    if not regular.all():
        _check_count((last - first) / step, step, source)
        count = int((last - first) / step + SAME) + 1
        return np.asarray(first + step * np.arange(count), dtype=np.float64)
    parts = np.append(np.where(steps <= bridged, whole, 1), 1).astype(np.int64)
    _check_count(float(parts.sum()), step, source)
    within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    moments = np.repeat(ticks, parts) + within * np.repeat(np.append(steps, 0.0) / parts, parts)
    return np.asarray(moments, dtype=np.float64)


def _check_count(count: float, step: float, source: str) -> None:
    if count > MAX_SAMPLES:
        raise FormatError(
            f"{source}: every {step:.6g} s makes {count:.3g} samples, at most {MAX_SAMPLES} are made; take a part by "
            f"start_s and end_s, or a longer [clock] sample_time_s"
        )


@dataclass(frozen=True, slots=True)
class Values:
    """One quantity at the moments of the common clock: its values, whether it has one there, whether that was recorded."""

    values: Array
    valid: NDArray[np.bool_]
    recorded: NDArray[np.bool_]


def at_moments(track: Track, moments: Array, step: float, bridged: float) -> Values:
    """The values of a track at moments of the common clock, shape (m,) [s]; gaps of up to `bridged` are bridged."""
    time, values = track.time, track.values
    if np.array_equal(time, moments):
        everywhere = np.ones(len(time), dtype=bool)
        return Values(values, everywhere, everywhere)
    after = np.clip(np.searchsorted(time, moments), 1, len(time) - 1)
    nearest = np.where(moments - time[after - 1] <= time[after] - moments, after - 1, after)
    recorded = np.abs(moments - time[nearest]) <= SAME * step
    between = (moments > time[0]) & (moments < time[-1])
    close = time[after] - time[after - 1] <= bridged
    return Values(
        np.where(recorded, values[nearest], np.interp(moments, time, values)), recorded | (between & close), recorded
    )


def on_rates(tracks: Sequence[Track]) -> list[str]:
    """How often each was recorded, and how regularly."""
    sentences = []
    for group in _groups(tracks, [track.clock for track in tracks]):
        step, steps = group[0].step, np.diff(group[0].clock)
        off = steps[steps < 1.5 * step] - step
        jitter = "without jitter"
        if len(off) and np.abs(off).max() > REGULAR * step:
            jitter = f"jitter {np.sqrt(np.mean(off**2)):.3g} s rms, {np.abs(off).max():.3g} s at worst"
        names = ", ".join(track.quantity for track in group)
        sentences.append(f"{names}: {len(steps) + 1} samples, one every {step:.6g} s ({1 / step:.6g} Hz), {jitter}")
    return sentences


def on_gaps(tracks: Sequence[Track], bridged: float) -> list[str]:
    """Where samples are missing."""
    sentences = []
    for group in _groups(tracks, [track.time for track in tracks]):
        time, step = group[0].time, group[0].step
        steps = np.diff(time)
        places = np.flatnonzero(steps > 1.5 * step)
        if len(places):
            kinds = ["bridged" if steps[k] <= bridged else "left open" for k in places[:_SHOWN]]
            shown = [f"{steps[k]:.6g} s after {time[k]:.9g} s ({how})" for k, how in zip(places, kinds, strict=False)]
            more = f", and {len(places) - _SHOWN} more" if len(places) > _SHOWN else ""
            names = ", ".join(track.quantity for track in group)
            sentences.append(f"{names}: no sample for {', '.join(shown)}{more}; bridged is up to {bridged:.4g} s")
    return sentences


def on_values(tracks: Sequence[Track], recorded: Sequence[NDArray[np.bool_]], step: float, left_out: int) -> list[str]:
    """What was interpolated and what was left out."""
    count = len(recorded[0])
    sentences = []
    if left_out:
        sentences.append(f"{left_out} of {count + left_out} common samples lie in a gap or beyond a channel: left out")
    for track, own in zip(tracks, recorded, strict=True):
        made = count - int(own.sum())
        if made:
            sentences.append(f"{track.quantity}: {made} of {count} values are interpolated")
        if step > 1.5 * track.step:
            sentences.append(f"{track.quantity}: taken every {step:.6g} s of one every {track.step:.6g} s, without a filter")
    if all(own.all() for own in recorded):
        sentences.append("every value stands as it was recorded: nothing is interpolated")
    return sentences


def _groups(tracks: Sequence[Track], clocks: Sequence[Array]) -> list[list[Track]]:
    """The tracks, those of equal clocks together."""
    groups: list[tuple[Array, list[Track]]] = []
    for track, ticks in zip(tracks, clocks, strict=True):
        same = next((group for known, group in groups if np.array_equal(known, ticks)), None)
        if same is None:
            groups.append((ticks, [track]))
        else:
            same.append(track)
    return [group for _, group in groups]
