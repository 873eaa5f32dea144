"""Serve the pages, and keep the worker of long tasks alive beside them."""

from __future__ import annotations

import gc
import os
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

import uvicorn

from elastogeo.errors import InputError
from elastogeo.history import History
from elastogeo.web.app import application
from elastogeo.web.guard import Connection, check_reach
from elastogeo.web.settings import Settings

_PATIENCE = 10.0
"""Seconds that a worker has to come to an end."""
_PAUSE = 2.0
"""Seconds after which a worker that died is started again."""


def serve(settings: Settings, say: Callable[[str], None] = print) -> None:
    """Serve until it is stopped.

    Parameters
    ----------
    settings : Settings
    say : callable
        Tells the person at the terminal.

    Raises
    ------
    InputError
        If the port cannot be had.
    StoreError
        If the history cannot be opened, or other computers are to be served and nobody could log in.
    """
    is_new = _is_new(settings.store)
    with (
        listening(settings.host, settings.port) as sockets,
        History(settings.store, create=is_new, files=settings.files, who=settings.who) as history,
    ):
        check_reach(settings, history.store)
        if is_new and not settings.demo:
            say(f"{settings.store} was not there: a new, empty history was made")
        if settings.demo and not history.machines():
            history.put_demo()
        if settings.worker:
            history.resume_jobs()
        app = application(settings, history.store)
        config = uvicorn.Config(
            app, settings.host, settings.port, log_level="warning", server_header=False, proxy_headers=settings.behind_https,
            timeout_keep_alive=20, h11_max_incomplete_event_size=32 * 1024, access_log=False, http=Connection,
        )  # fmt: skip
        worker = _Worker(settings) if settings.worker else None
        server = uvicorn.Server(config)
        gc.collect()
        gc.freeze()  # what is there by now stays: to look through it for waste costs a page now and then 0.1 s
        say(f"elastogeo is at http://{settings.host}:{settings.port}{settings.prefix}/ ; stop it with Ctrl+C")
        try:
            server.run(sockets)
        finally:
            if worker is not None:
                worker.stop()


@contextmanager
def listening(host: str, port: int) -> Iterator[list[socket.socket]]:
    """The port at every address of a host, held until the end: it is asked for before anything is made or said.

    Raises
    ------
    InputError
        If another program has it, it may not be had, or no address of this computer has that name.
    """
    with ExitStack() as held:
        try:
            found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
            sockets = [_bound(held, family, address) for family, _, _, _, address in dict.fromkeys(found)]
        except OSError as error:
            why = error.strerror or str(error)
            raise InputError(
                f"port {port} of {host} cannot be had: {why[:1].lower()}{why[1:]}; give another with --port, or an address "
                "of this computer with --host"
            ) from error
        yield sockets


def _bound(held: ExitStack, family: int, address: tuple[Any, ...]) -> socket.socket:
    # named TCP, or asyncio leaves the pause of small packets on: 40 ms an answer
    taken = held.enter_context(socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP))
    if os.name == "posix":
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    if family == socket.AF_INET6:
        taken.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
    taken.bind(address)
    return taken


def _is_new(store: str | Path) -> bool:
    """Whether a history is made: a file that is not there yet; an older one is migrated by a person only."""
    return "://" not in str(store) and not Path(store).exists()


class _Worker:
    """The process that does what takes long; it is started again when it dies."""

    def __init__(self, settings: Settings) -> None:
        self._command = [sys.executable, "-m", "elastogeo", "history", "work", "--attached"]
        self._given = {**os.environ, "ELASTOGEO_STORE": str(settings.store)}  # its command everybody on the computer sees
        if settings.files is not None:
            self._given["ELASTOGEO_FILES"] = str(settings.files)
        self._end = threading.Event()
        self._process = self._started()
        threading.Thread(target=self._watch, daemon=True).start()

    def stop(self) -> None:
        """End it: it finishes its step, or is killed and the step is done again at the next start."""
        self._end.set()
        self._process.terminate()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(_PATIENCE)
        self._process.kill()

    def _watch(self) -> None:
        while not self._end.is_set():
            self._process.wait()
            if not self._end.wait(_PAUSE):
                self._process = self._started()

    def _started(self) -> subprocess.Popen[bytes]:
        """A worker that ends when this program does, however that ends: its standard input ends then."""
        return subprocess.Popen(self._command, stdin=subprocess.PIPE, env=self._given)
