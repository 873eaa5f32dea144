"""What the checks of a positioning test say."""

from __future__ import annotations

import numpy as np

from elastogeo.report.numbers import pretty, probability, significant
from elastogeo.report.scales import ARCSEC
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import UM


@says("approached from both sides")
def approached_from_both_sides(facts: Facts, passed: bool | None) -> str:
    """Whether there is a reversal to speak of."""
    if passed:
        return "The targets were approached in both directions."
    return (
        f"The targets were approached in {facts['sides'][0]} only: there is no reversal, and no value of both directions; "
        f"backlash stays unknown."
    )


@says("cycles enough")
def cycles_enough(facts: Facts, passed: bool | None) -> str:
    """How often each target was approached."""
    least, most = facts["least"], facts["most"]
    often = f"{least}" if least == most else f"{least} to {most}"
    said = f"Each target was approached {often} {'time' if most == 1 else 'times'} in each direction"
    if passed:
        return f"{said}; the standard asks for {facts['wanted']}."
    why = " One approach shows no scatter: there is no repeatability and no accuracy." if least < 2 else ""
    return f"{said}; the standard asks for {facts['wanted']}.{why}"


@says("targets enough")
def targets_enough(facts: Facts, passed: bool | None) -> str:  # noqa: ARG001
    """How many targets there are."""
    return f"{facts['targets']} targets; for this travel the standard asks for {facts['wanted']} at least."


@says("targets unevenly spaced")
def targets_unevenly_spaced(facts: Facts, passed: bool | None) -> str:
    """Whether a periodic error can hide between the targets."""
    if passed:
        return "The targets are unevenly spaced, so that a periodic error does not hide between them."
    step = f"{np.rad2deg(facts['step']):.4g}°" if facts["rotary"] else f"{facts['step']:.4g} mm"
    return (
        f"The targets are all {step} apart: an error of the screw or scale whose period divides that is read at one phase "
        f"and stays unseen. Add a random part to each target."
    )


@says("readings complete")
def readings_complete(facts: Facts, passed: bool | None) -> str:
    """Whether every target has as many readings."""
    if passed:
        return "Every target has as many readings as any other."
    return (
        f"The targets have {facts['least']} to {facts['most']} readings in each direction; each counts with those it has, "
        f"and one with few knows its scatter badly."
    )


@says("free of drift")
def free_of_drift(facts: Facts, passed: bool | None) -> str:
    """Whether the cycles wander one way."""
    if passed is None:
        return f"A drift cannot be told from {facts['cycles']} cycles; it takes {facts['needed']}."
    size = _size(facts["drift"], facts)
    said = f"Over {facts['cycles']} cycles the readings go {size} one way, p = {probability(facts['p_value'])}"
    if passed:
        return f"{said}: no more than they scatter."
    return f"{said}: they drift; what is drift counts as repeatability here. Let machine and sensor warm up."


@says("error motion followed")
def error_motion_followed(facts: Facts, passed: bool | None) -> str:
    """Whether the parameters say what the means by target say."""
    if passed is None:
        return "Whether the parameters follow the means by target was not tested: it takes two cycles."
    left, scatter = _size(facts["left"], facts), _size(facts["scatter"], facts)
    said = f"The parameters of the error motion leave {left} of the means by target, cycles scatter by {scatter}"
    if passed:
        return f"{said}."
    return (
        f"{said}: they are the smooth part of it only, and what they leave is in no interval. For a correction take the "
        f"table by target; beside other tests ask for higher degrees or a period (P_XXc1)."
    )


def _size(value: float, facts: Facts) -> str:
    """A deviation in its unit."""
    return pretty(f"{significant(value * ARCSEC)}″" if facts["angular"] else f"{significant(value * UM)} µm")
