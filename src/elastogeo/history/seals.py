"""Seals of what the charts read: hashes that the audit trail keeps, so that a bit that changed is noticed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import Any

from elastogeo.history.store.columns import canonical

IndicatorRow = tuple[Any, Any, Any, Any]
"""Name, kind, value, standard uncertainty, as the table has them."""


def seal_of(document: Any) -> str:
    """Hash of a document as it is kept."""
    return hashlib.sha256(canonical(document).encode()).hexdigest()


def seal_of_indicators(rows: Iterable[IndicatorRow]) -> str:
    """Hash of the indicators of an analysis, whatever their order; SQLite keeps no sign of a zero."""
    plain = [
        (name, kind, float(value) + 0.0, None if deviation is None else float(deviation) + 0.0)
        for name, kind, value, deviation in rows
    ]
    return seal_of(sorted(canonical(list(row)) for row in plain))
