"""The verdict: named checks that every identification ends in, each with a sentence a person can act on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from elastogeo.estimate import Confounding
from elastogeo.identification.budget import Agreement
from elastogeo.identification.change import SIGNIFICANT, Change
from elastogeo.identification.check import Check
from elastogeo.identification.fit import Harmonic
from elastogeo.identification.models import Comparison
from elastogeo.identification.result import Parameter
from elastogeo.machine import Array

CONDITION_LIMIT = 30.0
"""Scaled condition number above which estimates are strongly coupled (Belsley, Kuh and Welsch, 1980)."""

UM = 1000.0


def identifiable(found: Confounding) -> Check:
    """Whether every parameter that was asked for is determined by itself."""
    asked, together = len(found.labels), len(found.labels) - found.rank - len(found.null)
    if found.rank == asked:
        return Check("identifiable", True, f"All {asked} parameters are determined by the test.")
    return Check(
        "identifiable",
        False,
        f"Of {asked} parameters the test determines {found.rank} combinations: {len(found.null)} change no reading, "
        f"{together} cannot be told from the retained ones, which stand for sums.",
    )


def conditioned(found: Confounding, remedy: str = "add force levels further apart, or another plane") -> Check:
    """Whether the retained parameters are far enough from one another; if not, what would help."""
    good = found.condition_scaled <= CONDITION_LIMIT
    advice = "" if good else f"; {remedy}"
    return Check(
        "conditioned",
        good,
        f"The scaled condition number is {found.condition_scaled:.3g}, "
        f"{'below' if good else 'above'} the limit of {CONDITION_LIMIT:g}{advice}.",
    )


def forces_distinct(levels: Sequence[float]) -> Check:
    """Whether there is more than one force level, so that what grows with the load can be told from what does not."""
    count = len(levels)
    good = count >= 2
    return Check(
        "forces distinct",
        good,
        f"{count} force levels, {levels[0]:g} to {levels[-1]:g} N."
        if good
        else f"All runs are at {levels[0]:g} N: what grows with the load cannot be told from what does not; "
        f"two distinct forces are mandatory.",
    )


def separated(parameters: Sequence[Parameter]) -> Check:
    """Whether compliance and geometry are told apart."""
    mixed = [parameter for parameter in parameters if not parameter.separated]
    if not mixed:
        return Check("separated", True, "Compliance and geometry are told apart: no combination mixes the two.")
    sums = "; ".join(" with ".join(parameter.stands_for) for parameter in mixed)
    return Check(
        "separated",
        False,
        f"Compliance and geometry cannot be told apart in {len(mixed)} of {len(parameters)} combinations ({sums}): the test "
        f"has too few distinct forces. Only the sums are determined, and none of their members may be named the cause. "
        f"Measure at two forces at least.",
        decisive=True,
    )


def uncertainty_by_run(by_run: bool, runs: int, reference: bool) -> Check:
    """Whether the uncertainties count on independent runs."""
    if by_run:
        return Check("uncertainty by run", True, f"The uncertainties come from the scatter of {runs} runs, not of readings.")
    why = "a reference level is taken off" if reference else f"{runs} run{'s are' if runs > 1 else ' is'} too few"
    return Check(
        "uncertainty by run",
        False,
        f"The uncertainties count on independent readings, because {why}. Readings along a trace rarely are: repeat the runs"
        f"{' and ask without a reference level' if reference else ''}.",
    )


def geometry_constant(change: Change, geometric: Sequence[str]) -> Check:
    """Whether the geometry that adjacent force levels give is the same at all forces."""
    moved = [name for name in geometric if change.each[name] < SIGNIFICANT / len(geometric)]
    if not moved:
        return Check(
            "geometry constant",
            True,
            "The geometry estimated from adjacent force levels does not change by more than its uncertainty.",
        )
    return Check(
        "geometry constant",
        False,
        f"{', '.join(moved)} seems to change with the force by more than the uncertainty (p = "
        f"{min(change.each[name] for name in moved):.2g}): the compliance model is too simple; compare models.",
    )


def first_order_enough(agreement: Agreement, labels: Sequence[str]) -> Check:
    """Whether the intervals to first order are those of the random draws (JCGM 101, 8)."""
    apart = [label for label, agrees in zip(labels, agreement.agrees, strict=True) if not agrees]
    trials = f"{agreement.draws.trials} Monte Carlo trials"
    if not apart:
        return Check("first order enough", True, f"The intervals agree with {trials} within their numerical tolerance.")
    return Check(
        "first order enough",
        False,
        f"For {', '.join(apart)} the interval to first order differs from that of {trials} by more than one significant "
        f"digit of the uncertainty: a distribution that is not normal decides there. Use the Monte Carlo interval.",
    )


def outliers(weights: Sequence[Array]) -> Check:
    """How many readings the robust estimate counts less, and what it costs."""
    every = np.concatenate(weights)
    fewer = int(np.sum(every < 1.0))
    return Check(
        "outliers",
        True,
        f"Robust estimate: {fewer} of {len(every)} readings count less than one (normal noise alone would make it 18 %), "
        f"the least {every.min():.2g}. Its price where nothing is wrong is 2.6 % greater standard uncertainties.",
    )


def model_adequate(models: Comparison) -> Check:
    """Whether the constant compliance is what the data support."""
    constant = models.models[0]
    if models.supported == constant.name:
        return Check("model adequate", True, "A constant compliance predicts left-out levels as well as any richer model.")
    better = next(model for model in models.models if model.name == models.supported)
    exponent = f" (exponent {better.exponent:.2f})" if better.exponent else ""
    return Check(
        "model adequate",
        False,
        f"The data support a {better.name} compliance{exponent}: it predicts left-out force levels to "
        f"{(better.left_out_level or 0) * UM:.3g} um, a constant one to {(constant.left_out_level or 0) * UM:.3g} um.",
    )


def residuals_unstructured(harmonics: Mapping[str, Harmonic], rmse: float, by_run: bool) -> Check:
    """Whether the residuals of every run are noise."""
    left = {run: harmonic for run, harmonic in harmonics.items() if harmonic.significant}
    if not left:
        return Check("residuals without structure", True, f"The residuals look like noise; RMSE {rmse * UM:.3g} um.")
    run, worst = max(left.items(), key=lambda item: item[1].amplitude)
    return Check(
        "residuals without structure",
        False,
        f"A harmonic of order {worst.order} with an amplitude of {worst.amplitude * UM:.3g} um is left in run {run} "
        f"({len(left)} of {len(harmonics)} runs have one; RMSE {rmse * UM:.3g} um): the model does not explain it. "
        + ("What of it is the same in all runs" if by_run else "It")
        + " is not covered by the stated uncertainties.",
    )


def above_resolution(peak_to_peak: Mapping[str, float], resolution: float | None) -> Check:
    """Whether every retained parameter moves the readings by more than the instrument can resolve."""
    if resolution is None:
        return Check("above resolution", True, "The resolution of the readings was not given, so this was not checked.")
    below = {name: value for name, value in peak_to_peak.items() if value < resolution}
    if not below:
        return Check("above resolution", True, f"Every parameter moves the readings by over {resolution * UM:.2g} um.")
    named = ", ".join(f"{name} ({value * UM:.2g} um)" for name, value in below.items())
    return Check(
        "above resolution",
        False,
        f"{named} moves the readings by less than their resolution of {resolution * UM:.2g} um; do not rely on "
        f"{'its value' if len(below) == 1 else 'their values'} alone.",
    )
