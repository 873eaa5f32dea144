"""The compliance of the tool relative to the workpiece at any pose, C_t = J C J^T (Eq. 4.10), as far as the tests tell it.

What the tests do not tell has no value and no interval here; with a prior asked for it has both, and the share of the
variance that is the prior's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.identification import (
    CollinearStiffness,
    Identification,
    Linear,
    Principal,
    StiffnessScrew,
    collinear_stiffness,
    is_compliance,
)
from elastogeo.machine import Array
from elastogeo.prediction.knowledge import Knowledge, Predicted, knowledge_of
from elastogeo.prediction.virtual import virtual_observations

UNIT = np.eye(6)

PAIRS = tuple((i, j) for i in range(6) for j in range(i, 6))
"""The elements of a symmetric compliance, row by row."""

_GIVES_WAY = 1e-6
"""Least eigenvalue, of a compliance scaled to unit diagonal, of what gives way in every direction."""

TRANSLATION = tuple((i, j) for i in range(3) for j in range(i, 3))
"""Those that a force shows in a displacement."""


@dataclass(frozen=True, slots=True, eq=False)
class ToolCompliance(ByValue):
    """The compliance at the tool at one pose; **compliances that were not asked for count as rigid.**

    Attributes
    ----------
    commands : array, shape (n,) [mm, rad]
        Where the machine stands.
    tool : array, shape (3,) [mm]
        Functional point in the last tool-branch frame.
    compliance : array, shape (6, 6)
        Symmetric part: twist (translation, rotation) per wrench (force, moment) along the foundation's axes; NaN where the
        tests do not support it.
    expanded : array, shape (6, 6)
        U of 95 %; NaN where there is none.
    supported : array of bool, shape (6, 6)
        Whether the tests determine each element of the symmetric part.
    alone : array of bool, shape (6, 6)
        Whether they determine C_ij by itself. **Of joints that were asked without reciprocity, C_ij alone may not be.**
    prior_share : array, shape (6, 6)
        Share of each variance that is the stated prior's.
    collinear : CollinearStiffness
        Principal directions, the softest first, and screws (thesis 2.7), with U.
    stiffness : array, shape (6, 6)
        K_t [N/mm, ...]: the inverse of the greatest determined block that gives way in every direction; NaN elsewhere.
    stiffness_expanded : array, shape (6, 6)
        U of 95 %, to first order.
    """

    commands: Array
    tool: Array
    compliance: Array
    expanded: Array
    supported: np.ndarray[tuple[int, int], np.dtype[np.bool_]]
    alone: np.ndarray[tuple[int, int], np.dtype[np.bool_]]
    prior_share: Array
    collinear: CollinearStiffness
    stiffness: Array
    stiffness_expanded: Array

    @property
    def principal(self) -> tuple[Principal, ...]:
        """Principal directions of what a force does, the softest first: the axes of the ellipsoid."""
        return self.collinear.translational

    @property
    def softest(self) -> Principal | None:
        """The direction in which the tool gives way most; None where no direction is determined."""
        return self.principal[0] if self.principal else None

    @property
    def screws(self) -> tuple[StiffnessScrew, ...]:
        """The six screws, where the whole compliance is determined."""
        return self.collinear.screws


def entry_rows(
    knowledge: Knowledge, commands: Array, tool: Array | None = None, pairs: Sequence[tuple[int, int]] = PAIRS
) -> Array:
    """What elements of the symmetric part of C_t ask of the parameters, shape (m, len(pairs), p).

    Parameters
    ----------
    knowledge : Knowledge
    commands : array, shape (m, n) [mm, rad]
    tool : array, shape (3,) [mm], optional
    pairs : sequence of (i, j)

    Raises
    ------
    UnsupportedError
        If no compliance was asked for, or one changes with force, feed or travel.
    """
    mirrored = [(j, i) for i, j in pairs]
    both = single_rows(knowledge, commands, [*pairs, *mirrored], tool)
    return np.asarray((both[:, : len(pairs)] + both[:, len(pairs) :]) / 2)


def single_rows(knowledge: Knowledge, commands: Array, pairs: Sequence[tuple[int, int]], tool: Array | None = None) -> Array:
    """What each C_ij by itself, displacement i for load j, asks of the parameters, shape (m, len(pairs), p).

    Raises
    ------
    UnsupportedError
        If no compliance was asked for, or one changes with force, feed or travel.
    """
    check_constant(knowledge)
    commands = np.atleast_2d(commands)
    each = np.repeat(commands, len(pairs), axis=0)
    shown, loaded = (np.tile(UNIT[list(components)], (len(commands), 1)) for components in zip(*pairs, strict=True))
    rows = knowledge.rows(virtual_observations(knowledge.machine, each, shown, loaded, tool))
    if any(joint.mass for joint in knowledge.machine.joints):
        rows -= knowledge.rows(virtual_observations(knowledge.machine, each, shown, 0 * loaded, tool))
    rows[:, [k for k, source in enumerate(knowledge.sources) if not source.elastic]] = 0.0
    return rows.reshape(len(commands), len(pairs), -1)


def weights_of(direction: Array, pairs: Sequence[tuple[int, int]]) -> Array:
    """Weights of the elements, shape (..., len(pairs)), of the compliance along directions, shape (..., 3 or 6)."""
    return np.stack([direction[..., i] * direction[..., j] * (1 if i == j else 2) for i, j in pairs], axis=-1)


def unit_direction(direction: Sequence[float]) -> Array:
    """A direction as a unit vector, shape (3,).

    Raises
    ------
    InputError
        If it is not three finite numbers that are not all zero.
    """
    given = np.asarray(direction, dtype=float)
    if given.shape != (3,) or not np.isfinite(given).all() or not given.any():
        raise InputError(f"the direction is {direction}; it must be three finite numbers that are not all zero")
    return np.asarray(given / np.linalg.norm(given))


def compliance_along(
    knowledge: Knowledge, commands: Array, direction: Array, tool: Array | None = None, prior: bool = False
) -> Predicted:
    """Compliance along unit directions, shape (3,) or (m, 3), for a force along them, at m poses [mm/N]."""
    rows = entry_rows(knowledge, commands, tool, TRANSLATION)
    weights = np.broadcast_to(weights_of(np.atleast_2d(direction), TRANSLATION), rows.shape[:2])
    return knowledge.predict(np.einsum("me,mep->mp", weights, rows), prior)


def tool_compliance(knowledge: Knowledge, commands: Array, tool: Array | None = None, prior: bool = False) -> ToolCompliance:
    """The compliance at the tool at one pose.

    Parameters
    ----------
    knowledge : Knowledge
    commands : array, shape (n,) [mm, rad]
    tool : array, shape (3,) [mm], optional
        Functional point, if not the machine's own.
    prior : bool
        Whether what is not supported is given by the stated prior.

    Raises
    ------
    UnsupportedError
        If no compliance was asked for, or one changes with force, feed or travel.
    """
    single = single_rows(knowledge, commands, [(i, j) for i in range(6) for j in range(6)], tool)[0]
    rows = np.array([(single[6 * i + j] + single[6 * j + i]) / 2 for i, j in PAIRS])
    found = knowledge.predict(rows, prior)
    rigid = ~np.array([rows[PAIRS.index((i, i))].any() for i in range(6)])
    values = _square(found.value)
    known = values.copy()
    known[rigid], known[:, rigid] = np.nan, np.nan

    def estimate(weights: Array) -> Estimate:
        return knowledge.predict(np.tensordot(_folded(weights), rows, axes=1), prior).estimate(0)

    stiffness, half = _inverse(known, estimate)
    own = np.asarray(knowledge.machine.tool if tool is None else tool, dtype=float)
    return ToolCompliance(
        commands=np.asarray(commands, dtype=float).ravel(),
        tool=own,
        compliance=values,
        expanded=_square(found.expanded),
        supported=_square(found.supported.astype(float)).astype(bool),
        alone=knowledge.predict(single).supported.reshape(6, 6),
        prior_share=_square(found.prior_share),
        collinear=collinear_stiffness(known, estimate, np.asarray(commands, dtype=float).ravel()),
        stiffness=stiffness,
        stiffness_expanded=half,
    )


def collinear_stiffness_of(result: Identification) -> CollinearStiffness:
    """The collinear stiffness values that a result's compliances amount to, at the centre of its (first) test.

    Raises
    ------
    UnsupportedError
        If no compliance was identified, or one changes with force, feed or travel.
    """
    first = next(iter(result.campaign.tests.values())).observations()[0]
    return tool_compliance(knowledge_of(result), first.centre, first.tool).collinear


def check_constant(knowledge: Knowledge) -> None:
    """Refuse what has no one compliance.

    Raises
    ------
    UnsupportedError
        If no compliance was asked for, or one changes with force, feed or travel.
    """
    elastic = [source for source in knowledge.sources if source.elastic]
    other = [source.name for source in elastic if not is_compliance(source)]
    if other or not elastic:
        why = f"{', '.join(other[:3])} is no constant compliance of a joint" if other else "no compliance was asked for"
        raise UnsupportedError(f"the stiffness at the tool adds up constant compliances of joints, and {why}")


def _square(values: Array) -> Array:
    """Elements of a symmetric matrix in their places, shape (6, 6)."""
    found = np.empty((6, 6), dtype=values.dtype)
    for value, (i, j) in zip(values, PAIRS, strict=True):
        found[i, j] = found[j, i] = value
    return found


def _folded(weights: Array) -> Array:
    """Weights of all elements, shape (6, 6), as weights of those of a symmetric matrix."""
    both = weights + weights.T
    return np.array([both[i, j] if i != j else weights[i, i] for i, j in PAIRS])


def _inverse(known: Array, estimate: Linear) -> tuple[Array, Array]:
    """The inverse of the greatest determined block, and U of its elements to first order: `dK = -K dC K`."""
    stiffness, half = np.full((6, 6), np.nan), np.full((6, 6), np.nan)
    blocks = (block for block in (range(6), range(3)) if np.isfinite(known[np.ix_(block, block)]).all())
    block = np.ix_(*([next(blocks, range(0))] * 2))
    C = known[block]
    if not len(C) or not (np.diag(C) > 0).all():
        return stiffness, half
    scale = np.sqrt(np.diag(C))
    if np.linalg.eigvalsh(C / np.outer(scale, scale))[0] < _GIVES_WAY:
        return stiffness, half
    K = np.linalg.inv(C)
    stiffness[block] = K
    for i, j in PAIRS:
        if j < len(C):
            weights = np.zeros((6, 6))
            weights[block] = np.outer(K[i], K[:, j])
            one = estimate(weights)
            half[i, j] = half[j, i] = one.expanded() if one.known else np.nan
    return stiffness, half
