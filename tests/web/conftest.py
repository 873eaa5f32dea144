"""A small fleet, made once and kept while its program does not change; a server on it; a browser that is watched.

`site` serves the fleet for every test that only looks; a test that acts takes `own_site`, a copy of its own. `screen` is
a page of Chromium at `site`, `screens` makes others. At the end of a test its pages must have said no error and asked no
other host.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from filelock import FileLock

import elastogeo
from tests.linuxcnc.unpacked import cache_folder
from tests.web.browsing import Site, Watched, chromium_or_skip, faults_of, serving
from tests.web.fleets import DATABASE, make_fleet

DESKTOP = {"width": 1400, "height": 900}
PHONE = {"width": 390, "height": 844}
KEPT = 2 * 86400
"""Seconds after which a fleet that was made may go."""

Serve = Callable[..., Site]
Screens = Callable[..., Watched]


@pytest.fixture(scope="session")
def made_fleet() -> Path:
    """The folder of the fleet; nobody may change it. Made anew each day and whenever what it is made by changes."""
    kept = cache_folder() / "fleets"
    kept.mkdir(parents=True, exist_ok=True)
    folder = kept / _state()
    with FileLock(kept / "fleets.lock"):
        if not folder.is_dir():
            for old in kept.iterdir():
                if old.is_dir() and time.time() - old.stat().st_mtime > KEPT:
                    shutil.rmtree(old)
            with TemporaryDirectory(dir=kept, prefix="new-") as new:
                make_fleet(Path(new) / "fleet")
                (Path(new) / "fleet").rename(folder)
    return folder


def _state() -> str:
    """The day, and the hash of what the fleet is made by: all below `report`, and the wings that keep tests."""
    digest = hashlib.sha256(f"{datetime.now(UTC):%Y-%m-%d}".encode())
    source = Path(elastogeo.__file__).parent
    wings = [source / "history" / name for name in ("store", "intake", "analyses", "fleets", "requirements")]
    rooms = [
        path
        for path in source.iterdir()
        if path.is_dir() and path.name not in ("cli", "web", "recording", "history", "report")
    ]
    files = [path for folder in (*rooms, *wings) for path in folder.rglob("*.py")]
    for path in (*sorted(files), Path(__file__).with_name("fleets.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def copy_of(made: Path, folder: Path) -> Path:
    """The database of a copy of the fleet, in a folder that is not there yet."""
    shutil.copytree(made, folder)
    return folder / DATABASE


@pytest.fixture
def fleet(made_fleet: Path, tmp_path: Path) -> Path:
    """The database of a fleet of one's own."""
    return copy_of(made_fleet, tmp_path / "fleet")


@pytest.fixture(scope="session")
def site(made_fleet: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """The fleet, served for all tests that only look at it."""
    folder = tmp_path_factory.mktemp("site")
    with serving(copy_of(made_fleet, folder / "fleet"), folder / "serve.log") as found:
        found.get("/tests/8")  # so that there is a job
        yield found


@pytest.fixture
def serve(tmp_path: Path) -> Iterator[Serve]:
    """`serve(database, "--option", ...)`: a server of one's own."""
    with ExitStack() as running:

        def start(database: Path, *options: str, **how: Any) -> Site:
            return running.enter_context(serving(database, tmp_path / "serve.log", *options, **how))

        yield start


@pytest.fixture
def own_site(fleet: Path, serve: Serve) -> Site:
    """The fleet, served for one test that changes it."""
    return serve(fleet)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium without a window. It ends with its file: as long as it runs, so does a loop in which no other can begin."""
    program = chromium_or_skip()
    playwright = pytest.importorskip("playwright.sync_api", reason="the pages in a browser, for playwright is not there")
    with playwright.sync_playwright() as found:
        options = ["--no-sandbox"] if os.name == "posix" and os.geteuid() == 0 else []
        chromium = found.chromium.launch(
            executable_path=program, args=[*options, "--disable-dev-shm-usage", "--disable-gpu", "--no-proxy-server"]
        )
        yield chromium
        chromium.close()


@pytest.fixture
def screens(browser: Any) -> Iterator[Screens]:
    """`screens(url, width=..., color_scheme="dark", ...)`: a watched page in a browser that knows nothing of the others."""
    with ExitStack() as opened:
        pages: list[Watched] = []

        def open_one(url: str, **how: Any) -> Watched:
            context = browser.new_context(**{"viewport": DESKTOP, "reduced_motion": "reduce", "locale": "en-GB", **how})
            context.set_default_timeout(30_000)
            opened.callback(context.close)
            pages.append(Watched(context.new_page(), url))
            return pages[-1]

        yield open_one
    assert faults_of(pages) == []


@pytest.fixture
def screen(site: Site, screens: Screens) -> Watched:
    """A page of the fleet that all look at."""
    return screens(site.url)


@pytest.fixture
def own_screen(own_site: Site, screens: Screens) -> Watched:
    """A page of a fleet of one's own, to act on."""
    return screens(own_site.url)
