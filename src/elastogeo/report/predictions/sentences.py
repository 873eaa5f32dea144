"""What the checks of a map say."""

from __future__ import annotations

from elastogeo.prediction import (
    DESIGN,
    FOUNDATION,
    LIMIT,
    NOTHING_LEFT_OUT,
    SUPPORTED_EVERYWHERE,
    UNCERTAINTY_KNOWN,
)
from elastogeo.report.document import UM
from elastogeo.report.numbers import p_said, significant
from elastogeo.report.sentences import Facts, says

_ALL = 36
_FEW = 4


@says(SUPPORTED_EVERYWHERE)
def supported_everywhere(facts: Facts, passed: bool | None) -> str:
    """Where the tests support the prediction."""
    if passed:
        where = "at the place" if facts["places"] == 1 else f"at all {facts['places']} places"
        return f"The tests determine what is asked {where}."
    known = facts["supported"]
    told = f"The tests determine {facts['rank']} of {facts['asked']} parameters or sums"
    rest = "there the values rest on the stated prior" if facts["prior"] else "elsewhere there is no value"
    if not known:
        rest = "the values rest on the stated prior" if facts["prior"] else "there is no value"
        return (
            f"{told}, and what is asked at none of the {facts['places']} places: {rest}. Plan tests for it (elastogeo plan)."
        )
    rest = "elsewhere the values rest on the stated prior" if facts["prior"] else rest
    return f"{told}, and what is asked at {known} of {facts['places']} places; {rest}. Plan tests for it."


@says(UNCERTAINTY_KNOWN)
def uncertainty_known(facts: Facts, passed: bool | None) -> str:
    """Whether the values have an interval."""
    if passed:
        return "Every value that the tests determine has an interval, by the scatter of the runs and every stated influence."
    if not facts["by_run"]:
        return "The runs are too few for an uncertainty, so that the values have none; repeat the runs."
    return f"At {facts['without']} places the value rests on hardly more than one run and has no interval; repeat the runs."


@says(NOTHING_LEFT_OUT)
def nothing_left_out(facts: Facts, passed: bool | None) -> str:
    """Which compliances count as rigid."""
    if passed:
        return f"All {facts['asked']} compliances of the joints were asked for: none is taken as rigid."
    parts = [_of_site(site, kinds) for site, kinds in facts["kinds"].items()]
    return f"Not asked for, and so taken as rigid: {'; '.join(parts)}. Ask for them with -p 'C_???'."


def _of_site(site: str, kinds: tuple[str, ...]) -> str:
    if len(kinds) == _ALL:
        return f"all of {site}"
    named = ", ".join(f"C_{kind}{site}" for kind in kinds[:_FEW])
    return named if len(kinds) <= _FEW else f"{len(kinds)} of {_ALL} of {site} ({named}, ...)"


@says(FOUNDATION)
def foundation(facts: Facts, passed: bool | None) -> str:
    """Whether the identification is sound."""
    if passed:
        return "No check of the identification failed."
    return f"The identification needs attention first: {', '.join(facts['failed'])}."


@says(LIMIT)
def stiff_enough(facts: Facts, passed: bool | None) -> str:
    """What the decision rule says."""
    limit = f"{significant(1.0 / facts['limit'] / UM)} N/µm"
    places = facts["conforming"] + facts["failing"] + facts["undecided"]
    if passed:
        return f"All {places} places are stiffer than {limit}, by U at least (ISO 14253-1)."
    counts = f"{facts['conforming']} conform, {facts['failing']} do not, {facts['undecided']} are not decided"
    return f"Against {limit}, with U as guard band (ISO 14253-1), of {places} places {counts}."


@says(DESIGN)
def as_designed(facts: Facts, passed: bool | None) -> str:
    """Whether the machine is as stiff as it was designed."""
    rigid = f" {facts['missing']} compliances that were asked for are rigid by design." if facts["missing"] else ""
    other = facts["unused"]
    more = (
        f" {len(other)} of the design were not asked for ({', '.join(other[:_FEW])}): rigid in what was measured."
        if other
        else ""
    )
    if passed is None:
        return f"No place can be compared with the design.{rigid}{more}"
    agreeing = facts["places"] - facts["differ"]
    said = f"at {agreeing or 'none'} of {facts['places']} places ({p_said(facts['p_value'])} together)"
    sums = f"{facts['parameters_differ']} of {facts['parameters']} compliances, or sums of them, differ by more than U."
    return f"The compliance at the tool is that of the design within U {said}; {sums}{rigid}{more}"
