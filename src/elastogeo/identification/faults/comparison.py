"""Two tests of one machine: what changed between them, and is it significant?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
    sides = determined(before), determined(after)
    names = in_common(*sides)
    if not names:
        raise UnsupportedError("the tests determine no parameter in common; ask both for the same ones")
    few = next((result for result, side in zip((before, after), sides, strict=True) if not side.judged), None)
    if few is not None:
        raise UnsupportedError(
            f"test {few.test.name!r} has too few runs, or subtracts a reference level: its values have no uncertainty by "
            f"which a change could be judged; repeat the runs and ask without a reference level"
        )
    differences, joint = differences_of(*sides, names)
    return BeforeAfter(before, after, differences, joint, (unchanged(differences, joint),))


@dataclass(frozen=True, slots=True)
class Determined:
    """What one test determines, as it is held against another.

    Attributes
    ----------
    solution : Solution
        With the covariance and the degrees of freedom that hold every influence.
    units : dict of str to str
    stands_for : dict of str to dict of str to float
    judged : bool
        Whether each value has an uncertainty by which a change of it can be judged.
    """

    solution: Solution
    units: Mapping[str, str]
    stands_for: Mapping[str, Mapping[str, float]]
    judged: bool


def determined(result: Identification) -> Determined:
    """What an identification determines, as it is held against another."""
    budget = result.budget
    return Determined(
        solution=replace(result.solution, covariance=budget.covariance, degrees_of_freedom=budget.degrees_of_freedom),
        units={p.name: p.unit for p in result.parameters},
        stands_for={p.name: p.stands_for for p in result.parameters},
        judged=result.by_run and not result.unshown,
    )


def in_common(before: Determined, after: Determined) -> tuple[str, ...]:
    """The parameters that both tests determine, standing for the same sum."""
    one, other = before.stands_for, after.stands_for
    return tuple(name for name in one if name in other and set(one[name]) == set(other[name]))


def differences_of(before: Determined, after: Determined, names: Sequence[str]) -> tuple[tuple[Difference, ...], Change]:
    """How these parameters changed, the surest first, and all of them together."""
    joint = difference(_only(before, names), _only(after, names))
    found = [_difference(before, after, name, joint) for name in names]
    return tuple(sorted(found, key=lambda d: d.p_value)), joint


def unchanged(differences: Sequence[Difference], joint: Change) -> Check:
    """Whether anything changed: each parameter at a level that allows for their number."""
    changed = tuple(d.name for d in differences if d.p_value < SIGNIFICANT / len(differences))
    facts = {"changed": changed, "together": joint.significant, "p_value": joint.p_value}
    return Check("unchanged", not (changed or joint.significant), facts)


def _only(side: Determined, names: Sequence[str]) -> Solution:
    """The named parameters with their covariance."""
    found = side.solution
    keep = [found.labels.index(name) for name in names]
    return replace(
        found,
        labels=tuple(names),
        values=found.values[keep],
        covariance=found.covariance[np.ix_(keep, keep)],
        degrees_of_freedom=found.degrees_of_freedom[keep],
    )


def _difference(before: Determined, after: Determined, name: str, joint: Change) -> Difference:
    one, other = _only(before, [name]), _only(after, [name])
    change = float(other.values[0] - one.values[0])
    uncertainty = float(np.sqrt(one.covariance[0, 0] + other.covariance[0, 0]))
    return Difference(
        name=name,
        unit=before.units[name],
        before=float(one.values[0]),
        after=float(other.values[0]),
        change=Estimate(change, uncertainty, float(difference_freedom(one, other)[0])),
        p_value=joint.each[name],
    )
