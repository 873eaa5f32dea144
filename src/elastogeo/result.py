"""What every result can do: show itself, as a table, a page, a document.

A result is numbers; how they are written is decided in one place above, the room `report`. That room registers itself here
(`register`) when it is imported, and is found by its name when the first result is shown: this file imports nothing of it.
"""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from typing import Any, Literal, Protocol

from elastogeo.equality import ByValue
from elastogeo.errors import InputError

RENDERING_ROOM = "elastogeo.report"

TableKind = Literal["rows", "pandas", "polars"]


class Renderer(Protocol):
    """What the room that renders gives every result."""

    def line(self, shown: Any) -> str:
        """A part of a result in one line: a parameter with its unit and interval."""

    def summary(self, result: Any) -> str:
        """A result in a few lines."""

    def text(self, result: Any) -> str:
        """A result as plain text, as a person reads it at a terminal."""

    def html(self, result: Any) -> str:
        """A result as a fragment of HTML, for a notebook."""

    def document(self, result: Any) -> dict[str, Any]:
        """A result as a JSON object: the same as the command line's `--json`."""

    def rows(self, result: Any) -> list[dict[str, Any]]:
        """The main table of a result, a row an entry, in the units of the house."""

    def write(self, result: Any, folder: Path) -> Path:
        """Write the report of a result to a folder; the path of its page."""


_REGISTERED: list[Renderer] = []


def register(renderer: Renderer) -> None:
    """Let a renderer show results, the last one registered."""
    _REGISTERED[:] = [renderer]


def renderer() -> Renderer:
    """The renderer; the room that renders is imported if it has not been."""
    if not _REGISTERED:
        import_module(RENDERING_ROOM)
    return _REGISTERED[0]


class Part(ByValue):
    """A part of a result that is shown in one line."""

    __slots__ = ()

    def __str__(self) -> str:
        return renderer().line(self)

    __repr__ = __str__


class Result(ByValue):
    """A result: frozen numbers that can show themselves.

    `print(result)` gives its table and verdict, its `repr` a few lines; a notebook shows it as HTML.
    """

    __slots__ = ()

    def __str__(self) -> str:
        return renderer().text(self)

    def __repr__(self) -> str:
        return renderer().summary(self)

    def _repr_html_(self) -> str:
        return renderer().html(self)

    def table(self, as_: TableKind = "rows") -> Any:
        """The main table: of an identification its parameters, of a diagnosis its faults.

        Parameters
        ----------
        as_ : {"rows", "pandas", "polars"}
            A list with a mapping for each row, or a data frame where pandas or polars is installed.

        Returns
        -------
        list of dict, or data frame
            Numbers are in the units of the house (mm, N, rad, s) or in the unit that the row or the column names.

        Raises
        ------
        InputError
            If it is asked for as something else, or the package for it is not installed.
        """
        return _framed(renderer().rows(self), as_)

    def to_dict(self) -> dict[str, Any]:
        """The whole result as plain values: the object that the command line prints with `--json`."""
        return renderer().document(self)

    def to_json(self, indent: int | None = 2) -> str:
        """The whole result as one JSON object, with a schema that names its version."""
        import json

        return json.dumps(self.to_dict(), indent=indent, allow_nan=False, ensure_ascii=False)

    def report(self, folder: str | Path) -> Path:
        """Write the report, HTML and PDF with its figures, to a folder.

        Returns
        -------
        Path
            Of the page.

        Raises
        ------
        InputError
            If matplotlib, jinja2 or typst is not installed (`pip install 'elastogeo[report]'`).
        """
        return renderer().write(self, Path(folder))


def _framed(rows: Iterable[dict[str, Any]], as_: str) -> Any:
    rows = list(rows)
    if as_ == "rows":
        return rows
    if as_ not in ("pandas", "polars"):
        raise InputError(f"a table comes as rows, pandas or polars, not as {as_!r}")
    try:
        frames = import_module(as_)
    except ModuleNotFoundError:
        raise InputError(f"{as_} is not installed; install it, or take the table as rows") from None
    return frames.DataFrame(rows)
