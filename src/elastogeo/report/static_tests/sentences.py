"""What the checks of a static test say."""

from __future__ import annotations

from elastogeo.report.numbers import p_said, significant
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import UM

_RESULTS = {
    "line": "the straight line",
    "matrix": "the Cartesian compliance",
    "twist": "the twist per force",
}
_ONE = set(_RESULTS.values())
_TIMES = {3: "three"}

_MICRO = 1e6
"""Nanometres in a millimetre."""


@says("displacement with the force")
def displacement_with_the_force(facts: Facts, passed: bool | None) -> str:
    """The static compliance, and the runs in which it is negative."""
    if passed is None:
        return _not_judged(facts, "static compliance")
    if passed:
        return f"Static compliance: {_extent(facts, _MICRO)} nm/N."
    return f"Static compliance{_wrong(facts, _MICRO)} nm/N; the displacement goes against the force: turn the sensor's sign."


@says("energy is lost, not gained")
def energy_is_lost(facts: Facts, passed: bool | None) -> str:
    """The mean hysteresis, and the loops that run the wrong way round."""
    if passed is None:
        return _not_judged(facts, "mean hysteresis")
    if passed:
        return f"Mean hysteresis: {_extent(facts, UM)} µm."
    return (
        f"Mean hysteresis{_wrong(facts, UM)} µm; the loop runs the wrong way round: force and displacement may be "
        f"shifted in "
        f"time against each other, or a sign is wrong."
    )


@says("uncertainty by cycle")
def uncertainty_by_cycle(facts: Facts, passed: bool | None) -> str:
    """Whether the uncertainty comes from the scatter of cycles."""
    if passed:
        return f"The uncertainties of each run come from the scatter of its cycles, {facts['cycles']} in all."
    runs = ", ".join(filter(None, facts["few"]))
    return (
        f"Too few cycles{f' in run {runs}' if runs else ''} to show how a further one would differ: no uncertainty is "
        f"given; "
        f"load {_TIMES.get(facts['needed'], facts['needed'])} times at least in a run."
    )


@says("loading cycles")
def loading_cycles(facts: Facts, passed: bool | None) -> str:
    """How many cycles there are, and which runs have none."""
    if passed:
        return f"{facts['cycles']} cycles of loading and unloading in {facts['runs']} runs."
    return f"{facts['without']} of {facts['runs']} runs say nothing of hysteresis. Run {facts['run']}: {facts['why']}."


@says("straight line enough")
def straight_line_enough(facts: Facts, passed: bool | None) -> str:
    """How much more the straight line leaves over than curves."""
    said = f"The straight line leaves {facts['line'] * UM:.3g} µm, curves through the branches {facts['curves'] * UM:.3g} µm"
    if passed:
        return f"{said}."
    return (
        f"{said}: hysteresis, curvature, or zeros that differ from run to run are more than scatter; take the line's "
        f"compliance as a mean over the range."
    )


@says("springs in series")
def springs_in_series(facts: Facts, passed: bool | None) -> str:
    """Which parts of a drive have a negative compliance."""
    if passed is None:
        return "Not tested: the runs are too few to show how the parts scatter."
    if passed:
        return "No part yields against the force by more than its uncertainty."
    return (
        f"The compliance of {', '.join(facts['negative'])} is negative by more than its uncertainty: the parts sum to more "
        f"than the whole, or a channel has the wrong sign, axis or unit."
    )


@says("uncertainty of the parts by run")
def uncertainty_of_the_parts(facts: Facts, passed: bool | None) -> str:
    """What the uncertainties of the parts of a drive assume to be independent."""
    if passed:
        return f"The uncertainties come from the scatter of {facts['runs']} runs."
    return _too_few(facts, "the parts")


@says("parts distinguished")
def parts_distinguished(facts: Facts, passed: bool | None) -> str:
    """Which parts of a drive are known as a sum only."""
    if passed:
        return "Each part that was seen stands for itself."
    return f"Only the sum is known of {'; '.join(facts['together'])}."


@says("drive located")
def drive_located(facts: Facts, passed: bool | None) -> str:  # noqa: ARG001
    """Why it cannot be said where in the drive the axis yields."""
    return _sentence(facts["why"])


@says("compliance determined")
def compliance_determined(facts: Facts, passed: bool | None) -> str:
    """Whether the Cartesian compliance is determined."""
    return "All nine elements are determined." if passed and not facts["why"] else _sentence(facts["why"])


@says("reciprocity")
def reciprocity(facts: Facts, passed: bool | None) -> str:
    """Whether C_ij and C_ji are the same."""
    if passed is None:
        return f"Not tested: {facts['why']}."
    said = (
        f"C_ij and C_ji differ by {significant(facts['greatest'] * _MICRO)} nm/N at most, chi-squared "
        f"{significant(facts['chi_squared'])} of three ({p_said(facts['p_value'])})"
    )
    return f"{said}{'.' if passed else ': look at the directions of the probes and of the force.'}"


@says("no energy gained")
def no_energy_gained(facts: Facts, passed: bool | None) -> str:
    """Whether the least principal compliance is positive."""
    said = f"The least principal compliance is {significant(facts['least'] * _MICRO)} nm/N"
    if passed is None:
        return f"Not tested: {said[:1].lower()}{said[1:]}, and the runs are too few to show how it scatters."
    return f"{said}{'.' if passed else ': a force would gain energy; look at the signs of the probes.'}"


@says("zeros of the probes")
def zeros_of_the_probes(facts: Facts, passed: bool | None) -> str:  # noqa: ARG001
    """What is assumed of the zeros."""
    if facts["zeroed"]:
        return "The probes are assumed zeroed without load, because no zero was asked for; else ask for E_Xw0, E_Yw0, E_Zw0."
    return "The zero of each probe is estimated with the compliance."


@says("uncertainty of the instrument's results by run")
def uncertainty_of_the_results(facts: Facts, passed: bool | None) -> str:
    """Whether the uncertainty of line, matrix or twist comes from the scatter of runs."""
    what = _RESULTS[facts["what"]]
    if passed:
        return f"The uncertainties of {what} come from the scatter of the runs."
    return _too_few(facts, what)


@says("twist determined")
def twist_determined(facts: Facts, passed: bool | None) -> str:
    """Whether the sensors see all of the twist."""
    return "The sensors determine all six components of the twist." if passed else _sentence(facts["why"])


@says("sensors agree")
def sensors_agree(facts: Facts, passed: bool | None) -> str:
    """Which sensor stands out."""
    if passed:
        return f"No sensor stands out of the {facts['sensors']}, in any run."
    if passed is None:
        return f"Nothing checks sensor {', '.join(map(str, facts['unchecked']))}; add sensors."
    said = ", ".join(f"sensor {sensor} in run {run}" for run, sensor in facts["suspects"].items())
    return (
        f"By more than the scatter of the others stands out: {said}. Look at how it touches, and at its cable; "
        f"leave it out if "
        f"it stays so."
    )


def _too_few(facts: Facts, what: str) -> str:
    runs, needed = facts["runs"], facts["needed"]
    few = f"{runs} run{'s are' if runs > 1 else ' is'} too few to show how {what} scatter{'s' if what in _ONE else ''}"
    do = "repeat the runs" if needed is None else f"{needed} runs like these give one"
    return f"{few}: no interval is given; {do}."


def _not_judged(facts: Facts, what: str) -> str:
    cycles = _TIMES.get(facts["needed"], facts["needed"])
    return f"Not tested: with fewer than {cycles} cycles in a run nothing shows how the {what} scatters."


def _extent(facts: Facts, scale: float) -> str:
    least, greatest = facts["least"] * scale, facts["greatest"] * scale
    return f"{least:.4g} to {greatest:.4g}" if least != greatest else f"{least:.4g}"


def _wrong(facts: Facts, scale: float) -> str:
    named = [f" in run {run}" if run else "" for run in facts["wrong"]]
    values = [f"{value * scale:.4g}" for value in facts["wrong"].values()]
    return ", ".join(f"{where}: {value}" for where, value in zip(named, values, strict=True))


def _sentence(reason: str) -> str:
    return f"{reason[:1].upper()}{reason[1:]}{'' if reason.endswith('.') else '.'}"
