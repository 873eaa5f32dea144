"""A contact that stiffens: `H_XXX` displaces by the load to the power 2/3 (Hertz, ball on flat), with its sign.

Another exponent is written into the name: `H0.8_XXX`. The exponent is not linear in the readings; `identify.compare_models`
searches it outside the linear solve.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.machine import Array, Machine
from elastogeo.sources.compliance import JointLoad, joint_compliance, load_of
from elastogeo.sources.families import family, named
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source

HERTZ = 2.0 / 3.0
_NAME = re.compile(r"H(\d+(?:\.\d+)?|)_([XYZABC]{2}[XYZUVWABCS])")


@dataclass(frozen=True, slots=True)
class StiffeningLoad:
    """Driver: `sign(load) |load|^a`."""

    load: JointLoad
    exponent: float

    def __call__(self, situation: Situation) -> Array:
        """Values [N^a or (N mm)^a] at every reading, shape (m,)."""
        load = self.load(situation)
        return np.asarray(np.sign(load) * np.abs(load) ** self.exponent)


@family
def stiffening_contact(machine: Machine) -> Iterator[Source]:
    """A stiffening contact beside every joint compliance, with the exponent of Hertz."""
    return (_stiffening(source, HERTZ, "") for source in joint_compliance(machine))


@named
def stiffening_named(machine: Machine, name: str) -> Source | None:
    """A stiffening contact with the exponent that its name gives: `H0.8_XXX`."""
    match = _NAME.fullmatch(name)
    if not match or not match[1] or not 0 < float(match[1]) <= 2:
        return None
    compliances = {source.name: source for source in joint_compliance(machine)}
    source = compliances.get(f"C_{match[2]}")
    return _stiffening(source, float(match[1]), match[1]) if source else None


def _stiffening(source: Source, exponent: float, written: str) -> Source:
    translation = source.load is not None and source.load < 3
    return replace(
        source,
        name=f"H{written}_{source.name.removeprefix('C_')}",
        unit=f"{source.unit.partition('/')[0]}/{'N' if translation else '(N mm)'}^{exponent:.4g}",
        driver=StiffeningLoad(load_of(source), exponent),
        meaning=f"stiffening part of {source.name}: load to the power {exponent:.4g}",
        force_degree=exponent,
    )
