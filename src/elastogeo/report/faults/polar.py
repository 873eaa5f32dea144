"""The trace of a circular test around its nominal circle, a drawing for each force level, all at one magnification."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, radians, sin
from typing import Any

import numpy as np

from elastogeo.identification import CauseParts, RunParts
from elastogeo.machine import Array
from elastogeo.report.document import UM
from elastogeo.report.drawing.circles import division_note, plane_axes
from elastogeo.report.drawing.magnified import Scale, around, centre_part, scale_for
from elastogeo.report.drawing.plots import Circle, Entry, Line, Mark, Place, Plot, Shape, Text
from elastogeo.report.numbers import pretty, significant

WIDTH, HEIGHT = 560.0, 500.0
_OUTER = 216.0
"""From the centre to the outermost ring [px]."""
_COLOURS = {1: "blue", -1: "orange"}
_WORDS = {1: "measured, CCW ↺", -1: "measured, CW ↻"}
_VALUES_AT = radians(67.5)
"""Angle [rad] at which the rings are labelled."""
_NAMES = (("start", 10.0, 4.0), ("middle", 0.0, -8.0), ("end", -10.0, 4.0), ("middle", 0.0, 16.0))
"""Where the names of the four directions stand, beyond the outermost ring [px]."""


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
    per_mm = _OUTER / (scale.radius + scale.outer * scale.division * scale.magnification)
    centre = (WIDTH / 2, HEIGHT / 2)

    def placed(angle: Array, deviation: Array) -> tuple[Place, ...]:
        x, y = around(angle, deviation, scale, len(runs))
        return tuple(_pixel(centre[0] + per_mm * a, centre[1] - per_mm * b) for a, b in zip(x, y, strict=True))

    shapes: list[Shape] = [*_rings(scale, per_mm, centre), *_directions(centre, axes)]
    measured: list[Shape] = []
    for run in sorted(runs, key=lambda run: -run.sense):
        trace, predicted = _centred(run)
        line = placed(run.angle, trace)
        begins = line[0] if (run.angle[-1] - run.angle[0]) * run.sense >= 0 else placed(run.angle[::-1], trace[::-1])[0]
        shapes.append(Line(line, _COLOURS[run.sense], 2.8))
        measured += [Line(placed(run.angle, predicted), "ink", 0.7), Mark(*begins, kind=_COLOURS[run.sense], size=4.5)]
    shown = [_COLOURS[sense] for sense in sorted({run.sense for run in runs}, reverse=True)]
    legend = tuple(Entry("line", kind, _WORDS[sense]) for sense, kind in _COLOURS.items() if kind in shown)
    return Polar(
        force=force,
        title=f"{force:g} N",
        note=f"{division_note(scale, to_scale=True)}; the offset of the centre is removed.".replace("one", "One", 1),
        plot=Plot(WIDTH, HEIGHT, (*shapes, *measured), _said(runs, force), (*legend, Entry("line", "ink", "model"))),
        centre=centre,
        radius=per_mm * scale.radius,
        per_um=per_mm * scale.magnification / UM,
    )


def _pixel(x: float, y: float) -> Place:
    """A point to a hundredth of a pixel, so that what is kept stays small."""
    return round(float(x), 2), round(float(y), 2)


def _centred(run: RunParts) -> tuple[Array, Array]:
    """The measured and the predicted trace [mm] without what the offset of the measured circle's centre makes of them."""
    offset = centre_part(run.angle, run.measured, run.angle)
    return run.measured - offset, run.predicted - offset


def _rings(scale: Scale, per_mm: float, centre: Place) -> list[Shape]:
    shapes: list[Shape] = []
    values: list[Shape] = []
    for k in range(scale.inner, scale.outer + 1):
        radius = per_mm * (scale.radius + k * scale.division * scale.magnification)
        kind, width = ("soft", 1.2) if k == 0 else ("line", 0.8)
        shapes.append(Circle(*centre, radius, kind, width=width))
        text = f"{k * scale.division * UM:+g}".replace("-", "−") if k else "0 µm"
        at = (centre[0] + radius * cos(_VALUES_AT), centre[1] - radius * sin(_VALUES_AT))
        values.append(Text(at[0], at[1] + 4, text, "middle", size=12))
    return [*shapes, *values]


def _directions(centre: Place, axes: Sequence[str]) -> list[Shape]:
    names = [f"+{axes[0]}", f"+{axes[1]}", f"−{axes[0]}", f"−{axes[1]}"] if axes else ["0°", "90°", "180°", "270°"]
    shapes: list[Shape] = []
    for k, (anchor, right, down) in enumerate(_NAMES):
        x, y = centre[0] + _OUTER * cos(radians(90 * k)), centre[1] - _OUTER * sin(radians(90 * k))
        shapes += [Line((centre, (x, y)), "line", 0.6), Text(x + right, y + down, names[k], anchor, "ink")]
    return shapes


def _said(runs: Sequence[RunParts], force: float) -> str:
    """What the drawing shows, in words."""
    spans = []
    for run in runs:
        trace = _centred(run)[0] * UM
        low, high = (pretty(significant(float(end))) for end in (trace.min(), trace.max()))
        spans.append(f"{'CCW' if run.sense > 0 else 'CW'} from {low} to {high} µm")
    return f"Deviation from the circle at {force:g} N, magnified: {'; '.join(spans)}"
