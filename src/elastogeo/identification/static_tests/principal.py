"""Principal directions of a compliance: a load along one displaces the tool along it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from elastogeo.estimate import Estimate
from elastogeo.machine import Array

_SAME = 1e-12
"""Of the greatest compliance: two that differ by less do not differ."""


@dataclass(frozen=True, slots=True)
class Principal:
    """A principal direction of the symmetric part of a compliance: a load along it moves the tool along it.

    Attributes
    ----------
    direction : array, shape (3,)
        Unit vector in the foundation; its greatest component is positive.
    direction_uncertainty : float [rad]
        Standard uncertainty of its direction, to first order: of the greatest turn towards one of the others. Infinite
        where two compliances do not differ: then every direction between the two is one.
    compliance : Estimate [mm/N or rad/(N mm)]
    """

    direction: Array
    direction_uncertainty: float
    compliance: Estimate

    def stiffness(self) -> Estimate:
        """Its inverse [N/mm or N mm/rad].

        Raises
        ------
        UnsupportedError
            If the interval of the compliance holds zero.
        """
        return self.compliance.inverse()


def principal_directions(
    block: Array, estimate: Callable[[Array], Estimate], axes: tuple[int, ...] = (0, 1, 2)
) -> tuple[Principal, ...]:
    """Principal directions of a compliance, the softest first.

    Parameters
    ----------
    block : array, shape (k, k)
        Its symmetric part counts.
    estimate : callable
        The estimate of a linear function of its elements, of weights of shape (k, k).
    axes : tuple of k int
        Which axes of the foundation the block is of.
    """
    values, vectors = np.linalg.eigh((block + block.T) / 2)
    found = []
    for k in range(len(block))[::-1]:
        v = vectors[:, k] * np.sign(vectors[np.argmax(np.abs(vectors[:, k])), k])
        turns = [0.0]
        for j in set(range(len(block))) - {k}:
            apart = values[k] - values[j]
            tilt = estimate((np.outer(vectors[:, j], v) + np.outer(v, vectors[:, j])) / 2).standard_uncertainty
            turns.append(tilt / abs(apart) if abs(apart) > _SAME * abs(values).max() else np.inf)
        direction = np.zeros(3)
        direction[list(axes)] = v
        found.append(Principal(direction, float(max(turns)), estimate(np.outer(v, v))))
    return tuple(found)
