"""What the checks of a plan say."""

from __future__ import annotations

from elastogeo.report.numbers import significant, whole_percent
from elastogeo.report.sentences import Facts, says
from elastogeo.report.text import combination

_NM = 1e6
_TERMS = 4


@says("workspace supported")
def workspace_supported(facts: Facts, passed: bool | None) -> str:
    """Whether the compliance at the tool follows everywhere."""
    tools = "the tool" if facts["tools"] == 1 else f"all {facts['tools']} tools"
    if passed:
        return (
            f"The compliance at {tools} will be supported everywhere in the volume, with U = "
            f"{significant(2 * facts['worst'] * _NM)} nm/N at worst from the readings alone."
        )
    more = facts["more"]
    needed = (
        f"{more} more {'test supports' if more == 1 else 'tests support'} all of it."
        if more
        else "All candidates together do not support all of it: let rotary axes move, add tools, or draw more candidates."
    )
    return f"The compliance at {tools} will be supported in {whole_percent(facts['share'])} % of the volume. {needed}"


@says("all directions strong")
def all_directions_strong(facts: Facts, passed: bool | None) -> str:
    """Whether rank is knowledge."""
    if passed:
        return f"All {facts['rank']} combinations will be known better than a parameter's expected size."
    return (
        f"{facts['weak']} of {facts['rank']} combinations will be known worse than a parameter's expected size: the rank "
        f"counts them, and they say little. More tests, or another goal, strengthen them."
    )


@says("asked parameters known alone")
def asked_known_alone(facts: Facts, passed: bool | None) -> str:
    """Whether what the user named becomes known by itself."""
    if passed:
        return (
            "What was asked for will be known by itself."
            if facts["asked"] == 1
            else f"All {facts['asked']} parameters that were asked for will be known by themselves."
        )
    parts = [
        f"{name} only within {combination(sum_, _TERMS)}" if sum_ else f"{name} not at all"
        for name, sum_ in facts["missing"].items()
    ]
    more = f" and {len(parts) - _TERMS} more" if len(parts) > _TERMS else ""
    return f"Not known by themselves: {'; '.join(parts[:_TERMS])}{more}."


@says("expected uncertainty below the expected size")
def uncertainty_below_size(facts: Facts, passed: bool | None) -> str:
    """Whether what becomes known becomes known well."""
    if passed is None:
        return "None of the parameters that were asked for becomes known by itself: there is no uncertainty to look at."
    share = significant(200 * facts["share"])
    said = f"U of {facts['worst']} will be {share} % of the size that it is expected to have"
    return f"{said}, the worst of them." if passed else f"{said}: that is as good as not known; plan more tests."
