"""The recorder without a server: what it does with samples as they arrive, and with a disk that is slow or refuses."""

import asyncio
import math
import time

import numpy as np
import pytest

from elastogeo.formats.logs.parquet import read_recording
from elastogeo.formats.recording_files import Gap, part_files, read_head, read_table, standing_gaps
from elastogeo.recording import RecordedNode, RecordingPlan
from elastogeo.recording.opcua import Sample
from elastogeo.recording.parts import PartFolder
from elastogeo.recording.recorder import FULL, NOT_RECORDING, OVERFLOW, SLOW_DISK, Recorder
from elastogeo.recording.writing import PartWriter

OVERFLOWED = 0x480


class Told:
    def __init__(self):
        self.sentences, self.parts = [], {}

    def say(self, sentence):
        self.sentences.append(sentence)

    def kept(self, part, samples, total):
        assert total >= samples
        self.parts[part] = samples


class Bench:
    """A recorder of channels x and y, and its folder, that is written only when it is told to."""

    def __init__(self, folder, backlog=1000):
        channels = (RecordedNode("x", "i=1", "mm"), RecordedNode("y", "i=2"))
        self.plan = RecordingPlan("opc.tcp://m", channels, backlog=backlog, batch=0.01)
        self.folder, self.told = folder, Told()
        self.parts = PartFolder(folder, self.plan.server, channels)
        self.recorder = Recorder(self.plan, folder, self.parts, self.told, asyncio.Event())

    def receive(self, *samples, full=()):
        self.recorder.receive([Sample(*sample) for sample in samples], frozenset(full))

    def write(self, disk=None):
        async def finish():
            finished = asyncio.Event()
            finished.set()
            writer = self.recorder._writer
            writer._disk = disk or self.parts
            await writer.run(finished)

        asyncio.run(finish())

    def gaps(self):
        return standing_gaps(read_head(path) for path in part_files(self.folder).values())

    def rows(self):
        tables = [read_table(path.read_bytes(), "f") for path in part_files(self.folder).values()]
        return [
            row
            for table in tables
            for row in zip(
                table.column("channel").to_pylist(),
                table.column("time").cast("int64").to_pylist(),
                table.column("value").to_pylist(),
                strict=True,
            )
        ]


@pytest.fixture
def bench(tmp_path):
    made = Bench(tmp_path)
    yield made
    made.parts.close()


def test_samples_are_kept_as_they_come(bench):
    bench.receive((0, 10, 1.5, 0), (1, 11, -2.0, 0), (0, 20, math.inf, 0))
    bench.write()
    assert bench.rows() == [("x", 10, 1.5), ("y", 11, -2.0), ("x", 20, math.inf)]
    assert bench.gaps() == ()
    assert bench.recorder.result().samples == {"x": 2, "y": 1}


def test_a_lost_connection_is_a_gap_until_the_next_sample(bench):
    bench.receive((0, 10, 1.0, 0), (1, 10, 1.0, 0))
    bench.recorder.lose("cut")
    bench.write()
    assert bench.gaps() == (Gap("x", 10, None, "cut"), Gap("y", 10, None, "cut")), "known before anything comes again"
    bench.receive((0, 10, 1.0, 0), (1, 30, 2.0, 0))
    bench.write()
    assert bench.gaps() == (Gap("y", 10, 30, "cut"),), "x has had no new sample"
    assert bench.rows() == [("x", 10, 1.0), ("y", 10, 1.0), ("y", 30, 2.0)]


@pytest.mark.parametrize(("status", "full", "cause"), [(OVERFLOWED, (), OVERFLOW), (0, (0,), FULL)])
def test_an_overflow_at_the_server_is_a_gap_before_the_sample_that_says_so(bench, status, full, cause):
    bench.receive((0, 10, 1.0, 0), (1, 10, 1.0, 0))
    bench.receive((0, 20, 1.0, status), (0, 30, 1.0, 0), (1, 20, 1.0, 0), full=full)
    bench.write()
    assert bench.gaps() == (Gap("x", 10, 20, cause),)


@pytest.mark.parametrize("status", [0x80, 0x400, 0x80 | 0x800, 0x80000000])
def test_only_the_overflow_bit_of_a_data_value_says_overflow(status):
    assert not Sample(0, 1, 1.0, status).after_overflow
    assert Sample(0, 1, 1.0, status & 0xF0000000 | OVERFLOWED).after_overflow


def test_one_time_with_two_values_is_kept_twice_and_read_once(bench):
    bench.receive((0, 10, 1.0, 0), (0, 10, 1.0, 0), (0, 10, 2.0, 0))
    bench.write()
    assert bench.rows() == [("x", 10, 1.0), ("x", 10, 2.0)]
    log = read_recording(bench.folder)
    assert log.channels["x"].values.tolist() == [1.0]
    assert "x: 1 samples have another value at a time that has one: the first is taken" in log.notes


def test_a_clock_that_goes_back_loses_nothing(bench):
    bench.receive((0, 20, 1.0, 0), (0, 10, 2.0, 0))
    bench.recorder.lose("cut")
    bench.receive((0, 5, 3.0, 0))
    bench.write()
    assert [moment for _, moment, _ in bench.rows()] == [20, 10, 5]
    assert bench.gaps() == (Gap("x", 10, 5, "cut"),)
    assert any("the clock of the source went back" in note for note in bench.recorder.result().notes)


def test_what_does_not_fit_the_backlog_is_marked_and_said_and_memory_is_bounded(bench):
    for k in range(1600):
        bench.receive((0, k, float(k), 0))
    assert bench.recorder._backlog.held == 1000
    assert bench.told.sentences == [f"x: {SLOW_DISK}; samples are lost and marked as a gap."]
    bench.write()
    bench.receive((0, 1700, 1700.0, 0))
    bench.write()
    assert bench.gaps() == (Gap("x", 999, 1700, SLOW_DISK),)
    assert [moment for _, moment, _ in bench.rows()] == [*range(1000), 1700]


def test_a_slow_disk_loses_nothing_unmarked(bench):
    class Slow:
        def write(self, batch):
            time.sleep(0.02)
            return bench.parts.write(batch)

    async def record():
        finished = asyncio.Event()
        writer: PartWriter = bench.recorder._writer
        writer._disk = Slow()
        writing = asyncio.create_task(writer.run(finished))
        for k in range(20_000):
            bench.receive((0, k, float(k), 0), (1, k, float(k), 0))
            assert bench.recorder._backlog.held <= 1000
            if k % 50 == 0:
                await asyncio.sleep(0)
        finished.set()
        await writing

    asyncio.run(record())
    kept, gaps = bench.rows(), bench.gaps()
    assert 0 < len(kept) < 40_000
    for channel in ("x", "y"):
        missing = np.array(sorted(set(range(20_000)) - {t for name, t, _ in kept if name == channel}))
        own = [gap for gap in gaps if gap.channel == channel]
        covered = np.zeros(len(missing), dtype=bool)
        for gap in own:
            covered |= (missing > gap.start) & (missing < (gap.end or 20_000))
        assert covered.all()


def test_a_disk_that_refuses_is_tried_again_and_told(bench, monkeypatch):
    monkeypatch.setattr("elastogeo.recording.writing.FIRST_PAUSE", 0.01)
    refusals = iter([OSError(28, "No space left on device"), OSError(5, "Input/output error"), None])

    class Full:
        def write(self, batch):
            error = next(refusals)
            if error:
                raise error
            return bench.parts.write(batch)

    async def record():
        finished = asyncio.Event()
        writer = bench.recorder._writer
        writer._disk = Full()
        bench.receive((0, 1, 1.0, 0))
        writing = asyncio.create_task(writer.run(finished))
        while not bench.told.parts:
            await asyncio.sleep(0.01)
        finished.set()
        await writing

    asyncio.run(record())
    assert bench.told.parts == {"part-000001.parquet": 1}
    assert [s[:60] for s in bench.told.sentences] == [
        "The disk refuses a part (No space left on device): 1 samples",
        "The disk refuses a part (Input/output error): 1 samples wait",
    ]


def test_a_disk_that_refuses_the_last_part_is_an_error(bench):
    class Dead:
        def write(self, _):
            raise OSError(28, "No space left on device")

    bench.receive((0, 1, 1.0, 0))
    with pytest.raises(OSError, match="No space left"):
        bench.write(Dead())
    assert bench.told.parts == {}


def test_filled_samples_go_to_disk_with_what_they_close(bench):
    bench.receive((0, 10, 1.0, 0))
    bench.recorder.lose("cut")
    bench.receive((0, 50, 5.0, 0))
    bench.write()
    gap, rest = Gap("x", 10, 50, "cut"), Gap("x", 30, 50, "cut")
    assert bench.recorder.witnesses_of(gap) == (10,)
    asyncio.run(bench.recorder.fill(gap, [Sample(0, 30, 3.0, 0)], (rest,)))
    bench.write()
    assert bench.gaps() == (rest,)
    asyncio.run(bench.recorder.fill(rest, [Sample(0, 40, 4.0, 0)], ()))
    bench.write()
    assert bench.gaps() == ()
    log = read_recording(bench.folder)
    assert log.channels["x"].values.tolist() == [1.0, 3.0, 4.0, 5.0]
    assert log.notes == ("2 samples were fetched afterwards, from the source's history",)
    assert bench.recorder.result().filled == {"x": 2, "y": 0}


def test_what_is_settled_is_marked_once_with_its_doubt(bench):
    bench.receive((0, 10, 1.0, 0))
    bench.recorder.lose("cut")
    bench.recorder.server_started(30)
    bench.receive((0, 50, 5.0, 0))
    (gap,) = bench.recorder.standing()
    assert gap.cause == "cut; the server was restarted meanwhile"
    settled = Gap("x", 10, 50, gap.cause + ", what it holds was taken")
    asyncio.run(bench.recorder.fill(gap, [Sample(0, 30, 3.0, 0)], (settled,)))
    bench.write()
    assert bench.gaps() == bench.recorder.standing() == (settled,)


def test_filling_waits_for_room_that_live_samples_need_first(bench):
    for k in range(600):
        bench.receive((0, k, float(k), 0))
    page = [Sample(1, k, 0.0, 0) for k in range(5000)]

    async def fill():
        filling = asyncio.create_task(bench.recorder.fill(Gap("y", -1, 9999, "cut"), page, ()))
        await asyncio.sleep(0.15)
        assert not filling.done()
        bench.receive((0, 600, 1.0, 0))
        assert bench.recorder._backlog.held == 601
        finished = asyncio.Event()
        finished.set()
        await bench.recorder._writer.run(finished)
        await filling

    asyncio.run(fill())
    assert bench.recorder._backlog.held == 5000


def test_what_was_not_recorded_between_two_runs_is_a_gap(tmp_path):
    first = Bench(tmp_path)
    first.receive((0, 10, 1.0, 0), (0, 20, 1.0, 0))
    first.write()
    first.parts.close()
    second = Bench(tmp_path)
    second.receive((0, 90, 1.0, 0), (1, 90, 1.0, 0))
    second.write()
    second.parts.close()
    assert second.gaps() == (Gap("x", 20, 90, NOT_RECORDING),)
    assert second.recorder.witnesses_of(second.gaps()[0]) == (10, 20)
    assert second.recorder.result().in_folder == {"x": 3, "y": 1}


def test_zeros_of_a_server_that_was_restarted_are_initial_values_and_no_samples(bench):
    second = 1_000_000_000
    bench.recorder.server_started(second)
    bench.receive((0, 10 * second, 1.5, 0), (1, 10 * second, 0.0, 0))
    bench.recorder.lose("cut")
    bench.recorder.server_started(20 * second)
    bench.receive((0, 21 * second, 0.0, 0), (1, 21 * second, 2.0, 0))
    bench.receive((0, 22 * second, 0.0, 0), (1, 22 * second, 0.0, 0))
    bench.receive((0, 23 * second, 1.25, 0), (0, 24 * second, 0.0, 0))
    bench.write()
    log = read_recording(bench.folder)
    np.testing.assert_array_equal(log.channels["x"].values, [1.5, np.nan, np.nan, 1.25, 0.0])
    np.testing.assert_array_equal(log.channels["y"].values, [0.0, 2.0, 0.0])
    assert "2 samples are zeros of a server that was restarted: given without a number" in log.notes
    assert bench.rows()[2] == ("x", 21 * second, 0.0), "what arrived is on the disk"
    assert any("zeros after the server was restarted" in sentence for sentence in bench.told.sentences)


def test_zeros_in_the_history_of_a_server_that_was_restarted_are_initial_values_too(bench):
    bench.recorder.server_started(1)
    bench.receive((0, 10, 1.5, 0))
    bench.recorder.lose("cut")
    bench.recorder.server_started(20)
    bench.receive((0, 40, 3.0, 0))
    (gap,) = bench.recorder.standing()
    history = [Sample(0, 15, 0.0, 0), Sample(0, 21, 0.0, 0), Sample(0, 22, 2.0, 0), Sample(0, 23, 0.0, 0)]
    asyncio.run(bench.recorder.fill(gap, history, ()))
    bench.write()
    np.testing.assert_array_equal(read_recording(bench.folder).channels["x"].values, [1.5, 0.0, np.nan, 2.0, 0.0, 3.0])
