"""Which backups were made, and when all was checked: rows of the audit trail, which stay when the folder has gone."""

from __future__ import annotations

import os
from datetime import datetime
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Row, select

from elastogeo.changes import KeptCheck, KeptCopies, KeptCopy, Verified
from elastogeo.errors import InputError, StoreError
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, audit, now, write
from elastogeo.history.store.schema import audit as rows
from elastogeo.history.upkeep.manifests import Copied

BACKUPS_VARIABLE = "ELASTOGEO_BACKUPS"
"""Of the environment: the folder in which the pages make backups."""
BACK_UP, VERIFY = "back up", "verify"
"""What the audit trail calls them."""
_LAST = 20
_FIRST = 5


def folder_of(store: Store) -> Path | None:
    """The folder in which the pages make backups: the one that is set, else beside a file of SQLite; or None."""
    named = os.environ.get(BACKUPS_VARIABLE, "")
    if named:
        return Path(named).expanduser().absolute()
    file = store.engine.url.database if store.engine.dialect.name == "sqlite" else None
    return Path(file).with_name(f"{Path(file).name}.backups") if file else None


def place_of_copy(store: Store, at: datetime) -> Path:
    """A new folder for a backup of now.

    Raises
    ------
    InputError
        If no folder for backups is set.
    """
    folder = folder_of(store)
    if folder is None:
        raise InputError(f"no folder for backups is set; name one in the variable {BACKUPS_VARIABLE} of the program's user")
    return folder / f"{at:%Y-%m-%dT%H%M%S}"


def make_folder(folder: Path) -> None:
    """The folder of all backups, if it is not there.

    Raises
    ------
    StoreError
        If it cannot be made.
    """
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise StoreError(f"{folder}: {error.strerror}; make it, or name another in {BACKUPS_VARIABLE}") from error


def note_copy(store: Store, copied: Copied, who: str) -> Copied:
    """Note that a backup was made."""
    said = {"rows": sum(copied.rows.values()), "files": copied.files, "size": copied.size, "wrong": list(copied.wrong)}
    with write(store) as connection:
        audit.record(connection, who, BACK_UP, copied.place, new=said)
    return copied


def is_noted(connection: Connection, place: str) -> bool:
    """Whether it is noted that this backup was made."""
    return connection.scalar(select(rows.c.number).where(rows.c.what == BACK_UP, rows.c.subject == place)) is not None


def note_check(store: Store, found: Verified, who: str) -> None:
    """Note that all was checked, and what was found."""
    decisive = [check.name for check in found.verdict if check.decisive and check.passed is False]
    faults = [one for one in found.faults if one.check in decisive]
    first = [f"{one.subject} is {one.fault}" for one in faults[:_FIRST]]
    said = {"rows": sum(found.rows.values()), "files": found.files, "faults": len(faults), "first": first}
    with write(store) as connection:
        audit.record(connection, who, VERIFY, "history", new=said)


def kept_copies(connection: Connection, store: Store) -> KeptCopies:
    """The last backups and checks."""
    folder = folder_of(store)
    copies = tuple(_copy(row) for row in _last(connection, BACK_UP))
    checks = tuple(_check(row) for row in _last(connection, VERIFY))
    return KeptCopies(store.url, days(now()), "" if folder is None else str(folder), copies, checks)


def _last(connection: Connection, what: str) -> list[Row[Any]]:
    asked = select(rows).where(rows.c.what == what).order_by(rows.c.number.desc()).limit(_LAST)
    return list(connection.execute(asked))


def _copy(row: Row[Any]) -> KeptCopy:
    said = row.new
    return KeptCopy(days(row.at), row.who, row.subject, said["rows"], said["files"], said["size"], tuple(said["wrong"]))


def _check(row: Row[Any]) -> KeptCheck:
    said = row.new
    return KeptCheck(days(row.at), row.who, said["rows"], said["files"], said["faults"], tuple(said["first"]))
