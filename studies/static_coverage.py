"""How often the intervals of a static instrument hold the truth: of the joints, and of what it shows by itself."""

from __future__ import annotations

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any, cast
from zlib import crc32

import numpy as np

from elastogeo.estimate import Estimate, solve_by_run
from elastogeo.identification import (
    Identification,
    StaticResults,
    confounding_of,
    effects_of,
    systems_of,
    uncertainty_budget,
)
from elastogeo.identification.static_tests.assessment import shown_by_instrument
from elastogeo.observe import instrument_named
from studies.static_tests import MAKERS, Made

STATIC = {f"{name}, new": name for name in MAKERS}
"""The layouts of the templates, by the names of the page."""


def made(layout: str, noise: str, trial: int) -> Made:
    """One trial: the levels and repeats that `elastogeo new` begins with."""
    name = STATIC[layout]
    template = cast("Any", instrument_named(name.replace(" ", "-"))).template
    levels = tuple(level for level in template.levels for _ in range(template.repeats))
    return MAKERS[name](noise, (crc32(f"{layout}, {noise}".encode()), trial), levels)


def static_covered(layout: str, noise: str, trials: range) -> tuple[dict[str, int], tuple[float, float]]:
    """How many intervals held the truth, by name, and the least and greatest degrees of freedom of the joints' scatter."""
    held: dict[str, int] = {}
    freedom = np.ones(1)
    for trial in trials:
        one = made(layout, noise, trial)
        observed = one.test.observations()
        systems = systems_of(one.test, observed)
        found = confounding_of(one.test, systems)
        solution = solve_by_run([run.factor for run in systems.runs], found.retained)
        budget, freedom = uncertainty_budget(systems, solution, effects_of(one.test, systems)), solution.degrees_of_freedom
        for k, label in enumerate(found.retained):
            true = sum(c * one.parameters.get(other, 0.0) for other, c in found.stands_for(label).items())
            low, high = budget.interval[k]
            held[label] = held.get(label, 0) + bool(low <= true <= high)
        joints = cast("Identification", SimpleNamespace(confounding=found, verdict=()))
        for name, estimate in shown(shown_by_instrument(one.test, joints, observed)):
            low, high = estimate.interval()
            held[name] = held.get(name, 0) + bool(estimate.known and low <= one.shown[name] <= high)
    return held, (float(freedom.min()), float(freedom.max()))


def shown(found: StaticResults) -> Iterator[tuple[str, Estimate]]:
    """What an instrument shows by itself with a 95 % interval."""
    for place in found.places:
        assert place.line is not None
        yield "line", place.line.compliance
        yield "zero", place.line.offset
    if found.cartesian is not None:
        matrix = found.cartesian.compliance
        size, freedom = matrix.standard_uncertainty, matrix.degrees_of_freedom.reshape(3, 3)
        for m, i in enumerate("XYZ"):
            for n, j in enumerate("XYZ"):
                estimate = Estimate(float(matrix.compliance[m, n]), float(size[m, n]), float(freedom[m, n]))
                yield f"C_{i}{j}", estimate
    for twist in found.twist_places:
        yield from ((f"twist {axis}", one) for axis, one in zip("XYZABC", twist.compliance, strict=True))
