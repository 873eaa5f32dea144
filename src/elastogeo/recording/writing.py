"""From the backlog to disk, beside reception: a part whenever it is time, and patience with a disk that refuses."""

from __future__ import annotations

import asyncio
import contextlib
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

from elastogeo.recording.backlog import Backlog, Batch
from elastogeo.recording.settings import RecordingPlan

TICK = 0.05
FIRST_PAUSE = 0.5


class Watcher(Protocol):
    """Who is told what goes on."""

    def say(self, sentence: str) -> None:
        """Something happened."""

    def kept(self, part: str, samples: int, total: int) -> None:
        """A part is on disk for good: its name, its samples, those of this run so far."""


class Disk(Protocol):
    """Where batches go: a `PartFolder`."""

    def write(self, batch: Batch) -> Path:
        """Write a batch; when this returns, it is there for good."""


class PartWriter:
    """Writes what waits in a backlog.

    Parameters
    ----------
    plan : RecordingPlan
    disk : Disk
    backlog : Backlog
    watcher : Watcher
        Told of a part only when it is on disk for good.
    last : callable
        The newest sample of each channel [ns since 1970, UTC, or None], asked when a batch is made.

    Attributes
    ----------
    kept, filled : Counter of str
        Samples of each channel that are on disk, and those of them from the server's history.
    """

    def __init__(
        self,
        plan: RecordingPlan,
        disk: Disk,
        backlog: Backlog,
        watcher: Watcher,
        last: Callable[[], Sequence[int | None]],
    ) -> None:
        self._plan, self._disk, self._backlog, self._watcher, self._last = plan, disk, backlog, watcher, last
        self.kept: Counter[str] = Counter()
        self.filled: Counter[str] = Counter()

    async def run(self, finished: asyncio.Event) -> None:
        """Write until `finished` is set and nothing is left.

        Raises
        ------
        OSError
            If the disk refuses the last batch.
        """
        loop = asyncio.get_running_loop()
        written = loop.time()
        while True:
            ending = finished.is_set()
            due = self._backlog.waiting and loop.time() - written >= self._plan.batch
            if due or self._backlog.waiting > self._plan.backlog // 4 or (ending and self._backlog.has_news):
                written = loop.time()
                await self._write(self._backlog.take(self._last()), finished)
            elif ending:
                return
            else:
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(finished.wait(), TICK)

    async def _write(self, batch: Batch, finished: asyncio.Event) -> None:
        """Write one batch; while the disk refuses, hold it and try again, until the recording ends."""
        pause = FIRST_PAUSE
        while True:
            try:
                path = await asyncio.to_thread(self._disk.write, batch)
                break
            except OSError as error:
                if finished.is_set():
                    raise
                self._watcher.say(
                    f"The disk refuses a part ({error.strerror or error}): {self._backlog.held} samples wait. "
                    f"Trying again in {pause:g} s."
                )
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(finished.wait(), pause)
                pause = min(2 * pause, self._plan.longest_pause)
        self._backlog.release(batch)
        for number, channel in enumerate(self._plan.channel):
            chosen = batch.samples.channel == number
            self.kept[channel.name] += int(chosen.sum())
            self.filled[channel.name] += int((chosen & batch.samples.filled).sum())
        self._watcher.kept(path.name, batch.rows, sum(self.kept.values()))
