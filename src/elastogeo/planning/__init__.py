"""Which tests to run: candidates, what they tell, the choice among them. Stands on `prediction` and all below."""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.planning.ceilings import Ceiling, Pair, ceiling
    from elastogeo.planning.families import FamilyCeiling, family_ceiling
    from elastogeo.planning.information import Unknowns, unknowns, whitened
    from elastogeo.planning.noise import ReadingNoise
    from elastogeo.planning.offers.candidate import Candidate
    from elastogeo.planning.offers.candidates import candidates
    from elastogeo.planning.offers.clearance import Clearance
    from elastogeo.planning.offers.means import Means
    from elastogeo.planning.offers.proposal import proposals, proposes
    from elastogeo.planning.planner import GOALS, plan
    from elastogeo.planning.reach import Reach, reach_of
    from elastogeo.planning.reasons import Exchange, Probe, Reason, Remedy, reason_for
    from elastogeo.planning.result import ALONE, IN_A_SUM, UNSEEN, Expectation, NextBest, Plan, PlannedTest, ToolSupport
    from elastogeo.planning.workspaces import Workspace, workspace

__all__ = [
    "ALONE",
    "GOALS",
    "IN_A_SUM",
    "UNSEEN",
    "Candidate",
    "Ceiling",
    "Clearance",
    "Exchange",
    "Expectation",
    "FamilyCeiling",
    "Means",
    "NextBest",
    "Pair",
    "Plan",
    "PlannedTest",
    "Probe",
    "Reach",
    "ReadingNoise",
    "Reason",
    "Remedy",
    "ToolSupport",
    "Unknowns",
    "Workspace",
    "candidates",
    "ceiling",
    "family_ceiling",
    "plan",
    "proposals",
    "proposes",
    "reach_of",
    "reason_for",
    "unknowns",
    "whitened",
    "workspace",
]

__getattr__ = first_use(
    __name__,
    {
        "ceilings": "Ceiling Pair ceiling",
        "families": "FamilyCeiling family_ceiling",
        "information": "Unknowns unknowns whitened",
        "noise": "ReadingNoise",
        "offers.candidate": "Candidate",
        "offers.candidates": "candidates",
        "offers.clearance": "Clearance",
        "offers.means": "Means",
        "offers.proposal": "proposals proposes",
        "planner": "GOALS plan",
        "reach": "Reach reach_of",
        "reasons": "Exchange Probe Reason Remedy reason_for",
        "result": "ALONE Expectation IN_A_SUM NextBest Plan PlannedTest ToolSupport UNSEEN",
        "workspaces": "Workspace workspace",
    },
)
