"""ASAM MDF version 4 (`.mf4`): groups of channels sampled together, each group with its own master.

The layout of blocks and records is that of asammdf (`v4_constants.py`, `v4_blocks.py`), which writes the files that the
tests read. It is read here without that library, because on damaged files the library crashes the whole process, loops
without end or writes to standard output, so that it cannot be given a file of unknown origin. Read are finished files of
version 4 with fixed-length records, sorted or not, plain or packed (`DT`, `DL`, `HL`, `DZ`). Every link is followed once
only; every block must lie in the file; the data of a group must be its number of records exactly; what is unpacked is
capped (`RATIO` times the file, at least `LEAST_UNPACKED` bytes), counted as it is unpacked, not as it is declared.

Conversions: none, linear, rational. Samples marked invalid become NaN. Left out, with a note: text, byte arrays,
structures, arrays, channels with tables or formulas. Unknown units are left out, with a note. Refused: files that were
not finished, column-wise storage (`LD`), a master that does not go forward, integers that a float64 would round.
"""

from __future__ import annotations

import math
import struct
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.log import Channel, Log
from elastogeo.formats.log_files import LogFormat, register
from elastogeo.formats.logs.mdf4_blocks import Blocks, text_of
from elastogeo.formats.logs.mtconnect_observations import stamp_of
from elastogeo.formats.text.units import UNITS, to_internal
from elastogeo.machine import Array

MAX_CHANNELS = 2000

_UNITS = {"N·m": "N m", "N*m": "N m", "U/min": "1/min", "r/min": "1/min", "min-1": "1/min", "min^-1": "1/min", "sec": "s"}
_MASTERS, _VIRTUAL = (2, 3), (3, 6)
_READ = (0, 2, 3, 6)
_SYNCS = {0: "nothing", 2: "an angle", 3: "a distance", 4: "an index"}


def can_read(head: bytes) -> bool:
    """Whether a file that begins with these bytes is MDF of version 4, finished or not."""
    return head.startswith((b"MDF     4.", b"UnFinMF 4.")) and head[64:68] == b"##HD"


def read_mdf4(data: bytes, source: str) -> Log:
    """Read an MDF 4 file.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Log
        A channel for each channel of numbers that is no master, time [s] from the start of the measurement; metadata with
        the `start` and the program.

    Raises
    ------
    FormatError
        If the file is damaged, cut off, not finished, or of a kind that is not read.
    """
    if data.startswith(b"UnFinMF"):
        raise FormatError(
            f"{source}: the recording was not finished (UnFinMF); open and save it with the program that made it"
        )
    file = Blocks(data, source)
    links, body = file.block(64, b"##HD", 6)
    start, _, _, flags = struct.unpack_from("<QhhB", file.need(body, 13))
    metadata = {"program": text_of(data[16:24]), "version": text_of(data[8:16]), "comment": file.text(links[5])}
    metadata["start"] = stamp_of(start).removesuffix("Z" if flags & 1 else "") if start else ""
    notes: list[str] = []
    found = [signal for group in _groups(file, links[0]) for signal in _signals(file, group, notes)]
    channels: dict[str, Channel] = {}
    names = Counter(signal.name for signal in found)
    inside = Counter((signal.name, signal.group) for signal in found)
    for signal in found:
        name = signal.name
        if names[name] > 1:
            alone = inside[name, signal.group] == 1
            name += f" (group {signal.group})" if alone else f" (group {signal.group}, channel {signal.number})"
        while name in channels:
            name += "'"
        channels[name] = Channel(name, signal.unit, signal.values, signal.time)
    if not channels:
        raise FormatError(f"{source}: holds no channel of numbers ({'; '.join(notes[:3]) or 'it is empty'}); save it again")
    return Log(channels, {key: value for key, value in metadata.items() if value}, source, tuple(notes))


@dataclass(frozen=True, slots=True)
class _Signal:
    """A channel as it was read."""

    name: str
    group: int
    number: int
    unit: str
    values: Array
    time: Array | None


@dataclass(frozen=True, slots=True)
class _Group:
    """A channel group: its number and records, how far apart these are, their bytes with and without invalidation bits, its
    first channel.
    """

    number: int
    records: bytes
    cycles: int
    stride: int
    whole: int
    inside: int
    first: int


@dataclass(frozen=True, slots=True)
class _Cn:
    """A channel block: what says where its values are, and what they mean."""

    name: str
    unit: str
    kind: int
    sync: int
    type: int
    bit: int
    byte: int
    bits: int
    flags: int
    invalid: int
    conversion: tuple[float, ...] | None
    why: str


def _groups(file: Blocks, address: int) -> Iterator[_Group]:
    """All channel groups with their records."""
    number = 0
    while address:
        (address, first, data, _), body = file.block(address, b"##DG", 4)
        width = file.need(body, 1)[0]
        heads = []
        while first:
            links, body = file.block(first, b"##CG", 6)
            identity, cycles, flags, _, _, inside, invalid = struct.unpack_from("<QQHHIII", file.need(body, 32))
            heads.append((number, identity, cycles, flags, inside, inside + invalid, links[1]))
            first, number = links[0], number + 1
        if width not in (0, 1, 2, 4, 8) or (len(heads) > 1 and not width):
            raise file.error(f"record numbers of {width} bytes")
        raw = b"".join(file.pieces(data))
        split = _split(file, raw, width, {h[1]: (h[5], h[3]) for h in heads}) if len(heads) > 1 else {}
        for index, identity, cycles, flags, inside, size, channel in heads:
            if flags & 1 or not channel:
                continue
            records = split.get(identity, b"") if len(heads) > 1 else raw
            skip = width if len(heads) == 1 else 0
            if len(records) != cycles * (skip + size):
                raise file.error(f"group {index} promises {cycles} records of {size} bytes, {len(records)} bytes arrived")
            yield _Group(index, records[skip:] if skip else records, cycles, skip + size, size, inside, channel)


def _split(file: Blocks, raw: bytes, width: int, sizes: dict[int, tuple[int, int]]) -> dict[int, bytes]:
    """The records of each group of an unsorted data block."""
    records = {identity: bytearray() for identity in sizes}
    at = 0
    while at < len(raw):
        identity = int.from_bytes(raw[at : at + width], "little")
        at += width
        if identity not in sizes:
            raise file.error(f"a record of unknown group {identity}")
        size, flags = sizes[identity]
        if flags & 1:
            at += 4 + int.from_bytes(raw[at : at + 4], "little")
        else:
            records[identity] += raw[at : at + size]
            at += size
    if at != len(raw):
        raise file.error("its last record is not whole")
    return {identity: bytes(found) for identity, found in records.items()}


def _signals(file: Blocks, group: _Group, notes: list[str]) -> Iterator[_Signal]:
    """All channels of numbers of a group, with the time of its master."""
    channels = []
    address = group.first
    while address:
        links, body = file.block(address, b"##CN", 8)
        channels.append(_cn(file, links, body))
        if len(channels) > MAX_CHANNELS:
            raise FormatError(f"{file.source}: a group has more than {MAX_CHANNELS} channels; record those of the test only")
        address = links[0]
    master = next((c for c in channels if c.kind in _MASTERS and c.sync == 1), None)
    time = None if master is None or not group.cycles else _time(file, group, master)
    for number, channel in enumerate(channels):
        where = f"{channel.name} (group {group.number})"
        if channel.kind in _MASTERS and channel.sync in _SYNCS:
            notes.append(f"group {group.number} has no clock: its master {channel.name!r} is {_SYNCS[channel.sync]}")
        if channel is master:
            continue
        why = channel.why or ("" if group.cycles else "it has no sample")
        if not why and channel.flags & 1:
            why = "all its samples are marked invalid"
        if why:
            notes.append(f"{where}: left out, because {why}")
            continue
        values = _values(file, group, channel)
        bad = _invalid(file, group, channel) | ~np.isfinite(values)
        if bad.any():
            notes.append(f"{where}: {int(bad.sum())} of {len(values)} samples are invalid or no finite number")
            values[bad] = np.nan
        unit = _UNITS.get(channel.unit, channel.unit)
        if unit and unit not in UNITS:
            notes.append(f"{where}: its unit {unit[:40]!r} is not known, so it has none")
        yield _Signal(channel.name, group.number, number, unit if unit in UNITS else "", values, time)


def _cn(file: Blocks, links: tuple[int, ...], body: memoryview) -> _Cn:
    kind, sync, code, bit, byte, bits, flags, invalid = struct.unpack_from("<4B4I", file.need(body, 20))
    why, conversion, unit = "", None, file.text(links[6])
    if links[4]:
        (_, other, _, _), head = file.block(links[4], b"##CC", 4, again=True)
        rule, count = file.need(head, 24)[0], struct.unpack_from("<H", head, 6)[0]
        unit = unit or file.text(other)
        if rule in (1, 2):
            conversion = struct.unpack_from(f"<{2 if rule == 1 else 6}d", file.need(head, 40 if rule == 1 else 72), 24)
        elif rule:
            why = f"its values are converted by a table, a formula or to text (type {rule}, {count} parameters)"
    if kind not in _READ or links[1]:
        why = "it is composed of others or of variable length"
    elif kind not in _VIRTUAL and code > 5:
        why = "it is text or bytes"
    elif kind not in _VIRTUAL and (bit > 7 or not 0 < bits <= 64 or (bit + bits > 64)):
        why = f"its {bits} bits from bit {bit} on are no number that is read"
    elif kind not in _VIRTUAL and code in (4, 5) and (bits not in (16, 32, 64) or bit):
        why = f"it is a float of {bits} bits"
    return _Cn(file.text(links[2])[:200] or "?", unit, kind, sync, code, bit, byte, bits, flags, invalid, conversion, why)


def _values(file: Blocks, group: _Group, channel: _Cn) -> Array:
    """The values of a channel, converted."""
    file.count_values(group.cycles)
    raw = np.arange(group.cycles) if channel.kind in _VIRTUAL else _raw(file, group, channel)
    with np.errstate(all="ignore"):
        values: Array = raw.astype(np.float64)
        if channel.conversion is None:
            if raw.dtype.kind in "iu" and raw.dtype.itemsize == 8 and (np.abs(values) >= 2.0**53).any():
                raise FormatError(
                    f"{file.source}, {channel.name}: has integers that a float64 would round; save it as float64"
                )
        elif len(channel.conversion) == 2:
            values *= channel.conversion[1]
            values += channel.conversion[0]
        else:
            a, b, c, d, e, f = channel.conversion
            values = (a * values**2 + b * values + c) / (d * values**2 + e * values + f)
    return values


def _raw(file: Blocks, group: _Group, channel: _Cn) -> NDArray[Any]:
    """The stored numbers of a channel."""
    count = math.ceil((channel.bit + channel.bits) / 8)
    if channel.byte + count > group.inside:
        raise file.error(f"channel {channel.name!r} lies outside its records")
    order = "<" if channel.type % 2 == 0 else ">"
    kind = "u" if channel.type < 2 else "i" if channel.type < 4 else "f"
    if channel.bit == 0 and channel.bits in (8, 16, 32, 64):
        dtype = np.dtype(f"{order}{kind}{count}")
        return np.ndarray((group.cycles,), dtype, group.records, channel.byte, (group.stride,))
    number = np.zeros(group.cycles, np.uint64)
    for k in range(count):
        part = np.ndarray((group.cycles,), np.uint8, group.records, channel.byte + k, (group.stride,))
        place = k if order == "<" else count - 1 - k
        number |= part.astype(np.uint64) << np.uint64(8 * place)
    number = (number >> np.uint64(channel.bit)) & np.uint64(2**channel.bits - 1)
    if kind == "i":
        shift = np.uint64(64 - channel.bits)
        return (number << shift).astype(np.int64) >> np.int64(64 - channel.bits)
    return number


def _invalid(file: Blocks, group: _Group, channel: _Cn) -> NDArray[np.bool_]:
    """Which samples are marked invalid."""
    if not channel.flags & 2:
        return np.zeros(group.cycles, bool)
    at = group.inside + channel.invalid // 8
    if at >= group.whole:
        raise file.error(f"channel {channel.name!r} has its invalidation bit outside its records")
    byte = np.ndarray((group.cycles,), np.uint8, group.records, at, (group.stride,))
    marked: NDArray[np.bool_] = (byte >> np.uint8(channel.invalid % 8)) & 1 == 1
    return marked


def _time(file: Blocks, group: _Group, master: _Cn) -> Array:
    """The time of each record [s]."""
    if master.why:
        raise FormatError(f"{file.source}: the time {master.name!r} of group {group.number} cannot be read: {master.why}")
    values = _values(file, group, master)
    if master.unit in UNITS and UNITS[master.unit].dimension == "time":
        values = to_internal(values, master.unit)
    good = np.isfinite(values)
    with np.errstate(invalid="ignore", over="ignore"):
        wrong = ~(np.diff(values) > 0)
    if not good.all() or wrong.any():
        row = int(np.argmin(good)) if not good.all() else int(np.argmax(wrong)) + 1
        raise FormatError(
            f"{file.source}: the time {values[row]:.12g} of record {row + 1} of group {group.number} is not after the one "
            "before it; records are doubled or out of order; take the recording as it was made"
        )
    return values


def _sample() -> bytes:
    """Three records of a clock, a current in A and a speed in 0.5 1/min, of which the last is marked invalid."""
    blocks = bytearray(b"MDF     4.10    sample  ".ljust(28, b"\0") + struct.pack("<H", 410)).ljust(64, b"\0")

    def block(kind: bytes, links: tuple[int, ...], body: bytes) -> int:
        blocks.extend(b"\0" * (-len(blocks) % 8))
        address = len(blocks)
        size = 24 + 8 * len(links) + len(body)
        blocks.extend(b"##" + kind + struct.pack(f"<IQQ{len(links)}Q", 0, size, len(links), *links) + body)
        return address

    block(b"HD", (0, 0, 0, 0, 0, 0), struct.pack("<QhhBBBBdd", 1_769_860_800_000_000_000, 0, 0, 0, 0, 0, 0, 0.0, 0.0))
    rows = ((0.0, 0.5, 100, 0), (0.001, -0.25, 150, 0), (0.002, 1e-17, 200, 1))
    data = block(b"DT", (), b"".join(struct.pack("<ddhB", *row) for row in rows))
    half = block(b"CC", (0, 0, 0, 0), struct.pack("<BBHHHdddd", 1, 0, 0, 0, 2, 0.0, 0.0, 0.0, 0.5))
    following = 0
    for name, unit, kind, code, byte, bits, flags, conversion in (
        (b"n_X", b"1/min", 0, 2, 16, 16, 2, half),
        (b"I_X", b"A", 0, 4, 8, 64, 0, 0),
        (b"time", b"s", 2, 4, 0, 64, 0, 0),
    ):
        texts = [block(b"TX", (), text + b"\0") for text in (name, unit)]
        links = (following, 0, texts[0], 0, conversion, 0, texts[1], 0)
        body = struct.pack("<4B4IBBH6d", kind, kind // 2, code, 0, byte, bits, flags, 0, 0, 0, 0, *(0.0,) * 6)
        following = block(b"CN", links, body)
    group = block(b"CG", (0, following, 0, 0, 0, 0), struct.pack("<QQHHIII", 0, 3, 0, 0, 0, 18, 1))
    blocks[88:96] = struct.pack("<Q", block(b"DG", (0, group, data, 0), bytes(8)))
    return bytes(blocks)


register(LogFormat("MDF 4", ".mf4", can_read, read_mdf4, _sample))
