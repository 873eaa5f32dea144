"""What the report says in words: what the test cannot distinguish, and what to keep in mind. Only what applies is said."""

from __future__ import annotations

import re
from collections.abc import Mapping

from elastogeo.estimate import Confounding
from elastogeo.identification import SCATTER, SIGNIFICANT, Identification, Parameter
from elastogeo.observe import Campaign
from elastogeo.report.numbers import micro, probability, significant
from elastogeo.report.sentences import sentence_of
from elastogeo.report.text import all_separated, display_units, listed

REPEATABILITY = (
    "Repeatability is not uncertainty: it says how runs of one set-up scatter, not how far all of them are from the truth."
)
_OWN_RESULTS = {
    "positioning": "The values of ISO 230-2 (A, E, R, B, M): elastogeo positioning",
    "loading-cycles": "The hysteresis of each run: elastogeo static",
    "cartesian-stiffness": "The Cartesian stiffness: elastogeo static",
    "twist": "The twist of the tool: elastogeo static",
    "stiffness-map": "The stiffness in every direction: elastogeo stiffness",
}
_ON_AXIS = re.compile(r"C_([XYZABC])\1[A-Z]")
_COUNTS = 1e-3
"""Share of a parameter from which what was subtracted counts."""

_GAIN = re.compile(r"E_([XYZ])(?:\1)1")


def confounding_words(found: Confounding) -> list[str]:
    """What the test can and cannot distinguish, in sentences."""
    asked = len(found.labels)
    if found.rank == asked:
        return [f"Every one of the {asked} parameters that were asked for is distinguished from all others."]
    words = [f"{asked} parameters were asked for; the readings determine {found.rank} combinations of them, no more."]
    if found.null:
        verb = "changes" if len(found.null) == 1 else "change"
        words.append(f"{listed(found.null)} {verb} no reading of this test: nothing at all is known of them.")
    groups = [group for group in found.groups if len(group) > 1]
    if groups:
        words.append(
            "Parameters in one of the groups below always produce the same trace but for its size. No amount of readings of "
            "this test distinguishes them; what is estimated is the sum that is given below."
        )
    if asked - len(found.null) - sum(len(group) - 1 for group in groups) > found.rank:
        words.append(
            "Beyond the groups, some traces are exact sums of others; they are counted into the combinations above."
            if not groups
            else "Beyond the groups, some traces are exact sums of several others: see what each parameter stands for."
        )
    return words


def banner(result: Identification) -> list[str]:
    """What must be said before anything else where compliance and geometry are not distinguished; else nothing."""
    if all_separated(result):
        return []
    return [
        "Compliance and geometry are not distinguished. At the forces of this test a soft machine and a crooked one make "
        "the same trace. What is given below under a sum belongs to the sum: no member of it may be named the cause, and "
        "none may be corrected on the ground of this test.",
        "What to do: repeat the test at a second, clearly different force, and ask again. "
        "(Coefficients are for mm, N and rad.)",
    ]


def uncertainty_words(result: Identification) -> list[str]:
    """What the uncertainties assume, and what is in them."""
    if result.by_run:
        ratios = result.solution.standard_uncertainty / result.naive.standard_uncertainty
        words = [
            f"The uncertainties come from the scatter of {len(result.traces)} runs, each of which counts once, however many "
            f"readings it has. They are {significant(float(ratios.min()), 2)} to {significant(float(ratios.max()), 2)} "
            f"times those that would assume independent readings: the errors along one trace are correlated, and any part "
            f"common to all runs does not scatter."
        ]
    else:
        checked = next((sentence_of(check) for check in result.verdict if check.name == "uncertainty by run"), None)
        words = [micro(checked or "The uncertainties assume independent readings; those along a trace rarely are.")]
    stated = influences(result)
    if stated:
        return [*words, f"The budget also holds what the test's file states as known: {listed(stated)}."]
    return [*words, "The test's file states no systematic influence ([[influences]]), so that none is in the budget."]


def has_influences(result: Identification) -> bool:
    """Whether anything but the scatter is in the budget."""
    return result.by_run and any(len(lines) > 1 for lines in result.budget.lines)


def influences(result: Identification) -> list[str]:
    """The systematic influences of the budget, by their labels."""
    return sorted({line.label for lines in result.budget.lines for line in lines} - {SCATTER})


def change_words(result: Identification) -> list[str]:
    """Whether the local estimates, the geometry above all, change with the force by more than their uncertainty."""
    change = result.local_change
    if change is None:
        why = (
            "a reference level is subtracted"
            if result.reference_force is not None
            else "it takes three force levels and runs that leave something over"
        )
        return [f"Whether they differ by more than their uncertainty was not tested: {why}."]
    p_value = probability(change.p_value)
    words = [
        f"All differences together: p = {p_value}. That is how often differences as great would come about if nothing "
        f"changed, so {'something seems to change with the force' if change.significant else 'no change has been shown'}."
    ]
    geometric = [p.name for p in result.parameters if not p.elastic and p.name in change.each]
    if geometric and all_separated(result):
        words.append(_geometry_words(change.each, geometric))
    return words


def keep_in_mind(result: Identification) -> list[str]:
    """The limits of what was found, in sentences."""
    named = [p.name for p in result.parameters if p.separated]
    scatter = "run to run" if result.by_run else "reading to reading, independently"
    stated = influences(result)
    held = (
        f"The intervals hold what scatters from {scatter}, and {listed(stated)}. Any other influence that is the same in "
        f"all readings is not in them."
        if stated
        else f"The intervals hold what scatters from {scatter}, and no more. What is the same in all readings (the force "
        f"calibration, the instrument's scale, the set-up, the temperature) is not in them."
    )
    words = [held, REPEATABILITY]
    if any(len(p.stands_for) > 1 and p.elastic and p.separated for p in result.parameters):
        words.append("Compliances here are equivalent ones: each is the sum of what it stands for, not of one joint alone.")
    words += structure_words(result) + corrected_words(result)
    if result.consistency is None:
        words += [_negative(p) for p in result.parameters if _impossible(p)]
    gains = [name for name in named if _GAIN.fullmatch(name)]
    tests = result.campaign.tests.values()
    limits = {limit for test in tests for limit in test.setup.limits}
    if gains:
        verb, it = ("carries", "its sum") if len(gains) == 1 else ("carry", "their common part")
        length, source = "bar's length", "bar's calibration"
        if "touching radius" in limits:
            length, source = "radius at which ball and roller touch", "radii"
        words.append(f"{listed(gains)} {verb} the error of the {length}: {it} is as good as the {source}.")
    if "bar calibration" in limits:
        loads = any(test.setup.loads for test in tests)
        force = "the force (its gauge, its calibration) and " if loads else ""
        words.append(
            f"Results are only as traceable as {force}the bar calibration that was entered; the form error of the balls, "
            f"which can reach 30 µm, is taken for an error of the machine."
        )
    if "motor constants" in limits:
        words.append(
            "Results are only as traceable as the motor constants, the transmissions and their efficiency, and the set-up's "
            "compliance that were entered; the force is that of a slow motion, with the roller rolling."
        )
    return words + assumptions(result.campaign)


def structure_words(result: Identification) -> list[str]:
    """What residuals with structure mean for the uncertainty; nothing if they look like noise."""
    if not any(check.name == "residuals without structure" and check.passed is False for check in result.verdict):
        return []
    if result.by_run:
        return [
            "The residuals have a structure that the runs share (see the verdict): it shifts the values and is not in U."
        ]
    return ["The true uncertainty is larger than U: the residuals have structure (see the verdict), which U does not cover."]


def corrected_words(result: Identification) -> list[str]:
    """What the subtracted deflection of the set-up would have been taken for; nothing if none was subtracted."""
    units = display_units(result)
    said = [
        f"{p.name} {significant(result.corrected[p.name] * units[p.name].factor)} {units[p.name].name}"
        for p in result.parameters
        if abs(result.corrected.get(p.name, 0.0)) > _COUNTS * abs(p.value)
    ]
    if not said:
        return []
    what = "What the set-up adds (its deflection, temperatures)"
    return [f"{what} is subtracted from the readings; left in, it would add {listed(said)}."]


def assumptions(campaign: Campaign) -> list[str]:
    """What of the machine is assumed, in one sentence, and what was done to the logs of the runs; or nothing."""
    assumed = "; ".join(text.rstrip(".") for text in campaign.machine.assumed)
    return [*([f"Assumed, not measured, of the machine: {assumed}."] if assumed else []), *log_words(campaign)]


def own_results_words(campaign: Campaign) -> tuple[str, ...]:
    """Which command shows what an instrument shows by itself, beside parameters."""
    extras = dict.fromkeys(test.setup.extra for test in campaign.tests.values())
    return tuple(f"{_OWN_RESULTS[extra]}." for extra in extras if extra in _OWN_RESULTS)


def log_words(campaign: Campaign) -> list[str]:
    """What was done to the logs before they became runs: each sentence once, with the runs that it holds for."""
    runs: dict[str, list[str]] = {}
    for name, test in campaign.tests.items():
        for run in test.runs:
            for note in run.notes:
                runs.setdefault(note, []).append(f"{name}/{run.name}" if campaign.several else run.name)
    return [
        f"Log of {'every run' if len(names) == campaign.runs else listed(names)}: {note.rstrip('.')}."
        for note, names in runs.items()
    ]


def repeats_words(result: Identification) -> list[str]:
    """What the repeats are, and what their numbers are not."""
    if result.repeats is None:
        return []
    counts = listed([f"{count} runs at {level}" for level, count in result.repeats.runs.items()])
    words = [f"{counts}. {REPEATABILITY}"]
    if result.reference_force is not None:
        words.append(
            f"The readings at {result.reference_force:g} N are subtracted from all runs, so the scatter of that reference "
            f"is in every one of them alike and the repeats do not show it. It is added as if the reference scattered like "
            f"the repeated runs, which may be too much, not too little."
        )
    number = len(result.repeats.combinations)
    return [
        *words,
        f"The {number} combinations of one run per level share runs and are not independent. Their standard deviation is "
        f"about that of one combination; dividing it by the root of {number} would claim far too much. The standard "
        f"uncertainty given here comes from the scatter of the runs, with Welch-Satterthwaite degrees of freedom.",
    ]


def _geometry_words(each: Mapping[str, float], geometric: list[str]) -> str:
    moved = [name for name in geometric if each[name] < SIGNIFICANT / len(geometric)]
    if not moved:
        least = min(geometric, key=lambda name: each[name])
        return (
            f"The geometry is the same at all forces within its uncertainty: the parameter that differs most, {least}, has "
            f"p = {probability(each[least])}. Close force levels couple compliance and geometry strongly; a drift within "
            f"the intervals says nothing of the machine."
        )
    return (
        f"{listed(moved)} {'changes' if len(moved) == 1 else 'change'} with the force by more than the uncertainty (p = "
        f"{probability(min(each[name] for name in moved))}). Geometry cannot do that: where the model lacks something, "
        f"geometry is made to explain it; whether it does, the comparison of models decides."
    )


def _impossible(p: Parameter) -> bool:
    """Whether it is negative though a sum of on-axis compliances cannot be: a load never gains energy."""
    return p.separated and p.value < 0 and all(_ON_AXIS.fullmatch(name) and c > 0 for name, c in p.stands_for.items())


def _negative(p: Parameter) -> str:
    if p.interval is None:
        certain = "has no interval that could say how surely"
    else:
        certain = "its interval excludes zero" if p.interval[1] < 0 else "its interval includes zero"
    return (
        f"{p.name} is negative, and {certain}. No joint's own compliance can be: a load never gains energy. "
        f"It describes the readings; it is not a compliance."
    )
