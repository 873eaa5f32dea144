"""The audit trail: who did what, when and why, and whether it is as it was written."""

from __future__ import annotations

from typing import Annotated

from fastapi import Query

from elastogeo.report import view_of
from elastogeo.web.answering import Shown
from elastogeo.web.asking import Ask
from elastogeo.web.pages import Pages

pages = Pages()
PAGE = 100
"""Rows of a page."""
QUICK = 1_000
"""Rows up to which the whole trail is checked each time that it is shown; a longer one when somebody asks."""


@pages.shows("/audit")
def audit(
    asked: Ask,
    subject: Annotated[str, Query(max_length=200)] = "",
    who: Annotated[str, Query(max_length=200)] = "",
    before: Annotated[int | None, Query(ge=1, le=2**62)] = None,
    check: bool = False,
) -> Shown:
    """The last rows, of a subject (`alarm 3`, `machine`), of a person; older ones by `before`; `check`: look at all rows."""
    trail = asked.history.audit(PAGE, subject, who, before, None if check else QUICK)
    context = {
        "subject": subject,
        "who": who,
        "next": trail.rows[-1].number if len(trail.rows) == PAGE else None,
        "checked": all(one.passed is not None for one in trail.verdict),
    }
    return Shown("care/audit.html.j2", view_of(trail), context=context)
