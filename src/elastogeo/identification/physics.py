"""What holds whatever the data say: a joint's compliance matrix is symmetric (reciprocity, Maxwell and Betti) and positive
semidefinite (a load never gains energy).

A free estimate may violate that within its noise. `consistency` gives the estimate that does not, how far it is from the
free one, and whether the data confirm physics, contradict it, or cannot tell: what they do not contradict is not confirmed.

An equivalent compliance is a sum over joints (`Confounding.stands_for`), so the law applies to the joints behind it and the
sum inherits what is left of it: a sum of on-axis terms is not negative, a sum of cross terms may be.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isinf, sqrt
from typing import Any

import numpy as np
from scipy.special import chdtri, nctdtrinc, ndtr, stdtr, stdtrit

from elastogeo.errors import InputError
from elastogeo.estimate import (
    Array,
    Block,
    Confounding,
    Projection,
    PsdCone,
    Solution,
    is_never_negative,
    p_value_bound,
    project,
    psd_cone,
)
from elastogeo.identification.check import Check
from elastogeo.identification.symmetric_joints import ReciprocalSource, is_compliance
from elastogeo.sources import Source

PHYSICALLY_CONSISTENT = "physically consistent"

CONSISTENT = "consistent"
CONTRADICTED = "contradicted"
NOT_TESTED = "not tested"

NOTHING_RESTRICTED = "nothing restricted"
FEW_DEGREES = "few degrees of freedom"
BY_READING = "independent readings assumed"
NEAR_LIMIT = "near the limit"

LEVEL = 0.05
"""Probability of a false alarm, at most; half of it is that of confirming physics that is violated."""

_SHOWN = 0.95
"""Probability with which a violation must be found for the test to have been able to show it."""

_LEAST = 0.05
"""Probability with which the true uncertainty is smaller than the least that its degrees of freedom allow."""

_NEARLY = 2.0
"""A sign is named as what is nearest to its limit if it is at most so many depths away from it: the depth is a bound."""


@dataclass(frozen=True, slots=True)
class Consistency:
    """Whether an estimate agrees with the physics of joints.

    Attributes
    ----------
    state : str
        `consistent`: joints can give the estimate and all that its uncertainty leaves open; `contradicted`: they can give
        none of that; or `not tested`.
    why : str
        Why it was not tested: `nothing restricted` by physics that the test determines; `independent readings assumed` by
        the uncertainty, which is then too small as a rule; `few degrees of freedom`, where a violation is significant by the
        least uncertainty that they allow, and is not with what is known of the uncertainty; or `near the limit`: the
        uncertainty holds values on both sides. Else empty.
    constrained : dict of str to float
        The nearest estimate, by name, that symmetric positive semidefinite joints can give.
    distance : float
        Of the free estimate from it, in standard uncertainties of the combination that is most out of bounds.
    dimension : int
        In how many directions physics restricts the estimate.
    degrees_of_freedom : float
        Least of the parameters that it restricts.
    p_value : float
        Probability of so great a violation, or a greater one, if physics holds: an upper bound for any joints that obey it,
        with both looks counted, the joint one and the one at the signs.
    p_joint : float
        Of the distance alone.
    p_negative : dict of str to float
        Of each parameter that no physical joints make negative: of its value or a lower one if the truth is zero (Student's
        t, one-sided, not corrected for their number).
    violated : tuple of str
        Those that are negative beyond their uncertainty, with their number counted (Holm).
    outward : dict of str to float
        The combination that is most out of bounds: coefficient by name, so scaled that its standard uncertainty is 1. It is
        at most zero for all physical joints, and `distance` for the free estimate.
    depth : float
        Standard uncertainties, at least, that the nearest physical estimate is away from any that is not.
    needed : float
        Depth that confirms physics.
    closest : str
        The parameter that is nearest to its limit; empty if none is restricted by an inequality.
    shows : dict of str to float
        Of each parameter that no physical joints make negative: the value nearest to zero that would have contradicted
        physics with a probability of 95 %.
    """

    state: str
    why: str
    constrained: dict[str, float]
    distance: float
    dimension: int
    degrees_of_freedom: float
    p_value: float
    p_joint: float
    p_negative: dict[str, float]
    violated: tuple[str, ...]
    outward: dict[str, float]
    depth: float
    needed: float
    closest: str
    shows: dict[str, float]


def consistency(
    sources: Sequence[Source],
    found: Confounding,
    solution: Solution,
    *,
    correlated_as: Array | None = None,
    by_reading: bool = False,
    level: float = LEVEL,
) -> Consistency:
    """Whether an estimate agrees with symmetric positive semidefinite joint compliances.

    Two looks share the level. One is at the sign of each parameter that cannot be negative (Student's t, one-sided, Holm).
    The other is at the distance d of the estimate from what physics allows. A covariance from few runs has fewer degrees of
    freedom than dimensions, so it cannot measure that distance: its inverse does not exist, or is noise. The distance is
    measured with the correlations of `correlated_as` and the estimated standard uncertainties, and held against the whole
    scatter in that measure: `d^2 / tr W` is that of Box (doi:10.1214/aoms/1177728786), F-distributed with
    `(tr W)^2 / tr W^2` and the least degrees of freedom, where W is the estimated covariance of the restricted directions
    (Brunner, Dette and Munk, doi:10.1080/01621459.1997.10473671). With a covariance that is known but for one variance this
    is Perlman's bound.

    What is not contradicted is not confirmed. Physics is confirmed if every combination that it bounds is within its bound
    by more than its uncertainty, one-sided at half the level: each is tested alone, since breaking any one breaks the law
    (intersection-union test: Berger, doi:10.1080/00401706.1982.10487790). For signs alone this is that no 95 % interval
    reaches zero. Equations, as of a cross term and its mirror that are both seen, cannot be confirmed so; they need not be
    contradicted.

    In between it was **not tested**, and a violation that only the few degrees of freedom keep from being significant, by
    the least uncertainty that they allow (95 %, chi-square), is told from one that noise explains.

    Components that were not asked for restrict nothing, nor does a cross term without its mirror.

    Parameters
    ----------
    sources : sequence of Source
        All that were asked for.
    found : Confounding
        Of their columns.
    solution : Solution
        Of the retained parameters.
    correlated_as : array, shape (r, r), optional
        Covariance whose correlations measure the distance, where that of the solution is estimated as a whole, from runs.
    by_reading : bool
        Whether the uncertainty assumes independent readings: it is then too small as a rule, so that nothing is tested.
    level : float
        Probability of a false alarm, at most.

    Raises
    ------
    InputError
        If the solution is not of the retained parameters, a source is missing, or a covariance is not positive definite.
    """
    if solution.labels != found.retained:
        raise InputError(f"the solution is of {', '.join(solution.labels)}; it must be of {', '.join(found.retained)}")
    blocks = list(joint_blocks(sources, found.labels).values())
    cone = psd_cone(_measure(solution, correlated_as), found.combinations, blocks)
    nearest = project(cone, solution.values)
    degrees = min((solution.degrees_of_freedom[k] for k in np.flatnonzero(cone.restricted)), default=inf)
    p_joint, p_joint_least = _p_joint(cone, nearest, solution.covariance, float(degrees))
    p_negative, p_negative_least = _p_negative(cone, solution)
    looks = 2 if p_negative and cone.dimension > 1 else 1
    signs = _holm(p_negative)
    p_value = min(1.0, looks * min([p_joint, *signs.values()]))
    by_least = looks * min([p_joint_least, *_holm(p_negative_least).values()])
    needed = float(stdtrit(degrees, 1.0 - level / 2))
    state, why = _state(
        cone,
        by_reading=by_reading,
        contradicted=not nearest.inside and p_value < level,
        in_doubt=not nearest.inside and by_least < level,
        confirmed=cone.one_sided and nearest.depth > needed,
    )
    return Consistency(
        state=state,
        why=why,
        constrained=dict(zip(solution.labels, map(float, nearest.values), strict=True)),
        distance=sqrt(nearest.distance_squared),
        dimension=cone.dimension,
        degrees_of_freedom=float(degrees),
        p_value=1.0 if nearest.inside else p_value,
        p_joint=p_joint,
        p_negative=p_negative,
        violated=tuple(name for name, p in signs.items() if looks * p < level),
        outward={} if nearest.inside else _outward(nearest, solution),
        depth=nearest.depth,
        needed=needed,
        closest=_closest(nearest, solution, p_negative) if cone.one_sided else "",
        shows=_shows(solution, list(p_negative), level / looks),
    )


def physically_consistent(
    consistent: Consistency, sources: Sequence[Source], found: Confounding, solution: Solution
) -> Check:
    """The check of a verdict: passed where the data confirm physics, failed where they contradict it, else not tested."""
    units = {source.name: source.unit for source in sources}
    uncertainty = dict(zip(solution.labels, map(float, solution.standard_uncertainty), strict=True))
    values = dict(zip(solution.labels, map(float, solution.values), strict=True))

    def facts_of(name: str) -> dict[str, Any]:
        return {
            "value": values[name],
            "standard_uncertainty": uncertainty[name],
            "unit": units[name],
            "stands_for": tuple(found.stands_for(name)),
            "shows": consistent.shows.get(name),
        }

    passed = None if consistent.state == NOT_TESTED else consistent.state != CONTRADICTED
    return Check(
        PHYSICALLY_CONSISTENT,
        passed,
        {
            "state": consistent.state,
            "why": consistent.why,
            "distance": consistent.distance,
            "degrees_of_freedom": consistent.degrees_of_freedom,
            "p_value": consistent.p_value,
            "negative": {name: facts_of(name) for name in consistent.violated},
            "depth": consistent.depth,
            "needed": consistent.needed,
            "closest": {name: facts_of(name) for name in [consistent.closest] if name},
            "farthest": max(consistent.outward, key=lambda name: consistent.outward[name] * values[name], default=None),
        },
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
        if not is_compliance(source) or source.load is None:
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


def _measure(solution: Solution, correlated_as: Array | None) -> Array:
    """The covariance that measures the distance, shape (r, r)."""
    if correlated_as is None:
        return solution.covariance
    scale = solution.standard_uncertainty / np.sqrt(np.diag(correlated_as))
    return np.asarray(correlated_as * np.outer(scale, scale))


def _p_joint(cone: PsdCone, nearest: Projection, covariance: Array, degrees: float) -> tuple[float, float]:
    """p-value of the distance whatever the truth; and by the least uncertainty."""
    if not cone.dimension or nearest.inside:
        return 1.0, 1.0
    scatter = cone.directions.T @ covariance @ cone.directions
    total, square = float(np.trace(scatter)), nearest.distance_squared
    count = total**2 / float(np.sum(scatter**2))
    bound = p_value_bound(square * count / total, count, degrees, one_sided=cone.one_sided)
    largest = square * max(1.0, cone.dimension / total) / _least_variance(degrees)
    return bound, p_value_bound(largest, cone.dimension, one_sided=cone.one_sided)


def _p_negative(cone: PsdCone, solution: Solution) -> tuple[dict[str, float], dict[str, float]]:
    """One-sided p-value of each parameter that no physical joints make negative; and by its least uncertainty."""
    own = np.eye(len(solution.labels))
    ratios = solution.values / solution.standard_uncertainty
    never = [k for k, unit in enumerate(own) if is_never_negative(cone, unit)]
    degrees = solution.degrees_of_freedom
    estimated = {solution.labels[k]: float(stdtr(degrees[k], ratios[k])) for k in never}
    return estimated, {solution.labels[k]: float(ndtr(ratios[k] / sqrt(_least_variance(degrees[k])))) for k in never}


def _least_variance(degrees: float) -> float:
    """The least variance that its degrees of freedom allow, as a share of its estimate."""
    return 1.0 if isinf(degrees) else float(degrees / chdtri(degrees, _LEAST))


def _state(cone: PsdCone, *, by_reading: bool, contradicted: bool, in_doubt: bool, confirmed: bool) -> tuple[str, str]:
    """What is said, and why nothing can be."""
    if not cone.dimension:
        return NOT_TESTED, NOTHING_RESTRICTED
    if by_reading:
        return NOT_TESTED, BY_READING
    if contradicted:
        return CONTRADICTED, ""
    if in_doubt:
        return NOT_TESTED, FEW_DEGREES
    return (CONSISTENT, "") if confirmed else (NOT_TESTED, NEAR_LIMIT)


def _closest(nearest: Projection, solution: Solution, never: Mapping[str, float]) -> str:
    """The parameter that is nearest to its limit: to zero, or the greatest part of the combination that is nearest."""
    ratios = dict(zip(solution.labels, solution.values / solution.standard_uncertainty, strict=True))
    least = min(never, key=lambda name: ratios[name], default="")
    if least and ratios[least] <= _NEARLY * nearest.depth:
        return least
    parts = np.abs(nearest.shallow) * solution.standard_uncertainty
    cross = [k for k, name in enumerate(solution.labels) if name not in never] or range(len(parts))
    return solution.labels[max(cross, key=lambda k: parts[k])]


def _shows(solution: Solution, never: Sequence[str], level: float) -> dict[str, float]:
    """Where the sign test of each, at its share of the level, has the power that is wanted (noncentral t)."""
    found = {}
    for name in never:
        k = solution.labels.index(name)
        degrees = float(solution.degrees_of_freedom[k])
        critical = float(stdtrit(degrees, 1.0 - level / len(never)))
        found[name] = -float(nctdtrinc(degrees, 1.0 - _SHOWN, critical) * solution.standard_uncertainty[k])
    return found


def _holm(p_values: Mapping[str, float]) -> dict[str, float]:
    """p-values adjusted for their number (Holm, 1979)."""
    ordered = sorted(p_values, key=lambda name: p_values[name])
    adjusted: dict[str, float] = {}
    greatest = 0.0
    for rank, name in enumerate(ordered):
        greatest = max(greatest, min(1.0, (len(ordered) - rank) * p_values[name]))
        adjusted[name] = greatest
    return adjusted


def _outward(nearest: Projection, solution: Solution) -> dict[str, float]:
    scaled = nearest.outward / sqrt(nearest.distance_squared)
    return dict(zip(solution.labels, map(float, scaled), strict=True))
