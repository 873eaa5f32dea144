"""The pictures of an identification, by name; what draws them is imported when a page needs it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from elastogeo.identification import Identification, shows_deviations
from elastogeo.report.view import Picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CAPTIONS = {
    "traces": (
        "Measured and predicted deviations, CCW in blue, CW in orange, stronger with the force; the offset of the "
        "circle's centre "
        "is removed.",
        "Measured and predicted traces of every force level",
    ),
    "residuals": (
        "What the parameters leave unexplained, one panel per force level. Noise looks like grass; a wave is something the "
        "model does not know.",
        "Measured minus predicted readings of every force level",
    ),
    "contributions": (
        "Contribution of each parameter to the trace at the highest force, greatest first, with its 95 % interval. "
        "Pale: it may "
        "be none.",
        "Contribution of each parameter to the trace, in micrometres, with its interval",
    ),
    "patterns": (
        "The trace that each parameter produces by itself, scaled to its own size: blue outward, orange inward of "
        "the nominal "
        "circle. Parameters in one panel produce the same trace.",
        "Response pattern of each group of parameters",
    ),
    "separation": (
        "Predicted deviations without the set-up, all at one scale: what grows with the force is the machine's "
        "compliance, what "
        "stays is its geometry.",
        "What compliance and geometry together, compliance alone and geometry alone do to the trace",
    ),
    "parts": (
        "What each parameter does to the trace at the highest force, with its peak to peak. Solid: the global estimate; "
        "dotted: the local estimate of the highest force levels.",
        "Trace of each parameter by itself at the highest force",
    ),
    "local-separation": (
        "The same by each local estimate, at the higher of its two forces. A machine's geometry does not depend on the "
        "force: where it seems to, the model of the compliance lacks something, or the estimates scatter.",
        "What compliance and geometry do to the trace by each local estimate",
    ),
    "local-traces": (
        "Measured deviations and what the local estimates predict of them: two lines where a level has neighbours on both "
        "sides.",
        "Measured traces and those predicted by local estimates",
    ),
    "local": (
        "Blue: local estimates with their standard uncertainties, each over the force levels it comes from. Orange, dashed: "
        "the global estimate with its 95 % interval. Green, dotted: the model whose compliances change with the force, with "
        "the 95 % band of its scatter.",
        "Local estimates against the global estimate and the linear model",
    ),
    "models": (
        "Error of each model: one that only follows the noise gets better at all readings and worse at those left out.",
        "Error of each model over all readings, at left-out runs and at left-out force levels",
    ),
    "budget": (
        "Share of each influence in the variance of each parameter. What dominates here is what to improve first.",
        "Share of each influence in the variance of each parameter",
    ),
    "repeats": (
        "Dots: every combination of one run per level. Dashed: the estimate from all repeated runs with its 95 % interval.",
        "Estimates from every combination of repeated runs",
    ),
}

_DEVIATIONS = (
    "Deviation of the tool from the workpiece ball along X, Y and Z of the machine, over the poses; above, where the rotary "
    "axes are.",
    "Deviations of the ball in the nest in X, Y and Z, measured and predicted, over the rotary axes",
)
"""Of the traces of a nest."""

_ALONG = ("Measured and predicted readings of every force level.", "Measured and predicted readings of every force level")
"""Of traces that do not go around a circle."""


def picture(name: str, result: Identification) -> Picture:
    """A picture of an identification."""
    caption, alternative = _CAPTIONS[name]
    if name == "traces" and in_a_nest(result):
        caption, alternative = _DEVIATIONS
    elif name == "traces" and result.test.setup.pose_quantity != "angle":
        caption, alternative = _ALONG
    return Picture(name, caption, alternative, lambda: _drawn(name, result))


def in_a_nest(result: Identification) -> bool:
    """Whether the readings show where a ball goes in its nest."""
    return shows_deviations(result.test)


def _drawn(name: str, result: Identification) -> Figure:
    from elastogeo.report.identification.figures.contributions import contributions_figure
    from elastogeo.report.identification.figures.deviations import deviations_figure
    from elastogeo.report.identification.figures.estimates import local_figure, repeats_figure
    from elastogeo.report.identification.figures.parts import parts_figure
    from elastogeo.report.identification.figures.patterns import patterns_figure
    from elastogeo.report.identification.figures.separation import local_separation_figure, separation_figure
    from elastogeo.report.identification.figures.traces import local_traces_figure, residuals_figure, traces_figure
    from elastogeo.report.identification.figures.uncertainties import budget_figure, models_figure

    if name == "traces" and in_a_nest(result):
        return deviations_figure(result)
    if name == "models":
        assert result.models is not None
        return models_figure(result.models)
    if name == "repeats":
        assert result.repeats is not None
        return repeats_figure(result, result.repeats)
    figures = {
        "traces": traces_figure,
        "residuals": residuals_figure,
        "contributions": contributions_figure,
        "parts": parts_figure,
        "patterns": patterns_figure,
        "separation": separation_figure,
        "local-separation": local_separation_figure,
        "local": local_figure,
        "local-traces": local_traces_figure,
        "budget": budget_figure,
    }
    return figures[name](result)
