"""What the sliders of a page compute with: of each run its angles, readings and the part of each cause.

radius_mm : nominal radius of the circle
resolution_um : what lengths are rounded to, 0 if they are not
causes : [[name, ...]], the parameters of each cause, greatest distortion first
runs : {run: {force_N, direction, deg, measured, predicted, columns}}
    The first run of each direction ("ccw", "cw") at each force level; `deg` [deg], `measured`, `predicted` [um], shape (n,);
    `columns` [um], shape (causes, n), what each cause does as it is now. With `f` times each cause
    `measured[i] - sum_k (1 - f[k]) columns[k][i]` would be measured, as a what-if says it; circular and radial deviation
    follow from it as in ISO 230-4, about the centre of the minimum zone and of least squares.

A run of very many readings is thinned, if its circular and radial deviations stay what they are.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from elastogeo.identification import CauseParts, RunParts, thinned_parts
from elastogeo.machine import Array
from elastogeo.report.document import UM

PLACES = 4
"""To which lengths are rounded for a page: a tenth of a nanometre, far below what is shown."""
_MORE = 2
"""Places that angles [deg] have more: at 1 m that is the same length."""
_MANY = 500
"""Readings of a run from which on it is thinned."""
_SAME = 2e-5
"""By how much [mm] a deviation may change when a run is thinned: less than the last digit that is shown of 10 um."""


def for_a_page(parts: CauseParts) -> CauseParts:
    """As many readings as a page needs to draw a circle and to find its deviations."""
    return thinned_parts(parts, _MANY, _SAME)


def columns_document(parts: CauseParts, places: int | None = PLACES) -> dict[str, Any]:
    """What the sliders of a page compute with, as plain types; without runs for what is no circle.

    Parameters
    ----------
    parts : CauseParts
    places : int, optional
        Decimal places of lengths [um]; None keeps every digit.
    """
    return {
        "radius_mm": parts.radius,
        "resolution_um": 0.0 if places is None else 10.0**-places,
        "causes": [list(cause.names) for cause in parts.causes],
        "runs": {run.run: _run(run, places) for run in parts.runs},
    }


def _run(run: RunParts, places: int | None) -> dict[str, Any]:
    return {
        "force_N": run.force,
        "direction": "ccw" if run.sense > 0 else "cw",
        "deg": _rounded(np.degrees(run.angle), None if places is None else places + _MORE),
        "measured": _rounded(run.measured * UM, places),
        "predicted": _rounded(run.predicted * UM, places),
        "columns": [_rounded(part * UM, places) for part in run.parts],
    }


def _rounded(values: Array, places: int | None) -> list[float]:
    return [float(value) if places is None else round(float(value), places) + 0.0 for value in values]
