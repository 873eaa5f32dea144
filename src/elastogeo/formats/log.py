"""A log as a control or a data logger recorded it: channels, each with a clock of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.machine import Array


@dataclass(frozen=True, slots=True)
class Channel:
    """One recorded signal, as it stands in the file: nothing is converted, dropped or filled.

    Attributes
    ----------
    name : str
        As the file spells it: `CURRENT|1`, `X1_CurrentFeedback`.
    unit : str
        As the file says it, in a spelling of `elastogeo.formats.text.units`; empty if the file gives none.
    values : array, shape (m,)
        In that unit; NaN where the file has a sample but no number.
    time : array, shape (m,) [s], or None
        Strictly increasing, from any zero that the channels of the file share; None if the file keeps no clock, and
        the samples only follow one another.
    """

    name: str
    unit: str
    values: Array
    time: Array | None = None

    def __post_init__(self) -> None:
        """Refuse a channel whose clock does not go forward."""
        if self.values.ndim != 1 or not len(self.values):
            raise FormatError(f"channel {self.name!r} has no sample; record it again or leave it out")
        if self.time is None:
            return
        if len(self.time) != len(self.values):
            raise FormatError(f"channel {self.name!r} has {len(self.values)} samples at {len(self.time)} times")
        steps = np.diff(self.time)
        if not np.isfinite(self.time).all() or (steps <= 0).any():
            row = int(np.argmax(~(steps > 0))) + 2 if len(steps) else 1
            raise FormatError(
                f"channel {self.name!r}: the time of sample {row} is not after the one before it; a log must be in the "
                f"order of its clock"
            )


@dataclass(frozen=True, slots=True)
class Log:
    """A recording.

    Attributes
    ----------
    channels : mapping of str to Channel
        By name, in the order of the file.
    metadata : mapping of str to str
        What the file says besides.
    source : str
        Where it came from, for messages.
    notes : tuple of str
        Sentences on what was repaired or left out in reading: an order put right, doubled samples, channels of text.
    counter : str
        Name of the channel that counts the samples of a file without a clock, in sample times; empty if none does.
    """

    channels: Mapping[str, Channel]
    metadata: Mapping[str, str]
    source: str
    notes: tuple[str, ...] = ()
    counter: str = ""

    def __post_init__(self) -> None:
        """Refuse a log without a channel."""
        if not self.channels:
            raise FormatError(f"{self.source}: holds no channel of numbers; export it again with its signals")


def in_time_order(time: Array, columns: Sequence[Array], where: str) -> tuple[NDArray[np.intp], tuple[str, ...]]:
    """Put the samples of a file that keeps one clock in its order, and leave out those that it holds twice.

    Parameters
    ----------
    time : array, shape (m,) [any unit]
        Of each sample; finite.
    columns : sequence of array, shape (m,)
        What was recorded, to tell a sample that was written twice from two that claim one moment. NaN equals NaN.
    where : str
        The file and the clock, for messages.

    Returns
    -------
    keep : array of int, shape (n,)
        The samples to take, in the order to take them: n <= m, and `time[keep]` increases strictly.
    notes : tuple of str
        A sentence on each thing that was put right.

    Raises
    ------
    FormatError
        If two samples of one moment are not the same.
    """
    back = int((np.diff(time) < 0).sum())
    keep = np.argsort(time, kind="stable") if back else np.arange(len(time))
    again = np.flatnonzero(np.diff(time[keep]) == 0) + 1
    notes = [f"{_times(back, 'the clock goes', 'back')}: the samples were put in its order"] if back else []
    if not len(again):
        return keep, tuple(notes)
    earlier, later = keep[again - 1], keep[again]
    same = np.ones(len(again), dtype=bool)
    for values in columns:
        a, b = values[earlier], values[later]
        same &= (a == b) | (np.isnan(a) & np.isnan(b))
    if not same.all():
        first = int(np.argmin(same))
        raise FormatError(
            f"{where}: samples {earlier[first] + 1} and {later[first] + 1} are both of {time[later[first]]:.9g} and differ "
            f"({int((~same).sum())} such pairs); export the clock with more digits, or take one of each pair out"
        )
    notes.append(f"{len(again)} samples stand in the file twice: taken once")
    return np.delete(keep, again), tuple(notes)


def _times(count: int, what: str, how: str) -> str:
    return f"{what} {how} once" if count == 1 else f"{what} {how} {count} times"
