"""What the checks of an identification say."""

from __future__ import annotations

from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import UM

REMEDIES = {
    "levels": "add force levels further apart, or another plane",
    "motion": "record more feeds and accelerations, in both directions",
}


@says("identifiable")
def identifiable(facts: Facts, passed: bool | None) -> str:
    """How many parameters the test determines."""
    asked, rank, null = facts["asked"], facts["rank"], facts["null"]
    if passed:
        return f"All {asked} parameters are determined by the test."
    return (
        f"Of {asked} parameters the test determines {rank} combinations: {null} change no reading, "
        f"{asked - rank - null} cannot be distinguished from the retained ones, which stand for sums."
    )


@says("conditioned")
def conditioned(facts: Facts, passed: bool | None) -> str:
    """How strongly the parameters are coupled, and what would help."""
    advice = "" if passed else f"; {REMEDIES[facts['remedy']]}"
    return (
        f"The scaled condition number is {facts['condition']:.3g}, {'below' if passed else 'above'} the limit of "
        f"{facts['limit']:g}{advice}."
    )


@says("forces distinct")
def forces_distinct(facts: Facts, passed: bool | None) -> str:
    """How many force levels there are."""
    levels = facts["levels"]
    if passed:
        return f"{len(levels)} force levels, {levels[0]:g} to {levels[-1]:g} N."
    return (
        f"All runs are at {levels[0]:g} N: what grows with the load cannot be distinguished from what does not; "
        f"two distinct forces are mandatory."
    )


@says("separated")
def separated(facts: Facts, passed: bool | None) -> str:
    """Whether compliance and geometry are distinguished."""
    mixed = facts["mixed"]
    if passed:
        return "Compliance and geometry are separated: no combination mixes the two."
    sums = "; ".join(" with ".join(names) for names in mixed)
    return (
        f"Compliance and geometry cannot be separated in {len(mixed)} of {facts['combinations']} combinations ({sums}): the "
        f"test has too few distinct forces. Only the sums are determined, and none of their members may be named the cause. "
        f"Measure at two forces at least."
    )


@says("uncertainty by run")
def uncertainty_by_run(facts: Facts, passed: bool | None) -> str:
    """What the uncertainties assume to be independent."""
    runs, reference = facts["runs"], facts["reference"]
    if passed:
        return f"The uncertainties come from the scatter of {runs} runs, not of readings."
    why = "a reference level is subtracted" if reference else f"{runs} run{'s are' if runs > 1 else ' is'} too few"
    return (
        f"The uncertainties assume independent readings, because {why}. Readings along a trace rarely are: repeat the runs"
        f"{' and ask without a reference level' if reference else ''}."
    )


@says("geometry constant")
def geometry_constant(facts: Facts, passed: bool | None) -> str:
    """Which geometry seems to change with the force."""
    moved = facts["moved"]
    if passed:
        return "The geometry estimated from adjacent force levels does not change by more than its uncertainty."
    return (
        f"{', '.join(moved)} {'seems' if len(moved) == 1 else 'seem'} to change with the force by more than the uncertainty "
        f"(p = {min(moved.values()):.2g}): the compliance model is too simple; compare models."
    )


@says("first order enough")
def first_order_enough(facts: Facts, passed: bool | None) -> str:
    """Whether the linear propagation agrees with the Monte Carlo trials."""
    if passed is None:
        return f"Not judged: {facts['why']}."
    trials = f"{facts['trials']} Monte Carlo trials"
    if passed:
        return f"The intervals agree with {trials} within their numerical tolerance."
    return (
        f"For {', '.join(facts['apart'])} the interval to first order differs from that of {trials} by more than one "
        f"significant digit of the uncertainty: a distribution that is not normal decides there. Use the Monte Carlo "
        f"interval."
    )


@says("outliers")
def outliers(facts: Facts, passed: bool | None) -> str:  # noqa: ARG001
    """How many readings count less."""
    return (
        f"Robust estimate: {facts['fewer']} of {facts['readings']} readings count less than one (normal noise alone would "
        f"make it 18 %), the least {facts['least']:.2g}. Its price where nothing is wrong is 2.6 % greater standard "
        f"uncertainties."
    )


@says("model adequate")
def model_adequate(facts: Facts, passed: bool | None) -> str:
    """Which model of the compliance the data support."""
    if passed:
        return "A constant compliance predicts left-out levels as well as any richer model."
    exponent = f" (exponent {facts['exponent']:.2f})" if facts["exponent"] else ""
    return (
        f"The data support a {facts['supported']} compliance{exponent}: it predicts left-out force levels to "
        f"{(facts['left_out'] or 0) * UM:.3g} µm, a constant one to {(facts['left_out_constant'] or 0) * UM:.3g} µm."
    )


@says("residuals without structure")
def residuals_unstructured(facts: Facts, passed: bool | None) -> str:
    """Which harmonic the model leaves over."""
    rmse = f"RMSE {facts['rmse'] * UM:.3g} µm"
    if passed:
        return f"The residuals look like noise; {rmse}."
    return (
        f"A harmonic of order {facts['order']} with an amplitude of {facts['amplitude'] * UM:.3g} µm is left in run "
        f"{facts['run']} ({facts['structured']} of {facts['runs']} runs have one; {rmse}): the model does not explain it. "
        f"{'Any part common to all runs' if facts['by_run'] else 'It'} is not covered by the stated uncertainties."
    )


@says("above resolution")
def above_resolution(facts: Facts, passed: bool | None) -> str:
    """Which parameters move the readings too little."""
    resolution, below = facts["resolution"], facts["below"]
    if passed is None:
        return "Not tested: the test file does not state the resolution of the readings."
    if passed:
        return f"Every parameter moves the readings by over {resolution * UM:.2g} µm."
    named = ", ".join(f"{name} ({value * UM:.2g} µm)" for name, value in below.items())
    one = len(below) == 1
    return (
        f"{named} {'moves' if one else 'move'} the readings by less than their resolution of {resolution * UM:.2g} µm; do "
        f"not rely on {'its value' if one else 'their values'} alone."
    )
