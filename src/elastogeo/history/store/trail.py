"""The audit trail as a result."""

from __future__ import annotations

from sqlalchemy import func, or_, select

from elastogeo.changes import AuditFault, AuditRow, AuditTrail, trail_whole
from elastogeo.history.store import audit
from elastogeo.history.store.opening import Store, read
from elastogeo.history.store.schema import audit as rows


def audit_trail(
    store: Store, last: int = 20, subject: str = "", who: str = "", before: int | None = None, check: int | None = None
) -> AuditTrail:
    """Check the whole trail, and give its last rows.

    Parameters
    ----------
    store : Store
    last : int
        How many rows.
    subject, who : str
        Only the rows of this subject, by its first words (`test 12`, `series`), or of this person.
    before : int, optional
        Only rows before this one.
    check : int, optional
        Rows up to which the trail is checked; a longer one is only shown. By default any is checked.
    """
    asked = select(rows).order_by(rows.c.number.desc()).limit(last)
    if subject.strip():
        said = subject.strip()
        more = (rows.c.subject.startswith(f"{said}{mark}", autoescape=True) for mark in (" ", ","))
        asked = asked.where(or_(rows.c.subject == said, *more))
    if who.strip():
        asked = asked.where(func.lower(rows.c.who) == who.strip().lower())
    if before is not None:
        asked = asked.where(rows.c.number < before)
    with read(store) as connection:
        count = connection.execute(select(func.count()).select_from(rows)).scalar_one()
        checked = check is None or count <= check
        found = audit.verify(connection) if checked else ()
        faults = tuple(AuditFault(one.number, one.fault, one.was) for one in found)
        head = connection.execute(select(rows.c.sha256).order_by(rows.c.number.desc()).limit(1)).scalar() or ""
        shown = tuple(
            AuditRow(row.number, row.at, row.who, row.what, row.subject, row.old, row.new, row.why, row.sha256)
            for row in connection.execute(asked)
        )
    return AuditTrail(store.url, count, head, shown, faults, (trail_whole(count, faults, checked),))
