"""Compliance and geometry apart: what each does to the trace, by force level (5.8) and by local estimate (5.12)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from elastogeo.identification import Identification, Response
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import (
    division_note,
    is_angular,
    nominal_radius,
    plane_axes,
    pose_axis,
    rings,
)
from elastogeo.report.drawing.magnified import Scale, around, scale_for
from elastogeo.report.drawing.style import SMALL, force_colours, panels
from elastogeo.report.identification.figures.traces import broken
from elastogeo.report.numbers import significant
from elastogeo.report.text import reading_unit

_PARTS = ("compliance and geometry", "compliance alone", "geometry alone")

_LINE = 0.17
"""Height of a line of the legend [in]."""
_MOST_COLUMNS = 8
_LETTERS = 92
"""Of the legend, in one line."""


@dataclass(frozen=True, slots=True)
class _Line:
    """What the parameters predict of the readings at one force: all of the machine, its compliance, its geometry."""

    name: str
    colour: str
    pose: Array
    parts: tuple[Array, Array, Array]


def separation_figure(result: Identification) -> Figure:
    """Predicted deviations without the set-up: all, compliance alone, geometry alone, at one scale."""
    first = responses_by_force(result)
    colours = force_colours(list(first))
    lines = [_line(result, f"{f:.4g} N", colours[f], one, result.solution.values) for f, one in first.items()]
    last = max(first, key=abs)
    strongest = lines[list(first).index(last)]
    unit = reading_unit(result)
    sizes = (significant(float(np.ptp(part)) * unit.factor) for part in strongest.parts)
    spans = (f"{size} {unit.name} peak to peak at {last:.4g} N" for size in sizes)
    return _figure(result, lines, [f"{what}\n{span}" for what, span in zip(_PARTS, spans, strict=True)])


def local_separation_figure(result: Identification) -> Figure:
    """The same by each local estimate, at the highest of its forces (Figure 5.12): geometry should be one line."""
    first = responses_by_force(result)
    colours = force_colours([float(k) for k in range(len(result.local))]).values()
    lines = [
        _line(result, _forces(local.forces), colour, first[max(local.forces, key=abs)], local.solution.values)
        for local, colour in zip(result.local, colours, strict=True)
    ]
    titles = list(_PARTS)
    if all(np.array_equal(line.pose, lines[0].pose) for line in lines):
        unit = reading_unit(result)
        differ = significant(float(np.ptp([line.parts[2] for line in lines], axis=0).max()) * unit.factor)
        titles[2] += f"\nlocal estimates differ by up to {differ} {unit.name}"
    return _figure(result, lines, titles)


def responses_by_force(result: Identification) -> dict[float, Response]:
    """The response of each force level, in the first of its directions."""
    found: dict[float, Response] = {}
    for one in result.responses:
        found.setdefault(one.force, one)
    return found


def _forces(forces: Sequence[float]) -> str:
    return f"{' and '.join(f'{force:.4g}' for force in forces)} N"


def _line(result: Identification, name: str, colour: str, one: Response, values: Array) -> _Line:
    machine = [bool(p.axis) for p in result.parameters]
    elastic = [bool(p.axis) and p.elastic for p in result.parameters]
    chosen = (np.array(machine), np.array(elastic), np.array(machine) & ~np.array(elastic))
    together, compliance, geometry = (one.columns[:, kept] @ values[kept] for kept in chosen)
    return _Line(name, colour, one.pose, (together, compliance, geometry))


def _figure(result: Identification, lines: Sequence[_Line], titles: Sequence[str]) -> Figure:
    longest = max(len(line.name) for line in lines) + 5
    most = min(_MOST_COLUMNS, max(_LETTERS // longest, 1))
    rows = -(-len(lines) // most)
    below = _LINE * (rows + 1.5)
    if is_angular(result):
        figure = panels(1, 3, 2.05, beside=0.3, above=0.5, below=below + 0.12, one_scale=True)
        note = _around(figure.axes, result, lines)
    else:
        figure = panels(1, 3, 1.7, beside=0.55, above=0.5, below=below + 0.55, one_scale=True)
        note = _along(figure.axes, result, lines)
    for ax, title in zip(figure.axes, titles, strict=True):
        ax.set_title(title, fontsize=SMALL, pad=13 if is_angular(result) else 6)
    handles = [Line2D([], [], color=line.colour, linewidth=2.0, label=line.name) for line in lines]
    columns = -(-len(lines) // rows)
    figure.legend(handles=handles, loc="lower center", ncols=columns, columnspacing=1.4, title=note, title_fontsize=SMALL)
    return figure


def _around(axes: Sequence[Axes], result: Identification, lines: Sequence[_Line]) -> str:
    scale: Scale = scale_for(np.concatenate([part for line in lines for part in line.parts]), nominal_radius(result) or 1.0)
    for k, ax in enumerate(axes):
        rings(ax, scale, plane_axes(result))
        for line in lines:
            ax.plot(*around(line.pose, line.parts[k], scale, 3 * len(lines)), color=line.colour, zorder=3)
    return division_note(scale, nominal_radius(result) is not None)


def _along(axes: Sequence[Axes], result: Identification, lines: Sequence[_Line]) -> str:
    (label, factor), unit = pose_axis(result), reading_unit(result)
    for k, ax in enumerate(axes):
        for line in lines:
            pose, values = broken(line.pose, line.parts[k] * unit.factor)
            ax.plot(pose * factor, values, color=line.colour)
        ax.set_xlabel(label)
    axes[0].set_ylabel(f"deviation ({unit.name})")
    return ""
