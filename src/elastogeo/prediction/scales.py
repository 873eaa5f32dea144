"""The size that a parameter is expected to have: the metric in which support is measured, and the stated prior."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.machine import Array
from elastogeo.sources import Source

TYPICAL_COMPLIANCE = 5e-6
"""Standard deviation [mm/N] of the prior of a translational joint compliance: 200 N/um."""

TYPICAL_LEVER = 300.0
"""Lever [mm] that carries it to rotations and moments."""


def compliance_scales(sources: Sequence[Source], size: float = TYPICAL_COMPLIANCE, lever: float = TYPICAL_LEVER) -> Array:
    """The scale of each compliance, shape (p,), in the parameter's own unit.

    Parameters
    ----------
    sources : sequence of Source, length p
        Compliances.
    size : float [mm/N]
        Of a translation for a force.
    lever : float [mm]
        A rotation is a translation over it, a moment a force times it.
    """
    rotary = np.array([(source.component >= 3) + ((source.load or 0) >= 3) for source in sources], dtype=float)
    return np.asarray(size / lever**rotary)
