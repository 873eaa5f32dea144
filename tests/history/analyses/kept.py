"""Tests that lie in a store, put there as rows and files: what an import does, without its questions."""

import hashlib
from datetime import UTC, datetime, timedelta
from pathlib import Path

from sqlalchemy import insert, select

from elastogeo.history.store import Store, now, schema, write
from elastogeo.version import VERSION

BEGAN = datetime(2026, 3, 1, 12, tzinfo=UTC)
EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def keep_series(store: Store, machine: str = "Mill 3", name: str = "circle XY", software: str = VERSION) -> int:
    """A series without tests; its key."""
    with write(store) as connection:
        owner = connection.execute(select(schema.machine.c.id).where(schema.machine.c.name == machine)).scalar()
        if owner is None:
            row = {"name": machine, "made_at": BEGAN}
            owner = connection.execute(insert(schema.machine).values(**row).returning(schema.machine.c.id)).scalar_one()
        row = {"machine": owner, "name": name, "recipe": {}, "recipe_sha256": name, "software": software}
        return int(connection.execute(insert(schema.series).values(**row).returning(schema.series.c.id)).scalar_one())


def keep_test(store: Store, series: int, files: dict[str, bytes], day: float = 0.0, name: str = "") -> int:
    """A test with these files by their paths; its key."""
    sha256 = dict(zip(files, store.files.put_all(files.values()), strict=True))
    at = BEGAN + timedelta(days=day)
    whole = hashlib.sha256(f"{series} {day} {name} {sorted(sha256.items())}".encode()).hexdigest()
    row = {"series": series, "sha256": whole, "name": name or f"on day {day:g}", "at": at, "imported_at": now()}
    with write(store) as connection:
        row |= {"origin": "measured", "about": {}}
        test = int(connection.execute(insert(schema.test).values(**row).returning(schema.test.c.id)).scalar_one())
        for path, content in files.items():
            known = select(schema.blob.c.sha256).where(schema.blob.c.sha256 == sha256[path])
            if connection.execute(known).scalar() is None:
                blob = {"sha256": sha256[path], "size": len(content), "made_at": now()}
                connection.execute(insert(schema.blob).values(**blob))
            connection.execute(insert(schema.test_file).values(test=test, path=path, sha256=sha256[path]))
    return test


def files_of(folder: Path) -> dict[str, bytes]:
    """All files below a folder by their paths in it."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
