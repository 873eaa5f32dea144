"""A view: all that a person is shown of a result, as strings, tables and pictures, made once.

The screen, the page, the PDF and the JSON are renderings of the same view: none of them formats a number. The view of a kind
of result is one function in a wing of this room, in a file named `view.py` or `*_view.py`::

    @views(Identification)
    def identification_view(result: Identification) -> View: ...
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from pkgutil import iter_modules, walk_packages
from typing import TYPE_CHECKING, Any, TypeVar

from elastogeo.identification import Check
from elastogeo.report.sentences import sentence_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from elastogeo.report.drawing.plots import Plot


@dataclass(frozen=True, slots=True)
class Said:
    """A check as it is said.

    Attributes
    ----------
    name : str
    passed : bool or None
        None if it was not tested.
    sentence : str
    decisive : bool
    """

    name: str
    passed: bool | None
    sentence: str
    decisive: bool = False


@dataclass(frozen=True, slots=True)
class Badge:
    """A state in shape and words, before the answer: `■`, `Alarm since 11 June 2026`.

    Attributes
    ----------
    mark : str
        A shape of its own for each state.
    text : str
    tone : str
        `bad`, `care`, `good` or `none`: its colour, which says nothing that the words do not.
    """

    mark: str
    text: str
    tone: str


@dataclass(frozen=True, slots=True)
class KeyValue:
    """One of the few numbers of the first screen: `C_XXX`, `61.92 ± 0.12`, `nm/N`, and what it is."""

    name: str
    value: str
    unit: str = ""
    meaning: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table, formatted.

    Attributes
    ----------
    headings : tuple of str
        With their units in brackets: `RMSE [µm]`.
    rows : tuple of tuple of str
    words : tuple of int
        Columns that hold words, set to the left; all others are figures.
    title : str
    note : str
        Below it.
    strong : tuple of int
        Rows that are set bold.
    name : str
        By which a page picks it; empty where none does.
    keys : tuple of int or str
        What each row is of, a machine's or a test's key, of which a page makes a link; empty, or one a row.
    tones : tuple of str
        What each row is of, bad, care, good or none, as `Badge.tone`: the colour of its cell headed `state`.
    sparks : tuple of Plot
        A small trend for each row; empty, or one a row. Only pages show them.
    """

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    words: tuple[int, ...] = (0,)
    title: str = ""
    note: str = ""
    strong: tuple[int, ...] = ()
    name: str = ""
    keys: tuple[int | str, ...] = ()
    tones: tuple[str, ...] = ()
    sparks: tuple[Plot, ...] = ()


@dataclass(frozen=True, slots=True)
class Picture:
    """A figure that is drawn when a page needs it.

    Attributes
    ----------
    name : str
        Of its file.
    caption : str
    alternative : str
        What it shows, for those who cannot see it.
    draw : callable
        Gives the matplotlib figure, under the house style.
    plain, narrow : callable or None
        Gives the same as plain shapes, where a page must be fast; `narrow` for a phone.
    """

    name: str
    caption: str
    alternative: str
    draw: Callable[[], Figure] = field(compare=False)
    plain: Callable[[], Plot] | None = field(default=None, compare=False)
    narrow: Callable[[], Plot] | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Scene:
    """A picture that can be turned, on a page of its own beside the report.

    Attributes
    ----------
    name : str
        Of its file.
    title, caption : str
    unknown : str
        How it shows what is not known.
    draw : callable
        Gives `data` (traces of plotly.js, of each the `choice` it belongs to, None for all), `layout`, `choices` (the
        menu) and `note`: plain types, every number that is shown already a string.
    """

    name: str
    title: str
    caption: str
    unknown: str
    draw: Callable[[], dict[str, Any]] = field(compare=False)


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the page below the first screen: a heading, paragraphs, pictures, tables, in this order."""

    title: str
    paragraphs: tuple[str, ...] = ()
    pictures: tuple[Picture, ...] = ()
    tables: tuple[Table, ...] = ()
    points: tuple[str, ...] = ()
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class View:
    """What a person is shown of a result; what there is not may be left out, but where the data come from is always said.

    Attributes
    ----------
    kind : str
        In words: `Identification`, `Stiffness map`.
    title, subtitle : str
    origin : str
        Empty for measured data; else what they are: simulated or reconstructed, and from what.
    head : tuple of (label, text)
        Who, when, machine, instrument, runs, file hashes.
    sentence : str
        The answer in one sentence.
    values : tuple of KeyValue
        Three to five.
    picture : Picture or None
        Of the first screen.
    checks : tuple of Said
    alert : tuple of str
        What must be said before anything else; mostly nothing.
    tables : tuple of Table
        The answer in full: what the terminal shows below the sentence.
    notes : tuple of str
        What the terminal says below the tables.
    sections : tuple of Section
        All else, folded on the page.
    scene : Scene or None
        A picture that can be turned, for a page of its own.
    badge : Badge or None
        The state of what is watched; none of a single test.
    strong : tuple of str
        Words of the sentence that a page sets bold: what changed, what it points to.
    advice : tuple of str
        What belongs to the answer and to the first screen: what it cannot tell, what to do next.
    document : mapping
        As JSON: plain types, nothing rounded.
    rows : sequence of mapping
        Its main table, a row an entry, for a data frame.
    """

    kind: str
    title: str
    subtitle: str = ""
    origin: str
    head: tuple[tuple[str, str], ...] = ()
    sentence: str
    values: tuple[KeyValue, ...] = ()
    picture: Picture | None = None
    checks: tuple[Said, ...] = ()
    document: Mapping[str, Any]
    rows: Sequence[Mapping[str, Any]] = ()
    alert: tuple[str, ...] = ()
    tables: tuple[Table, ...] = ()
    notes: tuple[str, ...] = ()
    sections: tuple[Section, ...] = ()
    scene: Scene | None = None
    badge: Badge | None = None
    strong: tuple[str, ...] = ()
    advice: tuple[str, ...] = ()

    @property
    def attention(self) -> tuple[Said, ...]:
        """The checks that failed, the decisive ones first, then those that were not tested."""
        failed = [check for check in self.checks if check.passed is False]
        untested = [check for check in self.checks if check.passed is None]
        return (*sorted(failed, key=lambda check: not check.decisive), *untested)

    @property
    def passed(self) -> tuple[Said, ...]:
        """The checks that passed."""
        return tuple(check for check in self.checks if check.passed)

    @property
    def supported(self) -> bool:
        """Whether the data support what was asked: no decisive check failed."""
        return not any(check.decisive and check.passed is False for check in self.checks)

    def table(self, name: str) -> Table | None:
        """The table of this name, the one of the first screen before those of the sections; None if there is none."""
        every = (*self.tables, *(table for section in self.sections for table in section.tables))
        return next((table for table in every if table.name == name), None)

    @property
    def pictures(self) -> dict[str, Picture]:
        """Every picture by name, the one of the first screen first."""
        first = [] if self.picture is None else [self.picture]
        return {p.name: p for p in (*first, *(p for section in self.sections for p in section.pictures))}


T = TypeVar("T")
_VIEWS: dict[type, Callable[[Any], View]] = {}
_LINES: dict[type, Callable[[Any], str]] = {}


def views(kind: type[T]) -> Callable[[Callable[[T], View]], Callable[[T], View]]:
    """Register the function that makes the view of results of this type."""

    def register(make: Callable[[T], View]) -> Callable[[T], View]:
        _VIEWS[kind] = make
        return make

    return register


def lines(kind: type[T]) -> Callable[[Callable[[T], str]], Callable[[T], str]]:
    """Register the function that says parts of results of this type in one line; it lies in a file of views."""

    def register(say: Callable[[T], str]) -> Callable[[T], str]:
        _LINES[kind] = say
        return say

    return register


def line_of(part: object) -> str:
    """A part of a result in one line.

    Raises
    ------
    KeyError
        If no wing says parts of this type.
    """
    return _found(_LINES, type(part))(part)


def view_of(result: object) -> View:
    """The view of a result of any kind.

    Raises
    ------
    KeyError
        If no wing makes a view of results of this type.
    """
    return _found(_VIEWS, type(result))(result)


def said(checks: Iterable[Check]) -> tuple[Said, ...]:
    """Checks as they are said."""
    return tuple(Said(check.name, check.passed, sentence_of(check), check.decisive) for check in checks)


def attention_sentence(checks: Iterable[Check | Said]) -> str:
    """How many checks need attention, and how many passed: the end of an answer's sentence."""
    marks = [check.passed for check in checks]
    failed, untested = marks.count(False), marks.count(None)
    parts = [
        "" if not failed else f"{failed} {'point needs' if failed == 1 else 'points need'} attention",
        "" if not untested else f"{untested} could not be tested",
        f"all {len(marks)} checks passed" if marks.count(True) == len(marks) else f"{marks.count(True)} checks passed",
    ]
    text = ", ".join(part for part in parts if part)
    return f"{text[:1].upper()}{text[1:]}." if marks else ""


def _found(register: Mapping[type, Callable[[Any], T]], kind: type) -> Callable[[Any], T]:
    """What is registered for a type; files of views are imported until it is."""
    unread = _view_files(kind)
    while kind not in register and (file := next(unread, None)):
        import_module(file)
    return register[kind]


def _view_files(kind: type) -> Iterator[str]:
    """The files of views; first those of the wing that is called like the wing or the room of this type of result, and of
    a wing its `view.py`: what is not read is not imported.
    """
    package, home = import_module(__name__.rpartition(".")[0]), kind.__module__.split(".")
    wings = [wing.name for wing in iter_modules(package.__path__, f"{package.__name__}.") if wing.ispkg]
    places = {wing: home.index(last) for wing in wings if (last := wing.rpartition(".")[2]) in home}
    for wing in sorted(wings, key=lambda wing: -places.get(wing, -1)):
        files = (file.name for file in walk_packages(import_module(wing).__path__, f"{wing}.") if not file.ispkg)
        yield from sorted((file for file in files if file.endswith("view")), key=lambda file: not file.endswith(".view"))
