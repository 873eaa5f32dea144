"""What the report says in words: what the test cannot tell apart, and what to keep in mind. Only what applies is said."""

from __future__ import annotations

import re
from collections.abc import Iterable

from elastogeo.estimate import Confounding
from elastogeo.identify import Identification, Parameter
from elastogeo.observe import LoadedBallBar, MachineTest

REPEATABILITY = (
    "Repeatability is not uncertainty: it says how runs of one set-up scatter, not how far all of them are from the truth."
)
_ON_AXIS = re.compile(r"C_([XYZABC])\1[A-Z]")
_GAIN = re.compile(r"E_([XYZ])(?:\1)1")


def confounding_words(found: Confounding) -> list[str]:
    """What the test can and cannot tell apart, in sentences."""
    asked = len(found.labels)
    if found.rank == asked:
        return [f"Every one of the {asked} parameters that were asked for is told apart from all others."]
    words = [f"{asked} parameters were asked for; the readings determine {found.rank} combinations of them, no more."]
    if found.null:
        verb = "changes" if len(found.null) == 1 else "change"
        words.append(f"{listed(found.null)} {verb} no reading of this test: nothing at all is known of them.")
    groups = [group for group in found.groups if len(group) > 1]
    if groups:
        words.append(
            "Parameters in one of the groups below always produce the same trace but for its size. No amount of readings of "
            "this test tells them apart; what is estimated is a sum, given under the name that was retained."
        )
    if asked - len(found.null) - sum(len(group) - 1 for group in groups) > found.rank:
        words.append(
            "Beyond the groups, some traces are exact sums of others; they are counted into the combinations above."
            if not groups
            else "Beyond the groups, some traces are exact sums of several others: see what each parameter stands for."
        )
    return words


def keep_in_mind(result: Identification) -> list[str]:
    """The limits of what was found, in sentences."""
    named = [p.name for p in result.parameters]
    words = [
        "The intervals hold what scatters from reading to reading, independently, and no more. What is the same in all "
        "readings (the force calibration, the instrument's scale, the set-up, the temperature) is not in them.",
        REPEATABILITY,
    ]
    if any(len(p.stands_for) > 1 for p in result.parameters):
        words.append("Compliances here are equivalent ones: each is the sum of what it stands for, not of one joint alone.")
    if structured(result):
        words.append(
            "The residuals have structure: where the model misses, its structure decides, not its size. "
            "The true uncertainty is larger than the intervals say."
        )
    words += [_negative(p) for p in result.parameters if _impossible(p)]
    gains = [name for name in named if _GAIN.fullmatch(name)]
    if gains:
        verb, it = ("carries", "its sum") if len(gains) == 1 else ("carry", "their common part")
        words.append(f"{listed(gains)} {verb} the error of the bar's length: {it} is as good as the bar's calibration.")
    if isinstance(result.test.setup, LoadedBallBar):
        words.append(
            "Results are only as traceable as the force (its gauge, its calibration) and the bar calibration that were "
            "entered; the form error of the balls, which can reach 30 µm, is taken for an error of the machine."
        )
    return words + assumptions(result.test)


def structured(result: Identification) -> bool:
    """Whether the residuals have structure left, so that the intervals claim too much."""
    return any(check.name == "residuals without structure" and not check.passed for check in result.verdict)


def assumptions(test: MachineTest) -> list[str]:
    """What of the machine is assumed, in one sentence, or nothing."""
    assumed = "; ".join(text.rstrip(".") for text in test.machine.assumed)
    return [f"Assumed, not measured, of the machine: {assumed}."] if assumed else []


def listed(names: Iterable[str]) -> str:
    """Names in a sentence: `C_XXX, C_XYX and C_YYY`."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def _impossible(p: Parameter) -> bool:
    """Whether it is negative though a sum of on-axis compliances cannot be: a load never gains energy."""
    return p.value < 0 and all(_ON_AXIS.fullmatch(name) and c > 0 for name, c in p.stands_for.items())


def _negative(p: Parameter) -> str:
    certain = "its interval excludes zero" if p.interval[1] < 0 else "its interval includes zero"
    return (
        f"{p.name} is negative, and {certain}. No joint's own compliance can be: a load never gains energy. "
        f"It describes the readings; it is not a compliance."
    )
