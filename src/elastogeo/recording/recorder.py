"""The recorder: from the first connection to the last part."""

from __future__ import annotations

import asyncio
import contextlib
import signal
import threading
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from elastogeo.formats import INITIAL, Gap
from elastogeo.recording.backlog import Backlog
from elastogeo.recording.filling import Filler
from elastogeo.recording.gaps import Follower, with_restart
from elastogeo.recording.opcua import Connection, Sample, ServerError
from elastogeo.recording.parts import PartFolder
from elastogeo.recording.settings import RecordingPlan
from elastogeo.recording.summary import Recording
from elastogeo.recording.writing import PartWriter, Watcher

NOT_RECORDING = "nothing was recorded in between"
SLOW_DISK = "the disk was slower than the source"
OVERFLOW = "the server's queue overflowed"
FULL = "the server's queue was full"

_FIRST_PAUSE = 0.5
_LAST_FILL = 15.0
_TICK = 0.05


def record(
    plan: RecordingPlan, folder: Path, watcher: Watcher, duration: float | None = None, password: str = ""
) -> Recording:
    """Record until the duration is over or the process is asked to end (Ctrl-C, SIGTERM); go on with what the folder holds.

    Parameters
    ----------
    plan : RecordingPlan
    folder : Path
        Made if it does not exist.
    watcher : Watcher
    duration : float, optional [s]
        From the first connection on.
    password : str
        Of the plan's user.

    Raises
    ------
    InputError
        If the server cannot be reached at the very beginning of a recording, or the folder cannot be used.
    FormatError
        If a part in the folder cannot be read.
    OSError
        If the disk refuses the last part.
    """
    return asyncio.run(_record(plan, folder, watcher, duration, password))


async def _record(plan: RecordingPlan, folder: Path, watcher: Watcher, duration: float | None, password: str) -> Recording:
    stop = asyncio.Event()
    parts = PartFolder(folder, _public(plan.server), plan.channel)
    try:
        recorder = Recorder(plan, folder, parts, watcher, stop)
        with _asked_to_end(stop):
            await recorder.run(password, duration)
        return recorder.result()
    finally:
        parts.close()


class Recorder:
    """Keeps what a recording needs to know: followers of each channel, the backlog, the gaps that stand."""

    def __init__(self, plan: RecordingPlan, folder: Path, parts: PartFolder, watcher: Watcher, stop: asyncio.Event) -> None:
        self._plan, self._folder, self._parts, self._watcher, self._stop = plan, folder, parts, watcher, stop
        begun = parts.begun
        names = [channel.name for channel in plan.channel]
        self._numbers = {name: number for number, name in enumerate(names)}
        self._followers = [Follower(name, begun.recorded.get(name, ()), NOT_RECORDING) for name in names]
        self._values: dict[int, tuple[float, int]] = {}
        self._gaps = {gap.key: gap for gap in begun.gaps}
        self._witnesses: dict[tuple[str, int, int | None], tuple[int, ...]] = {}
        self._backlog = Backlog(plan.backlog)
        self._writer = PartWriter(plan, parts, self._backlog, watcher, lambda: [one.last for one in self._followers])
        self._connections = 0
        self._notes: dict[str, None] = {}
        self._duration: float | None = None
        self._started: int | None = None
        self._initial: set[int] = set()
        for name in begun.unfinished:
            self.note(f"{name} was left half written by a recording that was killed; it is ignored and may be deleted.")

    async def run(self, password: str, duration: float | None = None) -> None:
        """Record until `stop` is set, or so many seconds after the first connection; in any case write what has arrived."""
        self._duration = duration
        finished = asyncio.Event()
        writing = asyncio.create_task(self._writer.run(finished))
        try:
            await self._connect(password, writing)
        finally:
            for follower in self._followers:
                if follower.pending is not None and follower.pending.key not in self._gaps:
                    self._mark(follower.pending)
            finished.set()
            await writing

    def result(self) -> Recording:
        """What came of it."""
        before = self._parts.begun.samples
        names = [*before, *(name for name in self._numbers if name not in before)]
        return Recording(
            server=_public(self._plan.server),
            folder=self._folder,
            samples=dict(self._writer.kept),
            filled=dict(self._writer.filled),
            in_folder={name: before.get(name, 0) + self._writer.kept[name] for name in names},
            gaps=tuple(sorted(self._gaps.values(), key=lambda gap: (gap.start, gap.channel))),
            parts=self._parts.number,
            reconnects=max(0, self._connections - 1),
            notes=tuple(self._notes),
        )

    # What a connection brings

    def receive(self, samples: Sequence[Sample], full: frozenset[int] = frozenset()) -> None:
        """Take samples from the subscription; beyond the backlog's limit they are lost, and marked."""
        doubtful = set(full)
        for sample in samples:
            follower = self._followers[sample.channel]
            if sample.channel in doubtful or sample.after_overflow:
                doubtful.discard(sample.channel)
                self._lose(follower, OVERFLOW if sample.after_overflow else FULL)
            if follower.is_known(sample.time) and self._is_again(sample):
                self._settle(follower)
                continue
            if not self._backlog.has_room():
                if self._lose(follower, SLOW_DISK):
                    self._watcher.say(f"{follower.channel}: {SLOW_DISK}; samples are lost and marked as a gap.")
                continue
            self._take(follower, self._checked(sample))

    def server_started(self, time: int | None) -> None:
        """Note when the server was started [ns since 1970, UTC]; None if it does not say so.

        A server that was restarted since the newest sample shows zeros until its machine gives it values; they are kept with
        the status `INITIAL`.
        """
        self._started = time
        if time is not None:
            lasts = enumerate(follower.last for follower in self._followers)
            self._initial |= {number for number, last in lasts if last is not None and last < time}

    def lose(self, cause: str) -> None:
        """Note that samples of every channel may be missing from here on."""
        for follower in self._followers:
            self._lose(follower, cause)

    def note(self, sentence: str) -> None:
        """Note what the user must know, once."""
        if sentence not in self._notes:
            self._notes[sentence] = None
            self._watcher.say(sentence)

    def _lose(self, follower: Follower, cause: str) -> bool:
        pending = follower.lose(cause)
        if pending is not None:
            self._mark(pending)
        return pending is not None

    def _settle(self, follower: Follower) -> None:
        """The newest sample arrived again, so none is missing after it."""
        pending = follower.pending
        follower.again()
        if pending is not None and self._gaps.pop(pending.key, None) is not None:
            self._backlog.close(pending)

    def _is_again(self, sample: Sample) -> bool:
        value, status = self._values.get(sample.channel, (sample.value, sample.status))
        return (repr(value), status) == (repr(sample.value), sample.status)

    def _checked(self, sample: Sample) -> Sample:
        """The sample, with the status of an initial value if it is one."""
        if sample.channel not in self._initial:
            return sample
        if sample.value == 0 and not sample.status:
            name = self._followers[sample.channel].channel
            self.note(f"{name!r}: zeros after the server was restarted are marked as initial values, not as measured.")
            return replace(sample, status=INITIAL)
        self._initial.discard(sample.channel)
        return sample

    def _take(self, follower: Follower, sample: Sample) -> None:
        if follower.last is not None and sample.time < follower.last:
            self.note(f"{follower.channel!r}: the clock of the source went back; the samples are kept as they came.")
        witnesses = follower.witnesses
        gap = follower.take(sample.time)
        self._backlog.add(sample.channel, sample.time, sample.value, sample.status)
        self._values[sample.channel] = (sample.value, sample.status)
        if gap is not None:
            self._mark(with_restart(gap, self._started))
            self._witnesses[gap.key] = witnesses

    def _mark(self, gap: Gap) -> None:
        self._gaps.pop((gap.channel, gap.start, None), None)
        self._gaps[gap.key] = gap
        self._backlog.mark(gap)

    # What filling asks for

    def standing(self) -> tuple[Gap, ...]:
        """The gaps that are marked now."""
        return tuple(self._gaps.values())

    def number_of(self, channel: str) -> int | None:
        """The number of a channel; None if it is not recorded now."""
        return self._numbers.get(channel)

    def witnesses_of(self, gap: Gap) -> tuple[int, ...]:
        """Times of samples received until the start of a gap."""
        return self._witnesses.get(gap.key, ())

    async def fill(self, gap: Gap, samples: list[Sample], rest: tuple[Gap, ...]) -> None:
        """Take samples that lie in a gap, and what remains of it, into one part."""
        while not self._backlog.is_calm(len(samples)):
            await asyncio.sleep(_TICK)
        zeros = self._started is not None and gap.end is not None and gap.start < self._started < gap.end
        for sample in samples:
            since = zeros and sample.time >= (self._started or 0)
            if since and sample.value == 0 and not sample.status:
                sample = replace(sample, status=INITIAL)
            elif since:
                zeros = False
            self._backlog.add(sample.channel, sample.time, sample.value, sample.status, filled=True)
        if gap in rest:
            return
        self._gaps.pop(gap.key, None)
        for one in rest:
            self._mark(one)
            self._witnesses[one.key] = self._witnesses.get(gap.key, ()) if one.start == gap.start else ()
        if gap.key not in self._gaps:
            self._witnesses.pop(gap.key, None)
            self._backlog.close(gap)

    # Connecting, and connecting again

    async def _connect(self, password: str, writing: asyncio.Task[None]) -> None:
        pause = _FIRST_PAUSE
        while not self._stop.is_set():
            connection = Connection(self._plan, password, self)
            try:
                await connection.open()
            except ServerError as error:
                await connection.close()
                if not self._connections and not self._parts.begun.parts:
                    raise
                self._watcher.say(f"{error}. Trying again in {pause:g} s.")
                await self._wait(writing, seconds=pause)
                pause = min(2 * pause, self._plan.longest_pause)
                continue
            self._connections += 1
            if self._connections == 1 and self._duration is not None:
                asyncio.get_running_loop().call_later(self._duration, self._stop.set)
            pause = _FIRST_PAUSE
            self._watcher.say(f"Connected to {_public(self._plan.server)}{', again' if self._connections > 1 else ''}.")
            await self._stay(connection, writing)

    async def _stay(self, connection: Connection, writing: asyncio.Task[None]) -> None:
        """Record over one connection until it is lost or the recording ends."""
        filler = Filler(connection, self)
        filling = asyncio.create_task(filler.run())
        try:
            await self._wait(writing, connection.lost)
            if connection.lost.done():
                self.lose(connection.lost.result())
                self._watcher.say(f"{connection.lost.result()}; connecting again.")
            else:
                await self._fill_last(filler, filling, connection)
        finally:
            filling.cancel()
            await asyncio.wait({filling})
            if not filling.cancelled() and filling.exception() is not None:
                self.note(f"Filling gaps failed ({filling.exception()!r}); they stay marked. Please report this.")
            await connection.close()

    async def _fill_last(self, filler: Filler, filling: asyncio.Task[None], connection: Connection) -> None:
        """Give the history a last chance to close what is open, while the connection is there."""
        end = asyncio.get_running_loop().time() + _LAST_FILL
        while filler.due() and not filling.done() and not connection.lost.done():
            if asyncio.get_running_loop().time() > end:
                break
            await asyncio.sleep(_TICK)

    async def _wait(self, *those: asyncio.Future[Any], seconds: float | None = None) -> None:
        """Until the recording shall stop, one of those is done, or the time is over; a failure of one is passed on."""
        stopping = asyncio.ensure_future(self._stop.wait())
        try:
            await asyncio.wait({stopping, *those}, timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        finally:
            stopping.cancel()
        for one in those:
            if one.done() and not one.cancelled() and one.exception() is not None:
                one.result()


@contextlib.contextmanager
def _asked_to_end(stop: asyncio.Event) -> Iterator[None]:
    """Turn the first Ctrl-C or SIGTERM into a clean end; a second one ends at once."""
    loop = asyncio.get_running_loop()
    before: dict[int, Any] = {}

    def end(_number: int, _frame: object) -> None:
        restore()
        loop.call_soon_threadsafe(stop.set)

    def restore() -> None:
        for number, handler in before.items():
            signal.signal(number, handler)
        before.clear()

    if threading.current_thread() is threading.main_thread():
        before = {number: signal.signal(number, end) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        restore()


def _public(server: str) -> str:
    """An address without user and password."""
    parts = urlsplit(server)
    return parts._replace(netloc=parts.netloc.rpartition("@")[2]).geturl()
