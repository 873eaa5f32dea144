"""What a reading of one test counts against those of the others: one over its variance (feasible weighted least squares).

Instruments scatter differently, and some read angles: no row of one test is worth a row of another by itself. The variance
comes from what each test leaves over of its own best fit, so that a test that contradicts the others is not thought to be
noisy for it. With one test nothing is weighted.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from elastogeo.estimate import RANK_TOLERANCE, Factor
from elastogeo.identification.run_system import with_precision
from elastogeo.identification.systems import Systems, merged

FLOOR = 1e-5
"""Least standard deviation of a reading as a share of the root mean square of the readings: none is read better."""

UNREAD = 1e-3
"""Standard deviation [mm] of a reading, and of an angle [rad] a thousandth of it, where nothing was read: in a plan."""


def weighted(systems: Systems, resolutions: Mapping[str, float | None]) -> Systems:
    """The same systems, each run with the precision of its test.

    Parameters
    ----------
    systems : Systems
        Of several tests.
    resolutions : mapping of str to float or None [mm or rad]
        Of the readings of each test.
    """
    parts = {test: systems.of(test) for test in systems.tests}
    deviation = {test: scatter_of(part, resolutions[test]) for test, part in parts.items()}
    counts = {test: sum(run.factor.rows for run in part.runs) for test, part in parts.items()}
    mean = sum(counts[test] / deviation[test] ** 2 for test in deviation) / sum(counts.values())
    runs = tuple(with_precision(run, 1.0 / deviation[run.test] ** 2 / mean) for run in systems.runs)
    return replace(systems, runs=runs, scatter=deviation)


def scatter_of(systems: Systems, resolution: float | None) -> float:
    """Standard deviation [mm or rad] of a reading of one test, from what its own best fit leaves over.

    At least what its resolution makes of it, and a small share of the readings where nothing is left over.
    """
    factor = merged(systems.runs)
    size = float(np.linalg.norm(factor.triangle[:, -1])) / np.sqrt(max(factor.rows, 1))
    angular = any(run.angular for run in systems.runs)
    least = max(FLOOR * size, (resolution or 0.0) / np.sqrt(12.0)) or UNREAD * (UNREAD if angular else 1.0)
    left, rank = _left_over(factor)
    return max(left / np.sqrt(factor.rows - rank), least) if factor.rows > rank else least


def _left_over(factor: Factor) -> tuple[float, int]:
    """Root of the residual sum of squares of the best fit with any columns, and how many of them are independent."""
    norms = factor.column_norms
    scaled = factor.R[:, norms > 0] / norms[norms > 0]
    U, sizes, _ = np.linalg.svd(scaled, full_matrices=False)
    rank = int(np.sum(sizes > RANK_TOLERANCE * sizes.max(initial=0.0)))
    rest = factor.z - U[:, :rank] @ (U[:, :rank].T @ factor.z)
    return float(np.hypot(np.linalg.norm(rest), factor.residual_norm)), rank
