"""What a path holds: one test, a campaign of them, or a folder with tests somewhere in it."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from elastogeo.errors import InputError
from elastogeo.history.intake.days import day_of

TESTS = ("test.toml", "drive.toml")
MOST = 100_000
"""Folders that are looked into, at most."""

_LATEST = datetime(9000, 1, 1, tzinfo=UTC)


def paths_of_tests(path: str | Path) -> tuple[Path, ...]:
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
    found = tuple(folders_of_tests(path))
    if not found:
        raise InputError(
            f"{path}: holds no test: no folder in it has a {' or '.join(TESTS)}; make one beside the run files with "
            f"elastogeo new, and fill it in"
        )
    return found


def folders_of_tests(path: Path) -> Iterator[Path]:
    """The folders with a test in and below a folder, in the order of their names; hidden ones are left out.

    Raises
    ------
    InputError
        If there are more than `MOST` folders.
    """
    for looked, (place, folders, files) in enumerate(os.walk(path), 1):
        if looked > MOST:
            raise InputError(f"{path}: holds more than {MOST} folders; name one of them")
        folders[:] = sorted(folder for folder in folders if not folder.startswith("."))
        if any(name in files for name in TESTS):
            yield Path(place)


def in_order(paths: Iterable[Path]) -> tuple[Path, ...]:
    """Tests in the order of the days on which they say that they were measured; those that say none come last."""
    return tuple(sorted(paths, key=lambda path: (_date(path), str(path))))


def strings_of(path: Path) -> tuple[str, ...]:
    """All that the file of a test says in strings; nothing of one that cannot be read."""
    found: list[str] = []
    entries: list[Any] = [_table(path)]
    while entries:
        entry = entries.pop()
        if isinstance(entry, str):
            found.append(entry)
        elif isinstance(entry, dict | list):
            entries += entry.values() if isinstance(entry, dict) else entry
    return tuple(sorted(found))


def written(path: Path) -> str:
    """When the last file of a test's folder was written, but for the test's own and hidden ones; empty if there is none."""
    folder = path if path.is_dir() else path.parent
    places = [Path(place) / name for place, _, files in os.walk(folder) for name in files]
    times = [place.stat().st_mtime for place in places if place.suffix != ".toml" and not place.name.startswith(".")]
    return datetime.fromtimestamp(max(times), UTC).isoformat(timespec="seconds") if times else ""


def _date(path: Path) -> str:
    try:
        return day_of(str(_table(path)["about"]["date"]).replace(" ", "T"), "", _LATEST).at.isoformat()
    except (KeyError, TypeError, InputError):
        return "~"


def _table(path: Path) -> dict[str, Any]:
    file = next((path / name for name in TESTS if (path / name).is_file()), path)
    try:
        return tomllib.loads(file.read_text("utf-8-sig"))
    except (OSError, ValueError, RecursionError):
        return {}
