"""The trace of a circular test around its nominal circle, a drawing for each force level, all at one magnification."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from elastogeo.identification import CauseParts, RunParts
from elastogeo.machine import Array
from elastogeo.report.drawing.circles import plane_axes
from elastogeo.report.drawing.magnified import Scale, centre_part, scale_for
from elastogeo.report.drawing.plots import Entry, Mark, Place, Plot, Shape
from elastogeo.report.drawing.polar import DIRECTIONS, SENSES, Frame, magnified_note, ring_shapes, trace_line
from elastogeo.report.numbers import pretty, significant
from elastogeo.report.text import UM

WIDTH, HEIGHT = 560.0, 500.0
_MARGIN, _LETTERS = 34.0, 26.0
"""Room for the names of the axes, and height of a written value [px]: letters are larger where a phone shrinks it all."""
_WORDS = {1: "measured, CCW ↺", -1: "measured, CW ↻"}


@dataclass(frozen=True, slots=True)
class Polar:
    """The traces of one force level.

    Attributes
    ----------
    force : float [N]
    title : str
        `500 N`.
    note : str
        What a ring means, and the magnification.
    plot : Plot
    centre : tuple of 2 float [px]
    radius : float [px]
        Of the nominal circle.
    per_um : float [px]
        Of one micrometre of deviation.
    """

    force: float
    title: str
    note: str
    plot: Plot
    centre: Place
    radius: float
    per_um: float

    def to_dict(self) -> dict[str, Any]:
        """As plain values, to be kept as JSON."""
        return {
            "force_N": self.force,
            "title": self.title,
            "note": self.note,
            "plot": self.plot.to_dict(),
            "centre": list(self.centre),
            "radius": self.radius,
            "per_um": self.per_um,
        }


def polars(parts: CauseParts) -> tuple[Polar, ...]:
    """The drawings of a circular test, the highest force first; none of what is no circle.

    The offset of each circle's centre is removed, as ball-bar software does.
    """
    if parts.radius is None or not parts.runs:
        return ()
    scale = scale_for(np.concatenate([_centred(run)[0] for run in parts.runs]), parts.radius)
    axes = plane_axes(parts.diagnosis.identification)
    forces = sorted({run.force for run in parts.runs}, key=abs, reverse=True)
    return tuple(_polar([run for run in parts.runs if run.force == force], force, scale, axes) for force in forces)


def _polar(runs: Sequence[RunParts], force: float, scale: Scale, axes: Sequence[str]) -> Polar:
    frame = Frame(scale, WIDTH, HEIGHT, _MARGIN)
    traces: list[Shape] = []
    models: list[Shape] = []
    for run in sorted(runs, key=lambda run: -run.sense):
        trace, predicted = _centred(run)
        kind, first = DIRECTIONS[run.sense], 0 if (run.angle[-1] - run.angle[0]) * run.sense >= 0 else -1
        begins = frame.at(float(run.angle[first]), float(trace[first]))
        traces.append(trace_line(frame, run.angle, trace, kind, 2.8, traces=len(runs)))
        models.append(trace_line(frame, run.angle, predicted, "ink", 0.7, traces=len(runs)))
        models.append(Mark(*begins, kind=kind, size=4.5))
    senses = sorted({run.sense for run in runs}, reverse=True)
    legend = tuple(Entry("line", DIRECTIONS[sense], _WORDS[sense]) for sense in senses)
    shapes = (*ring_shapes(frame, axes, _LETTERS), *traces, *models)
    return Polar(
        force=force,
        title=f"{force:g} N",
        note=f"{magnified_note(scale)} The offset of the centre is removed.",
        plot=Plot(WIDTH, HEIGHT, shapes, _said(runs, force), (*legend, Entry("line", "ink", "model"))),
        centre=frame.middle,
        radius=frame.ring(0.0),
        per_um=frame.per_unit * scale.magnification / UM,
    )


def _centred(run: RunParts) -> tuple[Array, Array]:
    """The measured and the predicted trace [mm] without what the offset of the measured circle's centre makes of them."""
    offset = centre_part(run.angle, run.measured, run.angle)
    return run.measured - offset, run.predicted - offset


def _said(runs: Sequence[RunParts], force: float) -> str:
    """What the drawing shows, in words."""
    spans = []
    for run in runs:
        trace = _centred(run)[0] * UM
        low, high = (pretty(significant(float(end))) for end in (trace.min(), trace.max()))
        spans.append(f"{SENSES[run.sense]} from {low} to {high} µm")
    return f"Deviation from the circle at {force:g} N, magnified: {'; '.join(spans)}"
