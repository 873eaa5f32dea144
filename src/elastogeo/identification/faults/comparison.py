"""Two tests of one machine: what changed between them, and is it significant?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Unpack

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import Estimate, Solution
from elastogeo.identification.change import SIGNIFICANT, Change, difference, difference_freedom
from elastogeo.identification.check import Check
from elastogeo.identification.identification import identified
from elastogeo.identification.question import Asked
from elastogeo.identification.result import Identification
from elastogeo.observe import MachineTest
from elastogeo.result import Result


@dataclass(frozen=True, slots=True)
class Difference:
    """How one parameter changed.

    Attributes
    ----------
    name, unit : str
    before, after : float
    change : Estimate
        After less before.
    p_value : float
        Probability of such a change, or a greater one, if nothing changed.
    """

    name: str
    unit: str
    before: float
    after: float
    change: Estimate
    p_value: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class BeforeAfter(Result):
    """What changed between two tests.

    Attributes
    ----------
    before, after : Identification
    differences : tuple of Difference
        The surest change first.
    joint : Change
        All parameters together.
    verdict : tuple of Check
    """

    before: Identification
    after: Identification
    differences: tuple[Difference, ...]
    joint: Change
    verdict: tuple[Check, ...]


def compare(
    before: MachineTest | Identification, after: MachineTest | Identification, **asked: Unpack[Asked]
) -> BeforeAfter:
    """Compare two tests of one machine.

    Parameters
    ----------
    before, after : MachineTest or Identification
        Tests, or what they say already.
    **asked
        Of tests, another question than their own, as in `with_question`.

    Notes
    -----
    Their systematic influences count as independent: a gauge or bar that both share makes the judgement more cautious
    than need be, never less.

    Raises
    ------
    UnsupportedError
        If the machines have different topologies, the tests determine no parameter in common, or one has no uncertainty by
        run.
    """
    before, after = identified(before, **asked), identified(after, **asked)
    machines = before.test.machine, after.test.machine
    if machines[0].topology != machines[1].topology:
        raise UnsupportedError(
            f"the tests are of different machines, {machines[0].topology.compact} and {machines[1].topology.compact}"
        )
    stands = [{p.name: p.stands_for for p in result.parameters} for result in (before, after)]
    common = [name for name in stands[0] if name in stands[1] and set(stands[0][name]) == set(stands[1][name])]
    if not common:
        raise UnsupportedError("the tests determine no parameter in common; ask both for the same ones")
    few = next((result for result in (before, after) if not result.by_run or result.unshown), None)
    if few is not None:
        raise UnsupportedError(
            f"test {few.test.name!r} has too few runs, or subtracts a reference level: its values have no uncertainty by "
            f"which a change could be judged; repeat the runs and ask without a reference level"
        )
    joint = difference(_combined(before, common), _combined(after, common))
    differences = sorted((_difference(before, after, name, joint) for name in common), key=lambda d: d.p_value)
    return BeforeAfter(before, after, tuple(differences), joint, (_verdict(differences, joint),))


def _combined(result: Identification, names: Sequence[str]) -> Solution:
    """The named parameters with their combined covariance."""
    keep = [result.solution.labels.index(name) for name in names]
    return replace(
        result.solution,
        labels=tuple(names),
        values=result.solution.values[keep],
        covariance=result.budget.covariance[np.ix_(keep, keep)],
        degrees_of_freedom=result.budget.degrees_of_freedom[keep],
    )


def _difference(before: Identification, after: Identification, name: str, joint: Change) -> Difference:
    one, other = (_combined(result, [name]) for result in (before, after))
    change = float(other.values[0] - one.values[0])
    uncertainty = float(np.sqrt(one.covariance[0, 0] + other.covariance[0, 0]))
    return Difference(
        name=name,
        unit=next(p.unit for p in before.parameters if p.name == name),
        before=float(one.values[0]),
        after=float(other.values[0]),
        change=Estimate(change, uncertainty, float(difference_freedom(one, other)[0])),
        p_value=joint.each[name],
    )


def _verdict(differences: Sequence[Difference], joint: Change) -> Check:
    """Whether anything changed: each parameter at a level that allows for their number."""
    changed = tuple(d.name for d in differences if d.p_value < SIGNIFICANT / len(differences))
    facts = {"changed": changed, "together": joint.significant, "p_value": joint.p_value}
    return Check("unchanged", not (changed or joint.significant), facts)
