"""Observations with time stamps, one by one or in series, gathered by data item into channels (MTConnect, SHDR)."""

from __future__ import annotations

import math
import re
from array import array
from calendar import timegm
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel

MAX_ITEMS = 2000
COARSE = 0.1
"""Share of an item's observations that may be dropped because others have the same time."""
#: A number in the spelling of XML and of most programs: a decimal point, perhaps an exponent.
NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?", re.ASCII)

_TIME = re.compile(r"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d)(?:\.(\d{1,12}))?(Z|[+-]\d\d:?\d\d)?", re.ASCII)
_PIECE = re.compile(r"\S[\s\S]{0,20000}\S*")
_PLAIN = re.compile(r"[-+.\deE\s]*", re.ASCII)
_SECOND = 1_000_000_000
_SHOWN = 5


@dataclass(slots=True, eq=False)
class Item:
    """The observations of one data item, each one value or a series of several.

    `times` are those of the last value of each [ns], `orders` those of arrival, `counts` numbers of values, `rates` their
    rate [Hz] (0 for one value), `values` the values of all.
    """

    key: str
    name: str
    unit: str = ""
    text: str = ""
    times: array[int] = field(default_factory=lambda: array("q"))
    orders: array[int] = field(default_factory=lambda: array("Q"))
    counts: array[int] = field(default_factory=lambda: array("I"))
    rates: array[float] = field(default_factory=lambda: array("d"))
    values: array[float] = field(default_factory=lambda: array("d"))

    def add(self, time: int, order: int, values: Sequence[float], rate: float = 0.0) -> None:
        """Add one value, or a series of values at a rate [Hz] whose last is of this time [ns]."""
        if not self.text and len(values):
            self.times.append(time)
            self.orders.append(order)
            self.counts.append(len(values))
            self.rates.append(rate)
            self.values.extend(values)

    def set_text(self, text: str) -> None:
        """Note that this is not an item of numbers; nothing more is kept of it."""
        if not self.text:
            self.text = text[:40] or "nothing"
            del self.times[:], self.orders[:], self.counts[:], self.rates[:], self.values[:]


class Observations:
    """All observations of a stream by data item; `channels` puts them in the order of time."""

    def __init__(self) -> None:
        self.items: dict[str, Item] = {}
        self.rateless: dict[str, None] = {}
        self.zoneless = False
        self._seconds: dict[str, int] = {}

    def item(self, key: str, name: str, where: str) -> Item:
        """The item of this key, new if need be.

        Raises
        ------
        FormatError
            If there are more than `MAX_ITEMS`.
        """
        if key not in self.items:
            if len(self.items) >= MAX_ITEMS:
                raise FormatError(f"{where}: there are more than {MAX_ITEMS} data items; record those of the test only")
            self.items[key] = Item(key, name)
        return self.items[key]

    def nanoseconds(self, text: str, where: str) -> int:
        """A time stamp (ISO 8601) in nanoseconds since 1970.

        Raises
        ------
        FormatError
            If it is none, or finer than a nanosecond.
        """
        found = _TIME.fullmatch(text)
        if not found:
            raise FormatError(f"{where}: the time {text[:40]!r} is not one as 2026-01-31T12:00:00.123Z; correct it")
        second, fraction, zone = found.groups()
        self.zoneless |= zone is None
        stamp = second + (zone or "Z")
        if stamp not in self._seconds:
            if len(self._seconds) > 1000:
                self._seconds.clear()
            self._seconds[stamp] = _epoch(stamp, where)
        digits = (fraction or "").ljust(9, "0")
        if digits[9:].strip("0"):
            raise FormatError(f"{where}: the time {text[:40]!r} is finer than a nanosecond; write at most 9 decimals")
        return self._seconds[stamp] * _SECOND + int(digits[:9])

    def channels(self, source: str) -> tuple[dict[str, Channel], int, list[str]]:
        """The channels of all items of numbers, the time of their zero [ns since 1970], and notes.

        Raises
        ------
        FormatError
            If there is no item of numbers, or the clock of one cannot be used.
        """
        notes: list[str] = []
        kept: list[Item] = []
        never: list[Item] = []
        texts: list[str] = []
        for item in self.items.values():
            if item.text:
                texts.append(f"{item.name} ({item.text!r})")
            elif len(item.values):
                (never if np.isnan(np.frombuffer(item.values)).all() else kept).append(item)
        if not kept:
            raise FormatError(f"{source}: holds no data item of numbers that was ever available; record its samples too")
        start = min(first for item in kept for first in _firsts(item))
        names = Counter(item.name for item in kept)
        channels: dict[str, Channel] = {}
        for item in kept:
            name = item.name if names[item.name] == 1 else f"{item.name} ({item.key})"
            while name in channels:
                name = f"{name} ({item.key})"
            channels[name] = _channel(item, name, start, f"{source}, {name}", notes)
        if texts:
            notes.append(f"{len(texts)} items of text are left out: {listed(texts)}")
        if never:
            notes.append(f"{len(never)} items that were never available are left out: {listed([i.name for i in never])}")
        if self.rateless:
            notes.append(f"time series without a sample rate are left out: {listed(list(self.rateless))}")
        if self.zoneless:
            notes.append("times without a zone are taken as UTC")
        return channels, start, notes


def numbers_of(text: str, where: str) -> array[float]:
    """The values of a time series, separated by blanks; NaN for one that is unavailable.

    Raises
    ------
    FormatError
        If one is no finite number.
    """
    values = array("d")
    for piece in _PIECE.finditer(text):
        cells = piece[0].split()
        if not _PLAIN.fullmatch(piece[0]):
            cells = [cell if cell.upper() != "UNAVAILABLE" else "nan" for cell in cells]
        values.extend(_value(cell, where) for cell in cells)
    return values


def rate_of(text: str, count: int, where: str) -> float:
    """The rate [Hz] of a time series of `count` values.

    Raises
    ------
    FormatError
        If it is none that a logger has.
    """
    rate = float(text) if NUMBER.fullmatch(text) else math.nan
    if not 1e-6 <= rate <= 1e8 or count / rate > 1e9:
        raise FormatError(f"{where}: the sample rate {text[:40]!r} is not one in Hz; correct it")
    return rate


def stamp_of(time: int) -> str:
    """A time [ns since 1970] as text (ISO 8601)."""
    moment = datetime.fromtimestamp(time // _SECOND, UTC)
    return f"{moment:%Y-%m-%dT%H:%M:%S}.{time % _SECOND:09d}Z"


def listed(names: Sequence[str]) -> str:
    """The first few names of many, for a note."""
    return ", ".join(names[:_SHOWN]) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")


def _value(cell: str, where: str) -> float:
    if cell == "nan":
        return math.nan
    value = float(cell) if NUMBER.fullmatch(cell) else math.inf
    if not math.isfinite(value):
        raise FormatError(f"{where}: {cell[:40]!r} in the time series is not a finite number; correct it")
    return value


def _epoch(stamp: str, where: str) -> int:
    """Seconds since 1970 of a time without fraction."""
    try:
        second = timegm(datetime.fromisoformat(stamp).utctimetuple())
    except (ValueError, OverflowError):
        second = -1
    if not 0 <= second < 9_000_000_000:
        raise FormatError(f"{where}: the time {stamp!r} is no date from 1970 on; correct it")
    return second


def _firsts(item: Item) -> Iterator[int]:
    """The time of the first value of each observation [ns]."""
    for time, count, rate in zip(item.times, item.counts, item.rates, strict=True):
        yield time if count == 1 else time - round((count - 1) * 1e9 / rate)


def _channel(item: Item, name: str, start: int, where: str, notes: list[str]) -> Channel:
    """The channel of an item: in the order of time, without repeated observations."""
    times, orders = np.frombuffer(item.times, np.int64), np.frombuffer(item.orders, np.uint64)
    place = np.arange(len(times))
    back = np.diff(times) <= 0
    if back.any():
        moved = int((np.diff(times) < 0).sum())
        place = np.lexsort((place, orders, times))
        if moved:
            notes.append(f"{name}: at {moved} places time went back; the observations are put in its order")
        place = place[_kept(item, place, name, where, notes)]
    series = np.frombuffer(item.counts, np.uint32)[place] > 1
    if series.any():
        return _series_channel(item, name, place, start, where)
    values = np.frombuffer(item.values)
    counts = np.frombuffer(item.counts, np.uint32)
    if len(place) < len(times) or back.any():
        values = values[(np.cumsum(counts, dtype=np.int64) - 1)[place]]
    after = times[place] - start
    return Channel(name, item.unit, values, after // _SECOND + (after % _SECOND) / 1e9)


def _kept(item: Item, place: NDArray[np.int64], name: str, where: str, notes: list[str]) -> NDArray[np.bool_]:
    """Which observations, in the order of time, are kept: of those of one time the last."""
    values = np.frombuffer(item.values)
    ends = np.cumsum(np.frombuffer(item.counts, np.uint32), dtype=np.int64)
    keep = np.ones(len(place), bool)
    repeated = clash = 0
    times = np.frombuffer(item.times, np.int64)[place]
    for k in np.flatnonzero(times[1:] == times[:-1]).tolist():
        one, other = int(place[k]), int(place[k + 1])
        mine = values[ends[one] - item.counts[one] : ends[one]]
        others = values[ends[other] - item.counts[other] : ends[other]]
        keep[k] = False
        if item.rates[one] == item.rates[other] and np.array_equal(mine, others, equal_nan=True):
            repeated += 1
        elif item.orders[one] == item.orders[other] or max(len(mine), len(others)) > 1:
            raise FormatError(
                f"{where}: sequence {item.orders[one]} and {item.orders[other]} are of one time with different values, as "
                f"{mine[-1]:.12g} and {others[-1]:.12g}; take one out"
            )
        else:
            clash += 1
    if clash > max(1, COARSE * len(place)):
        raise FormatError(
            f"{where}: {clash} of {len(place)} observations have the time of another with a different value; such a clock "
            "is too coarse; let the adapter send finer times"
        )
    if repeated:
        notes.append(f"{name}: {repeated} repeated observations are left out")
    if clash:
        notes.append(f"{name}: of different values at one time the last is kept ({clash} left out)")
    return keep


def _series_channel(item: Item, name: str, place: NDArray[np.int64], start: int, where: str) -> Channel:
    """The channel of an item with time series, in this order."""
    ends = np.cumsum(np.frombuffer(item.counts, np.uint32), dtype=np.int64)
    stored = np.frombuffer(item.values)
    whole = np.array_equal(place, np.arange(len(item.times)))
    values = stored if whole else np.concatenate([stored[ends[k] - item.counts[k] : ends[k]] for k in place.tolist()])
    seconds = np.empty(len(values))
    at, before = 0, -math.inf
    for k in place.tolist():
        count, after = item.counts[k], item.times[k] - start
        last = after // _SECOND + (after % _SECOND) / 1e9
        block = last - np.arange(count - 1, -1, -1) / item.rates[k] if count > 1 else np.array([last])
        if block[0] <= before:
            raise FormatError(
                f"{where}: the time series of sequence {item.orders[k]} begins before the one before it ends; the clock or "
                "the sample rate is wrong; correct it"
            )
        if (np.diff(block) <= 0).any():
            raise FormatError(f"{where}: the sample rate of sequence {item.orders[k]} is finer than its clock; correct it")
        seconds[at : at + count] = block
        at, before = at + count, last
    return Channel(name, item.unit, values, seconds)
