"""What the analysis of a static test says: frozen results, of numbers and reasons only."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.identification.result import Identification
from elastogeo.identification.static_tests.by_run import Counted
from elastogeo.identification.static_tests.cartesian import CartesianCompliance, Symmetry
from elastogeo.identification.static_tests.drive_train import OnAxis
from elastogeo.identification.static_tests.hysteresis import StaticHysteresis
from elastogeo.identification.static_tests.principal import Principal
from elastogeo.identification.static_tests.straight_line import StaticLine
from elastogeo.machine import Array
from elastogeo.observe import SensorTwist
from elastogeo.result import Result


@dataclass(frozen=True, slots=True)
class LoadedRun:
    """One run of a static force.

    Attributes
    ----------
    run : str
    force : array, shape (m,) [N]
        Along the direction of its place.
    displacement : array, shape (m,) [mm]
        Along the sensor; turned to the direction of the force where the sensor reads against it.
    hysteresis : StaticHysteresis or None
    refusal : str
        Why there is no hysteresis.
    """

    run: str
    force: Array
    displacement: Array
    hysteresis: StaticHysteresis | None
    refusal: str = ""


@dataclass(frozen=True, slots=True)
class LoadedPlace:
    """All runs that load the machine at one place along one line.

    Attributes
    ----------
    commands : mapping of str to float [mm, rad]
        Where the machine stands.
    direction : array, shape (3,)
        In which the force counts as positive, in the foundation.
    along : bool
        Whether the sensor reads along the force; across it, a compliance may have either sign.
    runs : tuple of LoadedRun
    line : StaticLine or None
        Straight line through all readings, whose zero counts as one.
    refusal : str
        Why there is no line.
    drive : OnAxis or None
        Where the loaded axis yields, if positions were recorded and the force is along a linear axis.
    drive_refusal : str
        Why recorded positions do not tell it.
    """

    commands: Mapping[str, float]
    direction: Array
    along: bool
    runs: tuple[LoadedRun, ...]
    line: StaticLine | None
    refusal: str = ""
    drive: OnAxis | None = None
    drive_refusal: str = ""


@dataclass(frozen=True, slots=True)
class Cartesian:
    """The Cartesian compliance that displacement probes show, and all that follows from it.

    Attributes
    ----------
    compliance : CartesianCompliance
        In the foundation; of probes on a turning table, the mean over its angles. Stated influences are in its uncertainty.
    zeroed : bool
        Whether the probes count as zeroed without load, because no zero was asked for.
    stiffness : array, shape (3, 3) [N/mm], or None
    stiffness_uncertainty : array, shape (3, 3) [N/mm], or None
        Standard uncertainty of each element, to first order; infinite where the runs are too few.
    symmetry : Symmetry or None
    principal : tuple of 3 Principal
        The softest first; empty if the compliance is not determined.
    refusal : str
        Why something of it is not there.
    """

    compliance: CartesianCompliance
    zeroed: bool
    stiffness: Array | None
    stiffness_uncertainty: Array | None
    symmetry: Symmetry | None
    principal: tuple[Principal, ...]
    refusal: str


@dataclass(frozen=True, slots=True)
class LoadStep:
    """The twist of the tool at one load.

    Attributes
    ----------
    force : float [N]
        Mean of its readings.
    readings : int
    twist : array, shape (6,) [mm, rad]
        Mean of the readings. It is of one run: nothing shows its uncertainty.
    """

    force: float
    readings: int
    twist: Array


@dataclass(frozen=True, slots=True)
class TwistRun:
    """What the sensor frame says of one run.

    Attributes
    ----------
    run : str
    force : array, shape (m,) [N]
        Its size, with its sign where its direction is known.
    twist : SensorTwist
        Along the axes in which the sensors are given.
    steps : tuple of LoadStep
        In the order of time.
    """

    run: str
    force: Array
    twist: SensorTwist
    steps: tuple[LoadStep, ...]

    @property
    def greatest(self) -> LoadStep:
        """The step of the greatest load."""
        return max(self.steps, key=lambda step: abs(step.force))


@dataclass(frozen=True, slots=True)
class TwistPlace:
    """Twist per force of all runs that load a sensor frame at one place along one line.

    Attributes
    ----------
    commands : mapping of str to float [mm, rad]
        Where the machine stands.
    direction : array, shape (3,)
        In which the force counts as positive, in the foundation.
    runs : tuple of str
    compliance : tuple of 6 Estimate [mm/N, rad/N]
        Slope of the straight line through each component, along the axes in which the sensors are given.
    counted : Counted
        What its uncertainties assume.
    """

    commands: Mapping[str, float]
    direction: Array
    runs: tuple[str, ...]
    compliance: tuple[Estimate, ...]
    counted: Counted


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class StaticResults(Result):
    """What a static test says.

    Attributes
    ----------
    joints : Identification
        Of what the test's question asks for.
    places : tuple of LoadedPlace
        Of a static force; else empty.
    cartesian : Cartesian or None
        Of displacement probes.
    twists : tuple of TwistRun
        Of a sensor frame; else empty.
    twist_places : tuple of TwistPlace
        Of a sensor frame that was loaded at two forces at least; else empty.
    refusal : str
        Why a sensor frame gives no twist.
    verdict : tuple of Check
        Of the instrument's own results, then of the joints.
    """

    joints: Identification
    places: tuple[LoadedPlace, ...] = ()
    cartesian: Cartesian | None = None
    twists: tuple[TwistRun, ...] = ()
    twist_places: tuple[TwistPlace, ...] = ()
    refusal: str = ""
    verdict: tuple[Check, ...] = ()
