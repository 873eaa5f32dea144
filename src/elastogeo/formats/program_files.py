'''Program files: a neutral `Program` to and from the language of a control. The language is told from the content.

To add a language, write one file in the folder `programs` beside this one; it is found and registered by itself. A complete
one, `programs/steps.py`::

    """The toy language: the word STEPS, then `GO axis mm feed` lines, then END."""

    from elastogeo.errors import FormatError
    from elastogeo.formats.program_files import Flavour, Reading, Writing, register
    from elastogeo.machine import Line, Program


    def can_read(head: bytes) -> bool:
        return head.startswith(b"STEPS\\n")


    def read(data: bytes, source: str, reading: Reading) -> Program:
        lines = data.decode("ascii", "replace").splitlines()
        if lines[-1] != "END":
            raise FormatError(f"{source}, line {len(lines)}: the program does not end with END; it may be cut off")
        blocks = []
        for number, line in enumerate(lines[1:-1], 2):
            match line.split():
                case ["GO", axis, to, feed]:
                    blocks.append(Line({axis: float(to)}, float(feed)))
                case _:
                    raise FormatError(f"{source}, line {number}: {line[:40]!r} is not understood; correct it")
        return Program(source, blocks)


    def write(program: Program, writing: Writing) -> str:
        moves = [block for block in program.blocks if isinstance(block, Line)]
        lines = [f"GO {axis} {to!r} {move.feed!r}" for move in moves for axis, to in move.to.items()]
        return "\\n".join(["STEPS", *lines, "END"])


    sample = "STEPS\\nGO X 5.0 10.0\\nEND"
    register(Flavour("steps", "a toy", ".steps", can_read, read, write, lambda: sample))

What the contract asks:

* `can_read` sees the first `HEAD` bytes, says yes to its own files only, and never raises;
* `read` gives the commands in mm and rad and the feeds in mm/s, or raises a `FormatError` with the line, what arrived, why
  it is refused, and what to do. What moves nothing (tools, spindle, coolant) it leaves out by name, in the notes of the
  program; what would move an axis in a way that it does not follow, it refuses;
* `write` gives a text that `read` turns into the same path, to the decimals written.
'''

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

from elastogeo.discovery import import_all
from elastogeo.errors import InputError
from elastogeo.formats.text.by_content import add, format_of, opened
from elastogeo.formats.text.whole_files import write_whole
from elastogeo.machine import Angle, Length, Program, ProgramLimits
from elastogeo.observe import Askable, Campaign, Procedure, campaign_of, short_name


@dataclass(frozen=True, slots=True)
class Reading:
    """What a program's text does not say, and the reader has to assume.

    Attributes
    ----------
    radius_tolerance : float [mm]
        By which the ends of an arc may lie at different distances from its centre.
    feed_counts : str
        Where linear and rotary axes move together, the feed counts along the `linear` axes, or along `all`, with a degree as
        a millimetre; empty for what the control does by default.
    dwell_p : str
        Unit of the word P of a dwell, `s` or `ms`; empty for what the control takes.
    whole_numbers : str
        Unit of a coordinate without a decimal point: `mm`, or `um` where the control counts in its least increment.
    """

    radius_tolerance: Length = 0.01
    feed_counts: str = ""
    dwell_p: str = ""
    whole_numbers: str = "mm"

    def __post_init__(self) -> None:
        """Refuse what is none of the choices."""
        _check_choice("feed_counts", self.feed_counts, ("", "linear", "all"))
        _check_choice("dwell_p", self.dwell_p, ("", "s", "ms"))
        _check_choice("whole_numbers", self.whole_numbers, ("mm", "um"))
        if not self.radius_tolerance > 0:
            raise InputError(f"radius_tolerance is {self.radius_tolerance:g} mm; it must be positive")


@dataclass(frozen=True, slots=True)
class Writing:
    """How a program is written, where its control leaves a choice. None and empty take what the flavour states.

    Attributes
    ----------
    decimals : int or None
        Of millimetres and degrees: as many as the control takes.
    blending : float [mm]
        By which the control may leave the path where blocks meet; zero for none said.
    zero : str
        The work offset that is called: `G54`; empty for none.
    numbers : bool
        Whether blocks are numbered.
    program_number : int
        Of an ISO program.
    chord : float [mm]
        By which lines may leave an arc, where the control has no arc for it.
    turn_step : float [rad]
        Greatest turn of such a line.
    """

    decimals: int | None = None
    blending: Length = 0.001
    zero: str = "G54"
    numbers: bool = False
    program_number: int = 1
    chord: Length = 0.0002
    turn_step: Angle = 0.0349

    def __post_init__(self) -> None:
        """Refuse what no text can hold."""
        if self.decimals is not None and not 1 <= self.decimals <= 9:
            raise InputError(f"decimals is {self.decimals}; write 1 to 9")
        if not 1 <= self.program_number <= 99_999_999:
            raise InputError(f"program_number is {self.program_number}; it must be 1 to 99999999")
        if not (self.blending >= 0 and self.chord > 0 and self.turn_step > 0):
            raise InputError("blending must not be negative, chord and turn_step must be positive")


@dataclass(frozen=True, slots=True)
class Flavour:
    """The contract of a language of programs; the module's docstring is the recipe.

    Attributes
    ----------
    name : str
        By which people choose it: `linuxcnc`.
    title : str
        What people call it, for messages.
    suffix : str
        The usual end of its file names, with the dot; used to name new files, never to recognise one.
    can_read : callable
        `can_read(head)`: whether a file that begins with these bytes is of this language.
    read : callable
        `read(data, source, reading)`: the whole file's bytes to a `Program`; `source` is for messages.
    write : callable
        `write(program, writing)`: the text of a program.
    sample : callable
        `sample()`: the text of a small valid program.
    """

    name: str
    title: str
    suffix: str
    can_read: Callable[[bytes], bool]
    read: Callable[[bytes, str, Reading], Program]
    write: Callable[[Program, Writing], str]
    sample: Callable[[], str]


T = TypeVar("T")


@runtime_checkable
class Planned(Protocol):
    """What has planned tests: a plan."""

    @property
    def campaign(self) -> Campaign:
        """The planned tests."""


_FLAVOURS: dict[str, Flavour] = {}


def register(flavour: Flavour) -> None:
    """Add a language to those that `read_program` knows.

    Raises
    ------
    FormatError
        If another has the same name.
    """
    add(_FLAVOURS, flavour)


def flavours() -> dict[str, Flavour]:
    """All known languages by name: those of every file in the folder `programs`."""
    import_all("elastogeo.formats.programs")
    return dict(_FLAVOURS)


def flavour_named(name: str) -> Flavour:
    """A language by its name.

    Raises
    ------
    InputError
        If there is none.
    """
    known = flavours()
    if name not in known:
        listed = ", ".join(f"{one.name} ({one.title})" for one in known.values())
        raise InputError(f"there is no flavour {name[:40]!r} of programs; there are: {listed}")
    return known[name]


def read_program(path: str | Path, flavour: str = "", reading: Reading | None = None) -> Program:
    """Read a program of a control.

    Parameters
    ----------
    path : str or Path
        The file, of at most `MAX_BYTES` bytes.
    flavour : str
        Its language; empty to tell it from the content.
    reading : Reading, optional
        What its text does not say.

    Returns
    -------
    Program
        Its commands in mm and rad, its feeds in mm/s, with the line of every block.

    Raises
    ------
    FormatError
        If it cannot be opened, is of no known language, or a line of it cannot be followed.
    """
    return read_program_bytes(opened(path, str(path)), str(path), flavour, reading)


def read_program_bytes(data: bytes, source: str, flavour: str = "", reading: Reading | None = None) -> Program:
    """Read the bytes of a program, as `read_program` does."""
    known = {flavour: flavour_named(flavour)} if flavour else flavours()
    chosen = format_of(known, data, source, lambda _: _UNKNOWN, list(known.values()) if flavour else None)
    return chosen.read(data, source, reading or Reading())


def program_text(program: Program, flavour: str, writing: Writing | None = None) -> str:
    """The text of a program in the language of a control.

    Raises
    ------
    InputError
        If there is no such flavour, or the control cannot be told this program.
    """
    return flavour_named(flavour).write(program, writing or Writing())


def write_program(
    what: Program | Askable | Planned, path: str | Path, flavour: str = "iso", **settings: Any
) -> tuple[Path, ...]:
    """Write the program of a test, or of each of several, in the language of a control.

    Parameters
    ----------
    what : Program, MachineTest, Campaign, Plan, sequence of MachineTest, or mapping of str to MachineTest
        A test gives the program that moves the machine as its instrument wants it; a plan those of its tests.
    path : str or Path
        The file; for several tests a folder, which gets a file for each, named after it.
    flavour : str
        Of the program: see `flavours`.
    **settings
        Fields of `observe.Procedure` (start, overshoot, feed_in, order, ...), of `Writing` (decimals, zero, ...) and of
        `machine.ProgramLimits` (most_feed, most_radius, ...), in mm, rad, s.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    FormatError
        If a file cannot be written: nothing is written then.
    InputError
        If there is no such flavour or setting.
    PathError
        If the machine cannot make it: with the axis, the value and the limit.
    """
    programs, writing = programs_of(what, **settings)
    return write_programs(programs, path, flavour, writing)


def write_programs(
    programs: Mapping[str, Program], path: str | Path, flavour: str = "iso", writing: Writing | None = None
) -> tuple[Path, ...]:
    """Write programs that were made already, by the names of their files, as `write_program` does; in their order."""
    suffix = flavour_named(flavour).suffix
    texts = [program_text(program, flavour, writing).encode("ascii") for program in programs.values()]
    single = len(texts) == 1 and not Path(path).is_dir()
    targets = [Path(path)] if single else [Path(path) / f"{name}{suffix}" for name in programs]
    return write_whole(dict(zip(targets, texts, strict=True)))


def programs_of(what: Program | Askable | Planned, **settings: Any) -> tuple[dict[str, Program], Writing]:
    """The program of each test under the test's short name, and how it is written; as `write_program`."""
    known = {one: [field.name for field in fields(one)] for one in (Procedure, Writing, ProgramLimits)}
    unknown = [name for name in settings if not any(name in names for names in known.values())]
    if unknown:
        listed = sorted({name for names in known.values() for name in names})
        raise InputError(f"programs have no setting {unknown[0][:40]!r}; there are: {', '.join(listed)}")
    procedure, writing, limits = _chosen(Procedure, settings), _chosen(Writing, settings), _chosen(ProgramLimits, settings)
    if isinstance(what, Program):
        return {_file_name(what.name): what}, writing
    tests = campaign_of(what.campaign if isinstance(what, Planned) else what).tests
    return {_file_name(name): test.program(procedure, limits) for name, test in tests.items()}, writing


def _file_name(name: str) -> str:
    """A name of a test as that of a file: as it is, if a campaign would take it."""
    return name if re.fullmatch(r"[\w.+-]+", name, re.ASCII) else short_name(name)


def _chosen(one: type[T], settings: Mapping[str, Any]) -> T:
    """An object of a class, of those settings that are its fields."""
    names = {field.name for field in fields(one)}  # type: ignore[arg-type]
    return one(**{name: value for name, value in settings.items() if name in names})


_UNKNOWN = "is no program of a control that is known; say its flavour"


def _check_choice(name: str, given: str, choices: tuple[str, ...]) -> None:
    if given not in choices:
        raise InputError(f"{name} is {given[:40]!r}; write one of {', '.join(filter(None, choices))}")
