"""What the checks of a calibration say."""

from __future__ import annotations

from elastogeo.report.numbers import probability, significant
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import in_micrometres


@says("force on a straight line")
def force_on_a_line(facts: Facts, passed: bool | None) -> str:
    """Whether the force goes with the pressure along a straight line."""
    most = f"{significant(facts['nonlinearity'], 2)} N"
    if passed:
        chance = probability(facts["p_value"])
        return f"No reading is further than {most} from the straight line, and no bend shows (p = {chance})."
    return (
        f"The readings bend (p = {probability(facts['p_value'])}, up to {most} from the line): the calibration is a table "
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
        return f"The readings leave Eq. 5.38 by {most} at most, and no bend shows (p = {probability(facts['p_value'])})."
    return (
        f"The deflection bends with the pressure (p = {probability(facts['p_value'])}, up to {most} from the line): a joint "
        f"of the set-up gives, or the post slips. Tighten it and read again; one number does not describe it."
    )
