"""How fast the pages answer: `python benchmarks/web.py [MACHINES TESTS]`.

A history with so many machines of so many tests each (200 of 200) is served by the program itself, with its worker, and
asked from beside it as a browser asks: one connection, one page after another. Wanted are, of a hundred answers the slowest
but five: machine 100 ms, fleet 150 ms, either while an analysis runs 300 ms, a page that has not changed (304) 10 ms; a page
packed 60 kB at most. Times are of the clock, so whoever else uses the cores is in them: look at the median too. Nothing is
asserted.
"""

from __future__ import annotations

import gzip
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from statistics import median, quantiles

from full_history import SAMPLE, fill

from elastogeo.history import History
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.store import Store, open_store

SIZE = (200, 200)
TIMES = 100
PACKED = ("/", "/machines/1", "/machines/1/tests", "/tests/1", "/alarms", "/events", "/instruments", "/audit", "/upload")
HOST = "127.0.0.1"
READY = 60.0
"""Seconds in which the server must answer first."""


def asked(connection: HTTPConnection, path: str, etag: str = "") -> tuple[int, str, bytes, float]:
    """Status, ETag and body of one page, and how long it took [ms]."""
    began = time.perf_counter()
    connection.request("GET", path, headers={"Accept-Encoding": "gzip"} | ({"If-None-Match": etag} if etag else {}))
    answer = connection.getresponse()
    body = answer.read()
    took = 1000 * (time.perf_counter() - began)
    if answer.getheader("Content-Encoding") != "gzip":
        body = gzip.compress(body, 6)
    return answer.status, answer.getheader("ETag") or "", body, took


@contextmanager
def served(database: Path, log: Path) -> Iterator[HTTPConnection]:
    """The program on a history, with its worker, and a connection to it."""
    with socket.socket() as one:
        one.bind((HOST, 0))
        port = one.getsockname()[1]
    command = [sys.executable, "-m", "elastogeo", "serve", "--store", str(database), "--port", str(port)]
    with log.open("wb") as told:
        process = subprocess.Popen(command, stdout=told, stderr=subprocess.STDOUT)
    connection = HTTPConnection(HOST, port, timeout=60)
    try:
        until = time.monotonic() + READY
        while True:
            try:
                asked(connection, "/health")
                break
            except OSError:
                connection.close()
                if process.poll() is not None or time.monotonic() > until:
                    raise SystemExit(f"the server did not come up:\n{log.read_text()}") from None
                time.sleep(0.1)
        yield connection
    finally:
        connection.close()
        process.terminate()
        process.wait(20)


def times(connection: HTTPConnection, paths: list[str], again: bool = False) -> str:
    """Half of all, all but the slowest twentieth, the slowest [ms]; with `again` of answers that nothing has changed."""
    took = []
    for path in paths:
        status, etag, _, one = asked(connection, path)
        if again:
            status, _, _, one = asked(connection, path, etag)
        if status != (304 if again else 200):
            raise SystemExit(f"{path} answered {status}")
        took.append(one)
    return f"{median(took):>10.1f}{quantiles(took, n=20)[-1]:>10.1f}{max(took):>10.1f}"


def analysing(database: Path, tests: Path, count: int) -> None:
    """Give the worker analyses to do: so many tests of the sample, each on a day of its own, as uploads would."""
    with History(database, who="benchmark") as history:
        for k in range(count):
            folder = tests / f"test {k}"
            shutil.copytree(SAMPLE, folder)
            file = folder / "test.toml"
            said = file.read_text(encoding="utf-8").split("\n[about]\n")[0]
            file.write_text(f'{said}\n[about]\ndate = "2025-01-{k % 28 + 1:02d}"\nremarks = "{k}"\n', encoding="utf-8")
            history.put_job("import", {"path": str(folder), "machine": f"Mill {k + 1}"})


def filled(folder: Path, machines: int, tests: int) -> Store:
    """The history, every series of it judged."""
    store = open_store(str(folder / "history.db"), create=True, who="benchmark")
    fill(store, machines, tests)
    for series in range(1, machines + 1):
        assess(store, series)
    return store


def main() -> None:
    """Print the tables."""
    machines, tests = [int(word) for word in sys.argv[1:]] or SIZE
    folder = Path(tempfile.mkdtemp(prefix="elastogeo-benchmark-"))
    try:
        filled(folder, machines, tests).close()
        database = folder / "history.db"
        pages = {
            "fleet": ["/"] * TIMES,
            "machine": [f"/machines/{k % machines + 1}" for k in range(TIMES)],
            "test": [f"/tests/{k * machines * tests // TIMES + 1}" for k in range(TIMES)],
            "tests of a machine": [f"/machines/{k % machines + 1}/tests" for k in range(TIMES)],
            "alarms": ["/alarms"] * TIMES,
        }
        with served(database, folder / "serve.log") as connection:
            print(f"{machines} machines of {tests} tests{'median':>24}{'95 %':>10}{'slowest':>10}   [ms]")
            for name, paths in pages.items():
                asked(connection, paths[0])
                print(f"{name:<40}{times(connection, paths)}", flush=True)
            for name in ("fleet", "machine"):
                print(f"{name + ', unchanged (304)':<40}{times(connection, pages[name], again=True)}", flush=True)
            analysing(database, folder / "new", 60)
            for name in ("fleet", "machine"):
                print(f"{name + ', while tests are analysed':<40}{times(connection, pages[name])}", flush=True)
            print("\npage packed [kB]")
            for path in (
                "/",
                "/machines/1",
                "/machines/1/tests",
                "/tests/1",
                "/alarms",
                "/events",
                "/instruments",
                "/audit",
                "/upload",
            ):
                status, _, body, _ = asked(connection, path)
                print(f"{path:<40}{len(body) / 1000:>10.1f}{'' if status == 200 else f'   ({status})'}", flush=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
