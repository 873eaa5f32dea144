"""Everything as files, which any program can read: a line a row, raw files by their hashes, and a manifest."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Table, select

from elastogeo.history.store import Files, Store, read
from elastogeo.history.store.migrations import REVISIONS
from elastogeo.history.store.schema import blob, metadata
from elastogeo.history.upkeep.entrances import EXPORT, Omitted
from elastogeo.history.upkeep.folders import disk_in_words, new_folder, write_file
from elastogeo.history.upkeep.manifests import AS_ROWS, FILES, TABLES, Copied, Manifest, write_manifest
from elastogeo.history.upkeep.raw_copies import Step, copy_raw, silent
from elastogeo.history.upkeep.rows import Counted, lines_of


def export(store: Store, folder: str | Path, step: Step = silent, omitted: Omitted = EXPORT) -> Copied:
    """Write rows and raw files of a history into a new folder: one consistent state, whatever others write meanwhile.

    Parameters
    ----------
    store : Store
    folder : str or Path
        Not there yet; it gets its name when all is in it.
    step : callable
        Is told what is going on.
    omitted : Omitted
        What is left out: what lets somebody in.

    Returns
    -------
    Copied

    Raises
    ------
    StoreError
        If a raw file is missing or damaged, or the folder cannot be written; nothing of it is there then.
    """
    target = Path(folder)
    with new_folder(target, store.files.folder) as filled:
        with read(store) as connection, disk_in_words(target):
            (filled / TABLES).mkdir()
            tables = {table.name: _written(connection, table, filled, step, omitted) for table in metadata.sorted_tables}
            hashes = connection.execute(select(blob.c.sha256).order_by(blob.c.sha256)).scalars().all()
        size = copy_raw(store.files, Files(filled / FILES), hashes, step)
        manifest = Manifest(AS_ROWS, REVISIONS[-1], tables, len(hashes), size)
        write_manifest(filled, manifest, store.url)
    return manifest.copied(str(target))


def _written(connection: Connection, table: Table, folder: Path, step: Step, omitted: Omitted) -> dict[str, Any]:
    step(f"rows of {table.name}")
    empty = omitted.columns.get(table.name, frozenset())
    lines = Counted(() if table.name in omitted.tables else lines_of(connection, table, empty))
    write_file(folder / TABLES / f"{table.name}.jsonl", lines)
    return lines.facts()
