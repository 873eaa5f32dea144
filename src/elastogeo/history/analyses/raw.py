"""The raw record of a test: its files as they were imported, laid out again in a folder of their own."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory, gettempdir

from sqlalchemy import Connection, select

from elastogeo.errors import InputError, StoreError
from elastogeo.formats import confined_to
from elastogeo.history.store import Files
from elastogeo.history.store.schema import test_file

TEST = "test"
"""The folder that stands for that of the test."""


@dataclass(frozen=True, slots=True)
class RawFile:
    """One file of a test: its path as seen from the test's folder, and the SHA-256 of its content."""

    path: str
    sha256: str


def raw_files(connection: Connection, test: int) -> tuple[RawFile, ...]:
    """The files of a test, in the order of their paths.

    Raises
    ------
    InputError
        If there is no such test.
    """
    found = connection.execute(select(test_file.c.path, test_file.c.sha256).where(test_file.c.test == test))
    files = tuple(sorted((RawFile(*row) for row in found), key=lambda file: file.path))
    if not files:
        raise InputError(f"there is no test {test}; `elastogeo history show` lists those of a series")
    return files


@contextmanager
def laid_out(files: Files, raw: Sequence[RawFile], name: str = TEST) -> Iterator[Path]:
    """The files of a test in a temporary folder, each under its own name; the folder of the test in it.

    A file beside the test's folder (`../machine.toml`) lies beside it here too, and never outside the temporary one. Nothing
    else is read while it is there, whatever a document names.

    Raises
    ------
    StoreError
        If a file is missing or damaged in the store, or its path would leave the temporary folder.
    """
    with ExitStack() as stack:
        try:
            top = Path(stack.enter_context(TemporaryDirectory(prefix="elastogeo-", ignore_cleanup_errors=True))).resolve()
            folder = top.joinpath(*["up"] * most_up(raw), name)
            lay_out(files, raw, folder)
            stack.enter_context(confined_to(top))
        except OSError as error:
            raise StoreError(
                f"{error.filename or gettempdir()}: {error.strerror}; the raw files could not be laid out for the analysis; "
                f"free some room there, or name another folder in TMPDIR"
            ) from error
        yield folder


def most_up(raw: Sequence[RawFile]) -> int:
    """How many folders above that of the test its files lie at most."""
    return max((PurePosixPath(file.path).parts.count("..") for file in raw), default=0)


def lay_out(files: Files, raw: Sequence[RawFile], folder: Path) -> None:
    """Write the files of a test to a folder, and to those above it that they lie in.

    Raises
    ------
    StoreError
        As `laid_out`.
    """
    top = folder.parents[most_up(raw)]
    folder.mkdir(parents=True, exist_ok=True)
    for file in raw:
        target = (folder / file.path).resolve()
        if PurePosixPath(file.path).is_absolute() or not target.is_relative_to(top):
            raise StoreError(f"the path {file.path!r} of a raw file leads out of its test; the store was altered: verify it")
        content = files.read(file.sha256)
        if target.exists() and target.read_bytes() != content:
            raise StoreError(f"two files would lie at {file.path!r} with different content; ask these tests one by one")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
