"""What the checks of an identification say."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from elastogeo.report.identification.models import left_out_said, model_said, owners_said, supported_said, together_said
from elastogeo.report.numbers import display_unit, probability, significant
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import MICRO, UM

REMEDIES = {
    "levels": "add force levels further apart, or another plane",
    "motion": "record more feeds and accelerations, in both directions",
}

_NOT_TESTED = {
    "nothing restricted": "physics restricts nothing that this test determines, because no compliance that a load causes "
    "along itself was asked for and seen",
}


@says("identifiable")
def identifiable(facts: Facts, passed: bool | None) -> str:
    """How many parameters the test determines."""
    asked, rank, null = facts["asked"], facts["rank"], facts["null"]
    if facts["by_default"] and rank < asked:
        return (
            f"The instrument's default question has {asked} parameters, of which the test determines {rank} "
            f"combinations; what "
            f"each stands for is said."
        )
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
    if not any(levels):
        return "No run has a force: nothing can be said of compliance. Load the machine, or ask for geometry alone."
    if len(levels) == 1:
        return (
            f"All runs are at {levels[0]:g} N, within the uncertainty of their forces: what grows with the load cannot be "
            f"distinguished from what does not. Measure at two clearly different forces."
        )
    return (
        f"{len(levels)} force levels, {levels[0]:g} to {levels[-1]:g} N, are only {facts['separation']:.2g} times their "
        f"uncertainty apart (wanted: {facts['limit']:g}): the forces alone decide what counts as compliance. Measure at "
        f"forces further apart, or state how well they are known (influence force-level)."
    )


@says("geometry in the model")
def geometry_modelled(facts: Facts, passed: bool | None) -> str:  # noqa: ARG001
    """Whether the geometry that the readings hold is in the model."""
    if passed:
        return "The geometry that the readings hold is in the model, or subtracted with the reference level."
    return (
        "The question holds compliance and no geometry, and no reference level is subtracted: the machine's geometry is "
        "taken for compliance. Ask for both (the default, or the preset loaded-xy), or subtract a reference level."
    )


@says("systematic influences stated")
def influences_stated(facts: Facts, passed: bool | None) -> str:
    """Which systematic influences are in the uncertainties."""
    if passed is None:
        return "Not tested: with a reference level subtracted there is no uncertainty that they could be in."
    if passed:
        return f"The uncertainties hold {', '.join(dict.fromkeys(facts['stated']))}."
    return (
        "The test states no systematic influence: no uncertainty of the force, of the instrument or of the temperature is "
        "in the intervals. State what is known under [[influences]]."
    )


@says("separated")
def separated(facts: Facts, passed: bool | None) -> str:
    """Whether compliance and geometry are distinguished."""
    mixed = facts["mixed"]
    if passed:
        return "Compliance and geometry are separated: no combination mixes the two."
    if not mixed:
        low, high = facts["within"]
        return (
            f"Only forces of one level, {low:g} to {high:g} N, separate compliance and geometry: they differ by less than "
            f"their uncertainty. Measure at two clearly different forces."
        )
    sums = "; ".join(" with ".join(names) for names in mixed)
    return (
        f"Compliance and geometry cannot be separated in {len(mixed)} of {facts['combinations']} combinations ({sums}): the "
        f"test has too few distinct forces. Only the sums are determined, and none of their members may be named the cause. "
        f"Measure at two forces at least."
    )


@says("tests agree")
def tests_agree(facts: Facts, passed: bool | None) -> str:
    """Whether the tests agree, and which does not."""
    if passed is None:
        return (
            "Not tested: no runs of one test show how runs scatter; repeat runs, or measure more levels."
            if facts["shared"]
            else "Not tested: no two tests determine the same."
        )
    if passed:
        alone = f" Nothing else determines what {' and '.join(facts['unshared'])} says." if facts["unshared"] else ""
        return f"Each test agrees with all others, by the scatter of runs and the stated influences.{alone}"
    named, rest = facts["named"], facts["rest_agrees"]
    if len(named) > 1:
        return (
            f"The tests contradict one another; without {_either(named)} the others agree, and the tests cannot say which "
            f"of them is wrong. Check their forces, axes and radii, or measure one more."
        )
    (name,) = named
    if not rest:
        others = ", ".join(one for one in facts["disagreeing"] if one != name)
        return (
            f"{name} contradicts the others most, and without it they still disagree ({others}): more than one test is "
            f"wrong, or the model is. Check forces, axes and radii, and ask for what else may move between the tests."
        )
    if facts["run"] or facts["level"] is not None:
        part = f"the run at {facts['level']:g} N" if facts["run"] and facts["level"] is not None else ""
        part = part or (facts["run"] if facts["run"] else f"the level of {facts['level']:g} N")
        return f"{name} contradicts the others, and only because of {part}: without it all agree. Check that force and run."
    return (
        f"{name} contradicts the others, which agree without it. Check its force, its axes and its radius as stated; leave "
        f"it out, or ask for what changed before it."
    )


def _either(names: tuple[str, ...]) -> str:
    return f"{', '.join(names[:-1])} or {names[-1]}"


@says("uncertainty by run")
def uncertainty_by_run(facts: Facts, passed: bool | None) -> str:
    """What the uncertainties assume to be independent."""
    runs, needed = facts["runs"], facts["needed"]
    if passed:
        return f"The uncertainties come from the scatter of {runs} runs, not of readings."
    if facts["reference"]:
        return (
            "No interval: a reference level is subtracted, and readings along a trace are not independent. Ask without a "
            "reference level."
        )
    remedy = "repeat the runs" if needed is None else f"it takes {needed} runs like these"
    if facts["unshown"]:
        return (
            f"No interval of {', '.join(facts['unshown'])}: hardly more than one of the {runs} runs knows so much; {remedy}."
            f" All others have theirs from the scatter of the runs."
        )
    return f"No interval: {runs} run{'s are' if runs > 1 else ' is'} too few to show how far runs scatter; {remedy}."


@says("first order enough")
def first_order_enough(facts: Facts, passed: bool | None) -> str:
    """Whether the intervals to first order hold as many Monte Carlo trials as they should; else the intervals to use."""
    if passed is None:
        return f"Not judged: {facts['why']}."
    trials = f"{facts['trials']} Monte Carlo trials"
    tail = f"{(1 - facts['coverage']) / 2:.1%}"
    if passed:
        return f"The intervals leave {tail} of {trials} on either side, to within {facts['within']:.1%}."
    beyond = "; ".join(f"{name} {x['below']:.1%} below, {x['above']:.1%} above" for name, x in facts["apart"].items())
    instead = "; ".join(f"{name} {drawn_interval(drawn)}" for name, drawn in facts["apart"].items())
    return (
        f"The interval to first order should leave {tail} of {trials} on either side, and leaves: {beyond}. A distribution "
        f"that is not normal, or a model that is not linear, decides. The interval given is that of the trials: {instead}."
    )


def drawn_interval(drawn: Facts) -> str:
    """An interval [unit of the house] as `61.2 to 62.6 nm/N`."""
    shown = display_unit(drawn["unit"], max(abs(drawn["low"]), abs(drawn["high"])))
    return f"{significant(drawn['low'] * shown.factor, 4)} to {significant(drawn['high'] * shown.factor, 4)} {shown.name}"


@says("free of assumptions")
def free_of_assumptions(facts: Facts, passed: bool | None) -> str:
    """Which values depend on what was assumed of the readings."""
    what = " and ".join(label.removeprefix("assumed ") for label in facts["assumed"])
    if passed:
        return f"Something of the readings is assumed, not known ({what}); no value depends on it."
    named = ", ".join(facts["depends"])
    return f"{named} depend on what is assumed, not known, of the readings ({what})."


@says("free of outliers")
def free_of_outliers(facts: Facts, passed: bool | None) -> str:
    """How many readings count less, and how many are outliers."""
    price = (
        f"{facts['fewer']} of {facts['readings']} readings count less than one (normal noise alone would make it 18 %); "
        f"where nothing is wrong, the robust estimate costs 2.6 % greater standard uncertainties"
    )
    if passed:
        return f"No reading is further off than {facts['limit']:g} standard deviations. {price}."
    one = facts["outlying"] == 1
    return (
        f"{facts['outlying']} {'reading is' if one else 'readings are'} further off than {facts['limit']:g} standard "
        f"deviations: look for the cause. {price}."
    )


@says("residuals without structure")
def residuals_unstructured(facts: Facts, passed: bool | None) -> str:
    """Which harmonic the model leaves over: in all runs, or, where readings are to be independent, in one."""
    rmse = f"RMSE {facts['rmse'] * UM:.3g} µm"
    own, runs = facts["structured"], facts["runs"]
    if passed and not own:
        return f"The residuals look like noise; {rmse}."
    if passed:
        return (
            f"The runs share no structure; {rmse}. {own} of {runs} {'has' if own == 1 else 'have'} a structure of "
            f"{'its' if own == 1 else 'their'} own, which the uncertainty by run covers."
        )
    harmonic = f"A harmonic of order {facts['order']}, amplitude {facts['amplitude'] * UM:.3g} µm,"
    if facts["shared"]:
        return (
            f"{harmonic} is left that the {runs} runs share or that grows with the force ({rmse}): the model does not "
            f"explain it, and the stated uncertainties do not cover it."
        )
    return (
        f"{harmonic} is left in run {facts['run']} ({own} of {runs} runs have one; {rmse}): the model does not explain it, "
        f"and the stated uncertainties, which assume independent readings, do not cover it."
    )


@says("above resolution")
def above_resolution(facts: Facts, passed: bool | None) -> str:
    """Which parameters move the readings too little."""
    resolution, below = facts["resolution"], facts["below"]
    if passed is None:
        return "Not tested: the test file does not state the resolution of the readings."
    factor, unit = (MICRO, "µrad") if facts["angles"] else (UM, "µm")
    if passed:
        return f"Every parameter moves the readings by over {resolution * factor:.2g} {unit}."
    named = ", ".join(f"{name} ({value * factor:.2g} {unit})" for name, value in below.items())
    one = len(below) == 1
    return (
        f"{named} {'moves' if one else 'move'} the readings by less than their resolution of {resolution * factor:.2g} "
        f"{unit}; do not rely on {'its value' if one else 'their values'} alone."
    )


@says("physically consistent")
def physically_consistent(facts: Facts, passed: bool | None) -> str:
    """Whether joints can give the estimate: confirmed, contradicted, or what keeps the test from telling."""
    if passed:
        return "Joints that are symmetric and never gain energy can give this estimate, and all that its uncertainty holds."
    if "distance" not in facts or facts["why"] in _NOT_TESTED:
        return f"Not tested: {_NOT_TESTED.get(facts['why'], facts['why'])}."
    outside = f"{_units(facts['distance'])} outside what joints that are symmetric and never gain energy can give"
    if passed is None:
        return f"Not tested: {_undecided(facts, outside)}"
    p = probability(facts["p_value"])
    p = p if p.startswith("<") else f"= {p}"
    named = "".join(f" {_negative(name, found)}" for name, found in facts["negative"].items())
    named = named or f" {facts['farthest']} is larger than the compliances of the same joints along one load allow."
    return (
        f"The data contradict physics (p {p}): the estimate is {outside}.{named} {_why_contradicted(facts)} Do not use the "
        f"values as compliances of joints."
    )


def _why_contradicted(facts: Facts) -> str:
    geometry = facts.get("with_geometry")
    if not geometry or geometry["state"] == "contradicted":
        return "Either the model lacks something that the readings hold, or the uncertainty misses an influence."
    told = "".join(f" {_negative(name, found)}" for name, found in geometry["values"].items())
    return f"With {owners_said(geometry['owners'])} in the model they do not:{told}"


def _units(distance: float) -> str:
    shown = significant(distance, 2 if distance < 100 else 3)
    return f"{shown} standard uncertainties"


def _undecided(facts: Facts, outside: str) -> str:
    """Why the test cannot tell, and what would."""
    if facts["why"] == "independent readings assumed":
        where = f"the estimate is {outside}, but that" if facts["distance"] else "the"
        return f"{where} uncertainty assumes independent readings. Repeat the runs."
    if facts["why"] == "few degrees of freedom":
        return (
            f"the estimate is {outside}, but with {facts['degrees_of_freedom']:.2g} degrees of freedom the uncertainty is "
            f"not known well enough to say whether noise explains it. Repeat the runs."
        )
    use = " Use the constrained values." if facts["distance"] else ""
    if not facts["closest"]:
        return f"cross terms agree with their mirrors; no compliance that a load causes along itself was seen.{use}"
    ((name, found),) = facts["closest"].items()
    if found["shows"] is None:
        return (
            f"{name} is, within its uncertainty, the largest that the compliances of the same joints along one load allow. "
            f"That is no fault.{use}"
        )
    unit = display_unit(found["unit"], max(abs(found["value"]), found["standard_uncertainty"]))
    value, uncertainty, shows = (found[key] * unit.factor for key in ("value", "standard_uncertainty", "shows"))
    return (
        f"{_sum(name, found)} is too close to zero to show that it is positive, {significant(value, 2)} {unit.name} with a "
        f"standard uncertainty of {significant(uncertainty, 2)}. That is no fault; below {significant(shows, 2)} it would "
        f"have been found as one.{use}"
    )


def _negative(name: str, found: Mapping[str, Any]) -> str:
    unit = display_unit(found["unit"], found["value"])
    value, uncertainty = found["value"] * unit.factor, found["standard_uncertainty"] * unit.factor
    return (
        f"{_sum(name, found)} is {significant(value)} {unit.name} with a standard uncertainty of "
        f"{significant(uncertainty, 2)}."
    )


def _sum(name: str, found: Mapping[str, Any]) -> str:
    others = [other for other in found["stands_for"] if other != name]
    return f"{name} (the sum with {', '.join(others)})" if others else name


@says("model adequate")
def model_adequate(facts: Facts, passed: bool | None) -> str:
    """Which model the data support, and from what the test cannot distinguish it."""
    if passed is None:
        return (
            f"Not tested: {facts['levels']} force levels in {facts['runs']} runs show no richer model. Add force levels or "
            f"repeat runs."
        )
    if passed:
        off = "" if facts["off_level"] is None else f", once {facts['off_level']:g} N is left out"
        return (
            f"Nothing of geometry, compliance, force or set-up is missing from the model{off} (p = {facts['p_value']:.2g})."
        )
    asked, best = left_out_said(facts["left_out_asked"]), left_out_said(facts["left_out"])
    if not facts["explained"]:
        return (
            f"The model lacks something (p = {facts['p_value']:.2g}), and no model that was tried explains it; "
            f"{model_said(facts['supported'])} comes nearest, and predicts left-out force levels to {best}, the model as "
            f"asked to {asked}."
        )
    together = together_said(facts["added"], facts["owners"]) if facts["alike"] else ""
    if together:
        return (
            f"The data support {together}. This test cannot distinguish them. The first predicts left-out force levels to "
            f"{best}, the model as asked to {asked}."
        )
    model = supported_said(facts["supported"], facts["stands_for"], facts["exponent"])
    words = f"The data support {model}: it predicts left-out force levels to {best}, the model as asked to {asked}."
    others = "; ".join(model_said(name) for name in facts["alike"])
    return f"{words} This test cannot distinguish it from: {others}." if others else words


@says("levels agree")
def levels_agree(facts: Facts, passed: bool | None) -> str:
    """Which force level does not follow the others."""
    if passed is None:
        return f"Not tested: {facts['levels']} force levels in {facts['runs']} runs are too few."
    if passed:
        return f"Each of the {facts['levels']} force levels is predicted by the others within their scatter."
    return (
        f"{facts['force']:g} N does not follow the other levels: it lies {facts['size'] * UM:.3g} µm (root mean square) "
        f"from what they predict (p = {facts['p_value']:.2g}). Repeat it, or leave it out."
    )


@says("geometry constant")
def geometry_constant(facts: Facts, passed: bool | None) -> str:
    """Whether one geometry holds at all forces, and why local estimates may seem to say otherwise."""
    if passed is None:
        return "Not tested: too few force levels to distinguish a geometry that changes from a model that lacks something."
    if not passed:
        return "No model that was tried describes all force levels with one geometry."
    seeming = ", ".join(facts["seeming"])
    if seeming and facts["supported"] != "constant":
        return (
            f"One geometry holds at all forces with {model_said(facts['supported'])}. Local estimates of {seeming} seem to "
            f"change with the force because the model as asked lacks that."
        )
    return "One geometry holds at all forces."
