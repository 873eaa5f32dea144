"""Stiffness by direction, of one kind, with its uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.estimate import coverage_factor, effective_degrees_of_freedom
from elastogeo.machine import Array

SECANT, INCREMENT, MODELLED = "secant", "increment", "modelled"
"""Kinds of stiffness: force over deflection from none on (Eq. 6.5), between two engagements, slope of the supported law."""


@dataclass(frozen=True, slots=True, eq=False)
class Stiffness:
    """Volumetric compliance and stiffness in k directions.

    Attributes
    ----------
    kind : str
        `SECANT`: with what the path is off in it, and with all that gives way before the least engagement. `INCREMENT`:
        between two engagements, free of both. `MODELLED`: the slope of the law that the engagements support.
    force : tuple of float [N]
        The level at which it holds, the two between which it holds, or none for all levels.
    angle : array, shape (k,) [rad]
        In the plane of the test.
    compliance : array, shape (k,) [mm/N]
    scatter : array, shape (k,) [mm/N]
        Standard uncertainty from the scatter of the runs; infinite where no runs are left to show any.
    scatter_freedom : int
    systematic : array, shape (n, k) [mm/N]
        What each uncertain quantity of drives and set-up contributes, by one standard uncertainty of it.
    labels : tuple of str, length n
    freedoms : tuple of float, length n
    """

    kind: str
    force: tuple[float, ...]
    angle: Array
    compliance: Array
    scatter: Array
    scatter_freedom: int
    systematic: Array
    labels: tuple[str, ...]
    freedoms: tuple[float, ...]

    @property
    def standard_uncertainty(self) -> Array:
        """Shape (k,) [mm/N]: scatter and all that is systematic."""
        return np.asarray(np.sqrt(self.scatter**2 + np.sum(self.systematic**2, axis=0)))

    @property
    def degrees_of_freedom(self) -> Array:
        """Effective ones of the standard uncertainty, shape (k,) (JCGM 100, G.4)."""
        if not np.isfinite(self.scatter).all():
            return np.ones(len(self.scatter))
        parts = np.column_stack([self.scatter, *self.systematic])
        freedoms = np.array([max(self.scatter_freedom, 1), *self.freedoms], dtype=float)
        return effective_degrees_of_freedom(parts, freedoms, ["scatter", *self.labels])

    @property
    def interval(self) -> Array:
        """95 %, shape (k, 2) [mm/N]."""
        half = coverage_factor(self.degrees_of_freedom) * self.standard_uncertainty
        return np.column_stack([self.compliance - half, self.compliance + half])

    @property
    def stiffness(self) -> Array:
        """Shape (k,) [N/mm]; infinite where the compliance is not positive."""
        return _inverse(self.compliance)

    @property
    def stiffness_interval(self) -> Array:
        """Shape (k, 2) [N/mm]; without an upper bound where the compliance may be zero."""
        return _inverse(self.interval[:, ::-1])

    def contribution(self, label: str) -> Array:
        """Standard uncertainty that all quantities of one label contribute, shape (k,) [mm/N]."""
        return np.asarray(np.linalg.norm(self.systematic[[name == label for name in self.labels]], axis=0))


def _inverse(compliance: Array) -> Array:
    positive = compliance > 0
    return np.where(positive, 1.0 / np.where(positive, compliance, 1.0), np.inf)
