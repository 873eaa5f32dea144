'''Compensation files: error tables -> the files of a control, and back. The format is told from the content.

To add a control, write one file in the folder `compensations` beside this one. It is found and registered by itself, and
the contract tests in `tests/formats/test_compensation_files.py` run on it at once. A complete one, `compensations/toy.py`::

    """The toy control: the word TOYCOMP with the axis, then position and correction on each line, and an END."""

    import numpy as np

    from elastogeo.errors import FormatError
    from elastogeo.formats.compensation_files import CompensationFormat, register
    from elastogeo.machine import ErrorTable


    def takes(table: ErrorTable) -> str:
        return "" if table.is_own and not table.is_rotary else "it corrects linear axes along themselves"


    def write(tables, settings):
        return {f"{table.axis}.toycomp": _text(table) for table in tables}


    def _text(table: ErrorTable) -> bytes:
        rows = zip(table.position, table.value.mean(axis=1), strict=True)
        lines = [f"TOYCOMP {table.axis}", *(f"{place:.4f} {-error:.6f}" for place, error in rows), "END", ""]
        return "\\n".join(lines).encode()


    def can_read(head: bytes) -> bool:
        return head.startswith(b"TOYCOMP ")


    def read(data, source, settings):
        if not data.endswith(b"\\nEND\\n"):
            raise FormatError(f"{source}: has no END; it may be cut off, copy it again")
        head, *lines = data.decode("ascii", "replace").removesuffix("\\nEND\\n").split("\\n")
        try:
            place, correction = np.array([line.split() for line in lines], dtype=float).T
        except ValueError:
            raise FormatError(f"{source}: a line is not a position and a correction; correct it") from None
        axis = head.removeprefix("TOYCOMP ")
        unknown = np.full((len(place), 2), np.nan)
        return (ErrorTable(axis, axis, place, np.column_stack([-correction, -correction]), unknown),)


    register(CompensationFormat("toy", ".toycomp", "toy control", takes, write, can_read, read))

What the contract asks:

* `write` turns tables, whose values are actual less nominal, into files with the sign of the control, at points that the
  control takes (evenly spaced, at most so many), and refuses what it does not: with axis, value and limit;
* `read` gives back what the control does with the file, again as actual less nominal, so that error less table is what is
  left; `takes` says in words why a control cannot take a table, and nothing if it can;
* what no public manual says is a setting with a stated default, never a silent constant. Where that is the sign,
  `sign_is_public` is false, and people are told to confirm it on the machine.
'''

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from elastogeo.discovery import import_all
from elastogeo.errors import FormatError, InputError
from elastogeo.formats.text.by_content import add, format_of, opened
from elastogeo.machine import ErrorTable

Settings = Mapping[str, str]
Files = dict[str, bytes]


@dataclass(frozen=True, slots=True)
class Setting:
    """What a control can have this way or that, or what no public manual says.

    Attributes
    ----------
    name, default, meaning : str
    choices : tuple of str
        What it may be; empty for anything.
    """

    name: str
    default: str
    meaning: str
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class CompensationFormat:
    """The contract of the compensation files of a control; the module's docstring is the recipe.

    Attributes
    ----------
    name : str
        What people choose it by.
    suffix : str
        The usual end of its file names, with the dot.
    title : str
        What it is, in words.
    takes : callable
        `takes(table)`: why the control cannot take this table, or nothing.
    write : callable
        `write(tables, settings)`: content by file name, of tables that it takes; every setting has a value.
    can_read : callable
        `can_read(head)`: whether a file that begins with these bytes is of this format.
    read : callable
        `read(data, source, settings)`: the tables that a file holds.
    settings : tuple of Setting
    sign_is_public : bool
        Whether a public text of the maker, or a run of the control itself, says the sign.
    """

    name: str
    suffix: str
    title: str
    takes: Callable[[ErrorTable], str]
    write: Callable[[Sequence[ErrorTable], Settings], Files]
    can_read: Callable[[bytes], bool]
    read: Callable[[bytes, str, Settings], tuple[ErrorTable, ...]]
    settings: tuple[Setting, ...] = ()
    sign_is_public: bool = True

    def with_defaults(self, given: Mapping[str, str]) -> dict[str, str]:
        """Every setting with its value: as given, else its default.

        Raises
        ------
        InputError
            If there is no such setting, or it may not be that.
        """
        known = {one.name: one for one in self.settings}
        for name, value in given.items():
            if name not in known:
                there = ", ".join(known) or "none"
                raise InputError(f"{self.title} has no setting {name!r}; it has: {there}")
            choices = known[name].choices
            if choices and value not in choices:
                raise InputError(f"{self.title}: {name} is {value!r}; it may be {', '.join(choices)}")
        return {name: given.get(name, one.default) for name, one in known.items()}


_FORMATS: dict[str, CompensationFormat] = {}


def register(compensation_format: CompensationFormat) -> None:
    """Add a control to those that `write_compensation` knows.

    Raises
    ------
    FormatError
        If another has the same name.
    """
    add(_FORMATS, compensation_format)


def compensation_formats() -> dict[str, CompensationFormat]:
    """All known controls by name: those of every file in the folder `compensations`."""
    import_all("elastogeo.formats.compensations")
    return dict(_FORMATS)


def compensation_format(control: str) -> CompensationFormat:
    """The format of a control, by its name.

    Raises
    ------
    InputError
        If there is none; the message names those there are.
    """
    known = compensation_formats()
    if control not in known:
        raise InputError(f"no compensation files are known of a control {control!r}; there are {', '.join(known)}")
    return known[control]


def compensation_text(
    tables: Sequence[ErrorTable], control: str, settings: Mapping[str, str] | None = None
) -> dict[str, bytes]:
    """The files of a control that make errors good: content by file name.

    Parameters
    ----------
    tables : sequence of ErrorTable
        Actual less nominal.
    control : str
        `linuxcnc`, `sinumerik-lec`, ...: see `compensation_formats`.
    settings : mapping of str to str, optional
        Of the control.

    Raises
    ------
    InputError
        If there is no such control or setting, or the control cannot take a table.
    """
    one = compensation_format(control)
    for table in tables:
        why = one.takes(table)
        if why:
            raise InputError(f"{one.title} does not take {table.name}: {why}; leave it out, or choose another control")
    return one.write(tables, one.with_defaults(settings or {}))


def read_compensation(path: str | Path, settings: Mapping[str, str] | None = None) -> tuple[ErrorTable, ...]:
    """The errors that a compensation file of a control compensates, actual less nominal; the control is told by content.

    Parameters
    ----------
    path : str or Path
    settings : mapping of str to str, optional
        Of the control, with which the file was written.

    Raises
    ------
    FormatError
        If the file cannot be opened, is of no known format, or has bad content.
    """
    data, source = opened(path, str(path)), str(path)
    one = format_of(compensation_formats(), data, source, lambda _: "")
    return one.read(data, source, one.with_defaults(settings or {}))


def read_back(files: Mapping[str, bytes], control: str, settings: Mapping[str, str]) -> tuple[ErrorTable, ...]:
    """What a control does with files that were written for it: the tables that it reads of them, in their order."""
    one = compensation_format(control)
    values = one.with_defaults(settings)
    return tuple(table for name, data in files.items() if one.can_read(data) for table in one.read(data, name, values))


def number(text: str, what: str, source: str) -> float:
    """A finite number of a file or a setting.

    Raises
    ------
    FormatError
        If it is none.
    """
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if value - value != 0:
        raise FormatError(f"{source}: {what} is {text[:40]!r}, which is no number; correct it")
    return value


def displacements_only(table: ErrorTable) -> str:
    """Why a control that moves one axis by the position of another cannot take a table, or nothing."""
    if table.is_own or not table.is_angular:
        return ""
    return "it corrects displacements, and the angle of a rotary axis about itself"


def axis_names(settings: Settings) -> dict[str, str]:
    """What the control calls each axis: of a setting `axes` such as `X=X1,Y=Y1`.

    Raises
    ------
    InputError
        If it is not of that form.
    """
    pairs = [pair.split("=") for pair in settings["axes"].split(",")]
    if any(len(pair) != 2 or not all(pair) for pair in pairs):
        raise InputError(f"axes is {settings['axes']!r}; give each letter with its name in the control, as in X=X1,Y=Y1")
    return {letter.strip(): name.strip() for letter, name in pairs}


def name_of(axis: str, names: Mapping[str, str]) -> str:
    """What the control calls an axis.

    Raises
    ------
    InputError
        If nothing says it.
    """
    if axis not in names:
        raise InputError(f"nothing says what the control calls {axis}; add it to axes, as in {axis}={axis}1")
    return names[axis]


def letter_of(name: str, names: Mapping[str, str], source: str) -> str:
    """The letter of an axis that the control calls so.

    Raises
    ------
    FormatError
        If there is none.
    """
    found = [letter for letter, called in names.items() if called == name]
    if not found:
        raise FormatError(f"{source}: has the axis {name}, which is none of {', '.join(names.values())}; say axes")
    return found[0]


def step_of(settings: Settings) -> float | None:
    """The setting `step`, in the unit of the control; None where it is left to the program.

    Raises
    ------
    InputError
        If it is no number.
    """
    return None if settings["step"] == "auto" else _given(settings, "step")


def whole(settings: Settings, name: str) -> int:
    """A setting that is a whole number.

    Raises
    ------
    InputError
        If it is none.
    """
    value = _given(settings, name)
    if value != int(value):
        raise InputError(f"{name} is {settings[name]!r}; give a whole number")
    return int(value)


def _given(settings: Settings, name: str) -> float:
    try:
        return number(settings[name], name, "settings")
    except FormatError:
        raise InputError(f"{name} is {settings[name]!r}; give a number") from None


SIGN = Setting(
    "sign", "error", "what the file holds: the error (actual less nominal), or the correction", ("error", "correction")
)
STEP = Setting("step", "auto", "between points, in mm or degrees")


def signed(settings: Settings) -> float:
    """+1 where a file holds the error, -1 where it holds the correction."""
    return 1.0 if settings["sign"] == "error" else -1.0
