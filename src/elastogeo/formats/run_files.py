'''Run files: any file of readings -> a `Table`. The format is told from the content, never from the file's name.

To add a format, write one file in the folder `runs` beside this one. It is found and registered by itself, and
the contract tests in `tests/formats/test_run_files.py` run on it at once. A complete one, `runs/toy.py`::

    """The toy format: the word TOY and how many forces follow, then one force in newtons on each line."""

    import numpy as np

    from elastogeo.errors import FormatError
    from elastogeo.formats.run_files import RunFormat, register
    from elastogeo.formats.text.table import Table


    def can_read(head: bytes) -> bool:
        return head.startswith(b"TOY ")


    def read(data: bytes, source: str) -> Table:
        head, *lines = data.split(b"\\n")
        promised, ended = head.removeprefix(b"TOY ").strip(), lines[-1:] == [b""]
        if not ended or promised != b"%d" % (len(lines) - 1):
            raise FormatError(f"{source}: {len(lines)} lines follow {head[:20]!r}; the file may be cut off, copy it again")
        forces = []
        for number, line in enumerate(lines[:-1], 2):
            try:
                forces.append(float(line))
            except ValueError:
                raise FormatError(f"{source}, line {number}: {line[:40]!r} is not a force; correct it") from None
        return Table({"force": np.array(forces)}, {}, source)


    register(RunFormat("toy", ".toy", can_read, read, sample=lambda: b"TOY 2\\n36.0\\n742.0\\n"))

What the contract asks:

* `can_read` sees the first `HEAD` bytes, says yes to its own files only, and never raises;
* `read` turns any bytes into a `Table` in internal units, or raises a `FormatError` that says where in the file, what
  arrived, why it is refused, and what to do. It counts all that is wrong and shows the first five;
* it never drops, pads or rounds a reading; it takes less than a second and ten times the file's size for each megabyte;
* `sample` gives a small valid file, on which the detectors of all other formats are tried. Cut off anywhere it is refused:
  half a number reads as another number, so a file must say where it ends;
* a format whose files may hold several runs also gives `read_runs`, and makes its `read` of it by `only_run`. People choose
  a run by its number behind the file's name: `file = "xy.b5r#2"`.
'''

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from elastogeo.discovery import import_all
from elastogeo.errors import FormatError
from elastogeo.formats.text.by_content import add, claiming, format_of, opened
from elastogeo.formats.text.table import Table
from elastogeo.formats.unread import unread
from elastogeo.machine import Array

_CHOICE = re.compile(r"(?P<path>.+)#(?P<number>\d{1,3})", re.ASCII | re.DOTALL)

Writer = Callable[[Mapping[str, Array], Mapping[str, str]], bytes]


@dataclass(frozen=True, slots=True)
class RunFormat:
    """The contract of a format of run files; the module's docstring is the recipe.

    Attributes
    ----------
    name : str
        What people call it, for messages.
    suffix : str
        The usual end of its file names, with the dot; used to name new files, never to recognise one.
    can_read : callable
        `can_read(head)`: whether a file that begins with these bytes is of this format.
    read : callable
        `read(data, source)`: the whole file's bytes to a `Table`; `source` is for messages.
    sample : callable
        `sample()`: the bytes of a small valid file.
    write : callable, optional
        `write(columns, metadata)`: bytes of a file; columns are arrays, shape (m,), in the file's own units, keyed by
        header (`radial_um`). Read back, they are the same bit for bit.
    read_runs : callable, optional
        `read_runs(data, source)`: all runs of a file that may hold several, in its order; at least one.
    read_columns : callable, optional
        `read_columns(data, source, columns)`: as `read`, but of the columns that a test names only: our name with its unit
        (`angle_deg`) -> header in the file.
    """

    name: str
    suffix: str
    can_read: Callable[[bytes], bool]
    read: Callable[[bytes, str], Table]
    sample: Callable[[], bytes]
    write: Writer | None = None
    read_runs: Callable[[bytes, str], tuple[Table, ...]] | None = None
    read_columns: Callable[[bytes, str, Mapping[str, str]], Table] | None = None


_FORMATS: dict[str, RunFormat] = {}


def register(run_format: RunFormat) -> None:
    """Add a format to those that `read_run` knows.

    Raises
    ------
    FormatError
        If another format has the same name.
    """
    add(_FORMATS, run_format)


def run_formats() -> dict[str, RunFormat]:
    """All known formats by name: those of every file in the folder `runs`."""
    import_all("elastogeo.formats.runs")
    return dict(_FORMATS)


def only_run(runs: tuple[Table, ...], source: str) -> Table:
    """The one run of a file.

    Raises
    ------
    FormatError
        If it holds several; the message says how to choose one.
    """
    if len(runs) > 1:
        raise FormatError(f'{source}: holds {_listed(runs)}; choose one by its number: file = "{Path(source).name}#1"')
    return runs[0]


def read_run(path: str | Path, columns: Mapping[str, str] | None = None) -> Table:
    """Read one run file of any known format, told from its content.

    Parameters
    ----------
    path : str or Path
        The file, of at most `MAX_BYTES` bytes; `name#2` is the second run of the file `name`.
    columns : mapping of str to str, optional
        What the columns mean where their headers do not say it: `{"angle_deg": "Winkel", "radial_um": "Abweichung"}`. Only
        these columns are read.

    Returns
    -------
    Table
        Its readings in internal units [mm, rad, N, N mm, s, mm/s; bar, A, V, degC].

    Raises
    ------
    FormatError
        If the file cannot be opened, is too large, is of no known format or of more than one, or has bad content.
    """
    data, number = opened_run(path)
    return read_run_bytes(data, str(path), number, columns)


def opened_run(path: str | Path) -> tuple[bytes, int | None]:
    """The bytes of a run file, and the number behind its name (`name#2`), if there is one.

    Raises
    ------
    FormatError
        If it cannot be opened.
    """
    source = str(path)
    choice = None if Path(path).exists() else _CHOICE.fullmatch(source)
    data = opened(choice["path"] if choice else path, source)
    return data, int(choice["number"]) if choice else None


def read_run_bytes(
    data: bytes,
    source: str,
    number: int | None = None,
    columns: Mapping[str, str] | None = None,
    claimed: Sequence[RunFormat] | None = None,
) -> Table:
    """Read the bytes of a run file, as `read_run` does (an upload, a member of an archive).

    Parameters
    ----------
    data : bytes
    source : str
        Where they came from, for messages.
    number : int, optional
        Which run of the file, from 1; without it the file must hold one only.
    columns : mapping of str to str, optional
        As of `read_run`.
    claimed : sequence of RunFormat, optional
        The formats that claim them, if that is known already.

    Raises
    ------
    FormatError
        As `read_run`.
    """
    if columns:
        return _columns_reader(data, source)(data, source, columns)
    return _read(format_of(run_formats(), data, source, partial(unread, run=True), claimed), data, source, number)


def _columns_reader(data: bytes, source: str) -> Callable[[bytes, str, Mapping[str, str]], Table]:
    """What reads named columns of a file: of Parquet, else of delimited text, whose headers may say anything."""
    formats = run_formats()
    claimed = claiming(formats, data) or [formats["delimited text"]]
    if claimed[0].read_columns is None:
        raise FormatError(f"{source}: is {claimed[0].name}, whose columns have no headers to choose by; leave columns out")
    return claimed[0].read_columns


def _read(run_format: RunFormat, data: bytes, source: str, number: int | None) -> Table:
    if number is None or (run_format.read_runs is None and number == 1):
        return run_format.read(data, source)
    runs = run_format.read_runs(data, source) if run_format.read_runs else (run_format.read(data, source),)
    if not 1 <= number <= len(runs):
        raise FormatError(f"{source}: there is no run {number}; the file holds {_listed(runs)}")
    return runs[number - 1]


def _listed(runs: tuple[Table, ...]) -> str:
    """The runs of a file in words."""
    names = (f"#{k} {run.metadata.get('direction', '')}".strip() for k, run in enumerate(runs, 1))
    return f"{len(runs)} run{'s' if len(runs) > 1 else ''} ({', '.join(names)})"
