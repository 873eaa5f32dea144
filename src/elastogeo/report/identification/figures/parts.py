"""What each parameter does to the trace at the highest force: globally (5.9, 5.10), by the last two levels (5.13, 5.14)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from elastogeo.identification import Identification
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import is_angular, pose_axis
from elastogeo.report.drawing.style import BLUE, GREEN, GREY, INK, ORANGE, SMALL, panels
from elastogeo.report.identification.figures.separation import responses_by_force
from elastogeo.report.identification.figures.traces import broken
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import all_separated, label, reading_unit

_COLOURS = (BLUE, ORANGE, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1")
_SMALL_PART = 0.25
"""Parts smaller than this share of the greatest of their kind get a panel, and a scale, of their own."""
_LOCAL = (0, (1.2, 1.6))
_LINE = 0.17
"""Height of a line of a legend [in]."""
_LETTERS, _LONGEST, _BESIDE_NAME = 92, 30, 13
"""Letters across the figure, of a name at most, and of what stands beside a name."""


@dataclass(frozen=True, slots=True)
class _Part:
    """The trace of one parameter, in the unit of the readings; by the local estimate too, where there is one."""

    name: str
    values: Array
    local: Array | None

    @property
    def span(self) -> float:
        return float(np.ptp([0.0, *self.values]))


def parts_figure(result: Identification) -> Figure:
    """The trace of each parameter of the machine; small ones beside the great ones, at a scale of their own."""
    first = responses_by_force(result)
    force = max(first, key=abs)
    pose = first[force].pose
    kinds = [
        (f"{kind}, {size}" if size else kind, parts)
        for kind, of_kind in _by_kind(result, force).items()
        for size, parts in _by_size(of_kind)
    ]
    columns = min(2, len(kinds))
    rows = -(-len(kinds) // columns)
    entries = max(min(len(parts), len(_COLOURS)) for _, parts in kinds)
    longest = max(len(part.name) for _, parts in kinds for part in parts) + _BESIDE_NAME
    per_line = max(_LETTERS // columns // longest, 1)
    legend = _LINE * -(-entries // per_line)
    figure = panels(rows, columns, 1.55, beside=0.62, above=0.25, below=legend + 0.5, between=legend + 0.6)
    (name, factor), unit = pose_axis(result), reading_unit(result).name
    for ax, (title, parts) in zip(figure.axes, kinds, strict=False):
        _panel(ax, pose * factor, title, parts, per_line, unit)
        if is_angular(result):
            ax.xaxis.set_major_locator(MultipleLocator(90))
    for spare in figure.axes[len(kinds) :]:
        spare.remove()
    figure.text(0.5, 0.04 / figure.get_figheight(), name, ha="center", va="bottom")
    loaded = f" at {force:.4g} N" if force else ""
    figure.text(0.02, 0.5, f"deviation{loaded} ({unit})", rotation=90, ha="left", va="center")
    return figure


def _by_kind(result: Identification, force: float) -> dict[str, list[_Part]]:
    """The parts of compliance and of geometry; of all together, where the two are not distinguished."""
    columns = responses_by_force(result)[force].columns * reading_unit(result).factor
    local = next((one.solution.values for one in reversed(result.local) if force in one.forces), None)
    kinds: dict[str, list[_Part]] = {}
    for k, p in enumerate(result.parameters):
        if p.axis:
            kind = ("compliance" if p.elastic else "geometry") if all_separated(result) else "not distinguished"
            part = _Part(_short(label(p)), columns[:, k] * p.value, None if local is None else columns[:, k] * local[k])
            kinds.setdefault(kind, []).append(part)
    return {kind: sorted(parts, key=lambda part: part.span, reverse=True) for kind, parts in kinds.items()}


def _by_size(parts: Sequence[_Part]) -> list[tuple[str, list[_Part]]]:
    """The great ones, and those that would be a flat line beside them."""
    great = [part for part in parts if part.span >= _SMALL_PART * parts[0].span]
    small = [part for part in parts if part.span < _SMALL_PART * parts[0].span]
    return [("greatest parts", great), ("smaller parts", small)] if small else [("", great)]


def _panel(ax: Axes, pose: Array, title: str, parts: Sequence[_Part], per_line: int, unit: str) -> None:
    for part, colour in zip(parts, _COLOURS, strict=False):
        said = pretty(f"{part.name}, {significant(part.span)} {unit}")
        ax.plot(*broken(pose, part.values), color=colour, label=said)
        if part.local is not None:
            ax.plot(*broken(pose, part.local), color=colour, linewidth=1.0, linestyle=_LOCAL)
    ax.axhline(0, color=INK, linewidth=0.6, zorder=1)
    left = len(parts) - len(_COLOURS)
    ax.set_title(title, loc="left", fontweight="bold", pad=4)
    ax.set_title(f"and {left} smaller" if left > 0 else "", loc="right", fontsize=SMALL, color=GREY, pad=4)
    ax.legend(
        loc="upper left", bbox_to_anchor=(0.0, -0.13), ncols=per_line, handlelength=1.2, columnspacing=1.0, borderpad=0.0
    )
    ax.margins(x=0.01)


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST else f"{name[: _LONGEST - 1]}…"
