"""The logs that a drive file or a command names: files, patterns, folders of recordings; each is one run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from elastogeo.errors import FormatError
from elastogeo.formats.log import Log
from elastogeo.formats.log_files import read_log
from elastogeo.formats.logs.parquet import read_recording
from elastogeo.formats.recording_files import PART, part_files
from elastogeo.formats.text.files_read import may_open
from elastogeo.formats.text.fingerprint import sha256_of


@dataclass(frozen=True, slots=True)
class RunLog:
    """The log of one run.

    Attributes
    ----------
    name : str
        Of the run: that of the file without its suffix, or of the folder of a recording.
    path : Path
    parts : tuple of Path
        Of a recording, if not all of its folder are named.
    """

    name: str
    path: Path
    parts: tuple[Path, ...] = ()

    def read(self) -> Log:
        """Read it.

        Raises
        ------
        FormatError
            If it is not what it must be.
        """
        return read_recording(self.path, self.parts) if self.parts else read_log(self.path)

    def sha256(self) -> str:
        """SHA-256 of the file; of the folder of a recording, as `sha256_of` makes it."""
        return sha256_of(self.path)


def is_recording(path: Path) -> bool:
    """Whether a path is the folder of a recording."""
    return path.is_dir() and bool(part_files(path))


def runs_of(paths: Sequence[Path]) -> list[RunLog]:
    """One run for each log; the parts of one recording are one run."""
    runs: dict[Path, RunLog] = {}
    for path in paths:
        if PART.fullmatch(path.name) and not path.is_dir():
            folder = path.parent
            earlier = runs[folder].parts if folder in runs else ()
            runs[folder] = RunLog(folder.resolve().name, folder, (*earlier, path))
        else:
            runs[path] = RunLog(path.resolve().name if path.is_dir() else path.stem, path)
    return list(runs.values())


def named_logs(entries: Sequence[str], file: Path) -> list[Path]:
    """The logs that a drive file names, patterns resolved, in their order.

    Raises
    ------
    FormatError
        If a pattern stands in a folder, or nothing matches.
    """
    found: list[Path] = []
    for entry in entries:
        folder, _, name = entry.replace("\\", "/").rstrip("/").rpartition("/")
        if not name or any(sign in folder for sign in "*?["):
            raise FormatError(f"{file}: logs has {entry!r}; write a file, or a pattern in its last part such as run_*.csv")
        place = file.parent / folder
        may_open(place)
        matches = sorted(place.glob(name)) if any(sign in name for sign in "*?[") else [place / name]
        if not matches:
            raise FormatError(f"{file}: no log matches {entry!r} in {place}; copy the logs there, or correct the path")
        found += matches
    if not found:
        raise FormatError(f'{file}: names no log; write for example logs = ["run_*.csv"]')
    return list(dict.fromkeys(found))
