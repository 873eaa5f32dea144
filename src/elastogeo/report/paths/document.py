"""`elastogeo.path-prediction/1`: the deviation of the tool along a path.

tests : name of the test or campaign it rests on
simulated : from what the readings of the tests are simulated; empty if they were measured
machine : name; topology
path : {name, points, blocks, length_mm}
force, tool : in words; empty without
normal_to : side of the travel to which the normal counts as positive
datum : machine, or probed: less the rigid motion of the workpiece that the unloaded machine's own probe would find
extremes : by component (x, y, z of the workpiece, normal) the least and greatest deviation:
    {value_um, interval95_um, point, way_mm}
points : of at most 2000 points, evenly chosen, with the extremes: [{point, block, way_mm, x_mm, y_mm, z_mm, force_N,
    deviation_um, standard_uncertainty_um, interval95_um, supported, prior_share}], each a list over x, y, z, normal; null
    where nothing is predicted
parts : at the same points, as far as it was split there: by name [{point, value_um, expanded_um}]
verdict : as in `envelope`
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.prediction import DEVIATION_COMPONENTS, PathPrediction
from elastogeo.report.document import UM, document, verdict_entries
from elastogeo.report.paths.rows import main_component, thinned_points

PATH_SCHEMA = "elastogeo.path-prediction/1"
MOST_POINTS = 2000


def path_json(found: PathPrediction) -> dict[str, Any]:
    """A prediction along a path as one JSON object (`elastogeo.path-prediction/1`)."""
    machine = found.path.machine
    return document(
        PATH_SCHEMA,
        {
            "tests": found.name,
            "simulated": found.simulated,
            "machine": machine.name,
            "topology": machine.topology.compact,
            "path": {
                "name": found.path.name,
                "points": len(found.path),
                "blocks": len(np.unique(found.path.block)),
                "length_mm": found.path.travelled[-1],
            },
            "force": found.force,
            "tool": found.tool,
            "normal_to": found.normal_to,
            "datum": found.datum,
            "extremes": _extremes(found),
            "points": point_entries(found),
            "parts": _part_entries(found),
            "verdict": verdict_entries(found.verdict),
        },
    )


def point_entries(found: PathPrediction, most: int = MOST_POINTS) -> list[dict[str, Any]]:
    """The points of a path, thinned."""
    wide = found.expanded
    return [
        {
            "point": at + 1,
            "block": int(found.path.block[at]) + 1,
            "way_mm": float(found.path.travelled[at]),
            **{f"{axis}_mm": float(found.path.points[at, k]) for k, axis in enumerate("xyz")},
            "force_N": found.wrench[at, :3].tolist(),
            "deviation_um": (found.value[at] * UM).tolist(),
            "standard_uncertainty_um": (found.standard_uncertainty[at] * UM).tolist(),
            "interval95_um": [
                [(v - u) * UM, (v + u) * UM] if np.isfinite(u) else None
                for v, u in zip(found.value[at], wide[at], strict=True)
            ],
            "supported": found.supported[at].tolist(),
            "prior_share": found.prior_share[at].tolist(),
        }
        for at in map(int, thinned_points(found.value[:, main_component(found)], most))
    ]


def _part_entries(found: PathPrediction) -> dict[str, Any]:
    return {
        name: [
            {"point": int(at) + 1, "value_um": (value * UM).tolist(), "expanded_um": (wide * UM).tolist()}
            for at, value, wide in zip(found.split_at, part.value, part.expanded, strict=True)
        ]
        for name, part in found.parts.items()
    }


def _extremes(found: PathPrediction) -> dict[str, Any]:
    wide, told = found.expanded, {}
    for k, name in enumerate(DEVIATION_COMPONENTS):
        values = found.value[:, k]
        if np.isfinite(values).any():
            ends = {"least": int(np.nanargmin(values)), "greatest": int(np.nanargmax(values))}
            told[name] = {
                end: {
                    "value_um": values[at] * UM,
                    "interval95_um": [(values[at] - wide[at, k]) * UM, (values[at] + wide[at, k]) * UM]
                    if np.isfinite(wide[at, k])
                    else None,
                    "point": at + 1,
                    "way_mm": float(found.path.travelled[at]),
                }
                for end, at in ends.items()
            }
    return told
