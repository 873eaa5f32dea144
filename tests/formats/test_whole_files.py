"""Files are written whole, a set of them together or not at all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from elastogeo.errors import FormatError
from elastogeo.formats import write_whole


def listed(folder: Path) -> list[str]:
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


def test_a_set_is_written_with_its_folders(tmp_path: Path) -> None:
    files = {tmp_path / "a" / "runs" / "1.csv": b"one", tmp_path / "a" / "2.csv": b"two"}
    assert write_whole(files) == tuple(files)
    assert listed(tmp_path) == ["a", "a/2.csv", "a/runs", "a/runs/1.csv"]
    assert [path.read_bytes() for path in files] == [b"one", b"two"]
    plain = tmp_path / "plain"
    plain.write_bytes(b"")
    assert (tmp_path / "a" / "2.csv").stat().st_mode == plain.stat().st_mode


def test_what_is_there_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "r.html").write_bytes(b"old")
    write_whole({tmp_path / "r.html": b"new"})
    assert (tmp_path / "r.html").read_bytes() == b"new"
    assert listed(tmp_path) == ["r.html"]


class Interrupted(Mapping[Path, bytes]):
    """Files of which Ctrl-C comes before the third."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __getitem__(self, path: Path) -> bytes:
        if path.name == "2":
            raise KeyboardInterrupt
        return b"x" * 100_000

    def __iter__(self) -> Iterator[Path]:
        return (self.folder / "runs" / str(k) for k in range(4))

    def __len__(self) -> int:
        return 4


def test_an_interruption_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        write_whole(Interrupted(tmp_path / "new"))
    assert listed(tmp_path) == []


def test_an_interruption_while_renaming_leaves_no_half_set(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = tmp_path / "kept.csv"
    kept.write_bytes(b"mine")
    replace, calls = Path.replace, []

    def interrupted(self: Path, target: Path) -> Path:
        calls.append(target)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole({tmp_path / "1.csv": b"one", kept: b"two", tmp_path / "3.csv": b"three"})
    assert listed(tmp_path) == ["kept.csv"]
    assert kept.read_bytes() == b"mine"


def test_what_cannot_be_written_is_said_and_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(FormatError, match=r"file/2\.csv: cannot be written \(.*\), and none of the files beside it was"):
        write_whole({tmp_path / "1.csv": b"one", tmp_path / "file" / "2.csv": b"two"})
    assert listed(tmp_path) == ["file"]
