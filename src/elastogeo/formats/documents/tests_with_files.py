"""A test of any kind with exactly the files that it is read from: what is kept of it, and what it is told from others by."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path, PurePosixPath
from typing import Any

from elastogeo.drive import DriveTest
from elastogeo.errors import FormatError
from elastogeo.formats.documents import feed_drives, machine_tests
from elastogeo.formats.documents.machines import shipped_machines
from elastogeo.formats.text.files_read import files_read
from elastogeo.formats.text.toml_documents import read_document
from elastogeo.observe import MachineTest

FILE_NAMES = {machine_tests.SCHEMA: machine_tests.FILE_NAME, feed_drives.SCHEMA: feed_drives.FILE_NAME}
"""By the schema of a test, what its file is usually called."""

MOST_UP = 3
"""So many folders above its own, at most, a test may name a file."""


@dataclass(frozen=True, slots=True)
class TestWithFiles:
    """A test that was read, and from what.

    Attributes
    ----------
    path : Path
        Its own file.
    test : MachineTest or DriveTest
    files : mapping of str to (Path, str)
        By the path from the folder of the test, with forward slashes (`runs/112N.csv`, `../machine.toml`): where each file
        is, and the SHA-256 of what was read. The test's own comes first and is called `test.toml` or `drive.toml`, whatever
        its name. Laid out by these paths they make the same test; what ships with elastogeo is not among them.
    """

    path: Path
    test: MachineTest | DriveTest
    files: Mapping[str, tuple[Path, str]]

    @property
    def sha256(self) -> str:
        """Of the test: of the hashes and paths of its files. Its folder's name and what else lies there do not count."""
        lines = sorted(f"{sha256}  {path}\n" for path, (_, sha256) in self.files.items())
        return hashlib.sha256("".join(lines).encode()).hexdigest()


def test_file(path: str | Path) -> Path:
    """The file of a test: of a folder its `test.toml` or `drive.toml`, else the file itself.

    Raises
    ------
    FormatError
        If it is not there, or a folder holds none or both.
    """
    path = Path(path)
    if not path.is_dir():
        if not path.exists():
            raise FormatError(f"{path}: is not there; check the path")
        return path
    found = [path / name for name in FILE_NAMES.values() if (path / name).is_file()]
    if len(found) == 1:
        return found[0]
    if found:
        raise FormatError(f"{path}: holds {' and '.join(file.name for file in found)}; name the one that is meant")
    raise FormatError(f"{path}: holds no {' and no '.join(FILE_NAMES.values())}; elastogeo new writes one to fill in")


def read_with_files(path: str | Path) -> TestWithFiles:
    """Read a test of any kind, and say from which files.

    Parameters
    ----------
    path : str or Path
        A folder that holds a `test.toml` or a `drive.toml`, or such a file of any name.

    Raises
    ------
    FormatError
        If a file is not what it must be, changes while it is read, or is named by an absolute path.
    InputError
        If the test contradicts itself.
    """
    file = test_file(path)
    with files_read() as seen:
        table = read_document(file)
        schema = table.get("schema")
        if schema not in FILE_NAMES:
            raise FormatError(f"{file}: is no test; its schema is {schema!r:.60}, that of a test {' or '.join(FILE_NAMES)}")
        test = machine_tests.read_test(file) if schema == machine_tests.SCHEMA else feed_drives.read_drives(file)
    shipped = set(shipped_machines().values())
    places = {path.parent for path in _absolute(table)}
    files = {FILE_NAMES[schema]: (file, seen[file])}
    for place, sha256 in seen.items():
        if place == file or place in shipped:
            continue
        if place.parent in places:
            raise FormatError(
                f"{file}: names {place} by its place on this computer; copy it beside the test and name it from there, so "
                f"that it can be kept with it"
            )
        files[_said(place, file)] = (place, sha256)
    return TestWithFiles(file, test, files)


def _absolute(entry: Any) -> Iterator[Path]:
    """The absolute paths that a document names."""
    if isinstance(entry, Mapping | list):
        for part in entry.values() if isinstance(entry, Mapping) else entry:
            yield from _absolute(part)
    elif isinstance(entry, str) and Path(entry).is_absolute():
        yield Path(entry)


def _said(place: Path, file: Path) -> str:
    """The path of a file as the test says it."""
    said = place.relative_to(file.parent).as_posix()
    lowest = min(accumulate(-1 if part == ".." else 1 for part in PurePosixPath(said).parts))
    if -lowest > MOST_UP:
        raise FormatError(f"{file}: names {said}, more than {MOST_UP} folders above its own; copy the file beside the test")
    return said
