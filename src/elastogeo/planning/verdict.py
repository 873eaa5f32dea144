"""The checks of a plan."""

from __future__ import annotations

from collections.abc import Sequence

from elastogeo.identification import Check
from elastogeo.planning.result import ALONE, Expectation, ToolSupport


def verdict_of(
    goal: str, asked: Sequence[Expectation], tools: Sequence[ToolSupport], weak: int, rank: int
) -> tuple[Check, ...]:
    """Whether the plan does what it is for."""
    needed = [tool.tests_needed for tool in tools]
    share = sum(tool.share for tool in tools) / len(tools)
    checks = [
        Check(
            "workspace supported",
            all(tool.share == 1.0 for tool in tools),
            {
                "share": share,
                "tools": len(tools),
                "needed": None if None in needed else max(n for n in needed if n is not None),
                "worst": max((tool.worst for tool in tools if tool.worst is not None), default=None),
            },
            decisive=False,
        ),
        Check("no direction weak", weak == 0, {"weak": weak, "rank": rank}),
    ]
    if goal == "parameters" and asked:
        missing = {p.name: dict(p.stands_for) for p in asked if p.known != ALONE}
        checks.insert(
            0,
            Check(
                "asked parameters known alone",
                not missing,
                {"asked": len(asked), "missing": missing},
                decisive=True,
            ),
        )
    return tuple(checks)
