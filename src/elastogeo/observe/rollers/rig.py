"""A compliant rig: a part of known compliance in the loop, to hold a measured compliance against (section 6.6.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Angle, Array, LengthPerForce


@dataclass(frozen=True, slots=True)
class Rig:
    """A part that is put in series with the machine.

    Attributes
    ----------
    compliance, standard_uncertainty : float [mm/N]
    angle : float or None [rad]
        Direction in which it gives way, in the plane of the test; None if it does so in all alike.
    """

    compliance: LengthPerForce
    standard_uncertainty: LengthPerForce = 0.0
    angle: Angle | None = None

    def __post_init__(self) -> None:
        """Refuse what is no compliance."""
        if not (self.compliance > 0 and self.standard_uncertainty >= 0):
            raise InputError(
                f"the rig has the compliance {self.compliance:g} mm/N, give or take {self.standard_uncertainty:g}; "
                f"it must be positive, its uncertainty not negative"
            )

    def along(self, angle: Array) -> Array:
        """Its compliance in directions of the plane, shape (k,) [mm/N]: with `cos^2` of the angle to its own."""
        return self.compliance * self.share(angle)

    def share(self, angle: Array) -> Array:
        """Which share of its compliance acts in directions of the plane, shape (k,)."""
        return np.ones(len(angle)) if self.angle is None else np.cos(angle - self.angle) ** 2
