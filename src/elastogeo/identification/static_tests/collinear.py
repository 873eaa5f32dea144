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

from elastogeo.errors import InputError
from elastogeo.estimate import Estimate
from elastogeo.identification.static_tests.principal import Principal, principal_directions
from elastogeo.machine import Array

_REGULAR = 1e-9
"""Least eigenvalue, of the compliance scaled to unit diagonal, of a spring that gives way in every direction."""

Linear = Callable[[Array], Estimate]
"""The estimate of `sum W C` for weights W of shape (6, 6)."""


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
    translational : tuple of Principal
        The softest first; in the greatest plane or space that is determined.
    rotational : tuple of Principal
    screws : tuple of StiffnessScrew
        The softest first, by `along`; empty unless the whole compliance is determined and gives way in every direction.
    commands : array, shape (n,) [mm, rad]
        Where the machine stands.
    """

    compliance: Array
    translational: tuple[Principal, ...]
    rotational: tuple[Principal, ...]
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


def _principal(C: Array, axes: tuple[int, ...], estimate: Linear) -> tuple[Principal, ...]:
    """Principal directions of the greatest determined part of a block, the softest first."""
    parts = [part for size in (3, 2, 1) for part in combinations(axes, size) if np.isfinite(C[np.ix_(part, part)]).all()]
    if not parts:
        return ()
    part = np.array(parts[0])

    def of_part(weights: Array) -> Estimate:
        whole = np.zeros((6, 6))
        whole[np.ix_(part, part)] = weights
        return estimate(whole)

    return principal_directions(C[np.ix_(part, part)], of_part, tuple(part % 3))


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
