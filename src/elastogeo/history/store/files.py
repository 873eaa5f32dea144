"""The raw files: each lies under the hash of its content, is written whole or not at all, and is never changed.

A file is written under another name, flushed, renamed, and its folder flushed; so what a crash leaves half written has no
hash for a name, is harmless, and is cleared a day later.
"""

from __future__ import annotations

import errno
import hashlib
import os
import re
import secrets
import time
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from elastogeo.errors import StoreError

LARGEST = 2**30
"""The largest file that is taken [bytes]."""
_INCOMING = "incoming"
_STALE = 86_400.0  # s after which nobody is writing an incoming file any more
_HASH = re.compile(r"[0-9a-f]{64}")
_BLOCK = 2**20
_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


@dataclass(frozen=True, slots=True)
class Files:
    """The folder of the raw files: `ab/ab34...` holds the content whose SHA-256 is `ab34...`.

    Attributes
    ----------
    folder : Path
    """

    folder: Path

    def make(self) -> None:
        """Make the folder, if it is not there."""
        try:
            (self.folder / _INCOMING).mkdir(parents=True, exist_ok=True)
            _flush_folder(self.folder.parent)
        except OSError as error:
            raise StoreError(f"{self.folder}: {error.strerror}; the raw files need a folder that can be written") from error

    def put(self, source: Path | bytes) -> str:
        """Keep a file: its SHA-256. What is there already is not written again.

        Raises
        ------
        StoreError
            If it is larger than `LARGEST`, changes while it is read, or cannot be written; nothing of it is kept then.
        """
        return self.put_all([source])[0]

    def put_all(self, sources: Iterable[Path | bytes]) -> tuple[str, ...]:
        """Keep several files, their SHA-256 in the same order; all are on the disk when this returns.

        All are written before the first is flushed, and renamed before the folders are: the disk then flushes them together.

        Raises
        ------
        StoreError
            As `put`; some may be kept then, each whole.
        """
        hashes: list[str] = []
        incoming: dict[str, Path] = {}
        try:
            for source in sources:
                sha256 = _hash_of(source)
                hashes.append(sha256)
                if sha256 not in incoming and not self._is_whole(sha256):
                    incoming[sha256] = self._incoming()
                    _write(source, incoming[sha256], sha256)
            for path in incoming.values():
                _flush(path)
            for sha256, path in incoming.items():
                self.path(sha256).parent.mkdir(exist_ok=True)
                os.replace(path, self.path(sha256))
            for folder in {self.folder, *(self.path(sha256).parent for sha256 in hashes)}:
                _flush_folder(folder)  # of what was there already too: who put it may have been killed before
        except OSError as error:
            todo = "; free some room, then repeat" if error.errno in _NO_ROOM else ""
            raise StoreError(f"{error.filename or self.folder}: {error.strerror}; nothing was kept of it{todo}") from error
        finally:
            for path in incoming.values():
                with suppress(OSError):
                    path.unlink(missing_ok=True)
        return tuple(hashes)

    def path(self, sha256: str) -> Path:
        """Where the content of a hash lies, if it is there.

        Raises
        ------
        StoreError
            If this is no SHA-256.
        """
        if not _HASH.fullmatch(sha256):
            raise StoreError(f"{sha256[:80]!r} is no SHA-256: 64 digits 0-9 a-f")
        return self.folder / sha256[:2] / sha256

    def read(self, sha256: str) -> bytes:
        """The content of a hash.

        Raises
        ------
        StoreError
            If it is not there, or is no longer what its name says.
        """
        path = self.path(sha256)
        try:
            content = path.read_bytes()
        except OSError as error:
            raise StoreError(f"{path}: {error.strerror}; restore it from a backup") from error
        if hashlib.sha256(content).hexdigest() != sha256:
            raise StoreError(
                f"{path}: was changed: its content no longer has the hash of its name; restore it from a backup"
            )
        return content

    def all(self) -> Iterator[str]:
        """The hashes of all files that are there, in order."""
        for folder in sorted(self.folder.glob("[0-9a-f][0-9a-f]")):
            yield from sorted(path.name for path in folder.iterdir() if _HASH.fullmatch(path.name))

    def sweep(self) -> None:
        """Clear what was left half written, a day ago or earlier."""
        limit = time.time() - _STALE
        with suppress(OSError):
            for path in (self.folder / _INCOMING).iterdir():
                if path.stat().st_mtime < limit:
                    path.unlink()

    def _is_whole(self, sha256: str) -> bool:
        try:
            return _hash_of(self.path(sha256)) == sha256
        except StoreError:
            return False

    def _incoming(self) -> Path:
        """A name for a file until it is whole."""
        if not self.folder.is_dir():
            raise StoreError(f"{self.folder}: the folder of the raw files is not there; put it back, or name where it is")
        folder = self.folder / _INCOMING
        folder.mkdir(exist_ok=True)
        return folder / secrets.token_hex(16)


def _write(source: Path | bytes, path: Path, sha256: str) -> None:
    digest = hashlib.sha256()
    with open(path, "xb") as file:
        for block in _blocks(source):
            digest.update(block)
            file.write(block)
        if os.name == "posix":
            os.fchmod(file.fileno(), 0o444)  # nobody changes it by chance
    if digest.hexdigest() != sha256:
        raise StoreError(f"{source!s}: changed while it was read; import it again when it is whole")


def _flush(path: Path) -> None:
    """Let the content of a file reach the disk."""
    descriptor = os.open(path, os.O_RDONLY if os.name == "posix" else os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def _hash_of(source: Path | bytes) -> str:
    digest = hashlib.sha256()
    try:
        for block in _blocks(source):
            digest.update(block)
    except OSError as error:
        raise StoreError(f"{source!s}: {error.strerror}") from error
    return digest.hexdigest()


def _blocks(source: Path | bytes) -> Iterator[bytes]:
    if isinstance(source, bytes):
        _check_size("the content", len(source))
        yield source
        return
    taken = 0
    with open(source, "rb") as file:
        while block := file.read(_BLOCK):
            taken += len(block)
            _check_size(str(source), taken)
            yield block


def _check_size(name: str, size: int) -> None:
    if size > LARGEST:
        raise StoreError(f"{name}: is larger than {LARGEST} bytes; the history takes no file as large as this")


def _flush_folder(folder: Path) -> None:
    """Let the entries of a folder reach the disk; Windows has no such call, and keeps them itself."""
    if os.name == "posix":
        _flush(folder)
