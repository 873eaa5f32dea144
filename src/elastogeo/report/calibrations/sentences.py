"""What the checks of a calibration say."""

from __future__ import annotations

from collections.abc import Sequence

from elastogeo.report.numbers import p_said, significant
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import UM, in_micrometres


@says("force on a straight line")
def force_on_a_line(facts: Facts, passed: bool | None) -> str:
    """Whether the force goes with the pressure along a straight line."""
    most = f"{significant(facts['nonlinearity'], 2)} N"
    if passed:
        chance = p_said(facts["p_value"])
        return f"No reading is further than {most} from the straight line, and no bend shows ({chance})."
    return (
        f"The readings bend ({p_said(facts['p_value'])}, up to {most} from the line): the calibration is a table "
        f"of {facts['levels']} pressures, interpolated between them. Calibrate at the pressures of the test."
    )


@says("same force rising and falling")
def same_both_ways(facts: Facts, passed: bool | None) -> str:
    """Whether friction sets rising and falling pressure apart."""
    if passed is None:
        way = "rising" if facts["rising"] else "falling"
        return f"Not tested: the pressure was {way} throughout. Go up and down, so that friction of the cylinder shows."
    apart = significant(abs(facts["rising_minus_falling"]), 2)
    if passed:
        return f"Rising and falling pressure agree within their scatter ({apart} N apart)."
    more = "greater" if facts["rising_minus_falling"] > 0 else "smaller"
    return (
        f"With rising pressure the force is {apart} N {more} than with falling: friction of the cylinder. Set the pressure "
        f"of a test from one side, the side of the calibration."
    )


@says("deflection in proportion to the pressure")
def deflection_in_proportion(facts: Facts, passed: bool | None) -> str:
    """Whether the set-up gives way in proportion (Eq. 5.38)."""
    most = f"{in_micrometres(facts['greatest'], 2)} µm"
    if passed:
        return f"The readings leave Eq. 5.38 by {most} at most, and no bend shows ({p_said(facts['p_value'])})."
    return (
        f"The deflection bends with the pressure ({p_said(facts['p_value'])}, up to {most} from the line): a joint "
        f"of the set-up gives, or the post slips. Tighten it and read again; one number does not describe it."
    )


@says("machine's secants free of an offset")
def machine_free_of_an_offset(facts: Facts, passed: bool | None) -> str:
    """Whether the machine stiffens, or its secants hold what is the same at every engagement."""
    offset, share = f"{significant(facts['offset_mm'] * UM, 2)} µm", 100 * facts["share"]
    if passed:
        return f"{offset} of the machine's deflection are the same at every engagement, {share:.2g} % of the least."
    straight = facts["straight_from_N"]
    where = "" if straight in (None, facts["force_N"]) else f" from {straight:.0f} N on"
    secants, increments = (_stiffnesses(facts[name]) for name in ("secants_mm_per_N", "increments_mm_per_N"))
    return (
        f"{offset} of the machine's deflection are the same at every engagement{where}, {share:.0f} % of the least: what "
        f"gives way before the contact carries. Secants change with it ({secants} N/µm); the increments ({increments} N/µm) "
        f"are free of it and show the machine."
    )


@says("set-up's compliance constant")
def set_up_constant(facts: Facts, passed: bool | None) -> str:
    """Whether one number describes the set-up."""
    said = f"{_stiffnesses(facts['secants_mm_per_N'])} N/µm"
    if passed is None:
        return f"Not tested: neither the resolution of the dials nor a repeat says how well {said} are known."
    chance = p_said(facts["p_value"])
    if passed:
        return f"One compliance describes ball and roller at every engagement ({said}, {chance})."
    return (
        f"The set-up is not equally stiff at every engagement ({said}, {chance}): take the table over the engagement, "
        f"not one constant."
    )


@says("readings repeated")
def readings_repeated(facts: Facts, passed: bool | None) -> str:
    """Whether repeats show the scatter."""
    if passed:
        return f"{facts['repeats']} repeats within {facts['engagements']} engagements show the scatter."
    known = "; the dials' resolution alone, which the checks use, is less than that" if facts["resolution_mm"] > 0 else ""
    return (
        f"Not tested: each engagement was read once, so no interval holds what readings scatter{known}. Press three times "
        f"to each."
    )


def _stiffnesses(compliances: Sequence[float]) -> str:
    return ", ".join(f"{1 / (value * UM):.3g}" if value > 0 else "∞" for value in compliances)
