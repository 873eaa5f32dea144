"""One idea: every fault is a small twist component at a site of the structural loop, times whatever drives it.

    reading_i = sum_k [b_i^T J_i](site_k, component_k) * phi_k(i) * p_k

A `Source` names the site, the component and the driver phi; its parameter p is what is identified.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from elastogeo.machine import Array, Site
from elastogeo.sources.situation import Situation

_POINTS = ("tool", "workpiece")


class Driver(Protocol):
    """What drives a source: phi, for every reading."""

    def __call__(self, situation: Situation, /) -> Array | float:
        """Values of phi, shape (m,), or one number if it is the same for all."""


@dataclass(frozen=True, slots=True)
class Sign:
    """What the sign of a value means for the axis, as facts for a sentence: "X falls 8 um short when it reverses".

    Attributes
    ----------
    kind : str
        `gain` (positive: travels too far), `bow` (its path bends towards + of `other` at both ends), `squareness` (the angle
        between the positive directions of `axis` and `other` is too small), `backlash`, `spike`, `lag` and `acceleration`
        (falls short of its command), `play` (sits towards - of `other` while it moves forth, towards + while it moves back).
    axis : str
        Its letter; all signs count along its own command, the motion of the tool relative to the workpiece.
    other : str
        The component letter of a play or a bow, the second axis of a squareness; empty for what acts along the axis.
    factor : float
        +1, or -1 where the parameter is positive for the opposite.
    """

    kind: str
    axis: str
    other: str = ""
    factor: float = 1.0


@dataclass(frozen=True, slots=True)
class Source:
    """One error source.

    Attributes
    ----------
    name : str
        Of the parameter, after ISO 230-1 or the thesis: `C_XXX`, `E_YX2`, `E_C(0Y)X`.
    unit : str
        Of the parameter.
    site : Site
        Where its twist acts.
    component : int
        Which component of the twist: 0 to 5 for X Y Z A B C.
    driver : Driver
    meaning : str
        In words.
    load : int or None
        Which load component of its joint drives it, 0 to 5 for forces and moments about X Y Z; None if no load does.
    force_degree : float
        The power of the force with which its column grows: 1 for a compliance, 0 for geometry.
    sign : Sign or None
        What the sign of its parameter means for the axis, if that has a sentence.
    """

    name: str
    unit: str
    site: Site
    component: int
    driver: Driver
    meaning: str
    load: int | None = None
    force_degree: float = 0.0
    sign: Sign | None = None

    @property
    def elastic(self) -> bool:
        """Whether a load drives it."""
        return self.load is not None

    @property
    def of_test(self) -> bool:
        """Whether it is of one test and no part of the machine: its set-up, what a reading has by direction."""
        return self.site[0] == "reading" or (self.site[0] in _POINTS and not self.elastic)

    @property
    def set_up(self) -> bool:
        """Whether it is of the set-up: where the two points sit, how long the bar is."""
        return self.of_test and self.name.startswith("E_")

    def column(self, situation: Situation) -> Array:
        """Change of every reading per unit of the parameter, shape (m,): first order, in closed form."""
        return np.asarray(situation.sensitivity(self.site)[:, self.component] * self.driver(situation))


def twist_unit(component: int) -> str:
    """Unit of a twist component: mm for a translation, rad for a rotation."""
    return "rad" if component >= 3 else "mm"
