"""A test with a rig of known compliance in the loop: its compliance against that without, and the rig's (Eq. 6.16)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.drive import RigCheck, rig_check, with_rig
from elastogeo.identification.rollers.stiffness import Stiffness
from elastogeo.machine import Array
from elastogeo.observe import Rig


@dataclass(frozen=True, slots=True, eq=False)
class RigTest:
    """What the test with the rig says (section 6.6.3, Figures 6.13, 6.14).

    Attributes
    ----------
    without, measured : Stiffness
        Slope of the supported law at the greatest engagement, without the rig and with it.
    rig : array, shape (k,) [mm/N]
        Compliance of the rig in each direction.
    predicted : array, shape (k,) [mm/N]
        That without it and the rig's own.
    predicted_uncertainty : array, shape (k,) [mm/N]
        Standard uncertainty of what the prediction does not share with the measurement: scatter, and the rig's own.
    check : RigCheck
        Whether measured and predicted agree, in each direction.
    engagements : tuple of float [mm]
        Commanded, of the levels of the test with the rig.
    secants, increments : tuple of Stiffness
        With the rig, as in `StiffnessMap`.
    """

    without: Stiffness
    measured: Stiffness
    rig: Array
    predicted: Array
    predicted_uncertainty: Array
    check: RigCheck
    engagements: tuple[float, ...]
    secants: tuple[Stiffness, ...]
    increments: tuple[Stiffness, ...]

    @property
    def softest(self) -> int:
        """Index of the direction in which the rig gives way most."""
        return int(np.argmax(self.rig))


def compare_with_rig(
    without: Stiffness,
    measured: Stiffness,
    rigs: Sequence[Rig],
    engagements: tuple[float, ...],
    secants: tuple[Stiffness, ...],
    increments: tuple[Stiffness, ...],
) -> RigTest:
    """Eq. 6.16 in every direction; what drives and set-up share between the two tests does not count twice."""
    angle = without.angle
    rig = np.sum([one.along(angle) for one in rigs], axis=0)
    own = np.linalg.norm([without.scatter, *(one.standard_uncertainty * one.share(angle) for one in rigs)], axis=0)
    systematic = [np.linalg.norm(found.systematic, axis=0) for found in (without, measured)]
    predicted = with_rig(without.compliance, rig)
    check = rig_check(
        measured.compliance,
        measured.scatter,
        predicted,
        own,
        freedom=(measured.scatter_freedom, without.scatter_freedom),
        u_shared=np.abs(systematic[1] - systematic[0]),
    )
    return RigTest(without, measured, rig, predicted, own, check, engagements, secants, increments)
