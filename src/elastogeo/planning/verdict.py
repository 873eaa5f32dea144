"""The checks of a plan."""

from __future__ import annotations

from collections.abc import Sequence

from elastogeo.identification import Check
from elastogeo.planning.result import ALONE, Expectation, ToolSupport


def verdict_of(
    goal: str, asked: Sequence[Expectation], tools: Sequence[ToolSupport], weak: int, rank: int
) -> tuple[Check, ...]:
    """Whether the plan does what it is for: the checks of its goal."""
    if goal == "parameters" and asked:
        return (_known_alone(asked), _surely(asked))
    weakness = Check("all directions strong", weak == 0, {"weak": weak, "rank": rank})
    return (_workspace(tools), weakness) if goal == "workspace" else (weakness,)


def _workspace(tools: Sequence[ToolSupport]) -> Check:
    more = [tool.more_needed for tool in tools]
    facts = {
        "share": sum(tool.share for tool in tools) / len(tools),
        "tools": len(tools),
        "more": None if None in more else max(n for n in more if n is not None),
        "worst": max((tool.worst for tool in tools if tool.worst is not None), default=None),
    }
    return Check("workspace supported", all(tool.share == 1.0 for tool in tools), facts)


def _known_alone(asked: Sequence[Expectation]) -> Check:
    missing = {p.name: dict(p.stands_for) for p in asked if p.known != ALONE}
    return Check("asked parameters known alone", not missing, {"asked": len(asked), "missing": missing}, decisive=True)


def _surely(asked: Sequence[Expectation]) -> Check:
    """Rank is no knowledge: what is known worse than it is expected to be large is as good as not known."""
    shares = {
        p.name: p.standard_uncertainty / p.scale for p in asked if p.known == ALONE and p.standard_uncertainty is not None
    }
    worst = max(shares, key=lambda name: shares[name], default=None)
    facts = {"worst": worst, "share": None if worst is None else shares[worst]}
    passed = None if worst is None else shares[worst] < 1.0
    return Check("expected uncertainty below the expected size", passed, facts)
