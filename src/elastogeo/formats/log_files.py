'''Log files: any recording of a control or data logger -> a `Log`. The format is told from the content, never from the name.

To add a format, write one file in the folder `logs` beside this one. It is found and registered by itself, and
the contract tests in `tests/formats/test_log_files.py` run on it at once. A complete one, `logs/toy.py`::

    """The toy format: the word TOYLOG, then one current in amperes on each line, a millisecond apart."""

    import numpy as np

    from elastogeo.errors import FormatError
    from elastogeo.formats.log import Channel, Log
    from elastogeo.formats.log_files import LogFormat, register


    def can_read(head: bytes) -> bool:
        return head.startswith(b"TOYLOG\\n")


    def read(data: bytes, source: str) -> Log:
        *lines, last = data.split(b"\\n")
        currents = []
        for number, line in enumerate(lines[1:], 2):
            try:
                currents.append(float(line))
            except ValueError:
                raise FormatError(f"{source}, line {number}: {line[:40]!r} is not a current; correct it") from None
        time = np.arange(len(currents)) / 1000
        notes = ("the last line has no end, so it may be cut off: left out",) if last else ()
        return Log({"current": Channel("current", "A", np.array(currents), time)}, {}, source, notes)


    register(LogFormat("toy", ".toy", can_read, read, sample=lambda: b"TOYLOG\\n0.5\\n0.25\\n"))

What the contract asks is what `run_files` asks of a format of runs: `can_read` never raises and says yes to its own files
only; `read` turns any bytes into a `Log`, or raises a `FormatError` that says where, what arrived, why it is refused, and
what to do. What it repairs, it says in the log's notes; it never drops, pads or rounds a sample in silence. A recording that
ends suddenly is still a recording: its whole samples are read; a last one that may be half a number is left out, and said.
'''

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from elastogeo.discovery import import_all
from elastogeo.errors import FormatError
from elastogeo.formats.log import Log
from elastogeo.formats.text.by_content import add, format_of, opened
from elastogeo.formats.unread import unread


@dataclass(frozen=True, slots=True)
class LogFormat:
    """The contract of a format of logs; the module's docstring is the recipe.

    Attributes
    ----------
    name : str
        What people call it, for messages.
    suffix : str
        The usual end of its file names, with the dot; never used to recognise one.
    can_read : callable
        `can_read(head)`: whether a file that begins with these bytes is of this format.
    read : callable
        `read(data, source)`: the whole file's bytes to a `Log`; `source` is for messages.
    sample : callable
        `sample()`: the bytes of a small valid file.
    read_folder : callable, optional
        `read_folder(path)`: a recording that is a folder of such files; it raises a `FormatError` for any other folder.
    """

    name: str
    suffix: str
    can_read: Callable[[bytes], bool]
    read: Callable[[bytes, str], Log]
    sample: Callable[[], bytes]
    read_folder: Callable[[Path], Log] | None = None


_FORMATS: dict[str, LogFormat] = {}


def register(log_format: LogFormat) -> None:
    """Add a format to those that `read_log` knows.

    Raises
    ------
    FormatError
        If another format has the same name.
    """
    add(_FORMATS, log_format)


def log_formats() -> dict[str, LogFormat]:
    """All known formats by name: those of every file in the folder `logs`."""
    import_all("elastogeo.formats.logs")
    return dict(_FORMATS)


def read_log(path: str | Path) -> Log:
    """Read one log of any known format, told from its content.

    Parameters
    ----------
    path : str or Path
        The file, of at most `MAX_BYTES` bytes; or a folder of `elastogeo record`.

    Raises
    ------
    FormatError
        If the file cannot be opened, is too large, is of no known format or of more than one, or has bad content.
    """
    if Path(path).is_dir():
        return _of_folder(Path(path))
    return read_log_bytes(opened(path, str(path)), str(path))


def read_log_bytes(data: bytes, source: str, claimed: Sequence[LogFormat] | None = None) -> Log:
    """Read the bytes of a log, as `read_log` does; `claimed` are the formats that claim them, if that is known already.

    Raises
    ------
    FormatError
        As `read_log`.
    """
    return format_of(log_formats(), data, source, partial(unread, run=False), claimed).read(data, source)


def _of_folder(folder: Path) -> Log:
    """The recording that a folder holds.

    Raises
    ------
    FormatError
        If it holds none.
    """
    readers = [one.read_folder for one in log_formats().values() if one.read_folder is not None]
    for read in readers[:-1]:
        with suppress(FormatError):
            return read(folder)
    return readers[-1](folder)
