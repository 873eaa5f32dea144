"""How much each parameter, and each fault of a diagnosis, moves the readings: ranked bars with their 95 % intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import fill

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from elastogeo.identify import Diagnosis, Fault, Identification, Parameter
from elastogeo.report.findings import described, distortion_interval
from elastogeo.report.style import BLUE, FAINT, GREY, INK, ORANGE, SMALL, new_figure
from elastogeo.report.text import UM, in_micrometres, label

COMPLIANCE, GEOMETRY, MOTION, SETUP, UNTOLD = "compliance", "geometry", "geometry, motion", "set-up", "not told apart"
_COLOURS = {COMPLIANCE: BLUE, GEOMETRY: ORANGE, MOTION: ORANGE, SETUP: GREY, UNTOLD: "#ffffff"}
_LINE, _WORDS = 26, 40


@dataclass(frozen=True, slots=True)
class _Bar:
    """One bar: its name, its length and 95 % interval [µm], what kind of fault it is, and a note."""

    name: str
    length: float
    low: float
    high: float
    kind: str
    note: str


def contributions_figure(result: Identification) -> Figure:
    """Peak-to-peak part of each parameter in the trace at the highest force [µm], signed, greatest first."""
    ranked = sorted(result.parameters, key=lambda p: abs(p.peak_to_peak))
    bars = []
    for p in ranked:
        per_unit = p.peak_to_peak / p.value if p.value else 0.0
        low, high = sorted(bound * per_unit * UM for bound in p.interval)
        note = f"{in_micrometres(p.peak_to_peak)} µm · {100 * p.share:.1f} %"
        bars.append(_Bar(fill(label(p), _LINE), p.peak_to_peak * UM, low, high, _kind(result, [p]), note))
    return _ranked(result, bars, "parameter")


def diagnosis_figure(diagnosis: Diagnosis, result: Identification) -> Figure:
    """Distortion of the trace by each fault [µm], signed, greatest first, the set-up last; pale if it may be none."""
    bars = []
    for fault in reversed(diagnosis.faults):
        shown = described(fault, result)
        low, high = (bound * UM for bound in distortion_interval(fault, result))
        members = [p for p in result.parameters if p.name in fault.names]
        share = f" · {100 * fault.share:.1f} %" if fault.axis else ""
        sure = "" if fault.significant else " · may be none"
        name = fill(shown.meaning if shown.separated else shown.title, _WORDS)
        note = f"{in_micrometres(fault.distortion)} µm{share}{sure}"
        bars.append(_Bar(name, fault.distortion * UM, low, high, _kind(result, members), note))
    return _ranked(result, bars, "fault")


def _kind(result: Identification, members: Sequence[Parameter]) -> str:
    if not all(p.separated for p in members):
        return UNTOLD
    if members[0].elastic:
        return COMPLIANCE
    if not members[0].axis:
        return SETUP
    errors = [p.name for p in result.parameters if p.axis and not p.elastic]
    return GEOMETRY if all(name.startswith("E_") for name in errors) else MOTION


def _ranked(result: Identification, bars: Sequence[_Bar], what: str) -> Figure:
    lines = max(1.25 if "\n" in bar.name else 1.0 for bar in bars)
    figure = new_figure(0.95 + 0.27 * lines * len(bars))
    ax = figure.subplots()
    if result.test.resolution is not None:
        resolution = result.test.resolution * UM
        ax.axvspan(-resolution, resolution, color=FAINT, zorder=0, linewidth=0)
    for k, bar in enumerate(bars):
        untold = {"edgecolor": GREY, "hatch": "////", "linewidth": 0.6} if bar.kind == UNTOLD else {}
        ax.barh(k, bar.length, color=_COLOURS[bar.kind], height=0.62, zorder=2, **untold)
        ax.plot([bar.low, bar.high], [k, k], color=INK, linewidth=1.0, marker="|", markersize=5, zorder=4)
        end, side, aligned = (bar.high, 5, "left") if bar.length >= 0 else (bar.low, -5, "right")
        note, frame = bar.note.replace("-", "−"), "offset points"
        ax.annotate(note, (end, k), (side, 0), textcoords=frame, ha=aligned, va="center", fontsize=SMALL, zorder=4)
    ax.axvline(0, color=INK, linewidth=0.7, zorder=3)
    ax.set_yticks(range(len(bars)), [bar.name for bar in bars])
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    ax.set_ylim(-0.6, len(bars) - 0.4)
    _make_room(ax, min(0.0, *(bar.low for bar in bars)), max(0.0, *(bar.high for bar in bars)))
    force = max((level.force for level in result.levels), key=abs)
    text = f"peak to peak at {force:g} N, with the sign of the {what} (µm); line: 95 % interval"
    ax.set_xlabel(text if result.test.resolution is None else f"{text}; grey: ± resolution")
    kinds = [kind for kind in _COLOURS if any(bar.kind == kind for bar in bars)]
    hatched = {UNTOLD: {"hatch": "////", "edgecolor": GREY}}
    handles = [Patch(facecolor=_COLOURS[kind], label=kind, **hatched.get(kind, {})) for kind in kinds]
    if len(kinds) > 1:
        figure.legend(handles=handles, loc="outside upper right", ncols=len(handles))
    return figure


def _make_room(ax: Axes, low: float, high: float) -> None:
    """Room for the notes at the ends of the bars."""
    room = 0.30 * ((high - low) or 1.0)
    ax.set_xlim(low - (room if low < 0 else 0.02 * room), high + (room if high > 0 else 0.02 * room))
