"""`elastogeo.path_compensation/1`: a program with its points moved, and what is left of the deviation along it.

test : what was tested, as of `elastogeo.identification/1`
program : {name, blocks}, of the new program
components : those of x, y, z of the workpiece that are compensated
tolerance_um : by which lines may leave the corrected path
left_out : [{names, reason, size_um, uncertainty_um}]
points : [{way_mm, x_mm, y_mm, z_mm, before_um, uncertainty_um, shift_um, after_um, uncertainty_after_um}], at most 2000 of
    them, evenly chosen; each of the last five a list along x, y, z and the normal (the shift: x, y, z), null where nothing
    is known
verdict : as of every document
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from elastogeo.prediction.compensation import PathCompensation
from elastogeo.report.document import document, in_um, tested_together, verdict_entries
from elastogeo.report.text import UM

PATH_COMPENSATION_SCHEMA = "elastogeo.path_compensation/1"
_MOST = 2000


def path_compensation_json(found: PathCompensation) -> dict[str, Any]:
    """A compensated path as one JSON object (`elastogeo.path_compensation/1`)."""
    return document(
        PATH_COMPENSATION_SCHEMA,
        {
            "test": tested_together(found.campaign, None),
            "program": {"name": found.program.name, "blocks": len(found.program.blocks)},
            "components": found.components,
            "tolerance_um": in_um(found.tolerance),
            "left_out": [
                {"names": out.names, "reason": out.reason, "size_um": in_um(out.size), "uncertainty_um": in_um(out.doubt)}
                for out in found.left_out
            ],
            "points": list(_points(found)),
            "verdict": verdict_entries(found.verdict),
        },
    )


def _points(found: PathCompensation) -> Iterator[dict[str, Any]]:
    path, before, doubt = found.before.path, found.before.value * UM, found.before.expanded * UM
    for k in np.unique(np.linspace(0, len(path) - 1, min(len(path), _MOST)).round().astype(int)):
        x, y, z = path.points[k]
        yield {
            "way_mm": path.travelled[k],
            "x_mm": x,
            "y_mm": y,
            "z_mm": z,
            "before_um": before[k],
            "uncertainty_um": doubt[k],
            "shift_um": found.shift[k] * UM,
            "after_um": found.value[k] * UM,
            "uncertainty_after_um": found.expanded[k] * UM,
        }
