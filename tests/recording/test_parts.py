import os
import subprocess
import sys

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.recording_files import Gap, part_files, read_head, read_table
from elastogeo.recording.backlog import Backlog
from elastogeo.recording.parts import PartFolder
from elastogeo.recording.settings import RecordedNode

SERVER = "opc.tcp://m:4840"
CHANNELS = (RecordedNode("x", "ns=2;s=X", "mm"), RecordedNode("i", "ns=2;s=I", "A"))


def batch(*rows, gaps=(), filled=(), last=(None, None)):
    backlog = Backlog(1000)
    for row in rows:
        backlog.add(*row)
    for gap in gaps:
        backlog.mark(gap)
    for gap in filled:
        backlog.close(gap)
    return backlog.take(last)


def test_parts_are_read_back_bit_for_bit_and_gone_on_with(tmp_path):
    gap = Gap("x", 10, 40, "cut")
    parts = PartFolder(tmp_path / "a" / "r", SERVER, CHANNELS)
    assert parts.begun.parts == 0
    first = parts.write(
        batch((0, 10, 0.1, 0), (1, 10, 1e-300, 0), (0, 40, float("nan"), 0x80000000), gaps=[gap], last=(40, 10))
    )
    parts.close()
    table = read_table(first.read_bytes(), "f")
    assert table.column("channel").to_pylist() == ["x", "i", "x"]
    assert table.column("time").cast("int64").to_pylist() == [10, 10, 40]
    assert table.column("value").to_numpy().tobytes() == np.array([0.1, 1e-300, np.nan]).tobytes()
    assert table.column("status").to_pylist() == [0, 0, 0x80000000]
    again = PartFolder(tmp_path / "a" / "r", "opc.tcp://moved:4840", CHANNELS)
    assert again.begun.samples == {"x": 2, "i": 1}
    assert again.begun.recorded == {"x": (10, 40), "i": (10,)}
    assert again.begun.gaps == (gap,)
    second = again.write(batch((0, 20, 2.0, 0, True), filled=[gap], last=(40, 10)))
    again.close()
    assert [first.name, second.name] == ["part-000001.parquet", "part-000002.parquet"]
    third = PartFolder(tmp_path / "a" / "r", SERVER, CHANNELS)
    assert third.begun.gaps == ()
    assert third.begun.recorded["x"] == (10, 40), "filled samples are no witnesses"
    third.close()


def test_a_folder_is_recorded_into_by_one_process(tmp_path):
    parts = PartFolder(tmp_path, SERVER, CHANNELS)
    with pytest.raises(InputError, match="another process is recording into it"):
        PartFolder(tmp_path, SERVER, CHANNELS)
    parts.close()
    PartFolder(tmp_path, SERVER, CHANNELS).close()


def test_a_channel_stays_the_same_signal(tmp_path):
    parts = PartFolder(tmp_path, SERVER, CHANNELS)
    parts.write(batch((0, 1, 1.0, 0), last=(1, None)))
    parts.close()
    for other in (RecordedNode("x", "ns=2;s=Y", "mm"), RecordedNode("x", "ns=2;s=X", "um")):
        with pytest.raises(InputError, match="holds channel 'x' of node 'ns=2;s=X' in 'mm', not of"):
            PartFolder(tmp_path, SERVER, (other,))
    more = PartFolder(tmp_path, SERVER, (RecordedNode("new", "ns=2;s=N"),))
    assert more.begun.recorded == {}
    more.close()


def test_what_is_half_written_is_ignored_and_named(tmp_path):
    (tmp_path / "part-000001.parquet.unfinished-00ff").write_bytes(b"PAR1 half")
    parts = PartFolder(tmp_path, SERVER, CHANNELS)
    assert parts.begun.unfinished == ("part-000001.parquet.unfinished-00ff",)
    parts.write(batch((0, 1, 1.0, 0), last=(1, None)))
    parts.close()
    assert list(part_files(tmp_path)) == [1]
    assert (tmp_path / "part-000001.parquet.unfinished-00ff").read_bytes() == b"PAR1 half"


def test_nothing_is_overwritten(tmp_path):
    parts = PartFolder(tmp_path, SERVER, CHANNELS)
    (tmp_path / "part-000001.parquet").write_bytes(b"somebody else's")
    with pytest.raises(FileExistsError, match="never overwritten"):
        parts.write(batch((0, 1, 1.0, 0), last=(1, None)))
    parts.close()
    assert (tmp_path / "part-000001.parquet").read_bytes() == b"somebody else's"
    assert [path.name for path in tmp_path.iterdir() if "unfinished" in path.name] == []


@pytest.mark.parametrize("step", ["fsync", "rename"])
def test_a_disk_that_refuses_leaves_nothing_and_the_batch_can_be_written_again(tmp_path, monkeypatch, step):
    def refuse(*_):
        raise OSError(28, "No space left on device")

    parts = PartFolder(tmp_path, SERVER, CHANNELS)
    one = batch((0, 1, 1.0, 0), last=(1, None))
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync" if step == "fsync" else "pathlib.Path.rename", refuse)
        with pytest.raises(OSError, match="No space left"):
            parts.write(one)
    assert [path.name for path in tmp_path.iterdir()] == ["recording.lock"]
    assert parts.write(one).name == "part-000001.parquet"
    parts.close()


def test_a_part_counts_only_when_it_and_its_folder_are_flushed(tmp_path, monkeypatch):
    done = []
    fsync, rename = os.fsync, type(tmp_path).rename
    monkeypatch.setattr("os.fsync", lambda number: (done.append(os.fstat(number).st_ino), fsync(number))[1])
    monkeypatch.setattr("pathlib.Path.rename", lambda one, other: (done.append("rename"), rename(one, other))[1])
    parts = PartFolder(tmp_path, SERVER, CHANNELS)
    path = parts.write(batch((0, 1, 1.0, 0), last=(1, None)))
    parts.close()
    assert done == [path.stat().st_ino, "rename", tmp_path.stat().st_ino]


def test_damaged_and_foreign_parts_are_named(tmp_path):
    (tmp_path / "part-000001.parquet").write_bytes(b"PAR1 nothing PAR1")
    with pytest.raises(FormatError, match=r"part-000001\.parquet: the Parquet file is damaged"):
        PartFolder(tmp_path, SERVER, CHANNELS)
    import pyarrow as pa
    import pyarrow.parquet as pq

    pq.write_table(pa.table({"a": [1]}), tmp_path / "part-000001.parquet")
    with pytest.raises(FormatError, match="is no part of a recording"):
        read_head(tmp_path / "part-000001.parquet")
    (tmp_path / "part-000001.parquet").unlink()
    PartFolder(tmp_path, SERVER, CHANNELS).close()


@pytest.mark.parametrize("kills", [2, pytest.param(30, marks=pytest.mark.nightly)])
def test_kills_of_a_writer_lose_no_part_that_it_named(tmp_path, kills):
    """The writer prints a part's name once it is acknowledged; it is killed at the next line, at whatever it does then."""
    script = (
        "import sys\n"
        "from pathlib import Path\n"
        "from elastogeo.recording.backlog import Backlog\n"
        "from elastogeo.recording.parts import PartFolder\n"
        "from elastogeo.recording.settings import RecordedNode\n"
        "parts = PartFolder(Path(sys.argv[1]), 'opc.tcp://m', (RecordedNode('x', 'i=1'),))\n"
        "while True:\n"
        "    backlog = Backlog(10**6)\n"
        "    for k in range(1000): backlog.add(0, k, k, 0)\n"
        "    print(parts.write(backlog.take([999])).name, flush=True)\n"
    )
    named = set()
    for kill in range(kills):
        writer = subprocess.Popen([sys.executable, "-c", script, str(tmp_path)], stdout=subprocess.PIPE, text=True)
        for _ in range(1 + kill % 3):
            named.add(writer.stdout.readline().strip())
        writer.kill()
        named |= {line.strip() for line in writer.stdout.read().splitlines()}
        writer.stdout.close()
        writer.wait()
    files = part_files(tmp_path)
    assert named <= {path.name for path in files.values()}
    assert list(files) == list(range(1, len(files) + 1))
    assert all(read_table(path.read_bytes(), "f").num_rows == 1000 for path in files.values())
