"""The parts of a recording: Parquet files of samples as they arrived, with what is known to be missing in their heads.

A recording is a folder of `part-000001.parquet`, `part-000002.parquet`, ... Each has the columns `channel` (dictionary of
strings), `time` (timestamp in ns, UTC: the source's own), `value` (float64; NaN where the source gave no number), `status`
(the source's code, uint32) and `filled` (bool: fetched afterwards from the source's history). The head, JSON under the
key `elastogeo.recording/1` of the schema's metadata, says the server, the channels, the gaps marked in this part and those
of earlier parts that its samples close.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.text.files_read import may_open
from elastogeo.formats.text.parquet_bytes import damaged, opened_parquet, pyarrow_modules, unpacked
from elastogeo.machine import Array

SCHEMA = "elastogeo.recording/1"
INITIAL = 0x40920000
"""OPC UA's UncertainInitialValue: the recorder gives it to the zeros of a server that was restarted, until a value comes."""
PART = re.compile(r"part-(\d{6,9})\.parquet", re.ASCII)

_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


@dataclass(frozen=True, slots=True)
class Gap:
    """A span in which samples of a channel may be missing.

    Attributes
    ----------
    channel : str
    start : int [ns since 1970, UTC]
        Time of the last sample before it.
    end : int [ns since 1970, UTC], or None
        Time of the first sample after it; None as long as none has arrived.
    cause : str
        Why, in words.
    """

    channel: str
    start: int
    end: int | None
    cause: str

    @property
    def key(self) -> tuple[str, int, int | None]:
        """What tells it from all others."""
        return self.channel, self.start, self.end


@dataclass(frozen=True, slots=True)
class RecordedChannel:
    """What a part says of one channel: its unit, its address at the source, its samples here, the newest sample so far."""

    name: str
    unit: str
    node: str
    samples: int
    last: int | None


@dataclass(frozen=True, slots=True)
class PartHead:
    """What a part says besides its samples: gaps that begin to be known with it, and gaps that its samples close."""

    server: str
    channels: tuple[RecordedChannel, ...]
    gaps: tuple[Gap, ...] = ()
    filled: tuple[Gap, ...] = ()


@dataclass(frozen=True, slots=True)
class Samples:
    """Samples as they arrived, all of shape (m,): index into the channels, time [ns since 1970], value, status, filled."""

    channel: NDArray[np.int32]
    time: NDArray[np.int64]
    value: Array
    status: NDArray[np.uint32]
    filled: NDArray[np.bool_]


def standing_gaps(heads: Iterable[PartHead]) -> tuple[Gap, ...]:
    """The gaps that remain marked after all parts, in the order of their start.

    A gap without an end is superseded by one of the same channel and start that has an end.
    """
    standing: dict[tuple[str, int, int | None], Gap] = {}
    for head in heads:
        for gap in head.gaps:
            standing.pop((gap.channel, gap.start, None), None)
            standing[gap.key] = gap
        for gap in head.filled:
            standing.pop(gap.key, None)
    return tuple(sorted(standing.values(), key=lambda gap: (gap.start, gap.channel)))


def part_name(number: int) -> str:
    """The file name of a part, counted from 1."""
    return f"part-{number:06d}.parquet"


def part_files(folder: Path) -> dict[int, Path]:
    """The parts in a folder by number, in their order; anything else in it is no part.

    Raises
    ------
    FormatError
        If the folder cannot be listed.
    """
    may_open(folder)
    try:
        found = {int(match[1]): path for path in folder.iterdir() if (match := PART.fullmatch(path.name))}
    except OSError as error:
        raise FormatError(f"{folder}: cannot be opened ({error.strerror}); check the path and its permissions") from None
    return dict(sorted(found.items()))


def encode_part(head: PartHead, samples: Samples) -> bytes:
    """The bytes of a part, with page checksums; read back, every number is the same bit for bit."""
    arrow, parquet = pyarrow_modules()
    names = [channel.name for channel in head.channels]
    columns = {
        "channel": arrow.DictionaryArray.from_arrays(arrow.array(samples.channel), arrow.array(names, arrow.string())),
        "time": arrow.array(samples.time).cast(arrow.timestamp("ns", tz="UTC")),
        "value": arrow.array(samples.value),
        "status": arrow.array(samples.status),
        "filled": arrow.array(samples.filled),
    }
    said = json.dumps({"schema": SCHEMA, **asdict(head)}, ensure_ascii=False)
    table = arrow.table(columns).replace_schema_metadata({SCHEMA: said})
    sink = arrow.BufferOutputStream()
    parquet.write_table(table, sink, compression="zstd", write_page_checksum=True)
    return bytes(sink.getvalue())


def read_head(path: Path) -> PartHead:
    """The head of a part file, without its samples.

    Raises
    ------
    FormatError
        If the file cannot be opened, is damaged, or is no part of a recording.
    """
    arrow, parquet = pyarrow_modules()
    try:
        metadata = parquet.read_schema(path).metadata or {}
    except (arrow.ArrowException, OSError, ValueError, MemoryError) as error:
        raise damaged(str(path), error) from None
    head = head_of(metadata, str(path))
    if head is None:
        raise FormatError(f"{path}: is no part of a recording of elastogeo; keep other files in another folder")
    return head


def head_of(metadata: dict[bytes, bytes], source: str) -> PartHead | None:
    """The head that a schema's metadata hold, or None if they hold none.

    Raises
    ------
    FormatError
        If there is one that cannot be understood.
    """
    said = metadata.get(SCHEMA.encode())
    if said is None:
        return None
    try:
        document = json.loads(said)
        channels = tuple(_checked(RecordedChannel, entry) for entry in document["channels"])
        gaps = tuple(_checked(Gap, entry) for entry in document["gaps"])
        filled = tuple(_checked(Gap, entry) for entry in document["filled"])
        return PartHead(_text(document["server"]), channels, gaps, filled)
    except (ValueError, TypeError, KeyError, RecursionError) as error:
        raise FormatError(
            f"{source}: the head of the part is damaged ({error!r:.80}); copy it again from a backup"
        ) from None


def read_table(data: bytes, source: str) -> Any:
    """The bytes of a Parquet file as a `pyarrow.Table`, checked as far as Parquet can be.

    Raises
    ------
    FormatError
        If the file is cut off or damaged, or unpacks to far more than its size.
    """
    file, _ = opened_parquet(data, source)
    return unpacked(file, len(data), source, "values")


def said_time(time: int) -> str:
    """A time [ns since 1970, UTC] in words: `2026-11-21T11:54:20.123456Z`, with as many digits as it has."""
    seconds, rest = divmod(time, 1_000_000_000)
    try:
        day = (_EPOCH + timedelta(seconds=seconds)).strftime("%Y-%m-%dT%H:%M:%S")
    except OverflowError:
        return f"{time} ns"
    digits = f"{rest:09d}".rstrip("0")
    return f"{day}.{digits}Z" if digits else f"{day}Z"


def said_gap(gap: Gap) -> str:
    """A gap in words."""
    end = "the end of the recording" if gap.end is None else said_time(gap.end)
    return f"{gap.channel} from {said_time(gap.start)} to {end} ({gap.cause})"


def _checked(kind: Any, entry: Any) -> Any:
    """A dataclass of a head from its JSON, refused unless every field is of its own type."""
    made = kind(**entry)
    for name, value in asdict(made).items():
        whole = name in ("samples", "start", "end", "last")
        if type(value) is not (int if whole else str) and not (value is None and name in ("end", "last")):
            raise TypeError(f"{name} is {value!r:.40}")
        if isinstance(value, int) and not -(2**63) <= value < 2**63:
            raise ValueError(f"{name} is {value}")
    return made


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{value!r:.40} is no text")
    return value
