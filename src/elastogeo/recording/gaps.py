"""Which samples may be missing: what is known of one channel, and how far the source's history closes a gap."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from elastogeo.formats import Gap

WITNESSES = 8
"""Samples before a gap that a history must hold too, to count as complete."""

RESTARTED = "; the server was restarted meanwhile"
THIN = "; the server's history holds fewer samples than it sent"
TAKEN = ", what it holds was taken"


def is_settled(gap: Gap) -> bool:
    """Whether the history was asked for a gap that it can never close, and gave what it has."""
    return gap.cause.endswith(TAKEN)


def with_restart(gap: Gap, started: int | None) -> Gap:
    """A gap, with the doubt in its cause if its server was started [ns since 1970, UTC] in it.

    A server that dies may take samples along that it neither sent nor put into its history.
    """
    inside = started is not None and gap.end is not None and gap.start < started < gap.end
    return replace(gap, cause=gap.cause + RESTARTED) if inside else gap


class Follower:
    """Follows the times of one channel as they arrive, and says between which of them samples may be missing.

    Parameters
    ----------
    channel : str
    recorded : sequence of int [ns since 1970, UTC]
        Times of the newest samples of an earlier recording that is gone on with, in their order; may be empty.
    cause : str
        Why samples after those may be missing.
    """

    __slots__ = ("_cause", "_recent", "channel", "last")

    def __init__(self, channel: str, recorded: tuple[int, ...] = (), cause: str = "") -> None:
        self.channel = channel
        self.last: int | None = recorded[-1] if recorded else None
        self._recent: deque[int] = deque(recorded, maxlen=WITNESSES)
        self._cause = cause if recorded else ""

    @property
    def witnesses(self) -> tuple[int, ...]:
        """Times of the newest samples, at most `WITNESSES`, the newest last."""
        return tuple(self._recent)

    @property
    def pending(self) -> Gap | None:
        """The gap whose end has not arrived yet, if there is one."""
        return Gap(self.channel, self.last, None, self._cause) if self._cause and self.last is not None else None

    def lose(self, cause: str) -> Gap | None:
        """Say that samples after the newest one may be missing; the pending gap, if it is new."""
        if self._cause or self.last is None:
            return None
        self._cause = cause
        return self.pending

    def is_known(self, time: int) -> bool:
        """Whether a sample is the newest one again, as a source sends it at the start of a subscription."""
        return time == self.last

    def again(self) -> None:
        """Say that the newest sample arrived again: the source has had none since, so none is missing."""
        self._cause = ""

    def take(self, time: int) -> Gap | None:
        """Take the time of a new sample; the gap that ends with it, if there was one."""
        pending = self.pending
        self.last, self._cause = time, ""
        self._recent.append(time)
        return replace(pending, end=time) if pending else None


@dataclass(frozen=True, slots=True)
class Fill:
    """What a history brings for a gap.

    Attributes
    ----------
    inside : array of bool, shape (m,)
        Which samples of the history lie in the gap.
    rest : tuple of Gap
        What remains marked: none if the gap is closed, the gap itself if nothing is gained.
    """

    inside: NDArray[np.bool_]
    rest: tuple[Gap, ...]


def plan_fill(gap: Gap, witnesses: tuple[int, ...], times: NDArray[np.int64], complete: bool = True) -> Fill:
    """Decide what of a history belongs in a gap, and what of the gap remains.

    A gap is closed only where the history is known to hold every sample: it must hold the samples at both ends of the gap,
    and those before it that were received (the witnesses). A history that begins later, or has not come so far yet, leaves
    the rest marked. One that leaves out witnesses, or whose server was restarted in the gap, gives what it holds, and
    leaves all of the gap marked and settled.

    Parameters
    ----------
    gap : Gap
        With an end after its start.
    witnesses : tuple of int [ns since 1970, UTC]
        Times of samples received until the start of the gap.
    times : array, shape (m,) [ns since 1970, UTC]
        The history from the first witness to the end of the gap, both included, in its order.
    complete : bool
        Whether it is all that the history holds of that span, rather than its first page.
    """
    if gap.end is None or gap.end <= gap.start:
        raise ValueError(f"a gap from {gap.start} to {gap.end} cannot be filled")
    inside = (times > gap.start) & (times < gap.end)
    held = set(times.tolist())
    if not held:
        return Fill(inside, (gap,))
    thin = any(min(held) <= witness <= min(gap.start, max(held)) and witness not in held for witness in witnesses)
    doubt = next((one for one in (RESTARTED, THIN) if one in gap.cause), THIN if thin else "")
    if doubt:
        return _doubtful(replace(gap, cause=gap.cause.removesuffix(doubt) + doubt), gap, inside, times, complete)
    found = times[inside]
    first, last = (int(found.min()), int(found.max())) if len(found) else (gap.end, gap.start)
    rest = []
    if gap.start not in held:
        rest.append(replace(gap, end=first))
    if (gap.end not in held or not complete) and not (rest and not len(found)):
        rest.append(replace(gap, start=last))
    return Fill(inside, tuple(rest))


def _doubtful(doubted: Gap, gap: Gap, inside: NDArray[np.bool_], times: NDArray[np.int64], complete: bool) -> Fill:
    """Take what a page of a history holds for a gap that it cannot close."""
    found = times[inside]
    if (complete and gap.end not in times) or not (complete or len(found)):
        return Fill(np.zeros_like(inside), (gap,))
    settled = replace(doubted, cause=doubted.cause + TAKEN)
    if complete:
        return Fill(inside, (settled,))
    last = int(found.max())
    return Fill(inside, (replace(settled, end=last), replace(doubted, start=last)))
