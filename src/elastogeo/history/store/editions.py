"""The edition of a history: which one a person looks at. A page that was made of the same edition is still true."""

from __future__ import annotations

from sqlalchemy import Connection, func, select

from elastogeo.history.store.clock import now
from elastogeo.history.store.schema import audit_head, drawing, outbox, series_state

_NUMBERS = select(
    select(audit_head.c.number).scalar_subquery(),
    select(func.sum(series_state.c.version)).scalar_subquery(),
    select(func.count()).select_from(outbox).where(outbox.c.state != "sent").scalar_subquery(),
    select(func.max(drawing.c.id)).scalar_subquery(),
)
"""Put together once: it is asked with every page, and is most of what a page costs that has not changed."""


def edition(connection: Connection) -> str:
    """A text that is another one as soon as anything has changed that is shown; every hour too, since dates fall due.

    Every act is a row of the audit trail; what the charts say follows acts, and is written after them.
    """
    numbers = connection.execute(_NUMBERS).one()
    return "-".join((f"{now():%Y%m%d%H}", *(str(number or 0) for number in numbers)))
