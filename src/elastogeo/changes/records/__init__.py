"""What the store says of itself: what a recomputation found, which plans and campaigns are kept. Filled by `history`."""

from elastogeo.changes.records.audit_trail import TRAIL_WHOLE, AuditFault, AuditRow, AuditTrail, trail_whole
from elastogeo.changes.records.campaigns import KeptCampaign
from elastogeo.changes.records.plans import KeptPlan, KeptPlans
from elastogeo.changes.records.recomputed import SAME_AGAIN, Differing, Recomputed, RecomputedTest, recomputed_same
from elastogeo.changes.records.verified import (
    CHANGED,
    DANGLING,
    DATABASE_SOUND,
    DOCUMENTS_WHOLE,
    MISSING,
    NO_STRAY_FILES,
    RAW_FILES_WHOLE,
    RECORDS_AGREE,
    REFERENCES_WHOLE,
    RESIZED,
    ROWS_PROTECTED,
    STRAY,
    UNPROTECTED,
    UNREADABLE,
    StoreFault,
    Verified,
    as_written,
)

__all__ = [
    "CHANGED",
    "DANGLING",
    "DATABASE_SOUND",
    "DOCUMENTS_WHOLE",
    "MISSING",
    "NO_STRAY_FILES",
    "RAW_FILES_WHOLE",
    "RECORDS_AGREE",
    "REFERENCES_WHOLE",
    "RESIZED",
    "ROWS_PROTECTED",
    "SAME_AGAIN",
    "STRAY",
    "TRAIL_WHOLE",
    "UNPROTECTED",
    "UNREADABLE",
    "AuditFault",
    "AuditRow",
    "AuditTrail",
    "Differing",
    "KeptCampaign",
    "KeptPlan",
    "KeptPlans",
    "Recomputed",
    "RecomputedTest",
    "StoreFault",
    "Verified",
    "as_written",
    "recomputed_same",
    "trail_whole",
]
