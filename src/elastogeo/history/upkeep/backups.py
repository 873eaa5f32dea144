"""A backup: one state of the database with its raw files, made while others write, and opened and checked before it counts.

Of SQLite it is the database itself, copied by the library's own backup in one step; of PostgreSQL it is an export. The copy
of SQLite is made and opened in the temporary folder of this computer (the variable TMPDIR), and only then goes to its place:
that may be a network drive, on which SQLite must not work.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from sqlalchemy import select

from elastogeo.changes import DATABASE_SOUND, RAW_FILES_WHOLE, Verified
from elastogeo.errors import StoreError
from elastogeo.history.store import Files, Store, open_store, read
from elastogeo.history.store.migrations import REVISIONS
from elastogeo.history.store.schema import blob, metadata
from elastogeo.history.upkeep.entrances import BACKUP
from elastogeo.history.upkeep.exports import export
from elastogeo.history.upkeep.folders import disk_in_words, new_folder, write_file
from elastogeo.history.upkeep.manifests import AS_DATABASE, DATABASE, FILES, Copied, Manifest, write_manifest
from elastogeo.history.upkeep.raw_copies import Step, copy_raw, silent
from elastogeo.history.upkeep.rows import digest_of, lines_of
from elastogeo.history.upkeep.verification import verify

_BLOCK = 2**20


def back_up(store: Store, folder: str | Path, step: Step = silent) -> Copied:
    """Copy a history into a new folder, while others write.

    Parameters
    ----------
    store : Store
    folder : str or Path
        Not there yet; it gets its name when all is in it and was checked.
    step : callable
        Is told what is going on.

    Returns
    -------
    Copied

    Raises
    ------
    StoreError
        If the history is damaged, or the folder cannot be written; nothing of it is there then.
    """
    if store.engine.dialect.name != "sqlite":
        wrong = _check(store, verify(store, step))
        return replace(export(store, folder, step, BACKUP), wrong=wrong)
    target = Path(folder)
    with new_folder(target, store.files.folder) as filled, disk_in_words(target), _copy_of(store, step) as copy:
        raw = Files(filled / FILES)
        with open_store(copy, files=filled / FILES) as copied:
            with read(copied) as connection:
                hashes = connection.execute(select(blob.c.sha256).order_by(blob.c.sha256)).scalars().all()
                tables = {table.name: digest_of(lines_of(connection, table)) for table in metadata.sorted_tables}
            size = copy_raw(store.files, raw, hashes, step)
            wrong = _check(store, verify(copied, step))
        write_file(filled / DATABASE, _blocks(copy))
        manifest = Manifest(AS_DATABASE, REVISIONS[-1], tables, len(hashes), size)
        write_manifest(filled, manifest, store.url)
    return manifest.copied(str(target), wrong)


@contextmanager
def _copy_of(store: Store, step: Step) -> Iterator[Path]:
    """A copy of the database in a temporary folder of this computer."""
    step("the database")
    with tempfile.TemporaryDirectory(prefix="elastogeo-backup-") as folder:
        copy = Path(folder) / DATABASE
        library: Any = store.engine.dialect.loaded_dbapi
        with closing(store.engine.raw_connection()) as pooled:
            source: Any = pooled.driver_connection
            try:
                with closing(library.connect(str(copy))) as target:
                    source.backup(target, pages=-1)
                    target.execute("PRAGMA secure_delete = ON")  # its pages would keep what was in them
                    for table in sorted(BACKUP.tables):
                        target.execute(f"DELETE FROM {table}")
                    target.commit()
            except library.Error as error:
                raise StoreError(f"{store.url}: could not be copied to {folder}: {error}; name another TMPDIR") from error
        yield copy


def _check(store: Store, found: Verified) -> tuple[str, ...]:
    """A copy that cannot be read is no backup; what else is wrong with the history is copied as it is, and named."""
    wrong = tuple(check.name for check in found.verdict if check.decisive and check.passed is False)
    if {DATABASE_SOUND, RAW_FILES_WHOLE} & set(wrong):
        first = found.faults[0]
        raise StoreError(
            f"{store.url}: could not be backed up: {first.subject} is {first.fault} ({first.detail}); "
            "see: elastogeo history verify"
        )
    return wrong


def _blocks(path: Path) -> Iterator[bytes]:
    with open(path, "rb") as file:
        while block := file.read(_BLOCK):
            yield block
