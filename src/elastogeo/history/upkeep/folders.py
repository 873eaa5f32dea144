"""A folder that is there whole under its name, or not at all; what the disk refuses is said in words."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from elastogeo.errors import StoreError

_MARK = ".unfinished-"
_STALE = 86_400.0  # s after which nobody fills such a folder any more
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
_NO_RIGHT = (errno.EACCES, errno.EPERM, errno.EROFS)


@contextmanager
def new_folder(target: Path, apart: Path) -> Iterator[Path]:
    """A folder to fill, which gets its name when it is full and on the disk; what a crash leaves has another name.

    Parameters
    ----------
    target : Path
    apart : Path
        The folder of the raw files of the history: it holds nothing else.

    Raises
    ------
    StoreError
        If there is something of that name already, it would lie among the raw files, or it cannot be written.
    """
    target = target.expanduser().absolute()
    if target.resolve().is_relative_to(apart.resolve()):
        raise StoreError(f"{target}: lies in {apart}, among the raw files of the history; name a folder outside of it")
    if target.exists() or target.is_symlink():
        raise StoreError(f"{target}: is there already; name a folder that is not there yet")
    if not target.parent.is_dir():
        raise StoreError(f"{target}: there is no folder {target.parent}; make it first")
    sweep(target)
    filled = unfinished(target)
    try:
        with disk_in_words(target):
            filled.mkdir()
        yield filled
        with disk_in_words(target):
            for folder, _, _ in os.walk(filled):
                flush_folder(Path(folder))
            os.rename(filled, target)
            flush_folder(target.parent)
    except BaseException:
        shutil.rmtree(filled, ignore_errors=True)
        raise


@contextmanager
def disk_in_words(target: Path) -> Iterator[None]:
    """Turn what the disk refuses into a `StoreError`."""
    try:
        yield
    except OSError as error:
        todo = "check the disk"
        if error.errno in _NO_ROOM:
            todo = "free some room, then repeat"
        elif error.errno in _NO_RIGHT:
            todo = "ask for the right to write there, or name another place"
        raise StoreError(f"{target}: {error.strerror or error}; nothing was kept of it; {todo}") from error


def write_file(path: Path, blocks: Iterable[bytes]) -> None:
    """Write a file that is on the disk when this returns."""
    with open(path, "xb") as file:
        for block in blocks:
            file.write(block)
        file.flush()
        os.fsync(file.fileno())


def flush_folder(folder: Path) -> None:
    """Let the entries of a folder reach the disk; Windows has no such call, and keeps them itself."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def unfinished(target: Path) -> Path:
    """Another name beside it, for as long as it is filled."""
    return target.with_name(f"{target.name}{_MARK}{secrets.token_hex(8)}")


def sweep(target: Path) -> None:
    """Clear what was left unfinished of this name, a day ago or earlier."""
    limit = time.time() - _STALE
    with suppress(OSError):
        for left in target.parent.glob(f"{target.name}{_MARK}*"):
            if left.stat().st_mtime >= limit:
                continue
            if left.is_dir():
                shutil.rmtree(left, ignore_errors=True)
            else:
                left.unlink()
