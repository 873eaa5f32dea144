"""The edition of a history: which one a person looks at. A page that was made of the same edition is still true."""

from __future__ import annotations

from sqlalchemy import Connection, func, select

from elastogeo.history.store.clock import now
from elastogeo.history.store.schema import audit_head, drawing, outbox, series_state


def edition(connection: Connection) -> str:
    """A text that is another one as soon as anything has changed that is shown; every hour too, since dates fall due.

    Every act is a row of the audit trail; what the charts say follows acts, and is written after them.
    """
    parts = (
        select(audit_head.c.number),
        select(func.sum(series_state.c.version)),
        select(func.count()).select_from(outbox).where(outbox.c.state != "sent"),
        select(func.max(drawing.c.id)),
    )
    numbers = connection.execute(select(*(part.scalar_subquery() for part in parts))).one()
    return "-".join((f"{now():%Y%m%d%H}", *(str(number or 0) for number in numbers)))
