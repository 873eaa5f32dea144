"""What tests say, computed from their raw records: analyses, whole series again, campaigns, plans. Sends nothing."""

from elastogeo.discovery import first_use

__getattr__ = first_use(
    __name__,
    {
        "analysing": "PROGRAM analyse last_analysis",
        "kept_campaigns": "campaign_text campaigns keep_campaign kept_campaign recompute_campaign",
        "kept_plans": "finish_plan keep_plan plans",
        "recomputing": "outdated recompute",
    },
)
