"""What holds whatever the data say: a joint's compliance matrix is symmetric (reciprocity, Maxwell and Betti) and positive
semidefinite (a load never gains energy).

A free estimate may violate that within its noise. `consistency` gives the estimate that does not, how far it is from the
free one, and whether the data contradict physics beyond their uncertainty. `reciprocal_sources` builds the symmetry into the
model instead, and `reciprocity` says what that assumption buys.

An equivalent compliance is a sum over joints (`Confounding.stands_for`), so the law applies to the joints behind it and the
sum inherits what is left of it: a sum of on-axis terms is not negative, a sum of cross terms may be.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from math import sqrt

import numpy as np
from scipy.special import stdtr

from elastogeo.errors import InputError
from elastogeo.estimate import (
    Block,
    Confounding,
    Projection,
    PsdCone,
    Solution,
    confounding,
    is_never_negative,
    p_value_at,
    p_value_bound,
    project,
    psd_cone,
)
from elastogeo.identification.check import Check
from elastogeo.identification.preference import retaining_order
from elastogeo.identification.systems import merged, run_systems
from elastogeo.machine import Array, Machine, Site
from elastogeo.observe import Observations
from elastogeo.sources import JointLoad, Situation, Source

CONSISTENT = "consistent"
WITHIN_NOISE = "violated within noise"
CONTRADICTED = "contradicted"

NOTHING_RESTRICTED = (
    "Symmetry and positive semidefiniteness of the joints restrict nothing that this test determines: no compliance that a "
    "load causes along itself was asked for and seen."
)

LEVEL = 0.05
"""Probability of calling data contradictory that obey physics, at most."""


@dataclass(frozen=True, slots=True)
class ReciprocalSource(Source):
    """Two compliances C_dfj and C_fdj as one parameter, the value of both: its column is the sum of theirs.

    Attributes
    ----------
    mirror : Source
        The other of the pair; name, component and driver of this source are those of the one that gave the name.
    """

    mirror: Source | None = None

    def column(self, situation: Situation) -> Array:
        """Change of every reading per unit of both, shape (m,)."""
        own = Source.column(self, situation)
        return own if self.mirror is None else own + self.mirror.column(situation)


@dataclass(frozen=True, slots=True)
class Consistency:
    """Whether an estimate agrees with the physics of joints.

    Attributes
    ----------
    state : str
        `consistent`, `violated within noise`, or `contradicted`: beyond the stated uncertainty.
    constrained : dict of str to float
        The nearest estimate, by name, that symmetric positive semidefinite joints can give.
    distance : float
        Of the free estimate from it, in standard uncertainties of the combination that is most out of bounds.
    dimension : int
        In how many directions physics restricts the estimate.
    p_value : float
        Probability of so great a violation, or a greater one, if physics holds: an upper bound for any joints that obey it,
        with both looks counted, the joint one and the one at the signs.
    p_joint : float or None
        Of the distance alone; None if the covariance does not support a joint test, and the signs alone were looked at.
    p_negative : dict of str to float
        Of each parameter that no physical joints make negative: of its value or a lower one if the truth is zero (Student's
        t, one-sided, not corrected for their number).
    violated : tuple of str
        Those that are negative beyond their uncertainty, with their number counted (Holm).
    outward : dict of str to float
        The combination that is most out of bounds: coefficient by name, so scaled that its standard uncertainty is 1. It is
        at most zero for all physical joints, and `distance` for the free estimate.
    p_projected : float or None
        Of the distance if the constrained estimate is the truth, by Monte Carlo, if that was asked for. **It has the stated
        level only there**; `p_value` decides.
    sentence : str
        The verdict in words.
    """

    state: str
    constrained: dict[str, float]
    distance: float
    dimension: int
    p_value: float
    p_joint: float | None
    p_negative: dict[str, float]
    violated: tuple[str, ...]
    outward: dict[str, float]
    p_projected: float | None
    sentence: str

    @property
    def check(self) -> Check:
        """For the verdict of an identification: failed if the data contradict physics."""
        return Check("physically consistent", self.state != CONTRADICTED, {"said": self.sentence})


@dataclass(frozen=True, slots=True)
class Reciprocity:
    """What assuming the symmetry of every joint buys in separation.

    Attributes
    ----------
    free, symmetric : Confounding
        Without and with the assumption; with it, a pair is one parameter.
    pairs : tuple of tuple of 2 str
        The merged pairs, the one that names both first.
    testable : int
        How many independent differences C_dfj - C_fdj, or sums of such, the observations see: so many checks of the
        assumption does the free estimate hold.
    alone_free, alone_symmetric : tuple of str
        Parameters that were asked for and are determined by themselves; with the assumption, both of a pair.
    sentence : str
    """

    free: Confounding
    symmetric: Confounding
    pairs: tuple[tuple[str, str], ...]
    testable: int
    alone_free: tuple[str, ...]
    alone_symmetric: tuple[str, ...]
    sentence: str


def consistency(
    sources: Sequence[Source],
    found: Confounding,
    solution: Solution,
    *,
    metric: Array | None = None,
    level: float = LEVEL,
    draws: int = 0,
    seed: int = 0,
) -> Consistency:
    """Whether an estimate agrees with symmetric positive semidefinite joint compliances.

    Two looks share the level: the distance of the estimate from what physics allows, and the sign of each parameter that
    cannot be negative. Components that were not asked for restrict nothing, nor does a cross term without its mirror.

    Parameters
    ----------
    sources : sequence of Source
        All that were asked for.
    found : Confounding
        Of their columns.
    solution : Solution
        Of the retained parameters; the covariance counts as known but for one variance, of the least degrees of freedom.
    metric : array, shape (r, r), optional
        Measures the distance where the solution's covariance is all estimated, from few runs; the signs alone decide then.
    level : float
        Probability of a false alarm, at most.
    draws : int
        If positive, `p_joint` is the least favourable one itself, not its bound, and `p_projected` is given: Monte Carlo.
    seed : int

    Raises
    ------
    InputError
        If the solution is not of the retained parameters, a source is missing, or the metric is not positive definite.
    """
    if solution.labels != found.retained:
        raise InputError(f"the solution is of {', '.join(solution.labels)}; it must be of {', '.join(found.retained)}")
    blocks = list(joint_blocks(sources, found.labels).values())
    cone = psd_cone(solution.covariance if metric is None else metric, found.combinations, blocks)
    nearest = project(cone, solution.values)
    p_joint = p_projected = None
    if metric is None:
        p_joint, p_projected = _p_joint(cone, nearest, float(solution.degrees_of_freedom.min()), draws, seed)
    p_negative = _p_negative(cone, solution)
    p_value, violated = _both_looks(cone, p_joint, _holm(p_negative), level)
    state = CONSISTENT if nearest.inside else CONTRADICTED if p_value < level else WITHIN_NOISE
    return Consistency(
        state=state,
        constrained=dict(zip(solution.labels, map(float, nearest.values), strict=True)),
        distance=sqrt(nearest.distance_squared),
        dimension=cone.dimension,
        p_value=1.0 if nearest.inside else p_value,
        p_joint=p_joint,
        p_negative=p_negative,
        violated=violated,
        outward={} if nearest.inside else _outward(nearest, solution),
        p_projected=p_projected,
        sentence=_sentence(state, found, solution, nearest, p_value, violated) if cone.dimension else NOTHING_RESTRICTED,
    )


def joint_blocks(sources: Sequence[Source], labels: Sequence[str]) -> dict[str, Block]:
    """Where the entries of each joint's compliance matrix are among the parameters: a block of indices by joint.

    Rows and columns are the components that were asked for, in the order X Y Z A B C; -1 where an entry was not.

    Raises
    ------
    InputError
        If a label is no source's name.
    """
    by_name = {source.name: source for source in sources}
    unknown = [label for label in labels if label not in by_name]
    if unknown:
        raise InputError(f"no source is given for {', '.join(unknown)}")
    entries: dict[str, dict[tuple[int, int], int]] = {}
    for k, label in enumerate(labels):
        source = by_name[label]
        if not _is_compliance(source) or source.load is None:
            continue
        joint = entries.setdefault(source.site[1], {})
        joint[source.component, source.load] = k
        if isinstance(source, ReciprocalSource):
            joint[source.load, source.component] = k
    blocks = {}
    for axis, joint in entries.items():
        components = sorted({component for entry in joint for component in entry})
        blocks[axis] = np.array([[joint.get((d, f), -1) for f in components] for d in components])
    return blocks


def reciprocal_sources(sources: Sequence[Source]) -> tuple[Source, ...]:
    """The same sources with each pair C_dfj, C_fdj merged into one parameter that is the value of both.

    The one with the force as load names the pair, else the one whose displacement comes first in X Y Z A B C: `C_XYX` and
    `C_CXY`, as the thesis retains. A compliance whose mirror is not among the sources stays as it is.
    """
    at: dict[tuple[Site, int | None, int | None], Source] = {
        (source.site, source.component, source.load): source for source in sources if _is_compliance(source)
    }
    pairs: list[Source] = []
    for source in sources:
        mirror = at.get((source.site, source.load, source.component)) if _is_compliance(source) else None
        if mirror is None or mirror is source:
            pairs.append(source)
        elif _names_pair(source):
            own = {field.name: getattr(source, field.name) for field in fields(Source)}
            own["meaning"] = f"{source.meaning}; by reciprocity also {mirror.meaning}"
            pairs.append(ReciprocalSource(**own, mirror=mirror))
    return tuple(pairs)


def reciprocity(
    sources: Sequence[Source],
    machine: Machine,
    observations: Sequence[Observations],
    reference: float | None = None,
    prefer: Sequence[str] = (),
) -> Reciprocity:
    """What the symmetry of every joint buys: the same observations with and without it.

    A force along the sensitive direction only ever shows C_dfj + C_fdj (virtual work: the reading is a quadratic form of the
    load), so there it takes away unknowns and no measured information, and nothing tests it. A force across the sensitive
    direction shows C_dfj by itself; the mirror then comes for free, or is a check.

    Parameters
    ----------
    sources : sequence of Source
    machine : Machine
    observations : sequence of Observations
        One per run.
    reference : float, optional [N]
        Force level that is taken off, as in `run_systems`.
    prefer : sequence of str
        Parameters to retain first.
    """
    together = reciprocal_sources(sources)
    free = _found(sources, machine, observations, reference, prefer)
    symmetric = _found(together, machine, observations, reference, prefer)
    pairs = tuple((s.name, s.mirror.name) for s in together if isinstance(s, ReciprocalSource) and s.mirror is not None)
    partner = dict(pairs)
    alone_free = _alone(free)
    alone = [name for name in _alone(symmetric) for name in (name, partner.get(name, name))]
    alone_symmetric = tuple(label for label in free.labels if label in alone)
    testable = free.rank - symmetric.rank
    return Reciprocity(
        free=free,
        symmetric=symmetric,
        pairs=pairs,
        testable=testable,
        alone_free=alone_free,
        alone_symmetric=alone_symmetric,
        sentence=_what_it_buys(free, symmetric, len(pairs), testable, alone_free, alone_symmetric),
    )


def _is_compliance(source: Source) -> bool:
    """Whether a source is an entry of a joint's compliance matrix, and no law of a higher power of the load."""
    return isinstance(source.driver, JointLoad) and source.load is not None


def _names_pair(source: Source) -> bool:
    displacement, load = source.component, source.load or 0
    if (load < 3) != (displacement < 3):
        return load < 3
    return displacement < load


def _p_joint(cone: PsdCone, nearest: Projection, degrees: float, draws: int, seed: int) -> tuple[float, float | None]:
    """p-value of the distance whatever the truth, and, from draws, if the constrained estimate is it."""
    square = nearest.distance_squared
    bound = p_value_bound(square, cone.dimension, degrees, one_sided=cone.one_sided)
    if not draws:
        return bound, None
    if nearest.inside:
        return 1.0, 1.0
    least_favourable = p_value_at(cone, square, None, degrees, draws, seed)
    return least_favourable, p_value_at(cone, square, nearest.values, degrees, draws, seed)


def _p_negative(cone: PsdCone, solution: Solution) -> dict[str, float]:
    """One-sided p-value of each parameter that no physical joints make negative."""
    own = np.eye(len(solution.labels))
    ratios = solution.values / solution.standard_uncertainty
    return {
        name: float(stdtr(degrees, ratio))
        for name, unit, ratio, degrees in zip(solution.labels, own, ratios, solution.degrees_of_freedom, strict=True)
        if is_never_negative(cone, unit)
    }


def _holm(p_values: Mapping[str, float]) -> dict[str, float]:
    """p-values adjusted for their number (Holm, 1979)."""
    ordered = sorted(p_values, key=lambda name: p_values[name])
    adjusted: dict[str, float] = {}
    greatest = 0.0
    for rank, name in enumerate(ordered):
        greatest = max(greatest, min(1.0, (len(ordered) - rank) * p_values[name]))
        adjusted[name] = greatest
    return adjusted


def _both_looks(
    cone: PsdCone, p_joint: float | None, p_signs: Mapping[str, float], level: float
) -> tuple[float, tuple[str, ...]]:
    """The p-value of the joint look and the signs together (Bonferroni), and the signs that are significant in it."""
    looks = 2 if p_joint is not None and p_signs and cone.dimension > 1 else 1
    least = min([*p_signs.values(), 1.0 if p_joint is None else p_joint])
    return min(1.0, looks * least), tuple(name for name, p in p_signs.items() if looks * p < level)


def _outward(nearest: Projection, solution: Solution) -> dict[str, float]:
    scaled = nearest.outward / sqrt(nearest.distance_squared)
    return dict(zip(solution.labels, map(float, scaled), strict=True))


def _sentence(
    state: str, found: Confounding, solution: Solution, nearest: Projection, p_value: float, violated: Sequence[str]
) -> str:
    if state == CONSISTENT:
        return "The estimate is one that symmetric, positive semidefinite joint compliances can give."
    distance = f"{sqrt(nearest.distance_squared):.3g} standard uncertainties"
    if state == WITHIN_NOISE:
        return (
            f"The estimate is {distance} from what symmetric, positive semidefinite joint compliances can give, which noise "
            f"explains (p {_p(p_value)}): use the constrained values; the violation is no property of the machine."
        )
    named = "; ".join(_negative(name, found, solution) for name in violated)
    return (
        f"The data contradict physics beyond their uncertainty (p {_p(p_value)}): the estimate is {distance} from what "
        f"symmetric, positive semidefinite joint compliances can give{'; ' if named else ''}{named}. Either the model lacks "
        f"something that the readings hold, or the stated uncertainty does not cover all influences; do not use the values "
        f"as compliances of joints."
    )


def _negative(name: str, found: Confounding, solution: Solution) -> str:
    k = solution.labels.index(name)
    terms = found.stands_for(name)
    what = "which stands for itself alone" if len(terms) == 1 else f"a sum over {', '.join(terms)}"
    value, uncertainty = solution.values[k], solution.standard_uncertainty[k]
    return f"{name}, {what}, is {value:.3g} with the standard uncertainty {uncertainty:.2g}"


def _p(p: float) -> str:
    return f"= {p:.2g}" if p >= 1e-4 else "< 0.0001"


def _found(
    sources: Sequence[Source],
    machine: Machine,
    observations: Sequence[Observations],
    reference: float | None,
    prefer: Sequence[str],
) -> Confounding:
    systems = run_systems(sources, machine, observations, reference)
    names = {source.name for source in sources}
    order = retaining_order(sources, machine, observations, [name for name in prefer if name in names])
    return confounding(merged(systems.runs), order, systems.ceilings)


def _alone(found: Confounding) -> tuple[str, ...]:
    return tuple(name for name in found.retained if len(found.stands_for(name)) == 1)


def _what_it_buys(
    free: Confounding, symmetric: Confounding, pairs: int, testable: int, alone_free: Sequence[str], alone: Sequence[str]
) -> str:
    if not pairs:
        return "No compliance was asked for together with its mirror, so reciprocity merges nothing."
    head = (
        f"Reciprocity merges {pairs} pairs, {len(free.labels)} parameters into {len(symmetric.labels)}; the rank is "
        f"{free.rank} without and {symmetric.rank} with it, {len(free.labels) - free.rank} and "
        f"{len(symmetric.labels) - symmetric.rank} unknowns are left undetermined."
    )
    new = [name for name in alone if name not in alone_free]
    named = f" Determined by themselves with it, and not without: {', '.join(new)}." if new else ""
    tested = (
        f"The observations see {testable} combinations of the differences between mirrors, which test the assumption."
        if testable
        else "The observations see no difference between mirrors, so they cannot test the assumption."
    )
    return f"{head} {tested}{named}"
