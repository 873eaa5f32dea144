"""How much each parameter or fault moves the readings: ranked bars with their 95 % intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import fill
from typing import Any

from matplotlib.figure import Figure
from matplotlib.patches import Patch

from elastogeo.identification import Identification, Parameter
from elastogeo.report.drawing.style import BLUE, FAINT, GREY, INK, ORANGE, new_figure
from elastogeo.report.numbers import significant
from elastogeo.report.text import UM, label, reading_unit

COMPLIANCE, GEOMETRY, MOTION, SETUP, UNTOLD = "compliance", "geometry", "geometry, motion", "set-up", "not distinguished"
_LOOKS: dict[str, dict[str, Any]] = {
    COMPLIANCE: {"facecolor": BLUE},
    GEOMETRY: {"facecolor": ORANGE},
    MOTION: {"facecolor": ORANGE},
    SETUP: {"facecolor": GREY},
    UNTOLD: {"facecolor": "white", "edgecolor": GREY, "hatch": "////", "linewidth": 0.6},
}
_PALE = 0.4
_LINE = 26


@dataclass(frozen=True, slots=True)
class Bar:
    """One bar: its name, its length and 95 % interval [µm], its share, what kind of fault it is, and whether it is sure."""

    name: str
    length: float
    low: float
    high: float
    share: str
    kind: str
    sure: bool


def contributions_figure(result: Identification) -> Figure:
    """Peak-to-peak part of each parameter in the trace at the highest force, signed, greatest first."""
    bars, unit = [], reading_unit(result)
    for p in sorted(result.parameters, key=lambda p: abs(p.peak_to_peak)):
        per_unit = p.peak_to_peak / p.value * unit.factor if p.value else 0.0
        low, high = sorted(bound * per_unit for bound in p.interval or (p.value, p.value))
        share, sure = f" · {100 * p.share:.1f} %" if p.share else "", not low <= 0 <= high
        bars.append(Bar(fill(label(p), _LINE), p.peak_to_peak * unit.factor, low, high, share, kind_of(result, [p]), sure))
    return ranked(result, bars)


def kind_of(result: Identification, members: Sequence[Parameter]) -> str:
    """Of what kind the parameters are, for the colour of their bar."""
    if not all(p.separated for p in members):
        return UNTOLD
    if members[0].elastic:
        return COMPLIANCE
    if not members[0].axis:
        return SETUP
    errors = [p.name for p in result.parameters if p.axis and not p.elastic]
    return GEOMETRY if all(name.startswith("E_") for name in errors) else MOTION


def _resolution(result: Identification) -> float | None:
    """The coarsest resolution [um, or urad where all readings are angles] of the tests that state one."""
    unit, tests = reading_unit(result), result.campaign.tests.values()
    alike = [test for test in tests if test.setup.reads_angles == (unit.factor != UM)]
    stated = [test.resolution * unit.factor for test in alike if test.resolution is not None]
    return max(stated, default=None)


def ranked(result: Identification, bars: Sequence[Bar]) -> Figure:
    """Bars with their intervals, the last on top."""
    lines = max(1.25 if "\n" in bar.name else 1.0 for bar in bars)
    figure = new_figure(0.95 + 0.25 * lines * len(bars))
    ax = figure.subplots()
    resolution, unit = _resolution(result), reading_unit(result).name
    if resolution is not None:
        ax.axvspan(-resolution, resolution, color=FAINT, zorder=0, linewidth=0)
    for k, bar in enumerate(bars):
        ax.barh(k, bar.length, height=0.62, alpha=1.0 if bar.sure else _PALE, zorder=2, **_LOOKS[bar.kind])
        ax.plot([bar.low, bar.high], [k, k], color=INK, linewidth=1.0, marker="|", markersize=5, zorder=4)
    ax.axvline(0, color=INK, linewidth=0.7, zorder=3)
    ax.set_yticks(range(len(bars)), [bar.name for bar in bars])
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    ax.set_ylim(-0.6, len(bars) - 0.4)
    ax.margins(x=0.03)
    beside = ax.twinx()
    beside.set_yticks(range(len(bars)), [f"{significant(bar.length)} {unit}{bar.share}".replace("-", "−") for bar in bars])
    beside.set_ylim(ax.get_ylim())
    beside.tick_params(axis="y", length=0)
    beside.spines["left"].set_visible(False)
    force = max((level.force for level in result.levels), key=abs)
    text = f"peak to peak at {force:g} N ({unit}); line: 95 % interval"
    ax.set_xlabel(text if resolution is None else f"{text}; grey: ± resolution")
    kinds = [kind for kind in _LOOKS if any(bar.kind == kind for bar in bars)]
    if len(kinds) > 1:
        handles = [Patch(label=kind, **_LOOKS[kind]) for kind in kinds]
        figure.legend(handles=handles, loc="outside upper center", ncols=len(handles))
    return figure
