"""What a path holds: one test, a campaign of them, or a folder with tests somewhere in it."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from pathlib import Path

from elastogeo.errors import InputError
from elastogeo.history.intake.days import day_of

TESTS = ("test.toml", "drive.toml")
MOST = 100_000
"""Folders that are looked into, at most."""

_LATEST = datetime(9000, 1, 1, tzinfo=UTC)


def tests_in(path: str | Path) -> tuple[Path, ...]:
    """The tests that a path means.

    Parameters
    ----------
    path : str or Path
        A folder with a `test.toml` or `drive.toml`, such a file of any name, a folder with tests in folders in it.

    Returns
    -------
    tuple of Path
        Folders or files, in the order of their names; folders of hidden names are left out.

    Raises
    ------
    InputError
        If it is not there, or holds none.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(f"{path}: is not there; check the path")
    if path.is_file() or any((path / name).is_file() for name in TESTS):
        return (path,)
    found = tuple(_below(path))
    if not found:
        raise InputError(
            f"{path}: holds no test: no folder in it has a {' or '.join(TESTS)}; make one beside the run files with "
            f"elastogeo new, and fill it in"
        )
    return found


def _below(path: Path) -> Iterator[Path]:
    for looked, (place, folders, files) in enumerate(os.walk(path), 1):
        if looked > MOST:
            raise InputError(f"{path}: holds more than {MOST} folders; name one of them")
        folders[:] = sorted(folder for folder in folders if not folder.startswith("."))
        if any(name in files for name in TESTS):
            yield Path(place)


def in_order(paths: Iterable[Path]) -> tuple[Path, ...]:
    """Tests in the order of the days on which they say that they were measured; those that say none come last."""
    return tuple(sorted(paths, key=lambda path: (_date(path), str(path))))


def _date(path: Path) -> str:
    file = next((path / name for name in TESTS if (path / name).is_file()), path)
    try:
        about = tomllib.loads(file.read_text("utf-8-sig")).get("about", {})
        return day_of(str(about["date"]).replace(" ", "T"), "", _LATEST).at.isoformat()
    except (OSError, ValueError, KeyError, TypeError, AttributeError, InputError):
        return "~"
