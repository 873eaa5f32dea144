"""Closing gaps from the server's history, one page of it at a time."""

from __future__ import annotations

import asyncio
from typing import Protocol

import numpy as np

from elastogeo.formats import Gap
from elastogeo.recording.gaps import is_settled, plan_fill
from elastogeo.recording.opcua import Connection, NoHistoryError, Sample, ServerError

ATTEMPTS = 10
"""How often a history is asked that brings nothing new; it may lag behind what the server sends."""
PAUSE = 0.5
"""Seconds between two attempts."""


class Keeper(Protocol):
    """Who keeps the gaps and the samples."""

    def standing(self) -> tuple[Gap, ...]:
        """The gaps that are marked now."""

    def number_of(self, channel: str) -> int | None:
        """The number of a channel; None if it is not recorded now."""

    def witnesses_of(self, gap: Gap) -> tuple[int, ...]:
        """Times of samples received until the start of a gap."""

    async def fill(self, gap: Gap, samples: list[Sample], rest: tuple[Gap, ...]) -> None:
        """Take samples that lie in a gap, and what remains of it; waits until there is room for them."""

    def note(self, sentence: str) -> None:
        """Note what the user must know, once."""


class Filler:
    """Fills the gaps of a keeper over one connection for as long as it lasts.

    Parameters
    ----------
    connection : Connection
    keeper : Keeper
    """

    def __init__(self, connection: Connection, keeper: Keeper) -> None:
        self._connection, self._keeper = connection, keeper
        self._attempts: dict[tuple[str, int, int | None], int] = {}
        self._without: set[str] = set()

    def due(self) -> list[Gap]:
        """Gaps that the history has not been asked for often enough."""
        return [
            gap
            for gap in self._keeper.standing()
            if gap.end is not None
            and gap.end > gap.start
            and not is_settled(gap)
            and gap.channel not in self._without
            and self._keeper.number_of(gap.channel) is not None
            and self._attempts.get(gap.key, 0) < ATTEMPTS
        ]

    async def run(self) -> None:
        """Fill until cancelled."""
        while True:
            await self.round()
            await asyncio.sleep(PAUSE)

    async def round(self) -> None:
        """Ask for every gap that is due, and go on with each as long as something comes."""
        for gap in self.due():
            following: Gap | None = gap
            while following is not None and following.channel not in self._without:
                following = await self._ask(following)

    async def _ask(self, gap: Gap) -> Gap | None:
        """Ask for one page; what to go on with at once, if the page did not reach the end."""
        channel = self._keeper.number_of(gap.channel)
        if channel is None or gap.end is None:
            return None
        self._attempts[gap.key] = self._attempts.get(gap.key, 0) + 1
        witnesses = self._keeper.witnesses_of(gap)
        try:
            history, complete = await self._connection.history(channel, min((*witnesses, gap.start)), gap.end)
        except NoHistoryError as error:
            self._without.add(gap.channel)
            self._keeper.note(f"{error}; gaps of it stay marked.")
            return None
        except ServerError:
            return None
        plan = plan_fill(gap, witnesses, np.array([sample.time for sample in history], dtype=np.int64), complete)
        if plan.rest == (gap,) and not plan.inside.any():
            return None
        await self._keeper.fill(gap, [history[k] for k in np.flatnonzero(plan.inside)], plan.rest)
        return None if complete or plan.rest == (gap,) else plan.rest[-1]
