"""The result of identified feed drives: what is known of each axis, by which model, and how the models compare."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from elastogeo.drive import BalanceFit, DriveTest, LeftOut, RunScore, Structure
from elastogeo.estimate import Estimate
from elastogeo.identification.check import Check
from elastogeo.result import Result

NEVER_NEGATIVE = ("inertia", "viscous", "viscous forward", "viscous backward", "coulomb", "stribeck")
"""Parameters that are negative in no drive. A negative Stribeck excess is the smooth sign in another dress."""


@dataclass(frozen=True, slots=True)
class DriveParameter:
    """One identified parameter of a balance.

    Attributes
    ----------
    name, unit, meaning : str
    estimate : Estimate
        In `unit`.
    stands_for : mapping of str to float
        The combination that it is: itself alone if it is told from all others.
    at_motor : tuple of (Estimate, str), or None
        With its unit at the motor's shaft, where the transmission is known and it differs there.
    """

    name: str
    unit: str
    meaning: str
    estimate: Estimate
    stands_for: Mapping[str, float]
    at_motor: tuple[Estimate, str] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ModelScore:
    """A model in the comparison.

    Attributes
    ----------
    name : str
    fit : BalanceFit
        From all runs that are not held out, on the samples that every model can use.
    parameters : tuple of DriveParameter
        Of that fit.
    left_out : LeftOut
        Each run from all others.
    held_out : tuple of RunScore
        The held-out runs, from all others; empty if there are none, or they hold a load that was not identified.
    gain : float
        Share by which the error at left-out runs is below that of the first model.
    better : bool
        Whether it predicts left-out runs better than the first model, surely (95 % over the runs).
    """

    name: str
    fit: BalanceFit
    parameters: tuple[DriveParameter, ...]
    left_out: LeftOut
    held_out: tuple[RunScore, ...]
    gain: float
    better: bool

    @property
    def impossible(self) -> tuple[str, ...]:
        """Parameters whose value no drive can have: it would move by its own friction or inertia."""
        values = zip(self.fit.solution.labels, self.fit.solution.values, strict=True)
        return tuple(label for label, value in values if label in NEVER_NEGATIVE and value < 0)


@dataclass(frozen=True, slots=True)
class Rest:
    """What the records show of a standstill, and what leaving it out does.

    Attributes
    ----------
    share : float
        Of the samples that are at rest, or that a low-pass ties to a rest.
    used : float
        Share of the samples used that are so.
    speed : float [mm/s; rad/s of a rotary axis]
        That noise and ringing show at rest; the greatest of the records.
    left_out, kept : float or None [unit of the effort]
        Error at left-out runs, at their moving samples alone, of the plain model that is identified without the rest and
        with it; None if no run can be left out, or there is no rest.
    worse : bool
        Whether leaving the rest out predicts surely worse.
    """

    share: float
    used: float
    speed: float
    left_out: float | None = None
    kept: float | None = None
    worse: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class AxisDrive:
    """What is known of one axis.

    Attributes
    ----------
    axis, effort_unit : str
    fit : BalanceFit or None
        Of the model that is shown; None if the axis cannot be identified at all.
    model : str
        Name of that model.
    refusal : str
        Why the axis cannot be identified.
    parameters : tuple of DriveParameter
        Of the fit; a combination where terms are not distinguished.
    identified : tuple of RunScore
        How well the runs are fitted that it was identified from.
    held_out : tuple of RunScore
        How well the runs are predicted that it was not identified from.
    left_out : LeftOut or None
        Each run of the identified ones from the others.
    models : tuple of ModelScore
        Compared models on the samples that all of them can use; empty if none were.
    supported : str
        Name of the model that the runs support; empty if none were compared.
    not_compared : mapping of str to str
        Why a model is not in the comparison, by its name; why none is, by `LEFT_OUT`.
    structure : Structure or None
    rest : Rest or None
    verdict : tuple of Check
    """

    axis: str
    effort_unit: str
    fit: BalanceFit | None
    model: str = ""
    refusal: str = ""
    parameters: tuple[DriveParameter, ...] = ()
    identified: tuple[RunScore, ...] = ()
    held_out: tuple[RunScore, ...] = ()
    left_out: LeftOut | None = None
    models: tuple[ModelScore, ...] = ()
    supported: str = ""
    not_compared: Mapping[str, str] = field(default_factory=dict)
    structure: Structure | None = None
    rest: Rest | None = None
    verdict: tuple[Check, ...] = ()


LEFT_OUT = "left-out runs"
"""Key of `AxisDrive.not_compared` for the reason why no run was left out."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DriveIdentification(Result):
    """The drives of a test.

    Attributes
    ----------
    test : DriveTest
    axes : tuple of AxisDrive
    """

    test: DriveTest
    axes: tuple[AxisDrive, ...]

    @property
    def verdict(self) -> tuple[Check, ...]:
        """Checks of all axes; their names begin with the axis."""
        return tuple(replace(check, name=f"{axis.axis}: {check.name}") for axis in self.axes for check in axis.verdict)
