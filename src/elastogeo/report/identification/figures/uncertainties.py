"""Where the uncertainty comes from, and which model of the compliance the data support."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from elastogeo.identification import Identification, ModelChoice
from elastogeo.report.drawing.style import BLUE, GREEN, GREY, INK, ORANGE, new_figure
from elastogeo.report.identification.models import model_said, shown_models
from elastogeo.report.text import UM, labels

_COLOURS = (BLUE, ORANGE, GREEN, "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1")
_REST = "all others"


def budget_figure(result: Identification) -> Figure:
    """For each parameter the share of its variance that each influence brings."""
    shares = _variance_shares(result)
    names = list(shares)
    shown = [*names[: len(_COLOURS)], *([_REST] if len(names) > len(_COLOURS) else [])]
    rows = list(labels(result).values())[::-1]
    figure = new_figure(0.9 + 0.27 * len(rows))
    ax = figure.subplots()
    left = np.zeros(len(rows))
    for name, colour in zip(shown, (*_COLOURS, GREY), strict=False):
        part = np.sum([shares[other] for other in names[len(_COLOURS) :]], axis=0) if name == _REST else shares[name]
        width = 100 * np.asarray(part)[::-1]
        ax.barh(range(len(rows)), width, left=left, color=colour, height=0.66, label=name, edgecolor="white", linewidth=0.5)
        left += width
    ax.set_yticks(range(len(rows)), rows)
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    ax.set_xlim(0, 100)
    ax.set_ylim(-0.6, len(rows) - 0.4)
    ax.set_xlabel("share of the variance of the parameter (%)")
    figure.legend(loc="outside upper left", ncols=4, columnspacing=1.4, handlelength=1.2)
    return figure


def models_figure(models: ModelChoice) -> Figure:
    """Error of each model: over all readings, at left-out runs, at left-out force levels."""
    shown = shown_models(models)[::-1]
    figure = new_figure(1.05 + 0.33 * len(shown))
    ax = figure.subplots()
    for k, model in enumerate(shown):
        found = ((model.rmse, GREY, "o"), (model.left_out_run, BLUE, "D"), (model.left_out_level, ORANGE, "s"))
        known = [error * UM for error, _, _ in found if error is not None]
        ax.plot([min(known), max(known)], [k, k], color="#d9d9d9", linewidth=1.0, zorder=1)
        for error, colour, marker in found:
            if error is not None:
                ax.plot([error * UM], [k], color=colour, marker=marker, markersize=6, linestyle="", zorder=2)
    for name, colour, marker in (
        ("all readings", GREY, "o"),
        ("left-out runs", BLUE, "D"),
        ("left-out force levels", ORANGE, "s"),
    ):
        ax.plot([], [], color=colour, marker=marker, markersize=6, linestyle="", label=name)
    ticks = [f"{model_said(m.name)}, {m.parameters} parameters" for m in shown]
    ax.set_yticks(range(len(ticks)), ticks, color=INK)
    for text, model in zip(ax.get_yticklabels(), shown, strict=True):
        text.set_fontweight("bold" if model.name == models.supported else "normal")
    ax.tick_params(axis="y", length=0)
    ax.set_ylim(-0.6, len(ticks) - 0.4)
    ax.margins(x=0.08)
    ax.set_xlabel("RMSE (µm); bold: the model that the data support")
    figure.legend(loc="outside upper right", ncols=3, columnspacing=1.4)
    return figure


def _variance_shares(result: Identification) -> dict[str, list[float]]:
    """Of each influence in the variance of each parameter, 0 to 1; the influence that matters most first."""
    names = list(dict.fromkeys(line.label for lines in result.budget.lines for line in lines))
    shares: dict[str, list[float]] = {name: [] for name in names}
    for lines in result.budget.lines:
        total = sum(line.contribution**2 for line in lines) or 1.0
        found = {line.label: line.contribution**2 / total for line in lines}
        for name in names:
            shares[name].append(found.get(name, 0.0))
    return dict(sorted(shares.items(), key=lambda item: -sum(item[1])))
