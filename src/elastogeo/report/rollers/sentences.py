"""What the checks of a stiffness map say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from elastogeo.report.numbers import p_said
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import UM


@says("one stiffness at every engagement")
def one_stiffness(facts: Facts, passed: bool | None) -> str:
    """Which law of the compliance the engagements support."""
    levels = facts["levels_N"]
    if passed is None:
        return (
            f"Not tested: with {len(levels)} engagements none can be predicted from the others by a law that stiffens. Add "
            f"engagements, four or more."
        )
    if not facts["follows"]:
        return "No law of the compliance describes all engagements: use the increments between them."
    errors = ", ".join(f"{name} {error * UM:.2g} µm" for name, error in facts["left_out_mm"].items())
    if passed:
        return f"A constant compliance predicts left-out engagements as well as richer laws ({errors})."
    others = f", not distinguished from {' and '.join(facts['alike'])}" if facts["alike"] else ""
    return (
        f"The compliance depends on the force: the engagements support the law {facts['supported']}{others} (left-out "
        f"engagements predicted to: {errors}). Use the stiffness at the force of the cut."
    )


@says("engagements follow the law")
def engagements_follow(facts: Facts, passed: bool | None) -> str:
    """Whether the supported law describes the means of the engagements."""
    if passed is None:
        return "Not tested: the law takes as many parameters as there are engagements, or no engagement was repeated."
    if passed:
        return f"What the {facts['law']} law leaves of the engagements ({facts['rms_mm'] * UM:.2g} µm) is their scatter."
    return (
        f"The {facts['law']} law leaves {facts['rms_mm'] * UM:.2g} µm of the engagements, more than their scatter "
        f"({p_said(facts['p_value'])}): its intervals do not hold, the secants and increments do."
    )


@says("secants free of an offset")
def secants_free(facts: Facts, passed: bool | None) -> str:
    """Whether a secant shows the machine, or an offset of its path."""
    path, share, least = facts["path_mm"] * UM, 100 * facts["share"], facts["force_N"]
    if passed:
        return f"The path is off by {path:.2g} µm, {share:.2g} % of the deflection at {least:.0f} N."
    secants, increments = (_stiffnesses(facts[name]) for name in ("secants_mm_per_N", "increments_mm_per_N"))
    return (
        f"{path:.2g} µm are the same at every engagement, {share:.0f} % of the deflection at {least:.0f} N: the path, or "
        f"what gives way before it. It makes the secants of Eq. 6.5 change with the engagement ({secants} N/µm); the "
        f"increments ({increments} N/µm) are free of it."
    )


@says("engagements repeated")
def engagements_repeated(facts: Facts, passed: bool | None) -> str:
    """How many runs show the scatter."""
    runs = facts["degrees_of_freedom"]
    return (
        f"{runs} repeats within {facts['levels']} engagements show the scatter."
        f"{'' if passed else ' They are too few: repeat each engagement in both directions.'}"
    )


@says("losses when driven back known")
def losses_known(facts: Facts, passed: bool | None) -> str:
    """Whether the losses of the transmissions against the load's own power are stated."""
    assumed: Mapping[str, float] = facts["assumed"]
    if passed:
        return "The losses of drives that are driven back are stated, or there are none."
    listed = ", ".join(f"{axis} {value:.3g}" for axis, value in assumed.items())
    return (
        f"Not tested: the efficiency of drives that the ball drives back is not stated; assumed is that of a friction in "
        f"proportion to the load ({listed}), which brings up to {100 * facts['relative_uncertainty']:.2g} % into the "
        f"compliance. State back_efficiency, or compare with a dynamometer."
    )


@says("force agrees with the dynamometer")
def force_agrees(facts: Facts, passed: bool | None) -> str:
    """Gain and offset of the force from the currents."""
    if passed is None:
        return f"Not tested: {facts['reason']}."
    gain, offset = facts["gain_interval"], facts["offset_interval_N"]
    outside = [
        name for name, inside in (("gain 1", facts["gain_is_one"]), ("offset 0", facts["offset_is_zero"])) if not inside
    ]
    judged = "gain 1 and offset 0 lie within" if not outside else f"{' and '.join(outside)} outside"
    return (
        f"Force from the currents against the dynamometer: gain {facts['gain']:.4g} ({gain[0]:.4g} to {gain[1]:.4g}), "
        f"offset {facts['offset_N']:.3g} N ({offset[0]:.3g} to {offset[1]:.3g} N), {judged} the uncertainty of both "
        f"together, with that of the drives, over {facts['units']} {'runs' if facts['by_run'] else 'blocks'}. They differ "
        f"by {facts['rms_N']:.3g} N RMS, {facts['maximum_N']:.3g} N at most."
    )


@says("compliance with the rig as predicted")
def rig_as_predicted(facts: Facts, passed: bool | None) -> str:  # noqa: ARG001
    """In how many directions the rig adds what it should."""
    return (
        f"Measured and predicted compliance agree within their uncertainty in {facts['share']:.0%} of {facts['directions']} "
        f"directions; the worst, at {np.rad2deg(facts['worst_rad']):.0f}°, has the normalised error "
        f"{facts['normalised_error']:.2f}."
    )


def _stiffnesses(compliances: Sequence[float]) -> str:
    return ", ".join(f"{1 / (value * UM):.3g}" if value > 0 else "∞" for value in compliances)
