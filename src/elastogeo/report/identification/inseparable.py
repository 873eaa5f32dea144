"""What no test between tool and workpiece distinguishes, why, and what would."""

from __future__ import annotations

from elastogeo.estimate import Confounding
from elastogeo.observe import Campaign
from elastogeo.planning import ceiling, reason_for
from elastogeo.report.ceilings import neither_words, remedy_words
from elastogeo.report.text import listed


def inseparable_words(campaign: Campaign, found: Confounding) -> tuple[str, ...]:
    """Compliances that these readings show in one sum, as every test between tool and workpiece does, in a sentence.

    Nothing if there are none.
    """
    bound = ceiling(campaign.machine, campaign.question.reciprocal)
    asked = [label for label in found.labels if label in bound.labels]
    together = [
        names
        for alike in bound.alike(asked)
        for group in found.groups
        if len(names := tuple(name for name in alike if name in group)) > 1
    ]
    if not together:
        return ()
    first, *others = together
    more = f", nor {len(others)} more such {'sum' if len(others) == 1 else 'sums'}" if others else ""
    reasons = [why for name in first if (why := reason_for(campaign.machine, bound, name)) is not None]
    told = next((f" {remedy_words(why.remedy, why.name)}" for why in reasons if why.remedy), "")
    return (
        f"No test between tool and workpiece distinguishes {listed(first)}{more}: what moves between them changes "
        f"{neither_words(reasons[0])}, so that each gives way alike at every pose.{told}",
    )


def unasked_words(campaign: Campaign, found: Confounding) -> tuple[str, ...]:
    """Compliances that were not asked for and that what was asked holds, whatever the test, in a sentence; or nothing."""
    bound = ceiling(campaign.machine, campaign.question.reciprocal)
    showing = [label for group in found.groups for label in group if label in bound.labels]
    held = []
    for alike in bound.alike(bound.labels):
        asked = [name for name in alike if name in found.labels]
        others = [name for name in alike if name not in found.labels]
        if others and any(name in showing for name in asked):
            held.append((asked, others))
    if not held:
        return ()
    (asked, others), *more = held
    were, them, they = ("was", "it", "it gives") if len(others) == 1 else ("were", "them", "they give")
    so = f" So with {len(more)} more." if more else ""
    return (
        f"{listed(others)} {were} not asked for, and so taken as rigid. No test between tool and workpiece tells {them} "
        f"from {asked[0]}: what {they} is in {listed(asked)}.{so}",
    )
