"""An application served by uvicorn in a thread, and connections on which every byte is our own."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import uvicorn

from elastogeo.web.guard import Connection


@contextmanager
def served(app: Any) -> Iterator[int]:
    """Serve on a free port: the port."""
    config = uvicorn.Config(app, "127.0.0.1", 0, log_level="critical", http=Connection, lifespan="off", access_log=False)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()
    until = time.monotonic() + 30
    while not server.started and time.monotonic() < until:
        time.sleep(0.01)
    try:
        yield server.servers[0].sockets[0].getsockname()[1]
    finally:
        server.should_exit = True
        thread.join(10)


@contextmanager
def connected(port: int) -> Iterator[socket.socket]:
    """A connection; what takes longer than half a minute is an error."""
    with socket.create_connection(("127.0.0.1", port), timeout=30) as found:
        yield found


def answer_on(connection: socket.socket) -> tuple[int, str]:
    """Status and text of what comes until the other side closes, or breaks off; 0 where nothing comes."""
    came = b""
    with suppress(ConnectionResetError):
        while part := connection.recv(65_536):
            came += part
    head, _, body = came.partition(b"\r\n\r\n")
    return (int(head.split()[1]), body.decode()) if head else (0, "")


def head_of(method: str, path: str, **headers: str) -> bytes:
    """The first lines of a request, up to the body."""
    lines = [f"{method} {path} HTTP/1.1", *(f"{name.replace('_', '-')}: {value}" for name, value in headers.items()), "", ""]
    return "\r\n".join(lines).encode()
