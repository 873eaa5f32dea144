"""A browser whose console and network are watched, a program that serves a history: what the tests of the pages share."""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.error import URLError
from urllib.parse import urlsplit
from urllib.request import ProxyHandler, build_opener

import pytest

from tests.linuxcnc.unpacked import alone, cache_folder, is_debian

PATIENCE = 120.0
"""Seconds in which a server must answer, on a computer that does much else."""
ABORTED = "net::ERR_ABORTED"
"""What the page itself gave up: a poll that a click overtook, an address that became a download."""
REFUSED = "Failed to load resource: the server responded with a status of "


def chromium_or_skip() -> str:
    """The path of Chromium; installed where that can be done, its absence a failure there, else the test is left out."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if found:
        return found
    if not (is_debian() and os.geteuid() == 0):
        pytest.skip("the pages in a browser, for there is no Chromium; install it (apt-get install chromium)")
    cache_folder().mkdir(parents=True, exist_ok=True)
    with alone(cache_folder() / "chromium.lock"):
        for command in (["update", "-q"], ["install", "-y", "-q", "--no-install-recommends", "chromium"]):
            if shutil.which("chromium"):
                break
            done = subprocess.run(["apt-get", *command], capture_output=True, text=True, check=False)
            said = done.stderr.strip()[-400:]
    found = shutil.which("chromium")
    if not found:
        pytest.fail(f"the pages are tested in Chromium, and apt-get install chromium failed: {said}")
    return found


@dataclass
class Watched:
    """A page of a browser, and what went wrong in it: errors of the console, failed requests, requests to other hosts.

    Attributes
    ----------
    page : playwright.sync_api.Page
    url : str
        Where the server is.
    faults : list of str
        They fail the test at its end.
    expected : tuple of int
        Answers that the test asks for, like 422 to a file that is none.
    """

    page: Any
    url: str
    faults: list[str] = field(default_factory=list)
    expected: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        self.page.on("console", self._said)
        self.page.on("pageerror", lambda error: self.faults.append(f"script: {error}"))
        self.page.on("request", self._asked)
        self.page.on("requestfailed", self._failed)
        self.page.on("response", self._answered)

    def go(self, path: str) -> Any:
        """Open an address of the server; the answer."""
        return self.page.goto(self.url + path)

    def _said(self, message: Any) -> None:
        awaited = any(message.text.startswith(f"{REFUSED}{code}") for code in self.expected)
        if message.type in ("error", "warning") and not awaited:
            self.faults.append(f"console: {message.text} ({message.location.get('url', '')})")

    def _asked(self, request: Any) -> None:
        if urlsplit(request.url).scheme in ("http", "https", "ws", "wss") and not request.url.startswith(f"{self.url}/"):
            self.faults.append(f"a request elsewhere: {request.url}")

    def _failed(self, request: Any) -> None:
        if request.failure != ABORTED:
            self.faults.append(f"request failed: {request.method} {request.url}: {request.failure}")

    def _answered(self, response: Any) -> None:
        if response.status >= 400 and response.status not in self.expected:
            self.faults.append(f"{response.status} for {response.request.method} {response.url}")


@dataclass
class Site:
    """A program that serves a history.

    Attributes
    ----------
    url : str
        Without a slash at its end.
    database : Path
    process : Popen
    """

    url: str
    database: Path
    process: subprocess.Popen[bytes]

    def get(self, path: str) -> bytes:
        """What it answers."""
        return read(self.url + path)


def read(url: str) -> bytes:
    """What a server of this computer answers, by no proxy."""
    with build_opener(ProxyHandler({})).open(url, timeout=PATIENCE) as answer:
        return answer.read()  # type: ignore[no-any-return]


def free_port() -> int:
    """A port that nobody listens at just now."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


@contextmanager
def serving(database: Path, log: Path, *options: str, given: str | None = None) -> Iterator[Site]:
    """Run `elastogeo serve` on a history, with its worker; ended when it is no longer needed."""
    port = free_port()
    command = [sys.executable, "-m", "elastogeo", "serve", "--store", str(database), "--port", str(port), *options]
    with log.open("wb") as told:
        process = subprocess.Popen(
            command, stdout=told, stderr=subprocess.STDOUT, env={**os.environ, "ELASTOGEO_WHO": "A. Miller"}
        )
        try:
            site = Site(given or f"http://127.0.0.1:{port}", database, process)
            _wait(site, log)
            yield site
        finally:
            end(process)


def end(process: subprocess.Popen[bytes]) -> None:
    """Ask a program to end, and see that it does."""
    process.terminate()
    try:
        process.wait(10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait(10)


def _wait(site: Site, log: Path) -> None:
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until:
        try:
            site.get("/health")
        except (URLError, OSError):
            if site.process.poll() is not None:
                break
            time.sleep(0.05)
        else:
            return
    raise AssertionError(f"elastogeo serve did not answer within {PATIENCE:g} s: {log.read_text(encoding='utf-8')[-2000:]}")


def faults_of(pages: Sequence[Watched]) -> list[str]:
    """What went wrong in any of them."""
    return [fault for page in pages for fault in page.faults]
