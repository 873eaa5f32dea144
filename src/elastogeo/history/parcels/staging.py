"""Parcels: what was sent, in a folder of its own beside the raw files, under a random name.

A parcel arrives as `NAME.part`; when all of it is on the disk, it is renamed to `NAME` and its folder flushed. So one that
was broken off is not there, and is swept later. The names that the sender gave are only text: files are called 0, 1, 2, ...
"""

from __future__ import annotations

import json
import os
import re
import secrets
import shutil
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

from sqlalchemy import select

from elastogeo.changes.records import DONE, RUNNING, WAITING
from elastogeo.errors import InputError, StoreError
from elastogeo.history.store import Files, Store, read
from elastogeo.history.store.schema import job

LARGEST = 100_000_000
"""Bytes of a parcel, counted as they come."""
MOST_FILES = 1000
MOST_COMING = 8
"""Parcels that come in at once."""
MOST_KEPT = 5_000_000_000
"""Bytes that all parcels may take, what was laid out of them too, until they are imported or swept."""
ROOM = 2 * LARGEST
"""Bytes that must be free on the disk, which may be that of the database."""
_FOLDER, _PART, _NAMES, _SENT = "parcels", ".part", "names.json", "sent"
_NAME = re.compile(r"[0-9a-f]{32}")
_SILENT = 60.0
"""Seconds without a byte after which nobody waits for a parcel; who sends is cut off far earlier."""
_BROKEN_OFF = 3600.0
"""Seconds without a byte after which a parcel does not come any more."""
_OLD = 86_400.0
"""Seconds after which a parcel that nobody confirmed is swept."""
_LONGEST_NAME = 1000


@dataclass(slots=True)
class Arriving:
    """A parcel that is coming in: `begin` a file, `write` its bytes, `begin` the next, `keep` all or `drop` it.

    Attributes
    ----------
    name : str
        Of the parcel.
    size : int
        Bytes so far.
    """

    name: str
    folder: Path
    size: int = 0
    names: list[str] = field(default_factory=list)
    _file: BinaryIO | None = None

    def begin(self, said: str) -> None:
        """Begin a file; how it was called is only noted.

        Raises
        ------
        InputError
            If there are too many.
        """
        self._end()
        if len(self.names) >= MOST_FILES:
            raise InputError(f"more than {MOST_FILES} files were sent at once; send them in several parts")
        try:
            self._file = open(self.folder / _SENT / str(len(self.names)), "xb")  # noqa: SIM115 - it stays open
        except OSError as error:
            raise _cannot(error, self.folder) from error
        self.names.append(said[:_LONGEST_NAME])

    def write(self, data: bytes) -> None:
        """Take bytes of the file that was begun.

        Raises
        ------
        InputError
            If more came than a parcel may hold.
        StoreError
            If they cannot be written.
        """
        assert self._file is not None
        self.size += len(data)
        if self.size > LARGEST:
            raise InputError(too_large())
        try:
            self._file.write(data)
        except OSError as error:
            raise _cannot(error, self.folder) from error

    def keep(self) -> str:
        """Let all of it reach the disk, and be there; its name.

        Raises
        ------
        InputError
            If nothing came.
        StoreError
            If it cannot be written.
        """
        self._end()
        if not self.names:
            raise InputError("no file was sent; choose one, or drop one here")
        try:
            with open(self.folder / _NAMES, "x", encoding="utf-8") as file:
                json.dump(self.names, file)
                file.flush()
                os.fsync(file.fileno())
            whole = self.folder.with_suffix("")
            for folder in (self.folder / _SENT, self.folder):
                _flush(folder)
            os.replace(self.folder, whole)
            _flush(whole.parent)
        except OSError as error:
            raise _cannot(error, self.folder) from error
        return self.name

    def drop(self) -> None:
        """Forget it."""
        if self._file is not None:
            self._file.close()
            self._file = None
        shutil.rmtree(self.folder, ignore_errors=True)

    def _end(self) -> None:
        """End the file that was begun: its bytes are on the disk then."""
        if self._file is None:
            return
        try:
            self._file.flush()
            os.fsync(self._file.fileno())
        except OSError as error:
            raise _cannot(error, self.folder) from error
        finally:
            self._file.close()
            self._file = None


def arriving(files: Files) -> Arriving:
    """A parcel that comes in now.

    Raises
    ------
    InputError
        If too many come in, or too much of what came waits.
    StoreError
        If there is no place for it.
    """
    _check_room(files)
    name = secrets.token_hex(16)
    folder = files.folder / _FOLDER / f"{name}{_PART}"
    try:
        (folder / _SENT).mkdir(parents=True)
    except OSError as error:
        raise _cannot(error, folder) from error
    return Arriving(name, folder)


def _check_room(files: Files) -> None:
    """Refuse another parcel where those that are there take what others need."""
    known = list(_all(files))
    if sum(folder.suffix == _PART and idle < _SILENT for folder, idle in known) >= MOST_COMING:
        raise InputError(f"{MOST_COMING} uploads are coming in already; send it again when they are done")
    if sum(_size(folder) for folder, _ in known) > MOST_KEPT:
        raise InputError(
            f"more than {MOST_KEPT // 10**9} GB that were sent wait to be imported; import them, or send it again tomorrow: "
            "what nobody imports is kept for a day"
        )
    if files.folder.is_dir() and shutil.disk_usage(files.folder).free < ROOM:
        raise StoreError(f"{files.folder}: less than {ROOM // 10**6} MB are free on its disk; free some, then send it again")


def _size(folder: Path) -> int:
    """Bytes of a parcel, as far as they can be counted while others work on it."""
    found = 0
    for place, _, names in os.walk(folder):
        for name in names:
            with suppress(OSError):
                found += os.lstat(os.path.join(place, name)).st_size
    return found


def parcel(files: Files, name: str) -> Path:
    """The folder of a parcel that came.

    Raises
    ------
    InputError
        If there is none of this name.
    """
    folder = files.folder / _FOLDER / name
    if not _NAME.fullmatch(name) or not folder.is_dir():
        raise InputError("what was sent is no longer there: it is kept for a day; send it again")
    return folder


def sent(folder: Path) -> tuple[tuple[str, Path], ...]:
    """The files of a parcel: how the sender called each, and where it is."""
    names = json.loads((folder / _NAMES).read_text("utf-8"))
    return tuple((str(name), folder / _SENT / str(k)) for k, name in enumerate(names))


def sweep_parcels(store: Store) -> int:
    """Clear parcels that are imported, old, or never came whole; how many."""
    with read(store) as connection:
        found = connection.execute(select(job.c.state, job.c.kind, job.c.asked).where(job.c.kind.in_(("look", "import"))))
        states = [(str(row.asked.get("parcel", "")), row.kind, row.state) for row in found]
    wanted = {name for name, _, state in states if state in (WAITING, RUNNING)}
    imported = {name for name, kind, state in states if kind == "import" and state == DONE}
    swept = 0
    for folder, idle in _all(store.files):
        name = folder.name.removesuffix(_PART)
        limit = 0.0 if name in imported else _BROKEN_OFF if folder.suffix == _PART else _OLD
        if name not in wanted and idle >= limit:
            shutil.rmtree(folder, ignore_errors=True)
            swept += 1
    return swept


def too_large() -> str:
    """What is said of a parcel that is larger than `LARGEST`."""
    return f"more than {LARGEST // 1_000_000} MB were sent at once; send the tests in several parts"


def _all(files: Files) -> Iterator[tuple[Path, float]]:
    """The folders of all parcels, and for how many seconds nothing came into each."""
    with suppress(OSError):
        for folder in (files.folder / _FOLDER).iterdir():
            with suppress(OSError):
                last = max(place.stat().st_mtime for place in (folder, *folder.glob("*"), *folder.glob(f"{_SENT}/*")))
                yield folder, time.time() - last


def _cannot(error: OSError, folder: Path) -> StoreError:
    return StoreError(f"{error.filename or folder}: {error.strerror}; nothing was kept of what was sent; send it again")


def _flush(folder: Path) -> None:
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
