"""The view of a history that was checked, and `elastogeo.verified/1`, its document.

store : where
rows : by table
files, size_bytes : the raw files that were read
faults : [{check, subject, fault, detail}]: `unreadable`, `unprotected`, `dangling`, `missing`, `changed`, `resized`,
    `stray`; of the audit trail `moved`, `cut off`, `head missing` too
verdict : as in every document
"""

from __future__ import annotations

from elastogeo.changes import Verified
from elastogeo.report.document import document, verdict_entries
from elastogeo.report.view import KeyValue, Section, Table, View, said, views

SCHEMA = "elastogeo.verified/1"
_SHOWN = 50


@views(Verified)
def verified_view(result: Verified) -> View:
    """The answer, and each thing that is not as it was written."""
    rows = [{"check": one.check, "subject": one.subject, "fault": one.fault, "detail": one.detail} for one in result.faults]
    found = {
        "store": result.store,
        "rows": result.rows,
        "files": result.files,
        "size_bytes": result.size,
        "faults": rows,
        "verdict": verdict_entries(result.verdict),
    }
    more = len(rows) - _SHOWN
    table = Table(
        ("What", "Fault", "Detail", "Check"),
        tuple((one["subject"], one["fault"], one["detail"], one["check"]) for one in rows[:_SHOWN]),
        words=(0, 1, 2, 3),
        title="Not as it was written",
        note=f"{more} more, in the JSON" if more > 0 else "",
    )
    tables = (table,) if rows else ()
    return View(
        kind="Verification",
        title=result.store,
        origin="",
        sentence=_answer(result),
        values=(KeyValue("Rows", f"{sum(result.rows.values())}"), KeyValue("Raw files", f"{result.files}")),
        checks=said(result.verdict),
        document=document(SCHEMA, found),
        rows=rows,
        tables=tables,
        notes=(),
        sections=(Section("Faults", tables=tables),) if rows else (),
    )


def _answer(result: Verified) -> str:
    decisive = {check.name for check in result.verdict if check.decisive}
    count = sum(1 for one in result.faults if one.check in decisive)
    held = f"{sum(result.rows.values())} rows, {result.files} raw files"
    if not count:
        return f"The history is as it was written: {held}."
    return f"The history is not as it was written: {count} {'fault' if count == 1 else 'faults'} in {held}."
