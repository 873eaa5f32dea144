"""The answer of a plan: which tests, in which order, and what they will tell."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from elastogeo.identification import Check
from elastogeo.machine import Point
from elastogeo.observe import Campaign
from elastogeo.planning.noise import ReadingNoise
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import Means
from elastogeo.planning.reasons import Reason
from elastogeo.result import Result

ALONE, IN_A_SUM, UNSEEN = "alone", "sum", "unseen"
"""What a plan tells of a parameter: its value; that of a named sum in which it stands; nothing."""


@dataclass(frozen=True, slots=True)
class PlannedTest:
    """A test of the plan.

    Attributes
    ----------
    candidate : Candidate
    rank_so_far : int
        Directions that it and those before it determine, with the tests made already.
    supported_so_far : float
        Share of the workspace that these support.
    worst_so_far : float [mm/N]
        Greatest standard uncertainty of a compliance in the workspace after these, with the stated prior.
    """

    candidate: Candidate
    rank_so_far: int
    supported_so_far: float
    worst_so_far: float


@dataclass(frozen=True, slots=True)
class Expectation:
    """What the plan will tell of one parameter.

    Attributes
    ----------
    name, unit, meaning : str
    known : str
        `alone`, `sum` or `unseen`.
    stands_for : mapping of str to float
        The sum that becomes known, coefficient by name; the parameter itself if it is known alone; empty if it is not seen.
    standard_uncertainty : float or None
        Expected, of the parameter or of the sum, in `unit`, from the readings alone; None if it is not seen.
    scale : float
        The size that the parameter is expected to have: its prior standard deviation.
    """

    name: str
    unit: str
    meaning: str
    known: str
    stands_for: Mapping[str, float]
    standard_uncertainty: float | None
    scale: float


@dataclass(frozen=True, slots=True)
class ToolSupport:
    """What the plan supports of the compliance at one tool.

    Attributes
    ----------
    tool : tuple of 3 float [mm]
        The tool point.
    share : float
        Of the workspace that is supported.
    median, worst : float or None [mm/N]
        Standard uncertainty of what is supported, from the readings alone; None if nothing is.
    worst_with_prior : float [mm/N]
        Greatest standard uncertainty anywhere, with the stated prior.
    worst_at : mapping of str to float [mm, rad]
        Axis commands where the supported compliance is known worst.
    tests_needed, more_needed : int or None
        Tests that support all of it by themselves, and those that it takes beside the plan; None if the candidates cannot.
    """

    tool: Point
    share: float
    median: float | None
    worst: float | None
    worst_with_prior: float
    worst_at: Mapping[str, float]
    tests_needed: int | None
    more_needed: int | None


@dataclass(frozen=True, slots=True)
class NextBest:
    """The test that would come next.

    Attributes
    ----------
    candidate : Candidate
    rank : int
        With it.
    worst : float [mm/N]
        Greatest standard uncertainty of a compliance in the workspace with it, with the stated prior.
    supported : float
        Share of the workspace with it.
    """

    candidate: Candidate
    rank: int
    worst: float
    supported: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Plan(Result):
    """Which tests to run, and what they will tell.

    Attributes
    ----------
    means : Means
        What there was to plan with: machine, tools, forces, bars.
    noise : ReadingNoise
        With what each test was taken to be read.
    goal : str
        `workspace`, `parameters` or `information`.
    asked : tuple of str
        The parameters that the user named.
    candidates : int
        How many tests were chosen from.
    proposed : tuple of str
        Instruments that were not asked for, and whose tests were added: those that were tell too little of what was asked.
    tests : tuple of PlannedTest
        In the order of doing.
    made : Campaign or None
        Tests that were made already, and are kept.
    parameters : tuple of Expectation
    rank, highest_rank : int
        Directions that the plan determines, and that any tests of these kinds would, with these tools.
    weak : int
        Of these, how many the readings alone know worse than a parameter's expected size.
    tools : tuple of ToolSupport
        One for each tool.
    supported : float
        Share of the workspace of all tools.
    fewest : int or None
        Tests that it takes to support the whole workspace, beside those made already; None if the candidates cannot.
    reasons : tuple of Reason
        Why parameters that were asked for are known by no test between tool and workpiece, and what would tell them.
    next_best : NextBest or None
        None if no candidate is left.
    verdict : tuple of Check
    """

    means: Means
    noise: ReadingNoise
    goal: str
    asked: tuple[str, ...]
    candidates: int
    proposed: tuple[str, ...]
    tests: tuple[PlannedTest, ...]
    made: Campaign | None
    parameters: tuple[Expectation, ...]
    rank: int
    highest_rank: int
    weak: int
    tools: tuple[ToolSupport, ...]
    supported: float
    fewest: int | None
    reasons: tuple[Reason, ...]
    next_best: NextBest | None
    verdict: tuple[Check, ...] = field(default=())

    @property
    def minutes(self) -> float:
        """Of all tests together."""
        return sum(test.candidate.minutes for test in self.tests)

    @property
    def campaign(self) -> Campaign:
        """The planned tests as one campaign: to write programs for, to simulate."""
        return Campaign("plan", {test.candidate.name: test.candidate.test for test in self.tests})

    def __getitem__(self, name: str) -> Expectation:
        """What will be known of a parameter.

        Raises
        ------
        KeyError
            If the machine has no such compliance.
        """
        return next((p for p in self.parameters if p.name == name), None) or _missing(name)


def _missing(name: str) -> Expectation:
    raise KeyError(f"the plan has no parameter {name!r}")
