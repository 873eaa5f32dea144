"""The audit trail as a result."""

from __future__ import annotations

from sqlalchemy import func, select

from elastogeo.changes import AuditFault, AuditRow, AuditTrail, trail_whole
from elastogeo.history.store import audit
from elastogeo.history.store.opening import Store, read
from elastogeo.history.store.schema import audit as rows


def audit_trail(store: Store, last: int = 20, subject: str = "", who: str = "") -> AuditTrail:
    """Check the whole trail, and give its last rows.

    Parameters
    ----------
    store : Store
    last : int
        How many rows.
    subject, who : str
        Only the rows of this subject (`test 12`), or of this person.
    """
    asked = select(rows).order_by(rows.c.number.desc()).limit(last)
    for column, wanted in ((rows.c.subject, subject), (rows.c.who, who)):
        asked = asked.where(column == wanted) if wanted else asked
    with read(store) as connection:
        faults = tuple(AuditFault(one.number, one.fault, one.was) for one in audit.verify(connection))
        count = connection.execute(select(func.count()).select_from(rows)).scalar_one()
        head = connection.execute(select(rows.c.sha256).order_by(rows.c.number.desc()).limit(1)).scalar() or ""
        shown = tuple(
            AuditRow(row.number, row.at, row.who, row.what, row.subject, row.old, row.new, row.why, row.sha256)
            for row in connection.execute(asked)
        )
    return AuditTrail(store.url, count, head, shown, faults, (trail_whole(count, faults),))
