"""Where in the volume the tests of a plan lie, and what they will tell of each parameter."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from elastogeo.machine import COMPONENTS, Array
from elastogeo.planning import ALONE, IN_A_SUM, Plan
from elastogeo.report.drawing.style import BLUE, FAINT, GREEN, GREY, ORANGE, READABLE, SMALL, WIDTH, new_figure

_PLACES = 9
"""Places up to which a test that stands still is drawn as points."""
_PALE = "#a6cee3"
_KNOWN = {ALONE: GREEN, IN_A_SUM: _PALE}


def volume_figure(plan: Plan) -> Figure:
    """The travel of the linear axes from above and from both sides, with the path of each test in it.

    From above at the left; X Z below it; Y Z at the right, so that each axis runs the same way in neighbouring views.
    """
    machine = plan.means.machine
    shown = [axis for axis in "XYZ" if axis in machine.axes]
    if len(shown) < len("XYZ"):
        return _few_axes(plan, shown)
    spans = {axis: float(np.ptp(plan.means.travel(axis))) for axis in shown}
    ratios = {"width_ratios": [spans["X"], spans["Y"]], "height_ratios": [spans["Y"], spans["Z"]]}
    width = READABLE + 0.6
    figure = new_figure(0.75 + width * 0.86 * (spans["Y"] + spans["Z"]) / (spans["X"] + spans["Y"]), width=width)
    grid = figure.subplots(2, 2, gridspec_kw=ratios)
    views = ((grid[0, 0], ("X", "Y")), (grid[1, 0], ("X", "Z")), (grid[1, 1], ("Y", "Z")))
    grid[0, 1].axis("off")
    _draw(plan, views)
    grid[0, 1].legend(handles=_handles(plan), loc="center")
    grid[0, 0].set_xlabel("")
    return figure


def _few_axes(plan: Plan, shown: list[str]) -> Figure:
    """Of a machine of two linear axes, or one."""
    figure = new_figure(4.0, width=READABLE)
    ax = figure.subplots()
    _draw(plan, ((ax, (shown[0], shown[-1])),))
    ax.legend(handles=_handles(plan), loc="best")
    return figure


def _draw(plan: Plan, views: Iterable[tuple[Axes, tuple[str, str]]]) -> None:
    paths = [one.candidate.test.observations()[0].commands for one in plan.tests]
    for ax, pair in views:
        _travel(ax, plan, pair)
        for number, path in enumerate(paths, start=1):
            _path(ax, plan, path, pair, number)


def _handles(plan: Plan) -> list[Line2D]:
    held = [(BLUE, "rotary axes held"), (ORANGE, "rotary axes turning")]
    named = held if plan.means.turnable else [(BLUE, "path of a test")]
    box = Line2D([], [], color=GREY, linewidth=0.7, label="travel")
    return [*(Line2D([], [], color=colour, label=label) for colour, label in named), box]


def _travel(ax: Axes, plan: Plan, pair: tuple[str, str]) -> None:
    (left, right), (low, high) = (plan.means.travel(axis) for axis in pair)
    ax.add_patch(Rectangle((left, low), right - left, high - low, fill=False, edgecolor=GREY, linewidth=0.7))
    ax.set_xlim(left - 0.05 * (right - left), right + 0.05 * (right - left))
    ax.set_ylim(low - 0.05 * (high - low), high + 0.05 * (high - low))
    ax.set_aspect("equal")
    ax.set_xlabel(f"{pair[0]} (mm)")
    ax.set_ylabel(f"{pair[1]} (mm)")


def _path(ax: Axes, plan: Plan, path: Array, pair: tuple[str, str], number: int) -> None:
    """The path of a test, its number where it begins, on a ground that the lines do not cross."""
    machine = plan.means.machine
    across, up = (path[:, machine.index(axis)] for axis in pair)
    turning = any(np.ptp(path[:, machine.index(axis)]) > 0 for axis in plan.means.turnable)
    colour = ORANGE if turning else BLUE
    places = len(np.unique(np.round(path), axis=0))
    apart = places <= _PLACES and plan.tests[number - 1].candidate.test.setup.pose_quantity != "angle"
    ax.plot(across, up, color=colour, linewidth=0 if apart else 0.9, marker="o" if apart else "", markersize=3)
    ax.annotate(
        str(number),
        (across[0], up[0]),
        ha="center",
        va="center",
        fontsize=SMALL,
        color="white",
        bbox={"boxstyle": "circle,pad=0.15", "facecolor": colour, "edgecolor": "white"},
    )


def knowledge_figure(plan: Plan) -> Figure:
    """The compliance matrix of each joint, each entry coloured by what the plan will tell of it."""
    sites = list(dict.fromkeys(_site(p.name) for p in plan.parameters))
    columns = min(5, len(sites))
    rows = -(-len(sites) // columns)
    figure = new_figure(0.45 + rows * (WIDTH / columns + 0.1))
    every = figure.subplots(rows, columns, squeeze=False).flat
    known = {p.name: p.known for p in plan.parameters}
    for ax, site in zip(every, sites, strict=False):
        _matrix(ax, site, known)
    for spare in list(every)[len(sites) :]:
        spare.remove()
    entries = [(GREEN, "known alone"), (_PALE, "in a named sum"), (FAINT, "not seen")]
    handles = [Rectangle((0, 0), 1, 1, facecolor=colour, label=label) for colour, label in entries]
    figure.legend(handles=handles, loc="outside upper center", ncols=3)
    return figure


def _site(name: str) -> tuple[str, str]:
    """The family letter and the joint or place of a compliance: `C`, `X` of `C_XBX`."""
    family, _, rest = name.partition("_")
    return family, rest[2:]


def _matrix(ax: Axes, site: tuple[str, str], known: dict[str, str]) -> None:
    family, place = site
    for row, d in enumerate(COMPONENTS):
        for column, f in enumerate(COMPONENTS):
            found = known.get(f"{family}_{d}{f}{place}", known.get(f"{family}_{f}{d}{place}"))
            colour = _KNOWN.get(found or "", FAINT)
            ax.add_patch(Rectangle((column, row), 0.92, 0.92, facecolor=colour, edgecolor="none"))
    ax.set_xlim(-0.08, 6)
    ax.set_ylim(6, -0.08)
    ax.set_aspect("equal")
    ax.set_xticks([k + 0.46 for k in range(6)], list(COMPONENTS))
    ax.set_yticks([k + 0.46 for k in range(6)], list(COMPONENTS))
    ax.tick_params(length=0)
    for side in ax.spines.values():
        side.set_visible(False)
    ax.set_title(f"joint {place}" if family == "C" else place)


def growth_figure(plan: Plan) -> Figure:
    """The share of the workspace that is supported, and the worst uncertainty, test by test."""
    figure = new_figure(2.6)
    ax, other = figure.subplots(1, 2)
    number = np.arange(1, len(plan.tests) + 1)
    ax.step(number, [100 * one.supported_so_far for one in plan.tests], where="post", color=GREEN)
    ax.plot(number, [100 * one.supported_so_far for one in plan.tests], "o", color=GREEN, markersize=3)
    ax.set_ylim(-3, 103)
    ax.set_ylabel("workspace supported (%)")
    other.plot(number, [2e6 * one.worst_so_far for one in plan.tests], "o-", color=BLUE, markersize=3)
    other.set_ylim(0, None)
    other.set_ylabel("greatest U, with the prior (nm/N)")
    for one in (ax, other):
        one.set_xlabel("tests made")
        one.xaxis.set_major_locator(MaxNLocator(integer=True))
    return figure
