"""What a copy of a history says of itself: schema, rows of each table with their hash, number and size of the raw files.

A copy is a folder: `manifest.json`, the raw files under their hashes in `files`, and either `history.db`, a file of SQLite,
or `tables`, the rows of each table as lines (`rows.py`).
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from elastogeo.errors import StoreError
from elastogeo.history.store import now
from elastogeo.history.store.columns import canonical
from elastogeo.history.store.migrations import REVISIONS
from elastogeo.history.upkeep.folders import disk_in_words, write_file
from elastogeo.version import VERSION

SCHEMA = "elastogeo.history-copy/1"
MANIFEST, DATABASE, TABLES, FILES = "manifest.json", "history.db", "tables", "files"
AS_DATABASE, AS_ROWS = "database", "rows"
"""How a copy holds the rows."""


@dataclass(frozen=True, slots=True)
class Copied:
    """A copy that was made, or restored.

    Attributes
    ----------
    place : str
        Where it is now.
    content : str
        `database` or `rows`.
    rows : dict of str to int
        By table.
    files, size : int
        The raw files, and their size [bytes].
    wrong : tuple of str
        Checks that the history did not pass when it was copied: the copy has these faults too.
    """

    place: str
    content: str
    rows: dict[str, int]
    files: int
    size: int
    wrong: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Manifest:
    """What a copy must hold.

    Attributes
    ----------
    content : str
        `database` or `rows`.
    revision : str
        The schema.
    tables : dict
        By table: `rows`, how many, and `sha256` of them as lines.
    files, size : int
        The raw files, and their size [bytes].
    """

    content: str
    revision: str
    tables: dict[str, dict[str, Any]]
    files: int
    size: int

    def copied(self, place: str, wrong: tuple[str, ...] = ()) -> Copied:
        """As a result."""
        rows = {name: of["rows"] for name, of in self.tables.items()}
        return Copied(place, self.content, rows, self.files, self.size, wrong)


def write_manifest(folder: Path, manifest: Manifest, url: str) -> None:
    """Write it into a copy that is otherwise complete."""
    said = {
        "schema": SCHEMA,
        "software": VERSION,
        "made_at": now().isoformat(),
        "from": url,
        "content": manifest.content,
        "revision": manifest.revision,
        "tables": manifest.tables,
        "files": {"count": manifest.files, "size": manifest.size},
    }
    said["sha256"] = _seal(said)
    text = json.dumps(said, indent=2, ensure_ascii=False)
    with disk_in_words(folder):
        write_file(folder / MANIFEST, [text.encode(), b"\n"])


def read_manifest(folder: Path) -> Manifest:
    """What a copy says of itself.

    Raises
    ------
    StoreError
        If this is no copy, is damaged, or was made by a newer version.
    """
    path = folder / MANIFEST
    if not folder.is_dir():
        raise StoreError(f"{folder}: there is no such folder; name the folder of a backup or of an export")
    if not path.is_file():
        raise StoreError(f"{folder}: is no backup and no export: it has no {MANIFEST}; name the folder of one")
    try:
        said = json.loads(path.read_bytes())
        kind = said["schema"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise StoreError(f"{path}: cannot be read ({error}); take another copy") from error
    if kind != SCHEMA:
        raise StoreError(f"{path}: has the schema {kind!r}; restore it with the version that made it")
    if said.get("sha256") != _seal(said):
        raise StoreError(f"{path}: was changed or is damaged; take another copy")
    if said["revision"] not in REVISIONS:
        raise StoreError(
            f"{folder}: was written by a newer elastogeo ({said['software']}, schema {said['revision']}; {VERSION} knows "
            f"{REVISIONS[-1]} and older); install that version, or take an older copy"
        )
    return Manifest(said["content"], said["revision"], said["tables"], said["files"]["count"], said["files"]["size"])


def _seal(said: dict[str, Any]) -> str:
    return hashlib.sha256(canonical({name: of for name, of in said.items() if name != "sha256"}).encode()).hexdigest()
