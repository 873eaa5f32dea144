"""What the check of a comparison says."""

from __future__ import annotations

from elastogeo.report.numbers import p_said
from elastogeo.report.sentences import Facts, says


@says("unchanged")
def unchanged(facts: Facts, passed: bool | None) -> str:
    """Which parameters changed."""
    if passed:
        return f"No parameter changed by more than the uncertainty of the two tests ({p_said(facts['p_value'])})."
    if facts["changed"]:
        return f"{', '.join(facts['changed'])} changed by more than the uncertainty of the two tests."
    return f"Together the parameters changed ({p_said(facts['p_value'])}), none of them by itself."
