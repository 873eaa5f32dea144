"""The verdict: the named checks that every identification ends in, with their facts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from elastogeo.estimate import HUBER, Confounding
from elastogeo.identification.budget import COVERAGE, TAIL, Agreement, Budget
from elastogeo.identification.change import SIGNIFICANT, Change
from elastogeo.identification.check import Check
from elastogeo.identification.fit import Harmonic
from elastogeo.identification.levels import ForceLevels
from elastogeo.identification.model_choice.result import ModelChoice
from elastogeo.identification.result import Parameter
from elastogeo.machine import Array
from elastogeo.observe import ASSUMED
from elastogeo.sources import Source

SEPARATED = 5.0
"""Least distance of the force levels over the uncertainty of a force.
With less, the forces alone make a compliance uncertain by a fifth."""

OUTLYING = 6.0
"""Standard deviations (robust) from which a reading is an outlier: normal noise never gets there."""

DEPENDS = 0.1
"""Share of its standard uncertainty by which an assumption about the readings moves a parameter that depends on it."""

CONDITION_LIMIT = 30.0
"""Scaled condition number above which estimates are strongly coupled (Belsley, Kuh and Welsch, 1980)."""


def identifiable(found: Confounding, by_default: bool = False) -> Check:
    """Whether every parameter that was asked for is determined by itself.

    `by_default`: the question is the instrument's own, which asks for all that a machine may have, and so for sums.
    """
    facts = {"asked": len(found.labels), "rank": found.rank, "null": len(found.null), "by_default": by_default}
    return Check("identifiable", by_default or found.rank == len(found.labels), facts)


def conditioned(found: Confounding, remedy: str = "levels") -> Check:
    """Whether the retained parameters are far enough from one another.

    `remedy` names what would help: `levels`, or `motion` for feed drives.
    """
    facts = {"condition": found.condition_scaled, "limit": CONDITION_LIMIT, "remedy": remedy}
    return Check("conditioned", found.condition_scaled <= CONDITION_LIMIT, facts)


def forces_distinct(levels: ForceLevels, with_geometry: bool) -> Check:
    """Whether the force levels are further apart than their uncertainty, so that what grows with the load can be told.

    Decisive where the answer depends on it: compliance beside geometry, or compliance without any force.
    """
    facts = {"levels": levels.forces, "separation": levels.separation, "limit": SEPARATED}
    apart = levels.separation >= SEPARATED
    return Check("forces distinct", apart, facts, decisive=with_geometry or not any(levels.forces))


def geometry_modelled(sources: Sequence[Source], reference: bool, around: bool) -> Check:
    """Whether the question holds the geometry that the readings hold, or subtracts it: else it is taken for compliance.

    On a path around a ball that is the machine's; elsewhere the zeros of the sensors are enough.
    """
    geometric = [source.name for source in sources if not (source.elastic or (around and source.set_up))]
    return Check("geometry in the model", reference or bool(geometric), {"geometric": len(geometric)}, decisive=True)


def influences_stated(labels: Sequence[str], reference: bool) -> Check:
    """Whether systematic influences are in the uncertainties; not tested where there is no uncertainty."""
    return Check("systematic influences stated", None if reference else bool(labels), {"stated": tuple(labels)})


def free_of_assumptions(budget: Budget) -> Check | None:
    """Whether the values are independent of what was assumed of the readings; no check where nothing was."""
    assumed = sorted({line.label for lines in budget.lines for line in lines if line.label.startswith(ASSUMED)})
    if not assumed:
        return None
    depends = {}
    for name, lines, u in zip(budget.labels, budget.lines, budget.standard_uncertainty, strict=True):
        share = float(np.linalg.norm([line.contribution for line in lines if line.label in assumed])) / float(u)
        if share > DEPENDS:
            depends[name] = share
    return Check("free of assumptions", not depends, {"assumed": tuple(assumed), "depends": depends})


def separated(parameters: Sequence[Parameter], levels: ForceLevels) -> Check:
    """Whether compliance and geometry are distinguished, by more than differences of force within one level."""
    mixed = tuple(tuple(parameter.stands_for) for parameter in parameters if not parameter.separated)
    alone = levels.members[0] if len(levels.members) == 1 else ()
    within = (alone[0], alone[-1]) if alone and alone[0] < alone[-1] else None
    passed = not mixed and within is None
    facts = {"mixed": mixed, "combinations": len(parameters), "within": within}
    return Check("separated", passed, facts, decisive=not passed)


def uncertainty_by_run(by_run: bool, runs: int, reference: bool, needed: int | None, unshown: Sequence[str] = ()) -> Check:
    """Whether the uncertainties assume independent runs; there are none if not."""
    facts = {"runs": runs, "reference": reference, "needed": needed, "unshown": tuple(unshown) if by_run else ()}
    return Check("uncertainty by run", by_run and not unshown, facts)


def first_order_enough(agreement: Agreement, parameters: Sequence[Parameter]) -> Check:
    """Whether the intervals to first order hold the share of random draws that they should (JCGM 101, 8)."""
    apart = {
        parameter.name: {
            "below": float(agreement.beyond[k, 0]),
            "above": float(agreement.beyond[k, 1]),
            "low": float(agreement.interval[k, 0]),
            "high": float(agreement.interval[k, 1]),
            "unit": parameter.unit,
        }
        for k, parameter in enumerate(parameters)
        if not agreement.agrees[k]
    }
    facts = {"apart": apart, "trials": agreement.draws.trials, "coverage": COVERAGE, "within": TAIL}
    return Check("first order enough", not apart, facts)


def free_of_outliers(weights: Sequence[Array]) -> Check:
    """Whether a reading lies further off than noise takes it, by the weights of a robust estimate."""
    every = np.concatenate(weights)
    far = int(np.sum(every < HUBER / OUTLYING))
    facts = {"fewer": int(np.sum(every < 1.0)), "readings": len(every), "outlying": far, "limit": OUTLYING}
    return Check("free of outliers", far == 0, facts)


def model_adequate(models: ModelChoice) -> Check:
    """Whether the model that was asked is the one that the data support."""
    asked = models.candidates[0]
    facts: dict[str, Any] = {"levels": models.levels, "runs": models.runs, "p_value": asked.p_value}
    if models.supported is not None:
        best = models.of(models.supported)
        facts |= {
            "supported": best.name,
            "stands_for": best.stands_for,
            "places": models.places,
            "alike": tuple(name for name in models.alike if name != best.name),
            "added": {name: models.of(name).added for name in dict.fromkeys((best.name, *models.alike))},
            "owners": {
                label: owners
                for name in (best.name, *models.alike)
                for label, owners in zip(models.of(name).added, models.of(name).stands_for, strict=True)
            },
            "explained": models.explained,
            "exponent": best.exponent,
            "left_out": best.left_out_level,
            "left_out_asked": asked.left_out_level,
            "log_ratio": best.log_ratio,
            "log_ratio_uncertainty": best.log_ratio_uncertainty,
            "off_level": None if models.off_level is None else models.off_level.force,
        }
    return Check("model adequate", models.constant, facts)


def levels_agree(models: ModelChoice) -> Check:
    """Whether the supported model, fitted to all other levels, predicts each."""
    off = models.off_level
    facts: dict[str, Any] = {"levels": models.levels, "runs": models.runs}
    if off is not None:
        facts |= {"force": off.force, "size": off.size, "p_value": off.p_value}
    return Check("levels agree", None if models.supported is None else off is None, facts)


def geometry_constant(models: ModelChoice, change: Change | None, geometric: Sequence[str]) -> Check:
    """Whether one geometry holds at all forces: it follows from the model that the data support.

    What local estimates seem to say is beside it: where the model lacks something, they change with the force, although
    nothing of the geometry does.
    """
    seeming: dict[str, float] = {}
    if change is not None:
        seeming = {name: change.each[name] for name in geometric if change.each[name] < SIGNIFICANT / len(geometric)}
    passed = None if models.supported is None else models.explained
    return Check("geometry constant", passed, {"seeming": seeming, "supported": models.supported})


def residuals_unstructured(harmonics: Mapping[str, Harmonic], shared: Harmonic | None, rmse: float) -> Check:
    """Whether the residuals are what the uncertainties take them for.

    An uncertainty by run holds what differs from run to run, so that only what runs have in common (`shared`) counts;
    without one, the readings are to be independent, and any structure of any run counts.
    """
    left = {run: harmonic for run, harmonic in harmonics.items() if harmonic.significant}
    facts: dict[str, Any] = {"rmse": rmse, "shared": None, "runs": len(harmonics), "structured": len(left)}
    if shared is not None:
        facts |= {"shared": shared.significant, "order": shared.order, "amplitude": shared.amplitude}
        return Check("residuals without structure", not shared.significant, facts)
    if left:
        run, worst = max(left.items(), key=lambda item: item[1].amplitude)
        facts |= {"run": run, "order": worst.order, "amplitude": worst.amplitude}
    return Check("residuals without structure", not left, facts)


def above_resolution(effect: Mapping[str, float], resolution: float | None, *, angles: bool = False) -> Check:
    """Whether every retained parameter moves the readings [mm or rad] by more than the instrument can resolve."""
    if resolution is None:
        return Check("above resolution", None, {"resolution": None, "below": {}, "angles": angles})
    below = {name: value for name, value in effect.items() if value < resolution}
    return Check("above resolution", not below, {"resolution": resolution, "below": below, "angles": angles})
