"""Watching the folder into which the computer of an instrument writes: every test comes in once, when it is whole.

A test is whole when all files that it names are there, can be opened, and have not changed for a while. What is half
written waits; what cannot be read is told once and left where it is, unchanged: it is tried again when its files change.
What was done is noted beside the raw files of the history, so that a watch that starts again goes on where it stopped;
without that note it would only find the tests known. Folders are looked at again and again, since network drives report no
changes.
"""

from __future__ import annotations

import hashlib
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from elastogeo.errors import ElastogeoError, InputError, StoreError, several
from elastogeo.formats import run_files_of, run_formats
from elastogeo.history.intake.folders import TESTS, folders_of_tests, in_order, strings_of
from elastogeo.history.intake.machines import UnplacedError
from elastogeo.history.intake.notebook import Notebook

NEW, KNOWN, WAITS, REFUSED, HELD, FAILED = "new", "known", "waits", "refused", "held", "failed"
"""What may be seen of a test: it came in; it had; is not whole; is wrong; is of a machine not known; the history failed."""

SETTLE = 5.0
"""Seconds without a change after which a file counts as written."""

EVERY = 10.0
"""Seconds between two looks."""

SHARE = 5
"""Looking takes at most one part in so many of the time: a slow network drive is looked at less often."""


_LOOKED_AT, _HEAD = 20, 65_536
"""Files of a folder without a test that are looked at, and the bytes of each."""


class Brought(Protocol):
    """What bringing a test in gives."""

    @property
    def new(self) -> bool:
        """Whether it came in just now, and was not known."""


B = TypeVar("B", bound=Brought)


@dataclass(frozen=True, slots=True)
class Seen(Generic[B]):
    """What was seen of a test.

    Attributes
    ----------
    what : str
        `NEW`, `KNOWN`, `WAITS`, `REFUSED`, `HELD` or `FAILED`.
    path : Path
    said : str
        Why it waits or was refused.
    brought : object or None
        What bringing it in gave.
    """

    what: str
    path: Path
    said: str = ""
    brought: B | None = None


@dataclass(slots=True)
class Watch(Generic[B]):
    """A watch over one folder.

    Parameters
    ----------
    folder : Path
    bring : callable
        `bring(path)`: import a test that is whole.
    notebook : Notebook
        What was done before.
    machines : callable
        `machines()`: a text that changes when machines are added, or the watch is told other things; a test that was held
        or refused is tried again then.
    settle, every : float [s]
    sleep, clock : callable
        Of the computer; tests put theirs here.
    """

    folder: Path
    bring: Callable[[Path], B]
    notebook: Notebook
    machines: Callable[[], str]
    settle: float = SETTLE
    every: float = EVERY
    sleep: Callable[[float], None] = time.sleep
    clock: Callable[[], float] = time.monotonic
    _since: dict[Path, tuple[str, float]] = field(default_factory=dict)
    _told: dict[Path, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse what is no folder, and times that are none."""
        if not self.folder.is_dir():
            raise InputError(f"{self.folder}: is no folder to watch; check the path")
        if not (self.settle >= 0 and self.every > 0):
            raise InputError(f"a watch looks every {self.every:g} s and waits {self.settle:g} s; give positive times")

    def run(self, once: bool = False) -> Iterator[Seen[B]]:
        """What is seen, as it is seen; for ever, or until all that is whole has come in."""
        while True:
            began = self.clock()
            yield from self._look()
            if once:
                break
            self.sleep(max(self.every, SHARE * (self.clock() - began)))
        if self._since:
            self.sleep(self.settle)
            yield from self._look()
        for path in sorted(set(self._since) - set(self._told)):
            yield Seen(WAITS, path, "is still being written")

    def _look(self) -> Iterator[Seen[B]]:
        if not self.folder.is_dir():
            yield from self._once(self.folder, FAILED, "the folder is away; it is looked for again")
            return
        try:
            machines = self.machines()
        except StoreError as error:
            yield from self._once(self.folder, FAILED, str(error))
            return
        self._told.pop(self.folder, None)
        for path in in_order(folders_of_tests(self.folder)):
            state = fingerprint(path)
            if self.notebook.knows(self._key(path), state, machines):
                self._since.pop(path, None)
            elif self._is_still(path, state):
                yield from self._try(path, state, machines)
        yield from self._loose()

    def _key(self, path: Path) -> str:
        return path.relative_to(self.folder).as_posix()

    def _is_still(self, path: Path, state: str) -> bool:
        """Whether the files of a test have not changed for a while."""
        before = self._since.get(path)
        if before is None or before[0] != state:
            self._since[path] = (state, self.clock())
            return self.settle == 0
        return self.clock() - before[1] >= self.settle

    def _try(self, path: Path, state: str, machines: str) -> Iterator[Seen[B]]:
        """Bring a test in that has not changed for a while."""
        seen: Seen[B]
        try:
            lacking = not_there(path)
            if lacking:
                yield from self._once(path, WAITS, lacking)
                return
            brought = self.bring(path)
        except UnplacedError as error:
            seen = Seen(HELD, path, str(error))
        except StoreError as error:
            yield from self._once(path, FAILED, str(error))
            return
        except ElastogeoError as error:
            if fingerprint(path) != state:
                return  # it was written on meanwhile: the next look sees it anew
            seen = Seen(REFUSED, path, str(error))
        except Exception as error:  # noqa: BLE001 - a fault of the program in one test must not stop the watch
            seen = Seen(REFUSED, path, f"{type(error).__name__}: {error}; a fault of elastogeo, please report it")
        else:
            seen = Seen(NEW if brought.new else KNOWN, path, brought=brought)
        self._since.pop(path, None)
        self._told.pop(path, None)
        self.notebook.note(self._key(path), state, machines if seen.what in (HELD, REFUSED) else "", seen.what)
        yield seen

    def _once(self, path: Path, what: str, said: str) -> Iterator[Seen[B]]:
        """Say something of a path if it was not said just before."""
        if self._told.get(path) != said:
            self._told[path] = said
            yield Seen(what, path, said)

    def _loose(self) -> Iterator[Seen[B]]:
        """Folders with run files that no test names: told once, since nothing can be done with them."""
        for path in loose_runs(self.folder, lambda place: self.notebook.knows(self._loose_key(place), "loose", "")):
            if self._is_still(path, fingerprint(path)):
                self._since.pop(path, None)
                self.notebook.note(self._loose_key(path), "loose", "", WAITS)
                yield Seen(WAITS, path, f"for a {TESTS[0]} beside its run files; elastogeo new makes one to fill in")

    def _loose_key(self, path: Path) -> str:
        return f"{self._key(path)}/"


def fingerprint(path: Path) -> str:
    """Sizes and times of all files of a test: its folder, and what it names outside of it."""
    folder = path if path.is_dir() else path.parent
    parts = [_stat(place) for place in _files(folder)]
    parts += [_stat(folder / said) for said in strings_of(path) if said.startswith("..")]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def not_there(path: Path) -> str:
    """What a test names and cannot be opened yet, in words; empty if all is there."""
    file = next((path / name for name in TESTS if (path / name).is_file()), path)
    if file.name == TESTS[1]:
        return ""
    try:
        named = run_files_of(file)
    except ElastogeoError:
        return ""  # the reader says what is wrong with it
    places = [place if place.exists() else place.with_name(place.name.partition("#")[0]) for place in named]
    missing = [_as_named(place, file.parent) for place in dict.fromkeys(places) if not place.exists()]
    if missing:
        return f"for {several(missing)}"
    for place in places:
        try:
            if place.is_file():
                place.open("rb").close()
        except OSError as error:
            return f"until {place.name} can be opened ({error.strerror})"
    return ""


def _as_named(place: Path, folder: Path) -> str:
    """A file as the test names it: from its folder, or from the root."""
    return (place.relative_to(folder) if place.is_relative_to(folder) else place).as_posix()


def loose_runs(folder: Path, known: Callable[[Path], bool]) -> Iterator[Path]:
    """Folders with a run file that have no test in them or above them, and are not known."""
    formats = run_formats().values()
    for place, folders, files in os.walk(folder):
        if any(name in files for name in TESTS):
            folders.clear()
            continue
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        heads = () if known(Path(place)) else (_head(Path(place) / name) for name in sorted(files)[:_LOOKED_AT])
        if any(one.can_read(head) for head in heads for one in formats):
            yield Path(place)


def _head(path: Path) -> bytes:
    try:
        with open(path, "rb") as file:
            return file.read(_HEAD)
    except OSError:
        return b""


def _files(folder: Path) -> Iterator[Path]:
    """The files in a folder, those of other tests in it left out."""
    for place, folders, files in os.walk(folder):
        if Path(place) != folder and any(name in files for name in TESTS):
            folders.clear()
            continue
        folders.sort()
        yield from (Path(place) / name for name in sorted(files))


def _stat(path: Path) -> str:
    try:
        found = path.stat()
    except (OSError, ValueError):  # what is not there, and a name that no file can have
        return f"{path} -"
    return f"{path} {found.st_size} {found.st_mtime_ns}"
