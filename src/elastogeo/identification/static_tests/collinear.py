"""Collinear stiffness values: where a load and the displacement that it causes have one axis (thesis 2.7).

From the 6x6 compliance C of the machine at the tool point, `twist = C wrench`. Translational: a force moves the tool along
itself, a principal direction of the force-to-translation block. Rotational: a moment turns it about itself. Screw: a force
and a moment on one axis move it along and about that axis, `C w = c D w` where D exchanges forces and moments: three
right-handed and three left-handed screws, as for any regular spring (Patterson and Lipkin, Structure of robot compliance,
1993; the sources of section 2.7 were not seen). C adds up the joints, `sum_j J_j C_j J_j^T`: of a test those entries that it
determines.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations
from math import inf

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.identification.question import sources_of
from elastogeo.identification.reciprocity import ReciprocalSource, is_compliance
from elastogeo.identification.result import Identification
from elastogeo.machine import Array, carried_to, loop_frames
from elastogeo.sources import Source

SAME = 1e-9
"""Of the greatest weight of a parameter: what differs by less is the same, or none."""

_REGULAR = 1e-9
"""Least eigenvalue, of the compliance scaled to unit diagonal, of a spring that gives way in every direction."""

Linear = Callable[[Array], Estimate]
"""The estimate of `sum W C` for weights W of shape (6, 6)."""


@dataclass(frozen=True, slots=True)
class Collinear:
    """A direction in which a load and the displacement that it causes are collinear.

    Attributes
    ----------
    direction : array, shape (3,)
        Unit vector in the foundation; its greatest component is positive.
    compliance : Estimate [mm/N or rad/(N mm)]
    """

    direction: Array
    compliance: Estimate

    def stiffness(self) -> Estimate:
        """Its inverse [N/mm or N mm/rad].

        Raises
        ------
        UnsupportedError
            If the interval of the compliance holds zero.
        """
        return self.compliance.inverse()


@dataclass(frozen=True, slots=True)
class StiffnessScrew:
    """An axis along and about which a wrench and the twist that it causes are collinear.

    Attributes
    ----------
    direction : array, shape (3,)
        Unit vector in the foundation; its greatest component is positive.
    point : array, shape (3,) [mm]
        Of the axis, that nearest to the tool point, from the tool point.
    pitch : float [mm]
        Moment per force on it; positive for a right-handed screw.
    along : float [N/mm]
        Force per displacement along the axis.
    about : float [N mm/rad]
        Moment per rotation about it.
    """

    direction: Array
    point: Array
    pitch: float
    along: float
    about: float


@dataclass(frozen=True, slots=True)
class CollinearStiffness:
    """The collinear stiffness values of a machine at a place; **what was not asked for counts as rigid.**

    Attributes
    ----------
    compliance : array, shape (6, 6)
        Of the tool relative to the workpiece at the tool point, along the foundation's axes: symmetric (reciprocity); NaN
        where it is not determined, or nothing that could give way was asked for.
    translational : tuple of Collinear
        The softest first; in the greatest plane or space that is determined.
    rotational : tuple of Collinear
    screws : tuple of StiffnessScrew
        The softest first, by `along`; empty unless the whole compliance is determined and gives way in every direction.
    commands : array, shape (n,) [mm, rad]
        Where the machine stands.
    """

    compliance: Array
    translational: tuple[Collinear, ...]
    rotational: tuple[Collinear, ...]
    screws: tuple[StiffnessScrew, ...]
    commands: Array


def collinear_stiffness(
    compliance: Array, linear: Linear | None = None, commands: Array | None = None
) -> CollinearStiffness:
    """The collinear stiffness values of a spring.

    Parameters
    ----------
    compliance : array, shape (6, 6) [mm/N, mm/(N mm), rad/N, rad/(N mm)]
        Twist (translation, rotation) per wrench (force, moment) at a point; its symmetric part counts; NaN where not known.
    linear : callable, optional
        The estimate of a linear function of the elements; without it the values have no uncertainty.
    commands : array, shape (n,), optional

    Raises
    ------
    InputError
        If the compliance is no 6x6 matrix.
    """
    C = np.asarray(compliance, dtype=float)
    if C.shape != (6, 6) or np.isinf(C).any():
        raise InputError(f"a compliance of shape {C.shape} was given; it must be a 6x6 matrix of finite numbers")
    C = (C + C.T) / 2

    def unknown(weights: Array) -> Estimate:
        return Estimate(float(np.sum(np.where(weights, weights * C, 0.0))), inf)

    estimate = linear or unknown
    return CollinearStiffness(
        compliance=C,
        translational=_principal(C, (0, 1, 2), estimate),
        rotational=_principal(C, (3, 4, 5), estimate),
        screws=_screws(C),
        commands=np.zeros(0) if commands is None else commands,
    )


def collinear_stiffness_of(result: Identification) -> CollinearStiffness:
    """The collinear stiffness values that a result's joint compliances amount to, at the centre of its (first) test.

    A sum of parameters that the test does not tell apart counts where the stiffness holds them in that very sum.

    Raises
    ------
    UnsupportedError
        If no joint compliance was identified, one changes with force, feed or travel, or compliance and geometry are not
        separated.
    """
    compliances = _joint_compliances(result)
    observed = next(iter(result.campaign.tests.values())).observations()[0]
    machine, found, solution = result.campaign.machine, result.confounding, result.solution
    frames = loop_frames(machine, observed.centre, observed.tool)
    weights = np.zeros((len(found.labels), 6, 6))
    for source in compliances:
        frame, side = frames.carried_at(source.site[1])
        J = np.vstack([carried_to(frame, frames.point, unit[np.newaxis], side) for unit in np.eye(6)])
        weight = np.outer(J[:, source.component], J[:, source.load or 0])
        whole = weight + weight.T if isinstance(source, ReciprocalSource) and source.mirror is not None else weight
        weights[found.labels.index(source.name)] = (whole + whole.T) / 2
    kept = [found.labels.index(name) for name in solution.labels]
    held = np.tensordot(found.combinations.T, weights[kept], axes=1)
    size = SAME * np.abs(weights).max(axis=(1, 2), initial=0.0, keepdims=True)
    determined = (np.abs(held - weights) <= 1e3 * np.maximum(size, SAME * np.abs(held))).all(axis=0)
    gives_way = (np.abs(weights) > size).any(axis=0)
    values = np.tensordot(solution.values, weights[kept], axes=1)
    rigid = ~np.diag(gives_way)
    values[~determined | rigid | rigid[:, np.newaxis]] = np.nan
    return collinear_stiffness(values, _linear(result, weights[kept]), observed.centre)


def _joint_compliances(result: Identification) -> tuple[Source, ...]:
    elastic = [source for source in sources_of(result.campaign) if source.elastic]
    other = [source.name for source in elastic if not is_compliance(source)]
    if other or not elastic:
        why = f"{', '.join(other[:3])} is no constant compliance of a joint" if other else "no compliance was asked for"
        raise UnsupportedError(f"the stiffness at the tool adds up constant compliances of joints, and {why}")
    if not all(p.separated for p in result.parameters if p.elastic):
        raise UnsupportedError("compliance and geometry are not separated, so that no stiffness follows; add a second force")
    return tuple(elastic)


def _linear(result: Identification, weights: Array) -> Linear:
    """The estimate of a linear function of the elements, by the uncertainty of the retained parameters."""
    solution, budget = result.solution, result.budget
    shown = np.array([result.by_run and name not in result.unshown for name in solution.labels])
    covariance = budget.covariance

    def estimate(chosen: Array) -> Estimate:
        w = np.tensordot(weights, chosen, axes=([1, 2], [0, 1]))
        used = np.abs(w) > SAME * np.abs(weights).max(axis=(1, 2), initial=0.0)
        value = float(w @ solution.values)
        if not shown[used].all():
            return Estimate(value, inf)
        degrees = min(map(float, budget.degrees_of_freedom[used]), default=inf)
        return Estimate(value, float(np.sqrt(max(float(w @ covariance @ w), 0.0))), degrees)

    return estimate


def _principal(C: Array, axes: tuple[int, ...], estimate: Linear) -> tuple[Collinear, ...]:
    """Principal directions of the greatest determined part of a block, the softest first."""
    parts = [part for size in (3, 2, 1) for part in combinations(axes, size) if np.isfinite(C[np.ix_(part, part)]).all()]
    if not parts:
        return ()
    part = parts[0]
    vectors = np.linalg.eigh(C[np.ix_(part, part)])[1]
    found = []
    for k in range(len(part))[::-1]:
        v = np.zeros(6)
        v[list(part)] = vectors[:, k] * np.sign(vectors[np.argmax(np.abs(vectors[:, k])), k])
        found.append(Collinear(v[list(axes)], estimate(np.outer(v, v))))
    return tuple(found)


def _screws(C: Array) -> tuple[StiffnessScrew, ...]:
    """The six screws of a regular spring: with `C = L L^T`, eigenvectors of `L^-1 D L^-T`."""
    if not (np.isfinite(C).all() and (np.diag(C) > 0).all()):
        return ()
    scale = np.sqrt(np.diag(C))
    if np.linalg.eigvalsh(C / np.outer(scale, scale))[0] < _REGULAR:
        return ()
    inverse = np.linalg.inv(np.linalg.cholesky(C))
    exchange = np.roll(np.eye(6), 3, axis=0)
    values, vectors = np.linalg.eigh(inverse @ exchange @ inverse.T)
    screws = [_screw(inverse.T @ vectors[:, k], 1.0 / values[k]) for k in range(6)]
    return tuple(sorted(screws, key=lambda screw: screw.along))


def _screw(wrench: Array, compliance: float) -> StiffnessScrew:
    """Axis and stiffness of a wrench whose twist turns by `compliance` times its force [rad/N]."""
    force, moment = wrench[:3], wrench[3:]
    size = float(np.linalg.norm(force))
    direction = force / size * np.sign(force[np.argmax(np.abs(force))])
    pitch = float(force @ moment) / size**2
    point = np.cross(force, moment) / size**2
    return StiffnessScrew(direction, point, pitch, 1.0 / (compliance * pitch), pitch / compliance)
