"""PostgreSQL: how a server is reached."""

from __future__ import annotations

from sqlalchemy import URL, Connection, Engine, create_engine, func, select

LOCK = 0x656C6173746F
"""The advisory lock of whoever writes a history: one at a time, as on SQLite."""
WAIT = 30.0
"""How long a writer waits for another [s]."""


def server_engine(server: URL) -> Engine:
    """The engine of a database; a connection that was cut while it rested is made again."""
    return create_engine(
        server, pool_size=4, pool_pre_ping=True, isolation_level="READ COMMITTED", connect_args={"connect_timeout": 10}
    )


def take_turn(connection: Connection, wait: float = WAIT) -> None:
    """Wait for whoever writes, and see what he wrote; what is committed is on the disk, whatever the server's default."""
    settings = {"lock_timeout": f"{wait * 1000:.0f}", "synchronous_commit": "on"}
    connection.execute(select(*(func.set_config(name, value, True) for name, value in settings.items())))
    connection.execute(select(func.pg_advisory_xact_lock(LOCK)))
