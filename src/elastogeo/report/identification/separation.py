"""Compliance and geometry apart (Figures 5.8 and 5.12): what each of them does to the trace, by force level."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from elastogeo.identification import Identification, Trace, systems_of
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import (
    Scale,
    around,
    division_note,
    is_angular,
    nominal_radius,
    pose_axis,
    rings,
    scale_for,
)
from elastogeo.report.drawing.style import SMALL, force_colours, new_figure, thinned
from elastogeo.report.identification.traces import of_level
from elastogeo.report.numbers import significant
from elastogeo.report.text import UM, all_separated

_TOGETHER, _ELASTIC, _GEOMETRIC = "compliance and geometry", "compliance alone", "geometry alone"

_BELOW_TITLES = 0.93


def has_both(result: Identification) -> bool:
    """Whether compliance and geometry of the machine were both identified, and told apart."""
    kinds = {parameter.elastic for parameter in result.parameters if parameter.axis}
    return len(kinds) == 2 and all_separated(result)


def separation_figure(result: Identification) -> Figure:
    """Predicted deviations without the set-up: all, compliance alone, geometry alone, at one scale."""
    first = {level.force: next(t for t, again in of_level(result, level.force) if not again) for level in result.levels}
    parts = _parts(result, list(first.values()))
    colours = force_colours(list(first))
    draw = _around if is_angular(result) else _along
    figure = new_figure(3.1 if is_angular(result) else 2.6, top=_BELOW_TITLES)
    axes = list(figure.subplots(1, 3, sharex=True, sharey=True))
    note = draw(axes, result, first, parts, colours)
    highest = max(first, key=abs)
    for ax, (what, values) in zip(axes, parts.items(), strict=True):
        span = significant(float(np.ptp(values[first[highest].run])) * UM)
        ax.set_title(f"{what}\n{span} µm peak to peak at {highest:g} N", fontsize=SMALL, pad=13)
    handles = [Line2D([], [], color=colour, linewidth=2.0, label=f"{force:g} N") for force, colour in colours.items()]
    columns = min(len(handles), 8)
    figure.legend(
        handles=handles, loc="outside lower center", ncols=columns, columnspacing=1.4, title=note, title_fontsize=SMALL
    )
    return figure


def _parts(result: Identification, traces: list[Trace]) -> dict[str, dict[str, Array]]:
    """For all of the machine, for its compliance and for its geometry, the deviation [mm] by run."""
    runs = {run.name: run for run in systems_of(result.test).runs}
    machine = [parameter for parameter in result.parameters if parameter.axis]
    chosen = {
        _TOGETHER: machine,
        _ELASTIC: [parameter for parameter in machine if parameter.elastic],
        _GEOMETRIC: [parameter for parameter in machine if not parameter.elastic],
    }
    return {
        what: {
            trace.run: runs[trace.run].design_of([p.name for p in parameters]) @ np.array([p.value for p in parameters])
            for trace in traces
        }
        for what, parameters in chosen.items()
    }


def _around(
    axes: list[Axes],
    result: Identification,
    traces: dict[float, Trace],
    parts: dict[str, dict[str, Array]],
    colours: dict[float, str],
) -> str:
    every = np.concatenate([values for part in parts.values() for values in part.values()])
    scale: Scale = scale_for(every, nominal_radius(result) or 1.0)
    for ax, part in zip(axes, parts.values(), strict=True):
        rings(ax, scale)
        for force, trace in traces.items():
            ax.plot(*around(trace.pose, part[trace.run], scale, 3 * len(traces)), color=colours[force], zorder=3)
    return division_note(scale, nominal_radius(result) is not None)


def _along(
    axes: list[Axes],
    result: Identification,
    traces: dict[float, Trace],
    parts: dict[str, dict[str, Array]],
    colours: dict[float, str],
) -> str:
    label, factor = pose_axis(result)
    for ax, part in zip(axes, parts.values(), strict=True):
        for force, trace in traces.items():
            pose, values = thinned(trace.pose, part[trace.run] * UM, 3 * len(traces))
            ax.plot(pose * factor, values, color=colours[force])
        ax.set_xlabel(label)
    axes[0].set_ylabel("deviation (µm)")
    return ""
