"""A drawing of plain shapes: coordinates in pixels, texts written, colours by what they are for. No matplotlib.

A page writes it as SVG with a class for each kind (`plot_svg`), so that light, dark and print follow the page; it is kept
as JSON (`Plot.to_dict`, `plot_of`). x runs to the right, y downwards.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

Place = tuple[float, float]

KINDS = ("ink", "soft", "line", "blue", "orange", "green", "bad", "care", "good", "band", "cone", "paper")
"""Colours: letters, notes, grid lines, the series of a chart, states, areas, the ground."""
SHAPES = ("circle", "ring", "square", "diamond", "cross", "up", "down")
"""Of marks."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line through points [px]."""

    points: tuple[Place, ...]
    kind: str = "ink"
    width: float = 1.0
    dashes: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Band:
    """An area within points [px]."""

    points: tuple[Place, ...]
    kind: str = "band"


@dataclass(frozen=True, slots=True)
class Mark:
    """A value: its place and shape, its interval from `low` to `high` [px, y], what is said of it when it is pointed at."""

    x: float
    y: float
    kind: str = "ink"
    shape: str = "circle"
    size: float = 3.5
    title: str = ""
    low: float | None = None
    high: float | None = None
    link: str | int = ""
    """Key of what it is, a test's."""


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle [px], filled or a line."""

    x: float
    y: float
    radius: float
    kind: str = "soft"
    filled: bool = False
    width: float = 1.0
    dashes: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Text:
    """A text at the foot of its letters; `anchor` is `start`, `middle` or `end`; `size` 0 is that of the page."""

    x: float
    y: float
    text: str
    anchor: str = "start"
    kind: str = "soft"
    strong: bool = False
    size: float = 0.0


Shape = Line | Band | Mark | Circle | Text


@dataclass(frozen=True, slots=True)
class Entry:
    """A line of the legend: a shape of `SHAPES`, or `line`, `dashes`, `area`, with its words."""

    shape: str
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class Plot:
    """A drawing.

    Attributes
    ----------
    width, height : float [px]
    shapes : tuple of Shape
        Those behind first.
    alternative : str
        What it shows, for those who cannot see it; empty of what a text beside it says already.
    legend : tuple of Entry
        Below it.
    """

    width: float
    height: float
    shapes: tuple[Shape, ...]
    alternative: str = ""
    legend: tuple[Entry, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """As plain values, to be kept as JSON."""
        return {
            "width": self.width,
            "height": self.height,
            "alternative": self.alternative,
            "shapes": [{"is": type(shape).__name__.lower(), **_plain(shape)} for shape in self.shapes],
            "legend": [_plain(entry) for entry in self.legend],
        }


_SHAPES: dict[str, type[Shape]] = {kind.__name__.lower(): kind for kind in (Line, Band, Mark, Circle, Text)}


def plot_of(document: Mapping[str, Any]) -> Plot:
    """What `Plot.to_dict` gave."""
    shapes = tuple(_shape(entry) for entry in document["shapes"])
    legend = tuple(Entry(**entry) for entry in document["legend"])
    return Plot(document["width"], document["height"], shapes, document["alternative"], legend)


def _plain(part: Shape | Entry) -> dict[str, Any]:
    return {one.name: getattr(part, one.name) for one in fields(part)}


def _shape(entry: Mapping[str, Any]) -> Shape:
    given = {name: value for name, value in entry.items() if name != "is"}
    if "points" in given:
        given["points"] = tuple((x, y) for x, y in given["points"])
    if "dashes" in given:
        given["dashes"] = tuple(given["dashes"])
    return _SHAPES[entry["is"]](**given)
