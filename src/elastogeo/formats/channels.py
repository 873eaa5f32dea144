"""Channels of a log -> columns of a table on one clock.

The common clock is that of the slowest channel chosen, unless a test asks for another: a faster one would give the slow
channels samples that nobody recorded. If that clock is regular, its channel and all that share it are passed on as they
are, bit for bit, at their own times; the others are interpolated linearly, between neighbours that are close enough. Over a
gap T a straight line is off by up to a T^2/8 where the acceleration is a: three sample times (two samples lost) cost nine
times the error between neighbours, and a reversal of the axis can still be told. So longer gaps are left open unless the
test says otherwise, and the time of the table jumps there. What was done to a recording is told in sentences.

**Not** a filter: where a channel is faster than the common clock, its samples in between are left out, and what it did there
faster than half the common rate shows as something slower.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.formats.channel_clock import (
    SAME,
    Track,
    at_moments,
    common_moments,
    cut,
    on_gaps,
    on_rates,
    on_values,
    unwrapped,
)
from elastogeo.formats.channel_uses import ChannelUse, Clock
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.spikes import sentences, spikes
from elastogeo.formats.text.table import Table
from elastogeo.formats.text.units import PERCENT, UNITS, check_unit, is_rated, split_unit, to_internal
from elastogeo.machine import Array

GAP = 3.0
"""The longest gap that is bridged, in sample times; why: see above."""

_SHOWN = 15


@dataclass(frozen=True, slots=True)
class OnOneClock:
    """Channels on one clock.

    Attributes
    ----------
    table : Table
        The column `time` [s], from zero, and one for each quantity, in internal units; all finite. The report stands in
        its metadata under `clock`.
    step : float [s]
        The sample time; `time` advances by it, and by more where samples were left out.
    report : tuple of str
        What was found and done, in sentences.
    percent : tuple of str
        Quantities whose column is in percent of a rated value that nobody gave.
    """

    table: Table
    step: float
    report: tuple[str, ...]
    percent: tuple[str, ...] = ()


_AS_RECORDED = Clock()


def on_one_clock(
    log: Log,
    uses: Sequence[ChannelUse] = (),
    clock: Clock = _AS_RECORDED,
    start: float | None = None,
    end: float | None = None,
) -> OnOneClock:
    """Put channels of a log on one clock.

    Parameters
    ----------
    log : Log
    uses : sequence of ChannelUse
        The channels to take; without any, each whose name is that of a quantity and whose unit is known (`current_x_A`).
    clock : Clock
    start, end : float, optional [s]
        The part to take, both ends included, on the clock of the file.

    Returns
    -------
    OnOneClock

    Raises
    ------
    FormatError
        If a channel is not there, has no unit or a wrong one, no number or no clock, or if the channels have no moment in
        common.
    """
    report = list(log.notes)
    tracks = [cut(unwrapped(t, report), start, end, log.source) for t in _tracks(log, uses, clock, report)]
    slowest = max(track.step for track in tracks)
    step = clock.sample_time or slowest
    bridged = (clock.longest_gap or GAP * max(step, slowest)) * (1 + SAME)
    moments = common_moments(tracks, step, bridged, log.source)
    found = [at_moments(track, moments, step, bridged) for track in tracks]
    kept = np.logical_and.reduce([one.valid for one in found])
    if not kept.any():
        raise FormatError(
            f"{log.source}: at no moment do all of {', '.join(t.quantity for t in tracks)} have a sample within "
            f"{bridged:.4g} s; take fewer channels, or allow a longer gap in test.toml or drive.toml: [clock] longest_gap_s"
        )
    report += on_rates(tracks) + on_gaps(tracks, bridged)
    report += on_values(tracks, [one.recorded[kept] for one in found], step, int((~kept).sum()))
    time = moments[kept]
    if time[0] != 0:
        report.append(f"the time of the table begins at zero, which is {time[0]:.9g} s on the clock of the file")
    columns = {track.quantity: one.values[kept] for track, one in zip(tracks, found, strict=True)}
    metadata = {**log.metadata, "clock": "\n".join(report)}
    percent = tuple(track.quantity for track in tracks if track.percent)
    return OnOneClock(Table({"time": time - time[0], **columns}, metadata, log.source), step, tuple(report), percent)


def _chosen(log: Log, uses: Sequence[ChannelUse], report: list[str]) -> list[tuple[ChannelUse, Channel]]:
    """The uses, each with its channel and with its unit filled in."""
    uses = uses or _told(log, report)
    names = [use.quantity for use in uses]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise FormatError(f"{log.source}: {twice[0]!r} is taken from two channels; take it from one, and rename the other")
    return [_with_unit(use, _find(log, use), log.source) for use in uses]


def _told(log: Log, report: list[str]) -> list[ChannelUse]:
    """The channels that say what they are and their unit."""
    uses, left_out = [], []
    for channel in log.channels.values():
        quantity = _quantity(channel)
        try:
            check_unit(quantity, channel.unit, percent=True)
        except FormatError:
            quantity = ""
        if quantity and channel.unit:
            uses.append(ChannelUse(quantity, channel.name))
        else:
            left_out.append(channel.name)
    if not uses:
        raise FormatError(
            f"{log.source}: no channel says what it is and its unit, as current_x_A does; say it in test.toml or "
            f'drive.toml for each: [[channels]] quantity = "current_x", channel = "{next(iter(log.channels))}", unit = "A". '
            f"The channels are {_listed(left_out)}"
        )
    if left_out:
        report.append(f"channels that do not say a quantity and its unit, not taken: {_listed(left_out)}")
    return uses


def _find(log: Log, use: ChannelUse) -> Channel:
    """The channel that a use means."""
    if use.channel in log.channels:
        return log.channels[use.channel]
    wanted = use.channel or use.quantity
    found = [c for c in log.channels.values() if wanted.lower() in (c.name.lower(), _quantity(c))]
    if len(found) == 1:
        return found[0]
    if found:
        raise FormatError(
            f"{log.source}: {wanted!r} may be {' or '.join(c.name for c in found)}; write the channel's whole name"
        )
    near = get_close_matches(wanted, log.channels, n=1)
    hint = f"did you mean {near[0]!r}?" if near else f"it has {_listed(list(log.channels))}"
    notes = "; ".join(note for note in log.notes if wanted in note)
    raise FormatError(f"{log.source}: has no channel {wanted!r}; {hint}{f' ({notes})' if notes else ''}")


def _with_unit(use: ChannelUse, channel: Channel, source: str) -> tuple[ChannelUse, Channel]:
    where = f"{source}, channel {channel.name!r}"
    if use.unit and channel.unit and UNITS.get(use.unit) != UNITS[channel.unit]:
        raise FormatError(f"{where}: the file says {channel.unit}, its [[channels]] says {use.unit}; leave the unit out")
    unit = channel.unit or use.unit
    if not unit:
        raise FormatError(f'{where}: the file gives no unit; add unit = "mm" (or "1" for none) to its [[channels]]')
    unit = "" if unit == "1" else unit
    try:
        check_unit(use.quantity, unit, percent=True)
    except FormatError as error:
        raise FormatError(f"{where}: {error}") from None
    if use.rated is not None and unit != "%":
        raise FormatError(f"{where}: has a rated value, but is in {unit}, not in %; leave the rated value out")
    return replace(use, unit=unit), channel


def _quantity(channel: Channel) -> str:
    """The quantity that the name of a channel says; empty if it says none."""
    try:
        quantity, unit = split_unit(channel.name)
    except FormatError:
        return ""
    if not unit or unit == channel.unit:
        return quantity
    return "_".join(channel.name.lower().split())


def _listed(names: Sequence[str]) -> str:
    more = f", ... ({len(names)} in all)" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more


def _tracks(log: Log, uses: Sequence[ChannelUse], clock: Clock, report: list[str]) -> list[Track]:
    """Every quantity on its own clock, in internal units, without the samples that have no number."""
    chosen = _chosen(log, uses, report)
    own = next((to_internal(channel.values, use.unit) for use, channel in chosen if use.quantity == "time"), None)
    others = [(use, channel) for use, channel in chosen if use.quantity != "time"]
    if not others:
        raise FormatError(f"{log.source}: only its time is asked for; name the channels to take")
    without = {len(channel.values) for _, channel in others if channel.time is None}
    if len(without) > 1:
        raise FormatError(
            f"{log.source}: channels without a clock have {sorted(without)} samples, so they cannot be aligned"
        )
    tracks = []
    for use, channel in others:
        where = f"{log.source}, channel {channel.name!r}"
        moments = channel.time
        if moments is None:
            moments = _made(len(channel.values), own, _counts(log), clock, where)
        strange = spikes(channel.values)
        report += sentences(use.quantity, channel.values, strange)
        values = to_internal(np.where(strange.code, np.nan, channel.values), use.unit)
        there = np.isfinite(values) & np.isfinite(moments)
        if there.sum() < 2:
            raise FormatError(
                f"{where}: {int(there.sum())} of its {len(values)} samples are numbers with a time; two are needed"
            )
        if not there.all():
            report.append(f"{use.quantity}: {int((~there).sum())} of {len(there)} samples have no number or no time")
        if use.delay:
            report.append(f"{use.quantity}: its clock is set back by its delay of {use.delay:.6g} s")
        ticks = moments[np.isfinite(moments)] - use.delay
        steps = np.diff(ticks)
        if (steps <= 0).any():
            raise FormatError(
                f"{where}: its time does not go forward at sample {int(np.argmax(steps <= 0)) + 2}; put it in order"
            )
        dimension = UNITS[use.unit].dimension if use.unit else ""
        percent = dimension == PERCENT and use.rated is None and is_rated(use.quantity)
        if use.rated is not None:
            values = values * use.rated / 100
        step = float(np.median(steps))
        clock_of = moments[there] - use.delay
        tracks.append(Track(use.quantity, ticks, clock_of, values[there], step, dimension == "angle", percent))
    return tracks


def _counts(log: Log) -> Array | None:
    """What the channel that counts the samples says, in sample times from zero."""
    if not log.counter:
        return None
    counts = log.channels[log.counter].values
    return np.asarray(counts - counts[0])


def _made(count: int, own: Array | None, counts: Array | None, clock: Clock, where: str) -> Array:
    """The clock of a channel that has none, shape (count,) [s]."""
    if own is not None:
        if len(own) != count:
            raise FormatError(f"{where}: has {count} samples, the channel of the time {len(own)}; they must be as many")
        return own
    if clock.sample_time is None:
        raise FormatError(
            f"{where}: the file keeps no clock; say the sample time in test.toml or drive.toml: [clock] sample_time_ms = 2"
        )
    if counts is not None and len(counts) == count:
        return counts * clock.sample_time
    return np.asarray(np.arange(count) * clock.sample_time, dtype=np.float64)
