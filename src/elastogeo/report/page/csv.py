"""Rows of a view as CSV: numbers stay numbers, and no spreadsheet takes a text for a formula."""

from __future__ import annotations

import csv
import json
import re
from collections.abc import Iterable, Mapping
from io import StringIO
from math import isfinite
from typing import Any

import numpy as np

_SIGNS = "=+\\-@\uff1d\uff0b\uff0d\uff20\u2212"
"""What a text begins with that a spreadsheet may take for a formula (OWASP, CSV injection); the wide forms too."""
_BLANK = "\\s\"'\u00a0\ufeff\u3000\\x00"
"""Before it; spreadsheets pass over them."""
_FORMULA = re.compile(f"(^|[;\\t\\r\\n])([{_BLANK}]*)(?=[{_SIGNS}])")
"""A formula at the begin of a text, or of what a spreadsheet that separates cells by semicolon or tab makes of it."""


def csv_of(rows: Iterable[Mapping[str, Any]]) -> str:
    """Rows as CSV (RFC 4180, UTF-8): a column for each name, in the order in which the rows bring them.

    Parameters
    ----------
    rows : iterable of mapping
        Plain values: numbers as Python writes them back bit for bit, nothing for None and for what is not finite, `true`
        and `false`, lists and mappings as JSON.

    Returns
    -------
    str
        With a head line; empty without rows. A text that could be a formula has an apostrophe before its
        sign. A text that is a number is left as it is.
    """
    every = [dict(row) for row in rows]
    names = list(dict.fromkeys(name for row in every for name in row))
    if not names:
        return ""
    file = StringIO()
    writer = csv.writer(file, lineterminator="\r\n")
    writer.writerow([_text(name) for name in names])
    writer.writerows([_cell(row.get(name)) for name in names] for row in every)
    return file.getvalue()


def _cell(value: Any) -> str:
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value) if isfinite(value) else ""
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return _text(value)
    return _text(json.dumps(_plain(value), ensure_ascii=False, allow_nan=False))


def _plain(value: Any) -> Any:
    """What JSON writes; a number that is not finite is null there."""
    if isinstance(value, np.generic | np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(name): _plain(one) for name, one in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [_plain(one) for one in value]
    if isinstance(value, float) and not isfinite(value):
        return None
    return value if value is None or isinstance(value, bool | int | float | str) else str(value)


def _text(text: str) -> str:
    return text if _is_number(text) else _FORMULA.sub(r"\1\2'", text)


def _is_number(text: str) -> bool:
    """Whether a text is nothing but a number as a spreadsheet reads it."""
    if not text.isascii() or "_" in text or text != text.strip():
        return False
    try:
        return isfinite(float(text))
    except ValueError:
        return False
