"""What trying the rule says: false alarms, and how soon it finds each fault."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

from scipy.special import ndtri

from elastogeo.changes.kinds import Kind
from elastogeo.changes.rules import Rule
from elastogeo.machine import Array
from elastogeo.result import Part, Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FaultFound(Part):
    """How soon the rule finds one fault of one indicator.

    Attributes
    ----------
    indicator : str
    shape : str
        `STEP` or `DRIFT`.
    size : float
        Of the step, or in a year: in the unit of the kind, or as a share of the baseline's mean where the kind is relative.
    deviations : float
        The same in standard deviations between tests, of the machine's own baseline.
    soon : float
        Share of machines on which it is an alarm within five tests.
    share : float
        On which it is an alarm within all tests that were simulated.
    median, most : float
        Tests until the alarm on half of the machines, and on 90 %; infinite where fewer find it.
    """

    indicator: str
    shape: str
    size: float
    deviations: float
    soon: float
    share: float
    median: float
    most: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class RuleTest(Result):
    """The rule on simulated machines, and on the tests that were recorded.

    Attributes
    ----------
    name : str
        Of the series; empty for machines as they are expected.
    simulated : str
        From what the machines are simulated.
    rule : Rule
    indicators : tuple of str, length q
    kinds : tuple of Kind, length q
    relevance : array, shape (q,)
        Least change that matters, as the size of a fault counts.
    baseline : int
        Tests of it, the fewest of any indicator.
    interval : float [d]
        Between tests.
    tests : int
        Simulated of each machine, after the baseline.
    machines : int
    blunders : float
        Share of the tests in which one indicator is off by six standard deviations.
    correlation : float
        Of one test with the next.
    alarmed : int
        Machines that nothing happened to, with an alarm in any of their tests.
    repeats : float
        Asked for of each such machine.
    faults : tuple of FaultFound
    judged : int
        Recorded tests after the baseline.
    over : tuple of str
        Those of them that are beyond a limit.
    verdict : tuple
        Empty: the numbers say how good the rule is, and its user whether that is good enough.
    """

    name: str
    simulated: str
    rule: Rule
    indicators: tuple[str, ...]
    kinds: tuple[Kind, ...]
    relevance: Array
    baseline: int
    interval: float
    tests: int
    machines: int
    blunders: float
    correlation: float
    alarmed: int
    repeats: float
    faults: tuple[FaultFound, ...]
    judged: int = 0
    over: tuple[str, ...] = ()
    verdict: tuple[()] = ()

    @property
    def false_alarms(self) -> float:
        """Share of machines with a false alarm."""
        return self.alarmed / self.machines

    @property
    def interval95(self) -> tuple[float, float]:
        """Of that share, 95 % (Wilson)."""
        n, z = self.machines, float(ndtri(0.975))
        middle = (self.false_alarms + z * z / 2 / n) / (1 + z * z / n)
        half = z / (1 + z * z / n) * sqrt(self.false_alarms * (1 - self.false_alarms) / n + z * z / 4 / n**2)
        return max(middle - half, 0.0), min(middle + half, 1.0)
