"""The raw files: whole or not at all, under their hash, never changed."""

import errno
import hashlib
import os
import signal
import time
import warnings
from collections.abc import Callable
from functools import partial
from itertools import count
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from elastogeo.errors import StoreError
from elastogeo.history.store import Files, files


@pytest.fixture
def kept(tmp_path: Path) -> Files:
    kept = Files(tmp_path / "raw")
    kept.make()
    return kept


def everything(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@given(contents=st.lists(st.binary(max_size=200), max_size=8))
@settings(max_examples=25)
def test_what_is_put_is_there_once_under_its_hash(contents: list[bytes], tmp_path_factory: pytest.TempPathFactory) -> None:
    kept = Files(tmp_path_factory.mktemp("files"))
    hashes = kept.put_all(contents)
    assert list(hashes) == [hashlib.sha256(content).hexdigest() for content in contents]
    assert [kept.read(sha256) for sha256 in hashes] == contents
    assert list(kept.all()) == sorted(set(hashes))
    assert sorted(everything(kept.folder).values()) == sorted(set(contents))


def test_a_file_is_taken_bit_for_bit_whatever_its_name(kept: Files, tmp_path: Path) -> None:
    source = tmp_path / "Messung 1 \u00b5m.csv"
    source.write_bytes(bytes(range(256)) * 9000)
    assert kept.read(kept.put(source)) == source.read_bytes()


def test_the_same_again_writes_nothing(kept: Files, monkeypatch: pytest.MonkeyPatch) -> None:
    sha256 = kept.put(b"742 N")
    before = os.stat(kept.path(sha256))

    def refuse(*_: object) -> None:
        raise AssertionError("something was written")

    monkeypatch.setattr(files, "_write", refuse)
    monkeypatch.setattr(files.os, "replace", refuse)
    assert kept.put(b"742 N") == sha256
    assert os.stat(kept.path(sha256)) == before


def test_each_flipped_bit_is_found_and_the_right_bytes_mend_it(kept: Files) -> None:
    content = b"36 N, 742 N"
    sha256 = kept.put(content)
    path = kept.path(sha256)
    path.chmod(0o644)
    for bit in range(8 * len(content)):
        changed = bytearray(content)
        changed[bit // 8] ^= 1 << bit % 8
        path.write_bytes(changed)
        with pytest.raises(StoreError, match="its content no longer has the hash of its name; restore it from a backup"):
            kept.read(sha256)
    assert kept.put(content) == sha256
    assert kept.read(sha256) == content


def test_a_missing_file_is_named(kept: Files) -> None:
    sha256 = hashlib.sha256(b"never put").hexdigest()
    with pytest.raises(StoreError, match=f"{sha256}: No such file or directory; restore it from a backup"):
        kept.read(sha256)


@pytest.mark.parametrize("name", ["", "../../etc/passwd", "A" * 64, "a" * 63, "a" * 64 + "\n", "/" * 64, "..%2f" + "a" * 59])
def test_only_a_hash_is_a_name(kept: Files, name: str) -> None:
    with pytest.raises(StoreError, match="is no SHA-256"):
        kept.read(name)


def fails_at(monkeypatch: pytest.MonkeyPatch, module: object, name: str, call: int, code: int) -> None:
    """The call of this number of a function of the system fails."""
    real: Callable[..., object] = getattr(module, name)
    calls = 0

    def failing(*given: object, **named: object) -> object:
        nonlocal calls
        calls += 1
        if calls == call:
            raise OSError(code, os.strerror(code))
        return real(*given, **named)

    monkeypatch.setattr(module, name, failing)


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EIO])
@pytest.mark.parametrize(
    ("module", "name", "calls"), [(os, "fsync", 5), (os, "replace", 2), (Path, "mkdir", 3), (os, "fchmod", 2)]
)
def test_a_disk_that_is_full_or_fails_leaves_nothing_half(
    kept: Files, monkeypatch: pytest.MonkeyPatch, module: object, name: str, calls: int, code: int
) -> None:
    before = kept.put(b"before")
    whole = {before}
    for call in range(1, calls + 1):
        both = [b"one %d" % call, b"two %d" % call]
        with monkeypatch.context() as patch:
            fails_at(patch, module, name, call, code)
            with pytest.raises(StoreError, match=f"{os.strerror(code)}; nothing was kept of it") as refused:
                kept.put_all(both)
        assert ("free some room" in str(refused.value)) is (code == errno.ENOSPC)
        whole |= {hashlib.sha256(content).hexdigest() for content in both}
        assert set(kept.all()) <= whole
        assert all(kept.read(sha256) for sha256 in kept.all())
        assert before in kept.all()
        assert list((kept.folder / "incoming").iterdir()) == []
        assert [kept.read(sha256) for sha256 in kept.put_all(both)] == both


def test_a_write_that_fails_in_the_middle_leaves_nothing(kept: Files, monkeypatch: pytest.MonkeyPatch) -> None:
    def half(_: object):
        yield b"first half"
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    sha256 = hashlib.sha256(b"content").hexdigest()
    monkeypatch.setattr(files, "_hash_of", lambda source: sha256 if source == b"content" else "")
    monkeypatch.setattr(files, "_blocks", half)
    with pytest.raises(StoreError, match="nothing was kept of it"):
        kept.put(b"content")
    assert everything(kept.folder) == {}


def test_a_file_that_changes_while_it_is_read_is_refused(
    kept: Files, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "growing.csv"
    source.write_bytes(b"first")
    blocks = files._blocks

    def grown(read: Path | bytes):
        yield from blocks(read)
        source.write_bytes(b"first and second")

    monkeypatch.setattr(files, "_blocks", grown)
    with pytest.raises(StoreError, match=r"growing\.csv: changed while it was read; import it again when it is whole"):
        kept.put(source)
    assert everything(kept.folder) == {}


def test_a_file_that_is_too_large_is_refused_as_it_is_read(
    kept: Files, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, "LARGEST", 1000)
    source = tmp_path / "large.csv"
    source.write_bytes(b"x" * 1001)
    for large in (source, source.read_bytes()):
        with pytest.raises(StoreError, match="is larger than 1000 bytes"):
            kept.put(large)
    assert everything(kept.folder) == {}
    kept.put(b"x" * 1000)


def test_what_a_crash_left_half_written_is_harmless_and_cleared_a_day_later(kept: Files) -> None:
    incoming = kept.folder / "incoming"
    old, new = incoming / "old", incoming / "new"
    for path in (old, new):
        path.write_bytes(b"half a fi")
    yesterday = time.time() - 90_000
    os.utime(old, (yesterday, yesterday))
    sha256 = kept.put(b"whole")
    assert list(kept.all()) == [sha256]
    kept.sweep()
    assert list(incoming.iterdir()) == [new]


def test_a_folder_that_is_gone_is_not_made_anew(tmp_path: Path) -> None:
    with pytest.raises(StoreError, match="the folder of the raw files is not there; put it back, or name where it is"):
        Files(tmp_path / "gone").put(b"x")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(os.name == "nt", reason="that raw files cannot be written by chance, of which Windows knows another way")
def test_nobody_writes_a_raw_file_by_chance(kept: Files) -> None:
    assert kept.path(kept.put(b"raw")).stat().st_mode & 0o777 == 0o444


def killed_at(call: int, action: Callable[[], object]) -> bool:
    """Whether a child process is killed at the call of this number of what reaches the disk."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of threads, of which the child uses none
        child = os.fork()
    if child:
        return os.WIFSIGNALED(os.waitpid(child, 0)[1])
    calls = count(1)

    def counted(real: Callable[..., object]) -> Callable[..., object]:
        def counting(*given: object, **named: object) -> object:
            if next(calls) == call:
                os.kill(os.getpid(), signal.SIGKILL)
            return real(*given, **named)

        return counting

    try:
        os.fsync, os.replace, os.fchmod, Path.mkdir = map(counted, (os.fsync, os.replace, os.fchmod, Path.mkdir))  # type: ignore[assignment,method-assign]
        action()
    finally:
        os._exit(0)


@pytest.mark.skipif(os.name == "nt", reason="kills while files are written, which Windows cannot fork for")
def test_a_program_that_is_killed_anywhere_leaves_only_whole_files(kept: Files) -> None:
    kills = 0
    for call in count(1):
        contents = [b"%d of %d" % (k, call) * 1000 for k in range(3)]
        if not killed_at(call, partial(kept.put_all, contents)):
            break
        kills += 1
        assert all(kept.read(sha256) for sha256 in kept.all())
        assert [kept.read(sha256) for sha256 in kept.put_all(contents)] == contents
    assert kills >= 12
    left = everything(kept.folder / "incoming")
    assert left
    assert not set(left) & set(kept.all())
