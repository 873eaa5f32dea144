"""`elastogeo.compensation/1`: what a control is told, and what is left of the errors after it.

test : what was tested, as of `elastogeo.identification/1`
control, title : its name, and what its files are
settings : {name: value} of the control
errors : [{name, axis, component, unit, position_unit, zero_at, greatest_before, greatest_after, at_most_after, points}]
    points : [{position, direction, before, uncertainty, correction, after}]; all deviations are actual less nominal;
    `uncertainty` is expanded, for 95 %, and the same before and after; `correction` is what the control adds to the command
left_out : [{names, table, reason, size, uncertainty, why}]
volume : {components, axes, poses, before_um, after_um, at_most_after_um} over the travel of the tests, or null
files : {name: {bytes, text}}
verdict : as of every document
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from elastogeo.machine import SIDES
from elastogeo.prediction.compensation import CompensatedError, Compensation, InVolume
from elastogeo.report.document import document, in_um, tested_together, verdict_entries
from elastogeo.report.scales import scale_of

COMPENSATION_SCHEMA = "elastogeo.compensation/1"


def compensation_json(found: Compensation) -> dict[str, Any]:
    """A compensation as one JSON object (`elastogeo.compensation/1`)."""
    return document(
        COMPENSATION_SCHEMA,
        {
            "test": tested_together(found.campaign, None),
            "control": found.control,
            "title": found.title,
            "settings": dict(found.settings),
            "errors": [_error(one) for one in found.errors],
            "left_out": [
                {
                    "names": out.names,
                    "table": out.table,
                    "reason": out.reason,
                    "size": out.size,
                    "uncertainty": out.doubt,
                    "why": out.why,
                }
                for out in found.left_out
            ],
            "volume": None if found.volume is None else _volume(found.volume),
            "files": {name: {"bytes": len(data), "text": data.decode("utf-8")} for name, data in found.files.items()},
            "verdict": verdict_entries(found.verdict),
        },
    )


def _volume(found: InVolume) -> dict[str, Any]:
    sizes = {"before_um": found.before, "after_um": found.after, "at_most_after_um": found.bound}
    return {
        "components": found.components,
        "axes": found.axes,
        "poses": found.poses,
        **{name: in_um(size) for name, size in sizes.items()},
    }


def _error(one: CompensatedError) -> dict[str, Any]:
    scale = scale_of(one.error)
    return {
        "name": one.error.name,
        "axis": one.error.axis,
        "component": one.error.component,
        "unit": scale.key,
        "position_unit": scale.place_key,
        "zero_at": one.found.zero_at * scale.place_factor,
        "greatest_before": one.before[0] * scale.factor,
        "greatest_after": one.after[0] * scale.factor,
        "at_most_after": one.bound * scale.factor,
        "points": list(_points(one)),
    }


def _points(one: CompensatedError) -> Iterator[dict[str, Any]]:
    scale, before, after, correction = scale_of(one.error), one.error, one.residual, one.correction
    for k, place in enumerate(before.position):
        for side, sign in enumerate(SIDES):
            yield {
                "position": place * scale.place_factor,
                "direction": sign,
                "before": before.value[k, side] * scale.factor,
                "uncertainty": before.uncertainty[k, side] * scale.factor,
                "correction": correction[k, side] * scale.factor,
                "after": after.value[k, side] * scale.factor,
            }
