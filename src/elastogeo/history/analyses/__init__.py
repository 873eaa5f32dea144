"""What tests say, computed from their raw records: analyses, whole series again, campaigns, plans. Sends nothing."""

from typing import TYPE_CHECKING

from elastogeo.discovery import first_use

if TYPE_CHECKING:
    from elastogeo.history.analyses.analysing import PROGRAM, analyse, last_analysis, unanalysed
    from elastogeo.history.analyses.drawings import draw, drawing_of
    from elastogeo.history.analyses.kept_campaigns import (
        campaign_text,
        campaigns,
        keep_campaign,
        keep_parts,
        kept_campaign,
        recompute_campaign,
    )
    from elastogeo.history.analyses.kept_plans import due_date, finish_plan, keep_plan, plans, read_plan
    from elastogeo.history.analyses.kept_tests import kept_test, raw_file
    from elastogeo.history.analyses.recomputing import outdated, recompute

__all__ = [
    "PROGRAM",
    "analyse",
    "campaign_text",
    "campaigns",
    "draw",
    "drawing_of",
    "due_date",
    "finish_plan",
    "keep_campaign",
    "keep_parts",
    "keep_plan",
    "kept_campaign",
    "kept_test",
    "last_analysis",
    "outdated",
    "plans",
    "raw_file",
    "read_plan",
    "recompute",
    "recompute_campaign",
    "unanalysed",
]

__getattr__ = first_use(
    __name__,
    {
        "analysing": "PROGRAM analyse last_analysis unanalysed",
        "drawings": "draw drawing_of",
        "kept_campaigns": "campaign_text campaigns keep_campaign keep_parts kept_campaign recompute_campaign",
        "kept_plans": "due_date finish_plan keep_plan plans read_plan",
        "kept_tests": "kept_test raw_file",
        "recomputing": "outdated recompute",
    },
)
