"""Estimates beside one another: local against global with force, and from every combination of repeats."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elastogeo.estimate import Repeatability
from elastogeo.identification import Identification, VariableCompliance
from elastogeo.machine import Array
from elastogeo.report.drawing.style import BLUE, GREEN, GREY, INK, ORANGE, SMALL, multiples
from elastogeo.report.numbers import DisplayUnit
from elastogeo.report.text import display_units, label, labels

_LONG = 12
"""Names from this many letters on leave no room for the unit beside them."""


def local_figure(result: Identification) -> Figure:
    """Local estimates with standard uncertainties against the global one (4.13), and the linear model (5.15, 5.16)."""
    shown = display_units(result)
    over = "" if result.reference_force is None else f" over {result.reference_force:g} N"
    figure, axes = _small(list(labels(result).values()), f"force{over} (N)")
    for ax, parameter in zip(axes, result.parameters, strict=True):
        unit = shown[parameter.name]
        _whole(ax, parameter.value * unit.factor, np.array(parameter.interval or (parameter.value,) * 2) * unit.factor)
        _local(ax, [local.forces for local in result.local], *_of(result, parameter.name, unit.factor))
        if result.variable is not None:
            _linear(ax, result.variable, parameter.name, [level.force for level in result.levels], unit.factor)
        _label(ax, label(parameter), unit)
    return figure


def repeats_figure(result: Identification, repeats: Repeatability) -> Figure:
    """Estimates from every combination of repeated runs, their mean, and its run-level 95 % interval (Figure 4.15)."""
    shown = display_units(result)
    shown_as = labels(result)
    solution, bounds = repeats.solution, repeats.solution.interval()
    figure, axes = _small([shown_as[name] for name in solution.labels], "combination of one run per level")
    number = np.arange(1, len(repeats.combinations) + 1)
    for k, (ax, name) in enumerate(zip(axes, solution.labels, strict=True)):
        unit = shown[name]
        _whole(ax, solution.values[k] * unit.factor, bounds[k] * unit.factor)
        ax.plot(number, repeats.combinations[:, k] * unit.factor, color=BLUE, marker="o", markersize=2.8, linestyle="")
        _label(ax, shown_as[name], unit)
    return figure


def _of(result: Identification, name: str, factor: float) -> tuple[Array, Array]:
    """Local values of a parameter and their standard uncertainties."""
    k = result.solution.labels.index(name)
    values = [(local.solution.values[k], local.solution.standard_uncertainty[k]) for local in result.local]
    return np.array(values)[:, 0] * factor, np.array(values)[:, 1] * factor


def _local(ax: Axes, forces: Sequence[Sequence[float]], values: Array, halves: Array) -> None:
    """Local estimates over the forces that they come from."""
    middle = [sum(some) / len(some) for some in forces]
    ax.hlines(values, [min(some) for some in forces], [max(some) for some in forces], color=BLUE, linewidth=0.8, alpha=0.6)
    ax.vlines(middle, values - halves, values + halves, color=BLUE, linewidth=1.2)
    ends = [*(values - halves), *(values + halves)]
    ax.plot([*middle, *middle], ends, color=BLUE, linestyle="", marker="_", markersize=5, markeredgewidth=1.2)
    ax.plot(middle, values, color=BLUE, marker="o", markersize=3.5, linestyle="")


def _small(names: Sequence[str], xlabel: str) -> tuple[Figure, list[Axes]]:
    """A panel for each of some parameters."""
    above = 0.4 if any(len(name) > _LONG for name in names) else 0.25
    return multiples(len(names), 3 if len(names) != 4 else 2, 1.36, above, xlabel)


def _linear(ax: Axes, model: VariableCompliance, name: str, forces: Sequence[float], factor: float) -> None:
    """The parameter by the model whose compliances change with the force, and how far its scatter lets it be elsewhere."""
    at = np.linspace(min(forces), max(forces), 9)
    found = [model.at(name, force) for force in at]
    value = np.array([one.value for one in found]) * factor
    ax.plot(at[[0, -1]], value[[0, -1]], color=GREEN, linewidth=1.4, linestyle=(0, (1, 1.2)), zorder=3)
    if model.by_run:
        low, high = ax.get_ylim()
        half = np.array([one.expanded() for one in found]) * factor
        ax.fill_between(at, value - half, value + half, color=GREEN, alpha=0.16, linewidth=0, zorder=0)
        ax.set_ylim(min(low, value.min()), max(high, value.max()))


def _whole(ax: Axes, value: float, interval: Array) -> None:
    """The estimate from everything, with its interval."""
    ax.axhspan(interval[0], interval[1], color=ORANGE, alpha=0.22, linewidth=0, zorder=0)
    ax.axhline(value, color=ORANGE, linewidth=1.0, linestyle=(0, (5, 2)), zorder=1)


def _label(ax: Axes, name: str, unit: DisplayUnit) -> None:
    if len(name) > _LONG:
        ax.set_title(f"{name}\n{unit.name}", loc="left", fontsize=SMALL, color=INK, pad=4)
    else:
        ax.set_title(name, loc="left", weight="bold", color=INK, pad=4)
        ax.set_title(unit.name, loc="right", fontsize=SMALL, color=GREY, pad=4)
    ax.ticklabel_format(axis="y", useOffset=False)
    ax.locator_params(axis="y", nbins=5)
    ax.margins(x=0.06, y=0.12)
