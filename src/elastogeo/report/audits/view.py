"""The view of an audit trail, and `elastogeo.audit/1`, its document.

store : where
count : of all rows
head : seal of the last row
rows : [{number, at, who, what, subject, old, new, why, sha256}], those asked for, the last first
faults : [{number, fault, was}], rows that are not as they were written: `changed`, `missing`, `moved` (it stood at `was`),
    `cut off` (from this row on), `head missing`
verdict : as in every document
"""

from __future__ import annotations

import json
from typing import Any

from elastogeo.changes import AuditRow, AuditTrail
from elastogeo.report.document import document, verdict_entries
from elastogeo.report.view import KeyValue, Section, Table, View, said, views

SCHEMA = "elastogeo.audit/1"
_LONG = 60
"""Characters of a value that a table shows; the JSON has all."""


@views(AuditTrail)
def audit_view(result: AuditTrail) -> View:
    """Who did what, the last first."""
    rows = [_entry(row) for row in result.rows]
    found = {
        "store": result.store,
        "count": result.count,
        "head": result.head,
        "rows": rows,
        "faults": [{"number": one.number, "fault": one.fault, "was": one.was} for one in result.faults],
        "verdict": verdict_entries(result.verdict),
    }
    table = Table(
        ("No.", "At (UTC)", "Who", "What", "Subject", "Old", "New", "Why"),
        tuple(_line(row) for row in result.rows),
        words=(1, 2, 3, 4, 5, 6, 7),
        title=f"{len(rows)} of {result.count} rows, the last first" if rows else "No row is of what was asked for",
        name="rows",
        keys=tuple(row.number for row in result.rows),
    )
    return View(
        kind="Audit trail",
        title=result.store,
        origin="",
        sentence=_answer(result),
        values=(KeyValue("Rows", f"{result.count}"), KeyValue("Seal of the last row", result.head[:16], "", result.head)),
        checks=said(result.verdict),
        document=document(SCHEMA, found),
        rows=rows,
        tables=(table,),
        notes=(f"Seal of the last row, to be noted elsewhere: {result.head}",) if result.head else (),
        sections=(Section("Rows", tables=(table,)),),
    )


def _answer(result: AuditTrail) -> str:
    holds = "is empty" if not result.count else f"holds {result.count} {'row' if result.count == 1 else 'rows'}"
    if any(check.passed is None for check in result.verdict):
        return f"The audit trail {holds}; whether all are as they were written was not looked at."
    return f"The audit trail {holds} and is {'not ' if result.faults else ''}as it was written."


def _entry(row: AuditRow) -> dict[str, Any]:
    return {
        "number": row.number,
        "at": f"{row.at:%Y-%m-%dT%H:%M:%S.%fZ}",
        "who": row.who,
        "what": row.what,
        "subject": row.subject,
        "old": row.old,
        "new": row.new,
        "why": row.why,
        "sha256": row.sha256,
    }


def _line(row: AuditRow) -> tuple[str, ...]:
    at = f"{row.at:%Y-%m-%d %H:%M:%S}"
    return f"{row.number}", at, row.who, row.what, row.subject, _short(row.old), _short(row.new), row.why


def _short(value: Any) -> str:
    if value is None:
        return ""
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    return text if len(text) <= _LONG else f"{text[: _LONG - 1]}…"
