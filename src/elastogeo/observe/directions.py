"""Directions in which instruments read and push, as unit vectors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array
from elastogeo.observe.circle import Direction


def unit_vector(direction: Direction, what: str) -> Array:
    """A direction as a unit vector, shape (3,).

    Raises
    ------
    InputError
        If it is no three finite numbers, or all are zero; `what` names it.
    """
    vector = np.asarray(direction, dtype=float)
    if vector.shape != (3,) or not np.isfinite(vector).all() or not vector.any():
        raise InputError(f"{what} is {direction}; a direction is three finite numbers that are not all zero")
    return np.asarray(vector / np.linalg.norm(vector))


def unit_vectors(directions: Sequence[Direction], what: str) -> Array:
    """Directions as unit vectors, shape (k, 3); each is named by its number.

    Raises
    ------
    InputError
        If there is none, or one is no direction.
    """
    if not directions:
        raise InputError(f"there is no {what}; give each its direction")
    return np.array([unit_vector(direction, f"{what} {k}") for k, direction in enumerate(directions, 1)])
