"""The verdict: named checks that every identification ends in, each with a sentence a person can act on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from elastogeo.estimate import Confounding
from elastogeo.identify.fit import Harmonic

CONDITION_LIMIT = 30.0
"""Scaled condition number above which estimates are strongly coupled (Belsley, Kuh and Welsch, 1980)."""

UM = 1000.0


@dataclass(frozen=True, slots=True)
class Check:
    """One check of the verdict."""

    name: str
    passed: bool
    sentence: str


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


def conditioned(found: Confounding) -> Check:
    """Whether the retained parameters are far enough from one another."""
    good = found.condition_scaled <= CONDITION_LIMIT
    advice = "" if good else "; add force levels further apart, or another plane"
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


def residuals_unstructured(harmonics: Mapping[str, Harmonic], rmse: float) -> Check:
    """Whether the residuals of every run are noise."""
    left = {run: harmonic for run, harmonic in harmonics.items() if harmonic.significant}
    if not left:
        return Check("residuals without structure", True, f"The residuals look like noise; RMSE {rmse * UM:.3g} um.")
    run, worst = max(left.items(), key=lambda item: item[1].amplitude)
    return Check(
        "residuals without structure",
        False,
        f"A harmonic of order {worst.order} with an amplitude of {worst.amplitude * UM:.3g} um is left in run {run} "
        f"({len(left)} of {len(harmonics)} runs have one; RMSE {rmse * UM:.3g} um): the model does not explain it, and the "
        f"stated uncertainties, which count on independent residuals, do not cover it.",
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
