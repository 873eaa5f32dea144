"""Logs in Parquet: the parts of a recording and its folder, other tables of channel, time and value, and a column a channel.

* Long: the columns `channel`, `value` and a clock, a row for each sample; `status` (OPC UA) and `filled` if there are any.
  This is what `elastogeo record` writes.
* Wide: a clock and a column of numbers for each channel, as data-frame libraries write it. Units in the headers are taken.

The clock is a column of timestamps, or of numbers whose header says their unit (`time_s`, `Time [ms]`). Times are given from
the first sample on; the metadata's `start` says when that was, if the file does.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log, in_time_order
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.recording_files import (
    INITIAL,
    Gap,
    PartHead,
    RecordedChannel,
    Samples,
    encode_part,
    head_of,
    part_files,
    read_table,
    said_gap,
    said_time,
    standing_gaps,
)
from elastogeo.formats.text.files_read import may_open, noted
from elastogeo.formats.text.parquet_bytes import can_read, damaged, pyarrow_modules
from elastogeo.formats.text.table import MAX_COLUMNS
from elastogeo.formats.text.units import UNITS, check_unit, split_unit
from elastogeo.machine import Array

Nanoseconds = NDArray[np.int64]

SHOWN = 20
MAX_PART = 100_000_000
MAX_SAMPLES = 500_000_000

_PER_SECOND = {"s": 1.0, "ms": 1e3, "us": 1e6, "µs": 1e6, "μs": 1e6, "ns": 1e9}
_CLOCK = re.compile(
    rf"(?i:time(?:[ _]?stamp)?|t)(?: *[\[(](?P<unit>{'|'.join(_PER_SECOND)})[\])]|_(?P<tail>{'|'.join(_PER_SECOND)}))"
)
_BAD = np.uint32(0x80000000)


def read_parquet_log(data: bytes, source: str) -> Log:
    """Read one Parquet file as a log.

    Raises
    ------
    FormatError
        If the file is cut off or damaged, has no channel of numbers or no clock where one is needed, or two samples of a
        wide table are of one moment and differ.
    """
    table = read_table(data, source)
    try:
        names = list(table.column_names)
        if {"channel", "value"} <= set(names):
            return _merged([_part(table, source)], source)
        return _wide(table, names, source)
    except (ValueError, OverflowError, MemoryError) as error:
        raise damaged(source, error) from None


def read_recording(folder: str | Path, only: Sequence[Path] = ()) -> Log:
    """Read the folder of a recording as one log.

    Samples are put in the order of their time; one that is there twice is taken once. What was missed stands in the notes.

    Parameters
    ----------
    folder : str or Path
    only : sequence of Path
        The parts to read; all by default.

    Raises
    ------
    FormatError
        If it holds no part, or one that cannot be read or is of another unit than the others.
    """
    folder = Path(folder)
    files = part_files(folder)
    if not files:
        raise FormatError(f"{folder}: holds no part of a recording (part-000001.parquet, ...); check the path")
    if only:
        wanted = {path.name for path in only}
        files = {number: path for number, path in files.items() if path.name in wanted}
        if len(files) < len(wanted):
            missing_part = sorted(wanted - {path.name for path in files.values()})[0]
            raise FormatError(f"{folder}: has no part {missing_part}; check its name")
    parts, notes, rows = [], [], 0
    for path in files.values():
        may_open(path)
        try:
            if path.stat().st_size > MAX_PART:
                raise FormatError(f"{path}: is larger than {MAX_PART // 1_000_000} MB; no recorder writes such parts")
            data = noted(path, path.read_bytes())
        except OSError as error:
            raise FormatError(f"{path}: cannot be opened ({error.strerror}); check its permissions") from None
        part = _part(read_table(data, str(path)), str(path))
        if part.head is None:
            raise FormatError(f"{path}: is no part of a recording of elastogeo; move it to another folder")
        parts.append(part)
        rows += len(part.time)
        if rows > MAX_SAMPLES:
            raise FormatError(f"{folder}: holds more than {MAX_SAMPLES} samples; read fewer parts at a time")
    missing = sorted(set(range(1, max(files))) - set(files)) if not only else []
    if missing:
        notes.append(f"{len(missing)} parts are not there any more (the first: {missing[0]}); their samples are missing")
    return _merged(parts, str(folder), notes)


@dataclass(frozen=True, slots=True)
class _Part:
    """A long table: index into the names, time [ns] from the epoch or any zero, value, and what is to be said of it."""

    names: tuple[str, ...]
    channel: NDArray[np.int64]
    time: Nanoseconds
    value: Array
    filled: NDArray[np.bool_]
    dated: bool
    head: PartHead | None
    bad: int
    initial: int


def _part(table: Any, source: str) -> _Part:
    arrow, _ = pyarrow_modules()
    names = table.column_names
    clock = _clock(table, names)
    if clock is None or "channel" not in names or "value" not in names:
        raise FormatError(
            f"{source}: has the columns {', '.join(names)[:200]}; a log needs channel, value and time_s, or a clock"
        )
    try:
        channel = table.column("channel").cast(arrow.string()).combine_chunks().dictionary_encode()
        channel = channel.combine_chunks() if isinstance(channel, arrow.ChunkedArray) else channel
        value = _floats(table.column("value"), "value", source)
        status = table.column("status").cast(arrow.uint32()).to_numpy() if "status" in names else None
        filled = table.column("filled").cast(arrow.bool_()).to_numpy() if "filled" in names else None
    except (arrow.ArrowException, ValueError) as error:
        raise damaged(source, error) from None
    if channel.null_count or (status is not None and status.dtype != np.uint32):
        raise FormatError(f"{source}: a sample has no channel or no status; copy or export the file again")
    if filled is None or filled.dtype != np.bool_:
        filled = np.zeros(len(value), dtype=np.bool_)
    bad = np.zeros(len(value), dtype=np.bool_) if status is None else (status & _BAD) != 0
    bad &= np.isfinite(value)
    initial = np.zeros(len(value), dtype=np.bool_) if status is None else status == INITIAL
    value = np.where(bad | initial, np.nan, value)
    time, dated = _nanoseconds(table.column(clock), clock, source)
    head = head_of(table.schema.metadata or {}, source)
    index = channel.indices.to_numpy(zero_copy_only=False).astype(np.int64)
    return _Part(
        tuple(channel.dictionary.to_pylist()), index, time, value, filled, dated, head, int(bad.sum()), int(initial.sum())
    )


def _merged(parts: Sequence[_Part], source: str, notes: Sequence[str] = ()) -> Log:
    """One log of the long tables of all parts."""
    numbers: dict[str, int] = {}
    for name in [name for part in parts for name in part.names]:
        numbers.setdefault(name, len(numbers))
    if not numbers:
        raise FormatError(f"{source}: holds no sample; record again")
    if len(numbers) > MAX_COLUMNS:
        raise FormatError(f"{source}: {len(numbers)} channels arrived, at most {MAX_COLUMNS} are read; split the file")
    lookup = [np.array([numbers[name] for name in part.names], dtype=np.int64) for part in parts]
    channel = np.concatenate([table[part.channel] for table, part in zip(lookup, parts, strict=True)])
    time = np.concatenate([part.time for part in parts])
    value = np.concatenate([part.value for part in parts])
    filled = np.concatenate([part.filled for part in parts])
    said = _Said(source, list(notes))
    said.of_parts(parts)
    units = said.units(parts)
    zero = int(time.min())
    channels = {}
    for name, number in numbers.items():
        rows = np.flatnonzero(channel == number)
        rows = rows[said.order(name, time[rows], value[rows], filled[rows])]
        channels[name] = Channel(name, units.get(name, ""), value[rows], (time[rows] - zero) / 1e9)
    servers = dict.fromkeys(part.head.server for part in parts if part.head is not None)
    metadata = {"server": ", ".join(servers)} if servers else {}
    if parts[0].dated:
        metadata["start"] = said_time(zero)
    return Log(channels, metadata, source, tuple(said.notes))


class _Said:
    """Collects what must be said of a recording while it is read."""

    def __init__(self, source: str, notes: list[str]) -> None:
        self.source, self.notes = source, notes

    def of_parts(self, parts: Sequence[_Part]) -> None:
        """Gaps, samples from the history, samples that the source calls bad."""
        gaps = standing_gaps(part.head for part in parts if part.head is not None)
        self.notes += [f"samples may be missing: {said_gap(gap)}" for gap in gaps[:SHOWN]]
        if len(gaps) > SHOWN:
            self.notes.append(f"samples may be missing in {len(gaps) - SHOWN} more gaps")
        filled, bad = sum(int(part.filled.sum()) for part in parts), sum(part.bad for part in parts)
        if filled:
            self.notes.append(f"{filled} samples were fetched afterwards, from the source's history")
        if bad:
            self.notes.append(f"{bad} samples are bad, says their source: given without a number")
        initial = sum(part.initial for part in parts)
        if initial:
            self.notes.append(f"{initial} samples are zeros of a server that was restarted: given without a number")

    def units(self, parts: Sequence[_Part]) -> dict[str, str]:
        """The unit of each channel, the same in all parts."""
        units: dict[str, str] = {}
        for entry in [entry for part in parts if part.head for entry in part.head.channels]:
            if units.setdefault(entry.name, entry.unit) != entry.unit:
                raise FormatError(
                    f"{self.source}: channel {entry.name!r} is in {units[entry.name]!r} and in {entry.unit!r}; "
                    f"move the parts of one unit to another folder"
                )
        for name in [name for name, unit in units.items() if unit and unit not in UNITS]:
            self.notes.append(f"the unit {units[name][:40]!r} of channel {name} is not known: it has none")
            units[name] = ""
        return units

    def order(self, name: str, time: Nanoseconds, value: Array, filled: NDArray[np.bool_]) -> NDArray[np.intp]:
        """The samples of one channel to take, in the order of their time: of several at one time the first that arrived."""
        back = int((np.diff(time[~filled]) < 0).sum())
        if back:
            self.notes.append(f"{name}: the clock goes back {back} times: the samples were put in its order")
        order = np.argsort(time, kind="stable")
        again = np.flatnonzero(np.diff(time[order]) == 0) + 1
        earlier, later = value[order[again - 1]], value[order[again]]
        differ = int(((earlier != later) & ~(np.isnan(earlier) & np.isnan(later))).sum())
        if len(again) - differ:
            self.notes.append(f"{name}: {len(again) - differ} samples arrived twice: taken once")
        if differ:
            self.notes.append(f"{name}: {differ} samples have another value at a time that has one: the first is taken")
        return np.delete(order, again)


def _wide(table: Any, names: list[str], source: str) -> Log:
    """A log of a clock and a column for each channel."""
    arrow, _ = pyarrow_modules()
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice or len(names) > MAX_COLUMNS:
        what = f"several columns are named {twice[0]!r}" if twice else f"{len(names)} columns arrived"
        raise FormatError(f"{source}: {what}; at most {MAX_COLUMNS} columns, each with a name of its own, are read")
    notes: list[str] = []
    clock = _clock(table, names)
    values, texts = {}, []
    for name in [name for name in names if name != clock]:
        kind = table.schema.field(name).type
        if arrow.types.is_integer(kind) or arrow.types.is_floating(kind) or arrow.types.is_boolean(kind):
            values[name] = _floats(table.column(name), name, source)
            missing = int(np.isnan(values[name]).sum())
            if missing:
                notes.append(f"column {name}: {missing} of {len(values[name])} samples have no number, kept as such")
        else:
            texts.append(name)
    if texts:
        notes.append(f"columns of no numbers, left out: {', '.join(texts)[:200]}")
    if not values or not table.num_rows:
        raise FormatError(f"{source}: holds no channel of numbers; export it again with its signals")
    metadata = {
        _text(k): _text(v) for k, v in (table.schema.metadata or {}).items() if k not in (b"pandas", b"ARROW:schema")
    }
    time, keep = None, np.arange(table.num_rows)
    if clock is not None:
        time, start = _seconds(table.column(clock), clock, source)
        keep, said = in_time_order(time, list(values.values()), f"{source}, clock {clock!r}")
        time, notes = time[keep], [*notes, *said]
        if start is not None:
            metadata["start"] = start
    channels = {name: Channel(name, _unit(name, notes), v[keep], time) for name, v in values.items()}
    return Log(channels, metadata, source, tuple(notes))


def _clock(table: Any, names: list[str]) -> str | None:
    """The column that is the clock: the first of timestamps, or of numbers that is named as a time and says its unit."""
    arrow, _ = pyarrow_modules()
    for name in names:
        kind = table.schema.field(names.index(name)).type
        number = arrow.types.is_integer(kind) or arrow.types.is_floating(kind)
        if arrow.types.is_timestamp(kind) or (number and _CLOCK.fullmatch(name.strip())):
            return name
    return None


def _seconds(cells: Any, name: str, source: str) -> tuple[Array, str | None]:
    """Times [s], shape (m,): since the earliest, and when that was, where they are dates; else as the file gives them."""
    arrow, _ = pyarrow_modules()
    if not len(cells) or arrow.types.is_timestamp(cells.type) or arrow.types.is_integer(cells.type):
        moments, dated = _nanoseconds(cells, name, source)
        zero = int(moments.min()) if dated and len(moments) else 0
        return (moments - zero) / 1e9, said_time(zero) if dated else None
    seconds = _floats(cells, name, source) / _per_second(name)
    if not np.isfinite(seconds).all():
        raise FormatError(f"{source}: {int(np.isnan(seconds).sum())} samples have no time in column {name}; complete it")
    return seconds, None


def _per_second(name: str) -> float:
    found = _CLOCK.fullmatch(name.strip())
    return _PER_SECOND[(found["unit"] or found["tail"]).lower()] if found else 1.0


def _nanoseconds(cells: Any, name: str, source: str) -> tuple[Nanoseconds, bool]:
    """Times [ns], shape (m,), and whether they are dates; every sample must have one."""
    arrow, _ = pyarrow_modules()
    if cells.null_count:
        raise FormatError(f"{source}: {cells.null_count} samples have no time in column {name}; complete it")
    try:
        if arrow.types.is_timestamp(cells.type):
            return cells.cast(arrow.timestamp("ns", tz=cells.type.tz)).cast(arrow.int64()).to_numpy(), True
        per_second = _per_second(name)
        if arrow.types.is_integer(cells.type) and per_second == 1e9:
            return cells.cast(arrow.int64()).to_numpy(), False
        seconds = cells.cast(arrow.float64()).to_numpy() / per_second
    except (arrow.ArrowException, ValueError) as error:
        raise damaged(source, error) from None
    if not np.isfinite(seconds).all() or (np.abs(seconds) > 9e9).any():
        raise FormatError(f"{source}: column {name} holds times that are no times; correct it")
    return np.rint(seconds * 1e9).astype(np.int64), False


def _floats(cells: Any, name: str, source: str) -> Array:
    """Values, shape (m,), exactly as stored; a null or an infinity becomes NaN: there is a sample, but no number."""
    arrow, _ = pyarrow_modules()
    try:
        if arrow.types.is_boolean(cells.type):
            cells = cells.cast(arrow.uint8())
        values = np.array(cells.cast(arrow.float64()).to_numpy(), dtype=np.float64)
    except (arrow.ArrowException, ValueError):
        raise FormatError(f"{source}: column {name} does not hold numbers that fit a float64; store it as float64") from None
    values[~np.isfinite(values)] = np.nan
    return values


def _unit(header: str, notes: list[str]) -> str:
    """The unit that a header says; empty if it says none, or one that its quantity cannot have."""
    try:
        quantity, unit = split_unit(header)
        check_unit(quantity, unit, percent=True)
    except FormatError:
        if any(bracket in header for bracket in "[("):
            notes.append(f"the unit of column {header} is not known: its channel has none")
        return ""
    return unit


def _text(value: bytes) -> str:
    return value.decode("utf-8", "replace")


def _sample() -> bytes:
    channels = (
        RecordedChannel("current", "A", "ns=2;s=Current", 3, 40),
        RecordedChannel("position", "mm", "ns=2;s=X", 2, 30),
    )
    head = PartHead("opc.tcp://a-sample-of-no-machine", channels, (Gap("position", 10, 30, "a sample of a gap"),))
    samples = Samples(
        np.array([0, 1, 0, 1, 0], dtype=np.int32),
        np.array([10, 10, 20, 30, 40], dtype=np.int64) * 10**6,
        np.array([0.5, 1.25, -0.5, np.nan, 1e-17]),
        np.array([0, 0, 0, 0x80000000, 0], dtype=np.uint32),
        np.zeros(5, dtype=np.bool_),
    )
    return encode_part(head, samples)


register(LogFormat("Parquet", ".parquet", can_read, read_parquet_log, _sample, read_recording))
