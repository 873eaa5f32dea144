"""The verdict of a map: the named checks that it ends in, with their facts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from elastogeo.identification import Check, Identification
from elastogeo.machine import Array
from elastogeo.prediction.maps.acceptance import Acceptance
from elastogeo.prediction.maps.design import AgainstDesign
from elastogeo.prediction.maps.result import Flags

SUPPORTED_EVERYWHERE = "prediction supported"
UNCERTAINTY_KNOWN = "prediction has an uncertainty"
NOTHING_LEFT_OUT = "all compliances asked for"
FOUNDATION = "identification sound"
LIMIT = "stiff enough"
DESIGN = "as designed"

_OF_PARAMETERS = ("identifiable", "conditioned", "above resolution")
"""Checks of single parameters: a prediction asks for sums of them, and its U says how well they are known."""


def supported_everywhere(supported: Flags, prior: bool, ranks: tuple[int, int]) -> Check:
    """Whether the tests support the prediction at every place; if at none, the data do not support the map."""
    facts = {
        "places": int(supported.size),
        "supported": int(supported.sum()),
        "prior": prior,
        "rank": ranks[0],
        "asked": ranks[1],
    }
    return Check(SUPPORTED_EVERYWHERE, bool(supported.all()), facts, decisive=not supported.any())


def uncertainty_known(by_run: bool, expanded: Array, supported: Flags) -> Check:
    """Whether what is supported has an interval."""
    without = int(np.sum(supported & ~np.isfinite(expanded)))
    return Check(UNCERTAINTY_KNOWN, without == 0 if by_run else None, {"by_run": by_run, "without": without})


def nothing_left_out(rigid: Sequence[str], asked: int) -> Check:
    """Whether every compliance of the machine was asked for; what was not counts as rigid."""
    sites = tuple(dict.fromkeys(_site(name) for name in rigid))
    kinds = {site: tuple(name.split("_", 1)[1][:2] for name in rigid if _site(name) == site) for site in sites}
    return Check(NOTHING_LEFT_OUT, not rigid, {"asked": asked, "rigid": len(rigid), "kinds": kinds})


def foundation(result: Identification) -> Check:
    """Whether the identification that it rests on passed its own checks."""
    failed = [check.name for check in result.verdict if check.passed is False and check.name not in _OF_PARAMETERS]
    return Check(FOUNDATION, not failed, {"failed": tuple(failed), "checks": len(result.verdict)})


def stiff_enough(acceptance: Acceptance) -> Check:
    """Whether every place is stiff enough by the decision rule."""
    facts = {
        "limit": acceptance.limit,
        "conforming": acceptance.conforming,
        "failing": acceptance.failing,
        "undecided": acceptance.undecided,
    }
    return Check(LIMIT, acceptance.passed, facts)


def as_designed(design: AgainstDesign) -> Check:
    """Whether the compliance at the tool is that of the design, all places that the tests tell together."""
    told = [one.agrees for one in design.parameters if one.agrees is not None]
    facts = {
        "places": int(np.sum(design.agrees != 0)),
        "differ": int(np.sum(design.agrees < 0)),
        "p_value": design.p_value,
        "parameters": len(told),
        "parameters_differ": told.count(False),
        "missing": len(design.missing),
        "unused": design.unused,
    }
    return Check(DESIGN, design.passed, facts)


def judged(*checks: Check | None) -> tuple[Check, ...]:
    """Those checks that were made."""
    return tuple(_made(checks))


def _made(checks: Iterable[Check | None]) -> Iterable[Check]:
    return (check for check in checks if check is not None)


def _site(name: str) -> str:
    """Where a compliance sits: what follows its two components."""
    return name.split("_", 1)[1][2:]
