"""Which tests to run next on a machine: a goal in words, and a few ways to reach it, as they are kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from math import inf, isfinite
from typing import Any

from elastogeo.changes.records.plans import KeptPlan
from elastogeo.equality import ByValue
from elastogeo.result import Part, Result

TELL, STIFFNESS, WORKSPACE, PARAMETERS = "tell apart", "stiffness", "workspace", "parameters"
GOALS = (TELL, STIFFNESS, WORKSPACE, PARAMETERS)
"""What tests may be for: to tell components apart; the stiffness at the tool everywhere to a share of it; the compliance at
the tool everywhere, however well; as many compliances of joints as possible."""

ONE, WITHIN, ENOUGH, MORE = "one test", "within the time", "as many as it takes", "with other instruments"
WAYS = (ONE, WITHIN, ENOUGH, MORE)
"""How a goal may be reached."""

SEEN, STANDS_OUT = 4.0, 2.0
"""Noise of the readings, in standard deviations: a fault that moves them by less is not seen; and by so much what is seen of
it must stand out of all that the other component can do."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class NextGoal(Part):
    """What tests are to be for.

    Attributes
    ----------
    kind : str
        One of `GOALS`.
    between : tuple of str
        Components that are to be told apart, as a verdict names them: `drive X`, `guideway Y`.
    share : float
        Of the stiffness, to which it is to be known (U of 95 %).
    compliance : float or None [mm/N]
        Least compliance at the tool that the series shows, against which the share counts.
    """

    kind: str
    between: tuple[str, ...] = ()
    share: float = 0.05
    compliance: float | None = None


@dataclass(frozen=True, slots=True)
class Way:
    """A fault of a component, against all that another one can do.

    Attributes
    ----------
    component, other : str
    name, unit : str
        Of the compliance that changes, and its unit.
    seen, apart : float
        By how much a change of a typical size moves the readings, and by how much of that nothing of the other component
        can, in standard deviations.
    uncertainty : float
        U (95 %) of such a change, with the other component free; infinite where it is like the other.
    """

    component: str
    other: str
    name: str
    unit: str
    seen: float
    apart: float
    uncertainty: float

    @property
    def told(self) -> bool | None:
        """Whether it is told from the other component; None where it is not seen at all."""
        return self.apart > STANDS_OUT if self.seen > SEEN else None


@dataclass(frozen=True, slots=True, eq=False)
class KeptAlternative(ByValue):
    """One way to reach a goal.

    Attributes
    ----------
    name : str
        One of `WAYS`.
    resolved : bool
        Whether it reaches the goal.
    ways : tuple of Way
        Of a goal that tells components apart.
    plan : dict
        `elastogeo.plan/1`.
    files : mapping of str to str
        The folder to measure: texts by their paths; `campaign/campaign.toml` names the tests.
    """

    name: str
    resolved: bool
    ways: tuple[Way, ...]
    plan: dict[str, Any]
    files: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class NextTests(Result):
    """A few ways to reach a goal, the cheapest first.

    Attributes
    ----------
    machine : str
    goal : NextGoal
    minutes : float
        That there are.
    instruments : tuple of str
        That there are.
    alternatives : tuple of KeptAlternative
    """

    machine: str
    goal: NextGoal
    minutes: float
    instruments: tuple[str, ...]
    alternatives: tuple[KeptAlternative, ...]

    def document(self) -> dict[str, Any]:
        """As plain values, to be kept as JSON."""
        return {
            "machine": self.machine,
            "goal": {**asdict(self.goal), "between": list(self.goal.between)},
            "minutes": self.minutes,
            "instruments": list(self.instruments),
            "alternatives": [
                {
                    "name": one.name,
                    "resolved": one.resolved,
                    "ways": [_plain(way) for way in one.ways],
                    "plan": one.plan,
                    "files": dict(one.files),
                }
                for one in self.alternatives
            ],
        }

    @staticmethod
    def of_document(document: Mapping[str, Any]) -> NextTests:
        """What `document` gave."""
        goal = {**document["goal"], "between": tuple(document["goal"]["between"])}
        return NextTests(
            machine=document["machine"],
            goal=NextGoal(**goal),
            minutes=document["minutes"],
            instruments=tuple(document["instruments"]),
            alternatives=tuple(
                KeptAlternative(
                    one["name"], one["resolved"], tuple(_way(way) for way in one["ways"]), one["plan"], one["files"]
                )
                for one in document["alternatives"]
            ),
        )


@dataclass(frozen=True, slots=True)
class ProgramFacts:
    """The program of a planned test.

    Attributes
    ----------
    test : str
        Its name.
    blocks : int
    minutes : float
        At feed, without stops and rapid moves.
    error : str
        Why there is none; empty if there is.
    """

    test: str
    blocks: int = 0
    minutes: float = 0.0
    error: str = ""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class PlanToDo(Result):
    """A plan that is kept, with what it takes to do it.

    Attributes
    ----------
    plan : KeptPlan
    goal : NextGoal or None
        What it was chosen for; None of one that was not chosen on the pages.
    programs : tuple of ProgramFacts
        Of its tests, in the order of doing; none where the plan was kept without the files of its tests.
    """

    plan: KeptPlan
    goal: NextGoal | None
    programs: tuple[ProgramFacts, ...]


def _plain(way: Way) -> dict[str, Any]:
    return {**asdict(way), "uncertainty": way.uncertainty if isfinite(way.uncertainty) else None}


def _way(entry: Mapping[str, Any]) -> Way:
    u = entry["uncertainty"]
    return Way(**{**entry, "uncertainty": inf if u is None else u})
