"""The pictures of an identification, by name; what draws them is imported when a page needs it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from elastogeo.identification import Identification
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
    "local": (
        "Blue: local estimates with their 95 % intervals, each over the force levels it comes from. Dashed: the "
        "global estimate.",
        "Local estimates with their intervals against the global estimate",
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
    """Whether the readings are those of a ball in a nest."""
    return result.test.setup.extra == "ball-deviations"


def _drawn(name: str, result: Identification) -> Figure:
    from elastogeo.report.identification.contributions import contributions_figure
    from elastogeo.report.identification.deviations import deviations_figure
    from elastogeo.report.identification.estimates import local_figure, repeats_figure
    from elastogeo.report.identification.patterns import patterns_figure
    from elastogeo.report.identification.separation import separation_figure
    from elastogeo.report.identification.traces import residuals_figure, traces_figure
    from elastogeo.report.identification.uncertainties import budget_figure, models_figure

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
        "patterns": patterns_figure,
        "separation": separation_figure,
        "local": local_figure,
        "budget": budget_figure,
    }
    return figures[name](result)
