"""What an identification says: frozen results, of numbers only. Tables, figures and pages are made from them elsewhere."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from elastogeo.equality import ByValue
from elastogeo.errors import SelectionError
from elastogeo.estimate import Confounding, Estimate, Repeatability, Solution
from elastogeo.identification.budget import Agreement, Budget
from elastogeo.identification.campaigns.agreement import TestsAgreement
from elastogeo.identification.campaigns.parts import TestPart
from elastogeo.identification.change import Change
from elastogeo.identification.check import Check
from elastogeo.identification.fit import Fit
from elastogeo.identification.model_choice.missing_geometry import MissingGeometry
from elastogeo.identification.model_choice.result import ModelChoice
from elastogeo.identification.model_choice.variable_compliance import VariableCompliance
from elastogeo.identification.physics import Consistency
from elastogeo.machine import Array
from elastogeo.observe import Campaign, MachineTest
from elastogeo.result import Part, Result
from elastogeo.sources import Sign


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Parameter(Part):
    """An identified parameter.

    Attributes
    ----------
    name, unit, meaning : str
    value : float
        In `unit`.
    estimate : Estimate or None
        The value with its uncertainty, all influences in it; None where the runs are too few for one, or a reference level
        is subtracted.
    interval : tuple of 2 float or None
        95 % coverage interval; None where there is no `estimate`.
    stands_for : dict of str to float
        The exact combination that it represents: coefficient by name, itself first.
    peak_to_peak : float [mm, or rad where all readings are angles]
        Range of its part of the trace at the highest force, zero included, with the sign of the value: what shifts all
        readings alike counts in full.
    share : float
        Of the sum of all absolute ranges but those of the set-up, 0 to 1; 0 for the set-up.
    axis : str
        The axis it sits at; empty for the set-up.
    elastic : bool
        Whether a load drives it.
    separated : bool
        Whether what it stands for is all elastic or all geometric. If not, no name is right: the test cannot tell.
    sign : Sign or None
        What the sign of its value means for the axis.
    truth : float or None
        Of simulated readings that say it: what `stands_for` truly amounts to, in `unit`.
    """

    name: str
    unit: str
    meaning: str
    value: float
    estimate: Estimate | None
    interval: tuple[float, float] | None
    stands_for: dict[str, float]
    peak_to_peak: float
    share: float
    axis: str
    elastic: bool
    separated: bool
    sign: Sign | None = None
    truth: float | None = None

    @property
    def holds_truth(self) -> bool | None:
        """Whether the interval holds the truth; None without either."""
        if self.truth is None or self.interval is None:
            return None
        return self.interval[0] <= self.truth <= self.interval[1]

    @property
    def expanded(self) -> float | None:
        """Expanded uncertainty U, in `unit`: half the width of `interval`; None without one."""
        return None if self.interval is None else (self.interval[1] - self.interval[0]) / 2

    @property
    def reach(self) -> float:
        """Greatest absolute value, in `unit`, that the parameter may have: the farther end of its interval, or the value."""
        return abs(self.value) if self.interval is None else max(map(abs, self.interval))

    @property
    def standard_uncertainty(self) -> float | None:
        """Combined standard uncertainty, in `unit` (JCGM 100, 5.1); None without `estimate`."""
        return None if self.estimate is None else self.estimate.standard_uncertainty

    @property
    def degrees_of_freedom(self) -> float | None:
        """Effective degrees of freedom of the standard uncertainty (JCGM 100, G.4); None without `estimate`."""
        return None if self.estimate is None else self.estimate.degrees_of_freedom


@dataclass(frozen=True, slots=True)
class Trace:
    """Measured and predicted readings of one run, less the reference if one was subtracted, and less the run's own set-up.

    Attributes
    ----------
    run : str
    force : float [N]
    pose : array, shape (m,) [rad or mm]
        What the run file counts along: the angle of a ball bar.
    measured, predicted : array, shape (m,) [mm or rad]
    test : str
        Name of the test in the campaign.
    """

    run: str
    force: float
    pose: Array
    measured: Array
    predicted: Array
    test: str = ""


@dataclass(frozen=True, slots=True)
class Level:
    """Fit at one force level.

    Attributes
    ----------
    force : float [N]
    readings : int
    rmse : float [mm]
        Eq. 5.40.
    fitness : float or None [%]
        Eq. 5.41; None if nothing was measured to vary.
    elastic, geometric : tuple of 2 float [mm]
        Least and greatest predicted deviation that compliance, and that geometry without the set-up, cause (Figure 5.8).
    variable : Fit or None
        Of the model whose compliances change with the force (Table 5.9).
    local : Fit or None
        Of the local estimates that this level is part of, one or two: their predictions together.
    test : str
        Name of the test in the campaign.
    """

    force: float
    readings: int
    rmse: float
    fitness: float | None
    elastic: tuple[float, float]
    geometric: tuple[float, float]
    variable: Fit | None = None
    local: Fit | None = None
    test: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Response(ByValue):
    """What a unit of each retained parameter does to the readings of one run, at a few of its poses: for drawing.

    `columns @ values` is the trace that values of the parameters predict.

    Attributes
    ----------
    run : str
    force : float [N]
    pose : array, shape (k,)
        As in `Trace`.
    columns : array, shape (k, p)
        In the order of the solution.
    """

    run: str
    force: float
    pose: Array
    columns: Array


@dataclass(frozen=True, slots=True)
class Local:
    """A local estimate from a few force levels (Eq. 4.29).

    Attributes
    ----------
    forces : tuple of float [N]
    solution : Solution
    peak_to_peak : dict of str to float [mm]
        Of each parameter's part of the trace at the highest force, signed.
    """

    forces: tuple[float, ...]
    solution: Solution
    peak_to_peak: dict[str, float]


@dataclass(frozen=True, slots=True)
class Pattern:
    """The response of a reading to parameters that cannot be distinguished (Table 4.4).

    Attributes
    ----------
    names : tuple of str
    pose : array, shape (m,)
    response : array, shape (m,)
        Scaled to a greatest absolute value of 1.
    test : str
        Name of the first test that shows it.
    """

    names: tuple[str, ...]
    pose: Array
    response: Array
    test: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Identification(Result):
    """All that a test says, or several tests of one machine together: `result["C_XXX"]` is one of its parameters.

    Attributes
    ----------
    campaign : Campaign
        The tests, as they were given; one test is a campaign of one.
    tests : tuple of TestPart
        What each of them adds.
    together : tuple of str
        Of several tests, the parameters that none determines alone.
    information : dict of str to dict of str to float
        Of several tests, by parameter and test: 1 less the variance with all over that without this test.
    reference_force : float or None [N]
        Force level that was subtracted.
    parameters : tuple of Parameter
        The retained set.
    confounding : Confounding
    solution : Solution
        Global estimate of the retained set (Eqs. 4.28, 5.37). Its covariance assumes independent runs where `by_run` is
        set, on independent readings where not.
    naive : Solution
        The same values with the covariance that assumes independent readings.
    by_run : bool
        Whether the runs are enough for an uncertainty by run.
    unshown : tuple of str
        Parameters that have none all the same, since they rest on hardly more than one run.
    budget : Budget
        Standard uncertainties with the systematic influences.
    local_change : Change or None
        Whether the local estimates differ by more than their uncertainty.
    minimum_norm : dict of str to float
        Minimum-norm solution over all parameters that were asked for.
    traces : sequence of Trace
        Of several tests each is made when it is asked for, of readings that are observed again.
    levels : tuple of Level
    local : tuple of Local
        From adjacent force levels; empty for several tests.
    repeats : Repeatability or None
        From the levels that were repeated, if at least two were.
    patterns : tuple of Pattern
    responses : tuple of Response
        Of the first run of each force level in each direction; empty for several tests.
    variable : VariableCompliance or None
        The model whose compliances change with the force, where the runs determine it.
    set_up : dict of str to dict of str to float [mm]
        Of each run its own set-up: where its circle really lies. Empty where it is one for all runs, or not in the model.
    corrected : dict of str to float
        How much greater each parameter would be if what was subtracted from the readings (`Observations.correction`: the
        deflection of the set-up, Eq. 5.38) were left in them; empty if nothing was.
    rmse : float [mm]
        Over all readings; of several tests over those that read lengths, if any do.
    agreement : Agreement or None
        Of the first-order budget with random draws; None if the test states no systematic influence.
    models : ModelChoice or None
        Models of the compliance against the force; None with a reference level, fewer than three levels, or no compliance.
    consistency : Consistency or None
        Whether the compliances agree with physics; None if none was asked for, or they are not told from geometry.
    missing_geometry : MissingGeometry or None
        The answer with geometry that the data support besides; None unless physics is contradicted and there is such.
    tests_agreement : TestsAgreement or None
        Of several tests, whether they agree, and how well all others predict each.
    verdict : tuple of Check
    """

    campaign: Campaign
    tests: tuple[TestPart, ...]
    together: tuple[str, ...]
    information: dict[str, dict[str, float]]
    reference_force: float | None
    parameters: tuple[Parameter, ...]
    confounding: Confounding
    solution: Solution
    naive: Solution
    by_run: bool
    unshown: tuple[str, ...]
    budget: Budget
    local_change: Change | None
    minimum_norm: dict[str, float]
    traces: Sequence[Trace]
    levels: tuple[Level, ...]
    local: tuple[Local, ...]
    repeats: Repeatability | None
    patterns: tuple[Pattern, ...]
    set_up: dict[str, dict[str, float]]
    corrected: dict[str, float]
    rmse: float
    verdict: tuple[Check, ...]
    agreement: Agreement | None = None
    models: ModelChoice | None = None
    consistency: Consistency | None = None
    responses: tuple[Response, ...] = ()
    variable: VariableCompliance | None = None
    missing_geometry: MissingGeometry | None = None
    tests_agreement: TestsAgreement | None = None

    @property
    def test(self) -> MachineTest:
        """The test that this is the result of.

        Raises
        ------
        InputError
            If there are several.
        """
        return self.campaign.only

    def __getitem__(self, name: str) -> Parameter:
        """The parameter of this name.

        Raises
        ------
        SelectionError
            If this test did not determine it; the message says what it did with the name.
        """
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        raise SelectionError(self._absent(name))

    def __contains__(self, name: object) -> bool:
        return any(parameter.name == name for parameter in self.parameters)

    def __iter__(self) -> Iterator[str]:
        return (parameter.name for parameter in self.parameters)

    def _absent(self, name: str) -> str:
        if name in self.confounding.null:
            return f"{name} changes no reading of this test, so it has no value; load another direction or pose"
        within = [parameter.name for parameter in self.parameters if name in parameter.stands_for]
        if within:
            return f"this test does not determine {name} by itself; it is part of the sum under {', '.join(within)}"
        return f"{name!r} was not asked for; this result has {', '.join(self)}"
