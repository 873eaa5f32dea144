"""TDMS files of LabVIEW and DIAdem (`.tdms`), through npTDMS. Needs `elastogeo[logs]`.

The layout of lead-ins, segments and properties is that of npTDMS's own reader and writer. Of a file that is cut off the
library gives what is left, some channels shorter than others, and only logs a warning. So each segment's lead-in is checked
first: segments must follow one another to the last byte of the file; and after its metadata are read, the data of each must
be whole chunks. Otherwise, or if the library logs any warning, the file is refused. Nothing in a TDMS file is compressed;
the number of pieces (segments, chunks, objects) and of values is capped by the file's size, so that a small file cannot cost
much. Files of DAQmx, whose channels share the bytes of a raw buffer, are read by the same checks.

A channel is named `group/channel`. Its unit is the property `unit_string`, if that is a known spelling. Its clock is made
of `wf_start_time`, `wf_start_offset` and `wf_increment` [s]; without an increment, or where `wf_xunit_string` is not a
second, it has none. Infinite values become NaN, with a note. Left out, with a note: text, time stamps, complex numbers,
empty channels. Refused: integers that a float64 would round.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import logging
import re
import threading
from collections.abc import Iterator, Mapping
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.logs.tdms_metadata import LEAST, TAG, check_segments
from elastogeo.formats.text.units import UNITS
from elastogeo.machine import Array

_BYTES_PER_PIECE = 50
_LEAST_VALUES = 1_000_000
_SCALES = "NI_Number_Of_Scales"
_SCALE = re.compile(r"NI_Scale\[(\d{1,19})\]")
_KINDS = {
    **dict.fromkeys("OUS", "text"),
    "M": "time stamps",
    "c": "complex numbers",
    "V": "raw counts without a scale",
}
_WRITTEN_OUT = {"volts": "V", "amps": "A", "amperes": "A", "newtons": "N", "degrees": "deg", "seconds": "s"}
"""Units as LabVIEW writes them."""


def can_read(head: bytes) -> bool:
    """Whether a file that begins with these bytes is TDMS."""
    return head.startswith(TAG)


def read_tdms(data: bytes, source: str) -> Log:
    """Read a TDMS file.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Log
        A channel for each channel of numbers, as `group/channel`; metadata are the properties of the file and its groups.

    Raises
    ------
    FormatError
        If the file is cut off or damaged, was not closed, is made of too many pieces, or npTDMS is not installed.
    """
    check_segments(data, source)
    library = _nptdms()
    with _quiet() as warnings:
        try:
            with library.TdmsFile.open(io.BytesIO(data)) as file:
                _check_data(file, len(data), source)
                arrays, about, notes = _arrays(file, source)
                metadata = _metadata(file)
        except FormatError:
            raise
        except Exception as error:  # noqa: BLE001 - on damaged files the library raises errors of any type
            raise _damaged(source, str(error) or type(error).__name__) from None
    if warnings:
        raise _damaged(source, warnings[0])
    times = _clocks(arrays, about, source, notes)
    channels = {}
    for name, values in arrays.items():
        bad = np.isinf(values)
        if bad.any():
            notes.append(f"{name}: {int(bad.sum())} infinite values are NaN")
            values[bad] = np.nan
        channels[name] = Channel(name, _unit(about[name], name, notes), values, times[name])
    if not channels:
        raise FormatError(f"{source}: holds no channel of numbers ({'; '.join(notes[:3]) or 'it is empty'}); save it again")
    return Log(channels, metadata, source, tuple(notes))


def _nptdms() -> ModuleType:
    try:
        return importlib.import_module("nptdms")
    except ImportError:
        raise FormatError("TDMS files need npTDMS: pip install 'elastogeo[logs]'") from None


def _damaged(source: str, reason: str) -> FormatError:
    return FormatError(
        f"{source}: the TDMS file is damaged ({(reason.splitlines() or ['?'])[0][:200]}); copy or save it again"
    )


def _check_data(file: Any, size: int, source: str) -> None:
    """Check that the data of each segment are whole chunks, and that there are not too many of them."""
    channels = sum(len(group.channels()) for group in file.groups())
    for said in _properties(file):
        numbered = [int(found[1]) for key in said if (found := _SCALE.match(key))]
        for scales in (said.get(_SCALES, 0), *numbered):
            if not isinstance(scales, int | np.integer) or not 0 <= scales <= len(said):
                raise _damaged(source, f"{_SCALES} or the number of a scale is {scales!r:.40}")
    pieces = values = 0
    for segment in file._reader._segments:
        objects = [o for o in segment.ordered_objects if o.has_data]
        pieces += segment.num_chunks * max(channels, len(objects))
        if segment.final_chunk_lengths_override is not None or segment.segment_incomplete:
            raise FormatError(
                f"{source}: the data of the segment at byte {segment.position} are not whole; the file is cut off or "
                "damaged; copy it again"
            )
        values += segment.num_chunks * sum(o.number_values for o in objects)
        texts = [o for o in objects if o.data_type.size is None and getattr(o, "daqmx_metadata", None) is None]
        if any(4 * o.number_values > o.data_size for o in texts if o.data_size is not None):
            raise FormatError(
                f"{source}: a text channel claims more texts than it has bytes; the file is damaged; copy it again"
            )
    if values > _LEAST_VALUES + size:
        raise FormatError(
            f"{source}: its channels claim {values} values in {size} bytes; the file is damaged, or holds many digital "
            f"lines: save the channels that you need to a file of their own"
        )
    if pieces > LEAST + size // _BYTES_PER_PIECE:
        raise FormatError(
            f"{source}: its data are in {pieces} pieces, too many for {size} bytes; save it again, defragmented"
        )


def _properties(file: Any) -> Iterator[Mapping[str, Any]]:
    """The properties of the file, its groups and its channels."""
    yield file.properties
    for group in file.groups():
        yield group.properties
        for channel in group.channels():
            yield channel.properties


def _arrays(file: Any, source: str) -> tuple[dict[str, Array], dict[str, Mapping[str, Any]], list[str]]:
    """The values and properties of each channel of numbers, and notes on those that are left out."""
    arrays: dict[str, Array] = {}
    about: dict[str, Mapping[str, Any]] = {}
    notes: list[str] = []
    names: dict[tuple[str, str], str] = {}
    for group in file.groups():
        for channel in group.channels():
            name = f"{group.name}/{channel.name}"
            while name in arrays:
                name += "'"
            kind = np.dtype(channel.dtype)
            if _is_count(channel):
                notes.append(f"{name}: raw counts of its converter, because the file says no scale")
            elif kind.kind not in "biuf" or kind.itemsize > 8:
                notes.append(f"{name}: left out, because it holds {_kind(kind)}")
                continue
            if not len(channel):
                notes.append(f"{name}: left out, because it is empty")
            else:
                names[group.name, channel.name] = name
                arrays[name] = np.full(len(channel), np.nan)
                about[name] = channel.properties
    filled = dict.fromkeys(arrays, 0)
    for chunk in file.data_chunks():
        for (group_name, channel_name), name in names.items():
            part = chunk[group_name][channel_name]
            if len(part):
                arrays[name][filled[name] : filled[name] + len(part)] = _floats(_numbers(part), name, source)
                filled[name] += len(part)
    if any(filled[name] != len(values) for name, values in arrays.items()):
        raise _damaged(source, "fewer samples arrived than its segments promise")
    return arrays, about, notes


def _is_count(channel: Any) -> bool:
    """Whether a channel of DAQmx holds the counts of one converter and no scale for them."""
    return channel._scaling is None and len(channel.scaler_data_types or ()) == 1


def _numbers(part: Any) -> NDArray[Any]:
    """The values of a piece of a channel; of DAQmx without a scale, its counts."""
    counts = part._raw_data.scaler_data
    if counts and part._channel._scaling is None:
        return np.asarray(next(iter(counts.values())))
    return np.asarray(part[:])


def _floats(part: NDArray[Any], name: str, source: str) -> Array:
    """Numbers as float64, exactly."""
    values: Array = part.astype(np.float64)
    if part.dtype.kind in "iu" and part.dtype.itemsize == 8 and (np.abs(values) >= 2.0**53).any():
        raise FormatError(f"{source}, {name}: has integers that a float64 would round; save it as float64")
    return values


def _kind(kind: np.dtype[Any]) -> str:
    return _KINDS.get(kind.kind, f"{kind} data")


def _clocks(
    arrays: Mapping[str, Array], about: Mapping[str, Mapping[str, Any]], source: str, notes: list[str]
) -> dict[str, Array | None]:
    """The time of each channel [s], None where the file keeps no clock; equal clocks are one array."""
    starts = {name: p["wf_start_time"] for name, p in about.items() if isinstance(p.get("wf_start_time"), np.datetime64)}
    first = min(starts.values(), default=np.datetime64(0, "us"))
    made: dict[tuple[int, float, float], Array] = {}
    times: dict[str, Array | None] = dict.fromkeys(arrays)
    for name, values in arrays.items():
        properties = about[name]
        try:
            step = float(properties.get("wf_increment", 0.0))
            offset = float(properties.get("wf_start_offset", 0.0))
        except (TypeError, ValueError):
            step, offset = 0.0, 0.0
        if name in starts:
            offset += float((starts[name] - first) / np.timedelta64(1, "us")) / 1e6
        unit = str(properties.get("wf_xunit_string", "") or "s")
        if starts and name not in starts:
            reason = "it has no start time, and others have one"
        elif unit != "s":
            reason = f"its steps are in {unit[:40]!r}, not in s"
        else:
            reason = "" if np.isfinite(offset) and 0 < step < 1e12 else "it has no sample time (wf_increment)"
        if reason:
            notes.append(f"{name}: keeps no clock, because {reason}")
            continue
        key = (len(values), offset, step)
        if key not in made:
            clock: Array = offset + np.arange(len(values), dtype=np.float64) * step
            made[key] = clock
            if len(clock) > 1 and (clock[1] <= clock[0] or clock[-1] <= clock[-2]):
                raise FormatError(f"{source}, {name}: its sample time {step:.6g} s is lost beside its start; save it again")
        times[name] = made[key]
    return times


def _unit(properties: Mapping[str, Any], name: str, notes: list[str]) -> str:
    unit = str(properties.get("unit_string", "")).strip()
    unit = _WRITTEN_OUT.get(unit.lower(), unit)
    if unit in UNITS or not unit:
        return unit
    notes.append(f"{name}: its unit {unit[:40]!r} is not known, so it has none")
    return ""


def _metadata(file: Any) -> dict[str, str]:
    """The properties of the file and its groups as text."""
    metadata = {str(key)[:80]: str(value)[:1000] for key, value in list(file.properties.items())[:100]}
    for group in file.groups()[:100]:
        for key, value in list(group.properties.items())[:100]:
            metadata[f"{group.name}/{key}"[:160]] = str(value)[:1000]
    return metadata


class _Catcher(logging.Filter):
    """Catches what the library logs in this thread."""

    def __init__(self) -> None:
        super().__init__()
        self.thread = threading.get_ident()
        self.messages: list[str] = []

    def filter(self, record: logging.LogRecord) -> bool:
        """Keep a record from being shown if it is of this thread."""
        if record.thread != self.thread:
            return True
        self.messages.append(record.getMessage())
        return False


@contextlib.contextmanager
def _quiet() -> Iterator[list[str]]:
    """What npTDMS logs in the meantime; nothing of it is shown."""
    catcher = _Catcher()
    loggers = list(importlib.import_module("nptdms.log").log_manager.loggers.values())
    for logger in loggers:
        logger.addFilter(catcher)
    try:
        with np.errstate(all="ignore"):
            yield catcher.messages
    finally:
        for logger in loggers:
            logger.removeFilter(catcher)


def _sample() -> bytes:
    library = _nptdms()
    buffer = io.BytesIO()
    clock = {"wf_start_offset": 0.0, "wf_increment": 0.001}
    with library.TdmsWriter(buffer) as writer:
        writer.write_segment(
            [
                library.RootObject({"machine": "a sample, of no machine"}),
                library.ChannelObject("drive", "X current", np.array([0.5, -0.25, 1e-17]), {"unit_string": "A", **clock}),
                library.ChannelObject("drive", "X position", np.array([1, 2, 4], np.int32), {"unit_string": "um", **clock}),
            ]
        )
    return buffer.getvalue()


register(LogFormat("TDMS", ".tdms", can_read, read_tdms, _sample))
