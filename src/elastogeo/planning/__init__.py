"""Which tests to run: candidates, what they tell, the choice among them. Stands on `prediction` and all below."""

from elastogeo.planning.ceilings import Ceiling, Pair, ceiling
from elastogeo.planning.families import FamilyCeiling, family_ceiling
from elastogeo.planning.information import Unknowns, unknowns, whitened
from elastogeo.planning.noise import ReadingNoise
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.candidates import candidates
from elastogeo.planning.offers.clearance import Clearance
from elastogeo.planning.offers.means import Means
from elastogeo.planning.offers.proposal import proposals, proposes
from elastogeo.planning.plan import GOALS, plan
from elastogeo.planning.reach import Reach, reach_of
from elastogeo.planning.reasons import Exchange, Probe, Reason, Remedy, reason_for
from elastogeo.planning.result import ALONE, IN_A_SUM, UNSEEN, Expectation, NextBest, Plan, PlannedTest, ToolSupport
from elastogeo.planning.workspace import Workspace, workspace

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
