"""What has arrived and is not on disk yet: bounded, and handed over in batches that are never split."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.formats import Gap, Samples


@dataclass(frozen=True, slots=True)
class Batch:
    """Samples that go to disk together with the gaps that begin to be known, or are closed, by them.

    Attributes
    ----------
    samples : Samples
    gaps, filled : tuple of Gap
    last : tuple of (int [ns since 1970, UTC] or None)
        The newest sample of each channel when the batch was made.
    """

    samples: Samples
    gaps: tuple[Gap, ...]
    filled: tuple[Gap, ...]
    last: tuple[int | None, ...]

    @property
    def rows(self) -> int:
        """The number of samples."""
        return len(self.samples.time)


class Backlog:
    """Holds samples between reception and disk, at most a given number; when it is full it stays shut until half empty.

    Parameters
    ----------
    limit : int
        Samples that may be waiting or on their way to disk.
    """

    def __init__(self, limit: int) -> None:
        self.limit = limit
        self.held = 0
        self.shut = False
        self._empty()

    def _empty(self) -> None:
        self._channel, self._time, self._value = array("i"), array("q"), array("d")
        self._status, self._filled = array("I"), array("b")
        self._gaps: list[Gap] = []
        self._closed: list[Gap] = []

    @property
    def waiting(self) -> int:
        """Samples not handed over yet."""
        return len(self._time)

    @property
    def has_news(self) -> bool:
        """Whether there is anything to write: samples or gaps."""
        return bool(self._time or self._gaps or self._closed)

    def has_room(self) -> bool:
        """Whether a sample may come in now."""
        self.shut = self.held >= self.limit or (self.shut and self.held > self.limit // 2)
        return not self.shut

    def is_calm(self, rows: int) -> bool:
        """Whether so many samples may come in that can wait at their source, and leave room for those that cannot."""
        return not self.held or self.held + rows <= self.limit // 2

    def add(self, channel: int, time: int, value: float, status: int, filled: bool = False) -> None:
        """Take one sample, for which there is room."""
        self._channel.append(channel)
        self._time.append(time)
        self._value.append(value)
        self._status.append(status)
        self._filled.append(filled)
        self.held += 1

    def mark(self, gap: Gap) -> None:
        """Note that samples may be missing; it goes to disk with the samples around it."""
        self._gaps.append(gap)

    def close(self, gap: Gap) -> None:
        """Note that the samples just added close a gap, or that what remains of it is marked anew."""
        self._closed.append(gap)

    def take(self, last: Sequence[int | None]) -> Batch:
        """All that waits, as one batch; it counts as held until it is released."""
        samples = Samples(
            np.array(self._channel, dtype=np.int32),
            np.array(self._time, dtype=np.int64),
            np.array(self._value, dtype=np.float64),
            np.array(self._status, dtype=np.uint32),
            np.array(self._filled, dtype=np.bool_),
        )
        batch = Batch(samples, tuple(self._gaps), tuple(self._closed), tuple(last))
        self._empty()
        return batch

    def release(self, batch: Batch) -> None:
        """Forget a batch that is on disk."""
        self.held -= batch.rows
