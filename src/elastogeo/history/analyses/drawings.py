"""What the page of a test shows, drawn once: its view with the pictures, and of a circular test its causes.

A drawing is kept beside the analysis that it shows and can be made anew at any time: it is no record.
"""

from __future__ import annotations

from typing import Any

from sqlalchemy import Connection, Row, delete, insert, select

from elastogeo.errors import InputError
from elastogeo.history.analyses.analysing import PROGRAM, analyse
from elastogeo.history.analyses.computation import ask_again, sha256_of
from elastogeo.history.analyses.differences import differences
from elastogeo.history.analyses.raw import raw_files
from elastogeo.history.store import Store, now, read, write
from elastogeo.history.store.schema import analysis, drawing
from elastogeo.report import causes_document, kept_view, view_of
from elastogeo.result import Result
from elastogeo.version import VERSION

SCHEMA = "elastogeo.drawing/4"
"""What was drawn otherwise is drawn anew."""


def draw(store: Store, test: int, who: str = PROGRAM, again: bool = False) -> int:
    """Draw what the page of a test shows, if that has not been done by this version; analyse it first if need be.

    Parameters
    ----------
    store : Store
    test : int
        Its key.
    who : str
        For the audit trail of the analysis.
    again : bool
        Whether to draw it anew.

    Returns
    -------
    int
        Key of the analysis that it shows.

    Raises
    ------
    InputError
        If there is no such test, or its analysis is an error: that is what its page says then.
    StoreError
        If a raw file is missing or damaged, or nothing can be written.
    MissingExtraError
        If matplotlib is not installed.
    """
    key = analyse(store, test, who)
    with read(store) as connection:
        if not again and drawing_of(connection, key) is not None:
            return key
        kept = connection.execute(select(analysis).where(analysis.c.id == key)).one()
        raw = raw_files(connection, test)
    if kept.error:
        raise InputError(f"test {test} could not be analysed, so there is nothing to draw: {kept.error}")
    _, content, error = ask_again(store.files, raw, lambda result: _content(result, kept))
    if content is None:
        raise InputError(f"test {test} could not be drawn: {error}")
    with write(store) as connection:
        here = (drawing.c.analysis == key) & (drawing.c.software == VERSION)
        connection.execute(delete(drawing).where(here))
        connection.execute(insert(drawing).values(analysis=key, software=VERSION, made_at=now(), content=content))
    return key


def drawing_of(connection: Connection, key: int) -> dict[str, Any] | None:
    """What is drawn of an analysis, by this version; None if nothing is yet.

    Returns
    -------
    dict or None
        `schema`; `view` as `kept_view` gave it, and its `rows`; `causes` as `causes_document` gave it, None without a
        circle; `same_bits` and `differing`: whether the raw files say the same again, and how many entries differ by more
        than last digits.
    """
    chosen = select(drawing.c.content).where(drawing.c.analysis == key, drawing.c.software == VERSION)
    found: dict[str, Any] | None = connection.execute(chosen).scalar_one_or_none()
    return found if found is not None and found["schema"] == SCHEMA else None


def _content(result: Result, kept: Row[Any]) -> dict[str, Any]:
    view = view_of(result)
    document = dict(view.document)
    return {
        "schema": SCHEMA,
        "view": kept_view(view),
        "causes": causes_document(result),
        "rows": [dict(row) for row in view.rows],
        "same_bits": sha256_of(document) == kept.document_sha256,
        "differing": len(differences(kept.document, document)),
    }
