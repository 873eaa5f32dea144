"""What the store says of itself: what a recomputation found, which plans and campaigns are kept. Filled by `history`."""

from elastogeo.changes.records.campaigns import KeptCampaign
from elastogeo.changes.records.plans import KeptPlan, KeptPlans
from elastogeo.changes.records.recomputed import SAME_AGAIN, Differing, Recomputed, RecomputedTest, recomputed_same

__all__ = [
    "SAME_AGAIN",
    "Differing",
    "KeptCampaign",
    "KeptPlan",
    "KeptPlans",
    "Recomputed",
    "RecomputedTest",
    "recomputed_same",
]
