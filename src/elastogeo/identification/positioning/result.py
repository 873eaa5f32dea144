"""What a positioning test says: frozen numbers only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.identification.positioning.standard import ByTarget, Numbers
from elastogeo.identification.result import Identification
from elastogeo.machine import Array
from elastogeo.observe import MachineTest
from elastogeo.result import Result


@dataclass(frozen=True, slots=True)
class Contribution:
    """What one influence brings to the uncertainty of a value.

    Attributes
    ----------
    label : str
    standard_uncertainty : float [mm or rad]
        That it contributes to the value.
    degrees_of_freedom : float
    """

    label: str
    standard_uncertainty: float
    degrees_of_freedom: float


@dataclass(frozen=True, slots=True)
class StandardValue:
    """One value of ISO 230-2.

    Attributes
    ----------
    name : str
        `A`, `E+`, ...: see `NAMES`.
    value : float [mm or rad]
    estimate : Estimate or None
        With the combined uncertainty; None with one approach of each target, which shows no scatter.
    measurement : float [mm or rad]
        Standard uncertainty of the measurement: of all influences that the test states, and no scatter of the machine.
    contributions : tuple of Contribution
        Greatest first.
    """

    name: str
    value: float
    estimate: Estimate | None
    measurement: float
    contributions: tuple[Contribution, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class PositioningResults(Result):
    """What a positioning test says.

    Attributes
    ----------
    test : MachineTest
    joints : Identification or None
        Of what the test's question asks for; None if that cannot be had.
    refusal : str
        Why not.
    target, sense, reading : array, shape (m,)
        Of every reading: target [mm or rad], direction of approach, deviation [mm or rad], which along the axis counts along
        its own command.
    cycle : array of int, shape (m,)
        In the order of the test.
    targets : ByTarget
    values : mapping of str to StandardValue
    axis : str
    along : bool
        Whether the positioning of the axis itself was read.
    angular : bool
        Whether the deviations are angles [rad].
    rotary : bool
        Whether the targets are.
    levers : mapping of str to float [mm/rad or 1]
        Greatest change of the readings per angular error motion of the axis about X, Y, Z, by name of that component.
    verdict : tuple of Check
        Of the standard's own demands, then of the joints.
    """

    test: MachineTest
    joints: Identification | None
    refusal: str
    target: Array
    sense: Array
    reading: Array
    cycle: Numbers
    targets: ByTarget
    values: Mapping[str, StandardValue]
    axis: str
    along: bool
    angular: bool
    rotary: bool
    levers: Mapping[str, float]
    verdict: tuple[Check, ...] = ()
