"""Serve the pages, and keep the worker of long tasks alive beside them."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

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
    StoreError
        If the history cannot be opened, or other computers are to be served and nobody could log in.
    """
    with History(settings.store, create=_is_new(settings.store), files=settings.files, who=settings.who) as history:
        check_reach(settings, history.store)
        if settings.demo and not history.machines():
            history.put_job("demo", {"until": f"{datetime.now(UTC):%Y-%m-%dT00:00:00+00:00}"})
        if settings.worker:
            history.resume_jobs()
        app = application(settings, history.store)
        config = uvicorn.Config(
            app, settings.host, settings.port, log_level="warning", server_header=False, proxy_headers=settings.behind_https,
            timeout_keep_alive=20, h11_max_incomplete_event_size=32 * 1024, access_log=False, http=Connection,
        )  # fmt: skip
        worker = _Worker(settings) if settings.worker else None
        server = uvicorn.Server(config)
        say(f"elastogeo is at http://{settings.host}:{settings.port}{settings.prefix}/ ; stop it with Ctrl+C")
        try:
            server.run()
        finally:
            if worker is not None:
                worker.stop()
        if not server.started:
            raise InputError(f"port {settings.port} of {settings.host} cannot be used; give another with --port")


def _is_new(store: str | Path) -> bool:
    """Whether a history is made: a file that is not there yet; an older one is migrated by a person only."""
    return "://" not in str(store) and not Path(store).exists()


class _Worker:
    """The process that does what takes long; it is started again when it dies."""

    def __init__(self, settings: Settings) -> None:
        self._command = [sys.executable, "-m", "elastogeo", "history", "work", "--store", str(settings.store), "--attached"]
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
        return subprocess.Popen(self._command, stdin=subprocess.PIPE)
