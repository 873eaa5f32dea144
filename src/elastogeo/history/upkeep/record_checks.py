"""Whether documents have their hash, and tests and analyses are what their files and the audit trail say of them."""

from __future__ import annotations

import hashlib
import json
import zlib
from collections import defaultdict
from collections.abc import Iterator
from typing import Any

from sqlalchemy import Connection, LargeBinary, Text, and_, or_, select, type_coerce

from elastogeo.changes import CHANGED, DOCUMENTS_WHOLE, MISSING, RECORDS_AGREE, StoreFault
from elastogeo.history.seals import IndicatorRow, seal_of, seal_of_indicators
from elastogeo.history.store.columns import Document, Packed, canonical
from elastogeo.history.store.schema import analysis, audit, campaign, indicator, metadata, test, test_file
from elastogeo.history.upkeep.raw_copies import Step

_AT_ONCE = {"yield_per": 200}
_RECOMPUTED = and_(audit.c.what == "recompute", audit.c.subject.startswith("campaign "))
_IMPORTED = ("sha256", "name", "series", "repeats")
_ANALYSED = ("software", "inputs_sha256", "document_sha256", "error", "supported")


def spoiled_documents(connection: Connection, checked: list[int], step: Step) -> Iterator[StoreFault]:
    """Documents that cannot be unpacked, are no JSON, or have another hash; appends to `checked` how many a table has."""
    for table in metadata.sorted_tables:
        kept = [column for column in table.columns if isinstance(column.type, Document | Packed)]
        if not kept:
            continue
        step(f"documents of {table.name}")
        (key,) = table.primary_key.columns
        hashed = [table.c.document_sha256] if "document_sha256" in table.c else []
        raw = [type_coerce(column, LargeBinary if isinstance(column.type, Packed) else Text) for column in kept]
        count = 0
        for row in connection.execute(select(key, *raw, *hashed), execution_options=_AT_ONCE):
            for column, value in zip(kept, row[1:], strict=False):
                count += value is not None
                seal = row[-1] if hashed and column.name == "document" else None
                if value is not None and not _is_whole(value, seal):
                    yield StoreFault(DOCUMENTS_WHOLE, f"{table.name} {row[0]}", CHANGED, column.name)
                elif value is None and seal is not None:
                    yield StoreFault(DOCUMENTS_WHOLE, f"{table.name} {row[0]}", MISSING, column.name)
        checked.append(count)


def _is_whole(value: str | bytes, seal: str | None) -> bool:
    try:
        text = value if isinstance(value, str) else zlib.decompress(value).decode()
        whole = canonical(json.loads(text))
    except (zlib.error, ValueError):
        return False
    return whole == text and (seal is None or hashlib.sha256(text.encode()).hexdigest() == seal)


def contradicted(connection: Connection, step: Step) -> Iterator[StoreFault]:
    """Tests that are not what their files and the trail say, and analyses that are not what the trail says."""
    step("tests and analyses against the audit trail")
    lines: dict[int, list[str]] = defaultdict(list)
    for of, path, sha256 in connection.execute(select(test_file.c.test, test_file.c.path, test_file.c.sha256)):
        lines[of].append(f"{sha256}  {path}\n")
    tests: dict[int, dict[str, Any]] = {}
    for row in connection.execute(select(test.c.id, test.c.at, *(test.c[name] for name in _IMPORTED))):
        tests[row.id] = {**{name: row._mapping[name] for name in _IMPORTED}, "at": row.at.isoformat()}
        if hashlib.sha256("".join(sorted(lines[row.id])).encode()).hexdigest() != row.sha256:
            yield StoreFault(RECORDS_AGREE, f"test {row.id}", CHANGED, "its files are not those that were imported")
    analyses, campaigns = _sealed(connection), dict(connection.execute(select(campaign.c.id, campaign.c.content)).all())
    last: dict[int, dict[str, Any]] = {}
    for what, subject, new in connection.execute(_told(), execution_options=_AT_ONCE):
        if what == "import":
            yield from _against(tests, _number(subject), subject, new)
        elif what == "analyse":
            yield from _against(analyses, new.get("analysis"), f"analysis {new.get('analysis')}", new)
        elif subject.startswith("campaign "):  # one that was recomputed is what was said last
            last[int(subject.split()[1])] = new
    yield from _campaigns(campaigns, last)


def _campaigns(kept: dict[int, dict[str, Any]], told: dict[int, dict[str, Any]]) -> Iterator[StoreFault]:
    """Campaigns whose document has not its hash, or that are not what the trail says."""
    for key, content in kept.items():
        document, seal = content.get("document"), content.get("document_sha256")
        if (None if document is None else seal_of(document)) != seal:
            yield StoreFault(RECORDS_AGREE, f"campaign {key}", CHANGED, "document")
    for key, new in told.items():
        yield from _against(kept, key, f"campaign {key}", new)


def _sealed(connection: Connection) -> dict[int, dict[str, Any]]:
    """Analyses with the seals of their indicators and signatures."""
    indicators: dict[int, list[IndicatorRow]] = defaultdict(list)
    told = select(
        indicator.c.analysis, indicator.c.name, indicator.c.kind, indicator.c.value, indicator.c.standard_uncertainty
    )
    for of, *one in connection.execute(told, execution_options=_AT_ONCE):
        indicators[of].append((one[0], one[1], one[2], one[3]))
    found = {
        row.id: {**row._asdict(), "signatures_sha256": None, "indicators_sha256": seal_of_indicators(indicators[row.id])}
        for row in connection.execute(_analyses())
    }
    raw = type_coerce(analysis.c.signatures, LargeBinary)
    moved = select(analysis.c.id, raw).where(analysis.c.signatures.is_not(None))
    for key, packed in connection.execute(moved, execution_options=_AT_ONCE):
        found[key]["signatures_sha256"] = _seal_of_packed(packed)
    return found


def _seal_of_packed(packed: bytes) -> str:
    """Of the text in it; one that cannot be unpacked has none, and `spoiled_documents` names it too."""
    try:
        return hashlib.sha256(zlib.decompress(packed)).hexdigest()
    except zlib.error:
        return ""


def _analyses() -> Any:
    return select(analysis.c.id, *(analysis.c[name] for name in _ANALYSED))


def _told() -> Any:
    return (
        select(audit.c.what, audit.c.subject, audit.c.new)
        .where(or_(audit.c.what.in_(("import", "analyse", "keep campaign")), _RECOMPUTED), audit.c.new.is_not(None))
        .order_by(audit.c.number)
    )


def _number(subject: str) -> int | None:
    kind, _, number = subject.partition(" ")
    return int(number) if kind == "test" and number.isdigit() else None


def _against(rows: dict[int, dict[str, Any]], key: Any, subject: str, told: dict[str, Any]) -> Iterator[StoreFault]:
    """Entries in which a row is not what the trail says of it."""
    row = rows.get(key)
    if row is None:
        yield StoreFault(RECORDS_AGREE, subject, MISSING, "the audit trail tells of it")
        return
    changed = [name for name in row if name in told and row[name] != told[name]]
    if changed:
        yield StoreFault(RECORDS_AGREE, subject, CHANGED, ", ".join(changed))
