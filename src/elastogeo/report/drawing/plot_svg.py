"""A drawing of plain shapes as an SVG element inside a page: every colour is a class, no style, no script, no address."""

from __future__ import annotations

from collections.abc import Iterable
from functools import singledispatch
from html import escape

from elastogeo.report.drawing.plots import Band, Circle, Line, Mark, Place, Plot, Shape, Text


def plot_svg(plot: Plot, name: str = "") -> str:
    """The element: classes `p-` and the kind of what is drawn as a line, `f-` and the kind of what is filled.

    Parameters
    ----------
    plot : Plot
    name : str
        A class more, by which a page finds it.

    Returns
    -------
    str
        All texts escaped. A mark with a title is a group of class `mark` with the title in it, so that it is said when it
        is pointed at.
    """
    said = f'role="img" aria-label="{escape(plot.alternative)}"' if plot.alternative else 'aria-hidden="true"'
    size = f'viewBox="0 0 {_n(plot.width)} {_n(plot.height)}" width="{_n(plot.width)}" height="{_n(plot.height)}"'
    return f'<svg class="plot{f" {escape(name)}" if name else ""}" {size} {said}>{"".join(map(_drawn, plot.shapes))}</svg>'


@singledispatch
def _drawn(shape: Shape) -> str:
    raise TypeError(f"a {type(shape).__name__} is no shape of a plot")


@_drawn.register
def _(shape: Line) -> str:
    return f'<path class="p-{shape.kind}" d="{_path(shape.points)}"{_pen(shape.width, shape.dashes)}/>'


@_drawn.register
def _(shape: Band) -> str:
    return f'<path class="f-{shape.kind}" d="{_path(shape.points)}Z"/>'


@_drawn.register
def _(shape: Circle) -> str:
    look = f'class="f-{shape.kind}"' if shape.filled else f'class="p-{shape.kind}"{_pen(shape.width, shape.dashes)}'
    return f'<circle {look} cx="{_n(shape.x)}" cy="{_n(shape.y)}" r="{_n(shape.radius)}"/>'


@_drawn.register
def _(shape: Text) -> str:
    strong = ' font-weight="700"' if shape.strong else ""
    size = f' font-size="{_n(shape.size)}"' if shape.size else ""
    anchor = "" if shape.anchor == "start" else f' text-anchor="{shape.anchor}"'
    at = f'x="{_n(shape.x)}" y="{_n(shape.y)}"'
    return f'<text class="f-{shape.kind}" {at}{anchor}{strong}{size}>{escape(shape.text)}</text>'


@_drawn.register
def _(shape: Mark) -> str:
    bar = ""
    if shape.low is not None and shape.high is not None:
        bar = f'<path class="p-{shape.kind}" d="M{_n(shape.x)} {_n(shape.low)}V{_n(shape.high)}"/>'
    drawn = bar + _mark(shape)
    if not shape.title:
        return drawn
    key = f' data-key="{escape(str(shape.link))}"' if shape.link != "" else ""
    return f'<g class="mark"{key}><title>{escape(shape.title)}</title>{drawn}</g>'


def _mark(mark: Mark) -> str:
    x, y, r = mark.x, mark.y, mark.size
    if mark.shape in ("circle", "ring"):
        look = f'class="f-{mark.kind}"' if mark.shape == "circle" else f'class="ring p-{mark.kind}" stroke-width="1.4"'
        return f'<circle {look} cx="{_n(x)}" cy="{_n(y)}" r="{_n(r)}"/>'
    if mark.shape == "cross":
        d = f"M{_n(x - r)} {_n(y - r)}L{_n(x + r)} {_n(y + r)}M{_n(x - r)} {_n(y + r)}L{_n(x + r)} {_n(y - r)}"
        return f'<path class="p-{mark.kind}" d="{d}" stroke-width="1.4"/>'
    corners = {
        "square": ((-r, -r), (r, -r), (r, r), (-r, r)),
        "diamond": ((0, -1.4 * r), (1.4 * r, 0), (0, 1.4 * r), (-1.4 * r, 0)),
        "up": ((0, -1.2 * r), (1.2 * r, r), (-1.2 * r, r)),
        "down": ((0, 1.2 * r), (1.2 * r, -r), (-1.2 * r, -r)),
    }[mark.shape]
    return f'<path class="f-{mark.kind}" d="{_path((x + a, y + b) for a, b in corners)}Z"/>'


def _path(points: Iterable[Place]) -> str:
    return "M" + "L".join(f"{_n(x)} {_n(y)}" for x, y in points)


def _pen(width: float, dashes: tuple[float, ...]) -> str:
    thick = "" if width == 1.0 else f' stroke-width="{_n(width)}"'
    return thick + (f' stroke-dasharray="{" ".join(map(_n, dashes))}"' if dashes else "")


def _n(value: float) -> str:
    """A coordinate to a tenth of a pixel."""
    return f"{value:.1f}".removesuffix(".0")
