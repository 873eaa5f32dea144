"""PostgreSQL: how a server is reached."""

from __future__ import annotations

from sqlalchemy import URL, Engine, create_engine

LOCK = 0x656C6173746F
"""The advisory lock of whoever writes a history: one at a time, as on SQLite."""
WAIT = 30.0
"""How long a writer waits for another [s]."""


def server_engine(server: URL) -> Engine:
    """The engine of a database; a connection that was cut while it rested is made again."""
    settings = {"connect_timeout": 10, "options": f"-c lock_timeout={WAIT * 1000:.0f}"}
    return create_engine(server, pool_size=4, pool_pre_ping=True, connect_args=settings)
