"""What the store says of itself: what a recomputation found, which plans and campaigns are kept. Filled by `history`."""

from elastogeo.changes.records.audit_trail import TRAIL_WHOLE, AuditFault, AuditRow, AuditTrail, trail_whole
from elastogeo.changes.records.campaigns import KeptCampaign
from elastogeo.changes.records.plans import KeptPlan, KeptPlans
from elastogeo.changes.records.recomputed import SAME_AGAIN, Differing, Recomputed, RecomputedTest, recomputed_same

__all__ = [
    "SAME_AGAIN",
    "TRAIL_WHOLE",
    "AuditFault",
    "AuditRow",
    "AuditTrail",
    "Differing",
    "KeptCampaign",
    "KeptPlan",
    "KeptPlans",
    "Recomputed",
    "RecomputedTest",
    "recomputed_same",
    "trail_whole",
]
