"""The check of a whole history: database, references, raw files, documents, records, audit trail."""

from __future__ import annotations

from sqlalchemy import Connection, select

from elastogeo.changes import (
    DATABASE_SOUND,
    DOCUMENTS_WHOLE,
    NO_STRAY_FILES,
    RAW_FILES_WHOLE,
    RECORDS_AGREE,
    REFERENCES_WHOLE,
    ROWS_PROTECTED,
    AuditFault,
    StoreFault,
    Verified,
    as_written,
    trail_whole,
)
from elastogeo.changes import TRAIL_WHOLE as TRAIL
from elastogeo.history.store import Store, audit, read
from elastogeo.history.store.schema import FROZEN, blob
from elastogeo.history.upkeep.database_checks import dangling, references, unprotected, unreadable
from elastogeo.history.upkeep.file_checks import damaged, stray
from elastogeo.history.upkeep.raw_copies import Step, silent
from elastogeo.history.upkeep.record_checks import contradicted, spoiled_documents
from elastogeo.identification import Check


def verify(store: Store, step: Step = silent) -> Verified:
    """Check all that a history keeps; nothing is changed.

    Parameters
    ----------
    store : Store
    step : callable
        Is told what is going on.

    Returns
    -------
    Verified
        Each thing that is not as it was written, by name.

    Raises
    ------
    StoreError
        If the database cannot be reached.
    """
    rows: dict[str, int] = {}
    with read(store) as connection:
        faults = list(unreadable(connection, rows, step))
        if faults:
            return Verified(store.url, rows, 0, 0, tuple(faults), _unreadable(rows, faults))
        documents: list[int] = []
        faults += unprotected(connection)
        faults += dangling(connection, step)
        faults += spoiled_documents(connection, documents, step)
        if not faults:  # what cannot be read cannot be compared
            faults += contradicted(connection, step)
        told = _trail(connection, step)
        sizes = {row.sha256: row.size for row in connection.execute(select(blob).order_by(blob.c.sha256))}
    sizes_read: list[int] = []
    faults += damaged(store.files, sizes, sizes_read, step)
    strays = list(stray(store.files, set(sizes)))
    faults += strays
    records = rows["test"] + rows["analysis"]
    verdict = (
        as_written(DATABASE_SOUND, sum(rows.values()), faults),
        as_written(ROWS_PROTECTED, len(FROZEN), faults),
        as_written(REFERENCES_WHOLE, references(), faults),
        as_written(RAW_FILES_WHOLE, len(sizes), faults),
        as_written(DOCUMENTS_WHOLE, sum(documents), faults),
        as_written(RECORDS_AGREE, records, faults, tested=not (set(_of(faults)) & {DOCUMENTS_WHOLE, REFERENCES_WHOLE})),
        trail_whole(rows["audit"], told),
        as_written(NO_STRAY_FILES, len(sizes), faults, decisive=False),
    )
    faults += [StoreFault(TRAIL, f"audit row {one.number}", one.fault, _was(one)) for one in told]
    return Verified(store.url, rows, len(sizes_read), sum(sizes_read), tuple(faults), verdict)


def _unreadable(rows: dict[str, int], faults: list[StoreFault]) -> tuple[Check, ...]:
    """The verdict of a database that cannot be read: nothing else was tested."""
    others = (ROWS_PROTECTED, REFERENCES_WHOLE, RAW_FILES_WHOLE, DOCUMENTS_WHOLE, RECORDS_AGREE)
    first = as_written(DATABASE_SOUND, sum(rows.values()), faults)
    return (first, *(as_written(name, 0, faults, tested=False) for name in others))


def _trail(connection: Connection, step: Step) -> tuple[AuditFault, ...]:
    step("the audit trail")
    return tuple(AuditFault(one.number, one.fault, one.was) for one in audit.verify(connection))


def _of(faults: list[StoreFault]) -> list[str]:
    return [fault.check for fault in faults]


def _was(fault: AuditFault) -> str:
    return "" if fault.was is None else f"stood at {fault.was}"
