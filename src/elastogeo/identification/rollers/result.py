"""The result of a ball-roller test: stiffness by direction, each kind of it under its name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from elastogeo.drive import MotorParameter, TorqueBalance
from elastogeo.identification.check import Check
from elastogeo.identification.result import Identification
from elastogeo.identification.rollers.dynamometer import AgainstDynamometer
from elastogeo.identification.rollers.laws import LawChoice
from elastogeo.identification.rollers.rig_test import RigTest
from elastogeo.identification.rollers.stiffness import Stiffness
from elastogeo.identification.rollers.torque_parts import TorqueParts
from elastogeo.machine import Array
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class StiffnessMap(Result):
    """What a ball-roller test says.

    Attributes
    ----------
    joints : Identification
        Of what the test's own question asks for.
    modelled : tuple of Stiffness
        Of the supported law: one for all levels if the compliance is constant, else one at each level.
    secants : tuple of Stiffness
        At each level (Eq. 6.5).
    increments : tuple of Stiffness
        From each level to the next.
    law : LawChoice
    path : array, shape (k,) [mm]
        What the supported law leaves to the path in each direction.
    balances : mapping of str to TorqueBalance
        Of the drives, by axis.
    motors : mapping of str to tuple of MotorParameter
        The balances as the motors feel them, by axis (Table 6.4).
    engagements : tuple of float [mm]
        Commanded, of each level: the mean of its runs.
    torques : tuple of TorqueParts
        What each motor takes along a run of the greatest engagement.
    dynamometer : AgainstDynamometer or None
        Of the force from the currents with the one that was measured, if one was.
    rig : RigTest or None
        Whether compliance with a rig is that without it and the rig's, in each direction.
    verdict : tuple of Check
    """

    joints: Identification
    modelled: tuple[Stiffness, ...]
    secants: tuple[Stiffness, ...]
    increments: tuple[Stiffness, ...]
    law: LawChoice
    path: Array
    balances: Mapping[str, TorqueBalance]
    motors: Mapping[str, tuple[MotorParameter, ...]]
    engagements: tuple[float, ...]
    torques: tuple[TorqueParts, ...]
    dynamometer: AgainstDynamometer | None
    rig: RigTest | None
    verdict: tuple[Check, ...]

    @property
    def overall(self) -> Stiffness:
        """That of all levels; at the greatest, where there is no single one; the last increment, where no law holds."""
        return self.modelled[-1] if self.law.follows else self.increments[-1]
