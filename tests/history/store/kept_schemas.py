"""Histories of released schemas, as text: what a migration must take.

When a version with a new schema is released, its dumps are made once, and never again:
`python -m tests.history.store.kept_schemas`.
"""

from __future__ import annotations

import os
import re
import sqlite3
import subprocess
import tempfile
from contextlib import closing
from datetime import timedelta
from pathlib import Path

from sqlalchemy import make_url

from elastogeo.history.store import audit, clock, open_store, write
from elastogeo.history.store.migrations import REVISIONS
from tests.history.conftest import Server
from tests.history.store.filled import AT, fill

FOLDER = Path(__file__).parent / "released"


def dump_of(revision: str, database: str) -> Path:
    """The dump of a schema that was released: of `sqlite` or of `postgresql`."""
    return FOLDER / f"{revision}.{database}.sql"


def load(dump: Path, url: str) -> None:
    """Make a database of a dump."""
    statements = dump.read_text(encoding="utf-8")
    if dump.suffixes[0] == ".sqlite":
        with closing(sqlite3.connect(url)) as file:
            file.executescript(statements)
        return
    import psycopg

    with psycopg.connect(url) as server:
        server.execute(statements.encode())


def keep(folder: Path = FOLDER) -> None:
    """Write the dumps of the schema of this version: a row in each table, and an audit trail."""
    times = (AT + timedelta(hours=k) for k in range(100))
    clock.source = lambda: next(times)
    server = Server()
    try:
        with tempfile.TemporaryDirectory() as place:
            os.environ["ELASTOGEO_FILES"] = place
            for url in (f"{place}/h.db", server.url(server.database())):
                with open_store(url, create=True, who="A. Miller") as store, write(store) as connection:
                    fill(connection)
                    audit.record(connection, "A. Miller", "set aside", "test 1", old=False, new=True, why="ball not seated")
                database = "postgresql" if "://" in url else "sqlite"
                text = _of_server(url, server) if "://" in url else _of_file(Path(url))
                folder.mkdir(exist_ok=True)
                (folder / f"{REVISIONS[-1]}.{database}.sql").write_text(text, encoding="utf-8")
    finally:
        server.stop()


def _of_file(file: Path) -> str:
    with closing(sqlite3.connect(file)) as connection:
        return "\n".join(connection.iterdump()) + "\n"


def _of_server(url: str, server: Server) -> str:
    options = ["--inserts", "--no-owner", "--no-privileges", "--dbname", make_url(url).render_as_string(hide_password=False)]
    made = subprocess.run([server.programs / "pg_dump", *options], capture_output=True, text=True, check=True).stdout
    lines = [line for line in made.splitlines() if not re.match(r"--|\\|SET transaction_timeout", line)]
    return re.sub(r"\n{2,}", "\n\n", "\n".join(lines)).strip() + "\n"


if __name__ == "__main__":
    keep()
