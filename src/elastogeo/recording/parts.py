"""The folder of a recording: parts that are whole or not there, and what they say of an earlier recording in it.

A part is written under a temporary name, flushed to the disk, renamed, and the folder flushed; only then does it count.
"""

from __future__ import annotations

import os
import secrets
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import numpy as np

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import (
    Gap,
    PartHead,
    RecordedChannel,
    encode_part,
    part_files,
    part_name,
    read_head,
    read_table,
    standing_gaps,
)
from elastogeo.recording.backlog import Batch
from elastogeo.recording.gaps import WITNESSES
from elastogeo.recording.settings import RecordedNode

_LOCK = "recording.lock"
_UNFINISHED = ".unfinished-"
_LOOKED_AT = 3


@dataclass(frozen=True, slots=True)
class Begun:
    """What a folder holds when a recording begins in it.

    Attributes
    ----------
    parts : int
        Number of the last part; 0 if there is none.
    samples : mapping of str to int
        By channel.
    recorded : mapping of str to tuple of int [ns since 1970, UTC]
        Times of the newest samples of each channel, in their order.
    gaps : tuple of Gap
        Those that remain marked.
    unfinished : tuple of str
        Names of files that a killed recording left half written; they are ignored.
    """

    parts: int
    samples: dict[str, int]
    recorded: dict[str, tuple[int, ...]]
    gaps: tuple[Gap, ...]
    unfinished: tuple[str, ...]


class PartFolder:
    """A folder open for recording, by one process at a time.

    Parameters
    ----------
    folder : Path
        Made if it does not exist.
    server : str
        The address as it is to be kept: without user and password.
    channels : sequence of RecordedNode

    Attributes
    ----------
    begun : Begun
    number : int
        Of the last part that is there; 0 if there is none.

    Raises
    ------
    InputError
        If another process records into the folder, or it holds one of the channels from another node or in another unit.
    FormatError
        If a part in it cannot be read.
    """

    def __init__(self, folder: Path, server: str, channels: Sequence[RecordedNode]) -> None:
        self._folder, self._server, self._channels = folder, server, tuple(channels)
        folder.mkdir(parents=True, exist_ok=True)
        self._lock = _locked(folder)
        try:
            self.begun = _begun(folder, self._channels)
        except BaseException:
            self._lock.close()
            raise
        self.number = self.begun.parts

    def write(self, batch: Batch) -> Path:
        """Write a batch as the next part; when this returns, neither a kill nor a power cut takes it away.

        Raises
        ------
        OSError
            If the disk refuses; nothing of the part is left, and the batch can be written again.
        """
        counts = np.bincount(batch.samples.channel, minlength=len(self._channels)).tolist()
        recorded = tuple(
            RecordedChannel(channel.name, channel.unit, channel.node, count, last)
            for channel, count, last in zip(self._channels, counts, batch.last, strict=True)
        )
        data = encode_part(PartHead(self._server, recorded, batch.gaps, batch.filled), batch.samples)
        path = self._folder / part_name(self.number + 1)
        _write_whole(path, data)
        self.number += 1
        return path

    def close(self) -> None:
        """Let others record into the folder."""
        self._lock.close()


def _write_whole(path: Path, data: bytes) -> None:
    """Put a new file in its place, whole or not at all."""
    unfinished = path.with_name(f"{path.name}{_UNFINISHED}{secrets.token_hex(4)}")
    try:
        with open(unfinished, "xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if path.exists():
            raise FileExistsError(17, "is there already, and is never overwritten", str(path))
        unfinished.rename(path)
    except OSError:
        unfinished.unlink(missing_ok=True)
        raise
    if os.name == "posix":
        descriptor = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _locked(folder: Path) -> IO[bytes]:
    """A file that stays locked until it is closed or the process ends, however it ends."""
    file = open(folder / _LOCK, "ab")  # noqa: SIM115
    try:
        if os.name == "nt":
            import msvcrt

            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        file.close()
        raise InputError(
            f"{folder}: another process is recording into it; stop that one, or choose another folder"
        ) from None
    return file


def _begun(folder: Path, channels: tuple[RecordedNode, ...]) -> Begun:
    files = part_files(folder)
    heads = [read_head(path) for path in files.values()]
    samples: Counter[str] = Counter()
    last: dict[str, int] = {}
    asked = {channel.name: channel for channel in channels}
    for path, head in zip(files.values(), heads, strict=True):
        for channel in head.channels:
            _check_same(channel, asked.get(channel.name), path)
            samples[channel.name] += channel.samples
            if channel.last is not None:
                last[channel.name] = channel.last
    recorded = {name: (*_before(files, name, time), time) for name, time in last.items() if name in asked}
    unfinished = tuple(sorted(path.name for path in folder.iterdir() if _UNFINISHED in path.name))
    return Begun(max(files, default=0), dict(samples), recorded, standing_gaps(heads), unfinished)


def _check_same(channel: RecordedChannel, asked: RecordedNode | None, path: Path) -> None:
    if asked and (asked.node, asked.unit) != (channel.node, channel.unit):
        raise InputError(
            f"{path.parent}: holds channel {channel.name!r} of node {channel.node!r} in {channel.unit or 'no unit'!r}, "
            f"not of {asked.node!r} in {asked.unit or 'no unit'!r}; give the channel another name, or choose another folder"
        )


def _before(files: dict[int, Path], name: str, last: int) -> tuple[int, ...]:
    """Times of the newest samples of a channel before its last one, from the newest parts."""
    times: list[int] = []
    for path in list(files.values())[-_LOOKED_AT:]:
        table = read_table(path.read_bytes(), str(path))
        try:
            names = table.column("channel").to_numpy()
            found = table.column("time").cast("int64").to_numpy()[(names == name) & ~table.column("filled").to_numpy()]
        except KeyError:
            raise FormatError(f"{path}: is no part of a recording of elastogeo; move it to another folder") from None
        times.extend(int(time) for time in found if time < last)
    return tuple(times[1 - WITNESSES :])
