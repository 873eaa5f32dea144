"""The look of every figure: one palette that colour-blind readers can distinguish, one type, nothing that is not data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from threading import RLock
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.colors import LinearSegmentedColormap, to_hex
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

BLUE, ORANGE, GREEN, GREY, INK, FAINT = "#0072b2", "#d55e00", "#009e73", "#767676", "#222222", "#d9d9d9"
"""After Okabe and Ito (2008)."""
WIDTH = 7.0
"""Width of every figure [in]: that of a page of A4 between its margins."""
READABLE = 5.2
"""Width of a figure of the first screen [in] whose letters are still read where the screen is a phone's."""
SMALL = 7.5
"""Size of notes [pt]; labels have 8.5."""

_RC: Any = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial", "sans-serif"],
    "font.size": 8.5,
    "text.color": INK,
    "text.parse_math": False,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.5,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": True,
    "axes.titley": 1.0,  # no ticks above: the search for a free place takes a third of the time of a figure
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": SMALL,
    "ytick.labelsize": SMALL,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "legend.frameon": False,
    "legend.fontsize": SMALL,
    "lines.linewidth": 1.2,
    "lines.solid_capstyle": "round",
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.hashsalt": "elastogeo",
}
_FORCES = LinearSegmentedColormap.from_list("forces", ["#a6dbe8", "#56a9d6", "#4878b8", "#6c5aa8", "#a0468f"])
_DIRECTIONS = {
    1: LinearSegmentedColormap.from_list("ccw", ["#9fd0ee", "#3d9bd4", "#0072b2", "#005688"]),
    -1: LinearSegmentedColormap.from_list("cw", ["#f6c39b", "#ef8a4a", "#d55e00", "#a84a00"]),
}
_EDGE_RIGHT = 0.12
"""Room at the right of a figure [in]."""
_LOCK = RLock()  # matplotlib's settings are global, and a web application draws from several threads


@contextmanager
def house_style(outlines: bool = False) -> Iterator[None]:
    """Draw and save under the settings of the house; with outlines, letters are drawn and need no font."""
    with _LOCK, rc_context({**_RC, "svg.fonttype": "path" if outlines else "none"}):
        yield


def new_figure(height: float, top: float = 1.0, width: float = WIDTH) -> Figure:
    """An empty figure of this width and height [in]; it is laid out below `top`, a part of the height."""
    return Figure(figsize=(width, height), layout=ConstrainedLayoutEngine(rect=(0, 0, 1, top)))


def laid_out(figure: Figure) -> Figure:
    """The figure with everything in its place for an SVG file, so that saving it need not draw it once before for this."""
    for axis in (axis for ax in figure.axes for axis in (ax.xaxis, ax.yaxis) if not axis.get_label_text()):
        axis.set_label_coords(0, 0)  # without a label there is no place to look for
    layout = figure.get_layout_engine()
    if layout is not None:
        FigureCanvasSVG(figure)  # measures letters as the file has them
        figure.set_dpi(FigureCanvasSVG.fixed_dpi)
        layout.execute(figure)
        figure.set_layout_engine(None)
    return figure


def panels(
    rows: int,
    columns: int,
    height: float,
    beside: float,
    above: float,
    below: float,
    between: float = 0.0,
    one_scale: bool = False,
) -> Figure:
    """A figure of panels at places for which nothing has to be measured: it takes two thirds of the time of `grid`.

    Parameters
    ----------
    rows, columns : int
    height : float [in]
        Of a panel.
    beside, above, below, between : float [in]
        Room to the left of each panel, above the first row, below the last and between rows.
    one_scale : bool
        Whether all panels have the same scales.
    """
    whole = rows * height + (rows - 1) * between + above + below
    width = (WIDTH - columns * beside - _EDGE_RIGHT) / columns
    places = {"left": beside / WIDTH, "right": 1 - _EDGE_RIGHT / WIDTH, "bottom": below / whole, "top": 1 - above / whole}
    apart = {"wspace": beside / width, "hspace": between / height}
    figure = Figure(figsize=(WIDTH, whole))
    figure.subplots(rows, columns, sharex=one_scale, sharey=one_scale, squeeze=False, gridspec_kw={**places, **apart})
    return figure


def multiples(
    count: int, columns: int, height: float, above: float, xlabel: str, ylabel: str = "", sharey: bool = False
) -> tuple[Figure, list[Axes]]:
    """Small multiples as `panels`, and their `count` axes, with one label for all their axes.

    Parameters
    ----------
    count, columns : int
    height, above : float [in]
        Of a panel, and of its title.
    xlabel, ylabel : str
    sharey : bool
    """
    columns = min(columns, count)
    rows = -(-count // columns)
    beside = (0.5 if sharey else 0.6) + (0.2 / columns if ylabel else 0.0)
    figure = panels(rows, columns, height, beside, above, below=0.48, between=above + 0.24)
    for spare in figure.axes[count:]:
        spare.remove()
    if sharey:
        for ax in figure.axes[1:]:
            ax.sharey(figure.axes[0])
    figure.text(0.5, 0.04 / figure.get_figheight(), xlabel, ha="center", va="bottom")
    figure.text(0.012, 0.5, ylabel, rotation=90, ha="left", va="center")
    return figure, list(figure.axes)


def grid(count: int, columns: int, height: float, sharey: bool = False) -> tuple[Figure, list[Axes]]:
    """A figure of small multiples, and its `count` axes; `height` [in] is that of a row."""
    columns = min(columns, count)
    rows = -(-count // columns)
    figure = new_figure(rows * height)
    axes = list(figure.subplots(rows, columns, sharey=sharey, squeeze=False).flat)
    for spare in axes[count:]:
        spare.remove()
    return figure, axes[:count]


def force_colours(forces: Sequence[float]) -> dict[float, str]:
    """A colour for each force level, darker with the force, all light enough for a dark line on them."""
    last = max(len(forces) - 1, 1)
    return {force: to_hex(_FORCES(k / last if len(forces) > 1 else 0.5)) for k, force in enumerate(forces)}


def direction_colours(forces: Sequence[float], sense: int) -> dict[float, str]:
    """A colour for each force level of one direction: CCW in blues, CW in oranges, stronger with the force."""
    last = max(len(forces) - 1, 1)
    shades = _DIRECTIONS[sense]
    return {force: to_hex(shades(k / last if len(forces) > 1 else 0.6)) for k, force in enumerate(forces)}
