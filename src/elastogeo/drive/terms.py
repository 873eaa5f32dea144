"""The terms of the torque balance (Eq. 6.6). Each registers itself; a new one is one small function with `@term`.

    @term("cubic", {"cubic": "{effort} s^3/{length}^3"}, "drag with the third power of the velocity")
    def cubic(motion: Motion) -> Array:
        return motion.velocity[:, np.newaxis] ** 3

A term gives a column per unit of each of its parameters, and says their units with `{effort}` and `{length}` for those of
the record.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """The motion that an effort belongs to, and the laws of friction near standstill.

    Attributes
    ----------
    velocity : array, shape (m,) [mm/s; rad/s of a rotary axis]
    acceleration : array, shape (m,) [mm/s^2]
    smooth_speed : float or None [mm/s]
        Of the law `tanh(v / smooth_speed)` in place of the sign; None for the sign.
    stribeck_speed : float or None [mm/s]
        At which the friction of the start has fallen to 1/e of its excess.
    """

    velocity: Array
    acceleration: Array
    smooth_speed: float | None = None
    stribeck_speed: float | None = None

    @property
    def sense(self) -> Array:
        """Direction of the motion, shape (m,): -1 to 1; the sign of the velocity, or its smooth law."""
        if self.smooth_speed is None:
            return np.sign(self.velocity)
        return np.tanh(self.velocity / self.smooth_speed)


Columns = Callable[[Motion], Array]


@dataclass(frozen=True, slots=True)
class Term:
    """A term of the balance.

    Attributes
    ----------
    name : str
    units : mapping of str to str
        Unit of each parameter by its label.
    meaning : str
    columns : callable
        Motion -> array, shape (m, number of parameters): effort per unit of each.
    signed : bool
        Whether it rests on the direction of the motion, which is not known at standstill.
    """

    name: str
    units: Mapping[str, str]
    meaning: str
    columns: Columns
    signed: bool = False


_TERMS: dict[str, Term] = {}


def term(name: str, units: Mapping[str, str], meaning: str, signed: bool = False) -> Callable[[Columns], Columns]:
    """Register a term of the balance."""

    def register(columns: Columns) -> Columns:
        _TERMS[name] = Term(name, units, meaning, columns, signed)
        return columns

    return register


def terms() -> Mapping[str, Term]:
    """All terms by name."""
    return dict(_TERMS)


def term_named(name: str) -> Term:
    """A term of the balance.

    Raises
    ------
    InputError
        If there is none of this name.
    """
    if name not in _TERMS:
        raise InputError(f"the torque balance has no term {name!r:.40}; there are {', '.join(_TERMS)}")
    return _TERMS[name]


@term("inertia", {"inertia": "{effort} s^2/{length}"}, "effort per acceleration")
def inertia(motion: Motion) -> Array:
    """J_T of Eq. 6.6, seen by the motor."""
    return motion.acceleration[:, np.newaxis]


@term("viscous", {"viscous": "{effort} s/{length}"}, "friction that grows with the velocity")
def viscous(motion: Motion) -> Array:
    """B_T of Eq. 6.6."""
    return motion.velocity[:, np.newaxis]


@term("coulomb", {"coulomb": "{effort}"}, "friction with the sign of the velocity", signed=True)
def coulomb(motion: Motion) -> Array:
    """tau_c of Eq. 6.6."""
    return motion.sense[:, np.newaxis]


@term("constant", {"constant": "{effort}"}, "gravity, preload, offset of the current sensor")
def constant(motion: Motion) -> Array:
    """What is the same whatever the motion."""
    return np.ones((len(motion.velocity), 1))


@term(
    "coulomb asymmetric",
    {"coulomb forward": "{effort}", "coulomb backward": "{effort}"},
    "friction with the sign of the velocity, each direction its own",
    signed=True,
)
def coulomb_asymmetric(motion: Motion) -> Array:
    """Coulomb friction of either direction. With the sharp sign it holds the constant already: leave that out."""
    return np.column_stack([np.maximum(motion.sense, 0.0), np.minimum(motion.sense, 0.0)])


@term(
    "viscous asymmetric",
    {"viscous forward": "{effort} s/{length}", "viscous backward": "{effort} s/{length}"},
    "friction that grows with the velocity, each direction its own",
)
def viscous_asymmetric(motion: Motion) -> Array:
    """Viscous friction of either direction."""
    return np.column_stack([np.maximum(motion.velocity, 0.0), np.minimum(motion.velocity, 0.0)])


@term("stribeck", {"stribeck": "{effort}"}, "excess of the friction near standstill, gone at speed", signed=True)
def stribeck(motion: Motion) -> Array:
    """`sgn(v) exp(-(v / v_st)^2)` beside the Coulomb friction, whose value is then that at speed."""
    if motion.stribeck_speed is None:
        raise InputError("the term stribeck needs a stribeck_speed")
    return (motion.sense * np.exp(-((motion.velocity / motion.stribeck_speed) ** 2)))[:, np.newaxis]
