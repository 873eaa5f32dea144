"""How fast the pages answer: `python benchmarks/web.py [MACHINES TESTS]`.

A history with so many machines of so many tests each (200 of 200) is served by the program itself, with its worker, and
asked from beside it as a browser asks: one connection, one page after another. Wanted are, of a hundred answers the slowest
but five: machine 100 ms, fleet 150 ms, either while an analysis runs 300 ms, a page that has not changed (304) 10 ms; a page
packed 60 kB at most.

Times are of the clock, so whoever else uses the cores is in them. Where the system tells it (Linux), two columns say how far
they are to be believed: `CPU`, what the server itself computes for an answer, and `others`, how many cores were kept busy
meanwhile by what is neither the server, nor its worker, nor this program. Nothing is asserted, but it stops where the worker
had nothing to do while the pages were asked beside it; that it got a core for it shows in the column `worker`, near 1.
"""

from __future__ import annotations

import gzip
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from http.client import HTTPConnection
from math import nan
from pathlib import Path
from statistics import median, quantiles
from urllib.parse import urlsplit

from full_history import SAMPLE, fill

from elastogeo.changes.records import DONE, RUNNING, WAITING
from elastogeo.history import History
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.store import Store, open_store

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.web.browsing import serving

SIZE = (200, 200)
TIMES = 100
PACKED = ("/", "/machines/1", "/machines/1/tests", "/alarms", "/events", "/instruments", "/audit", "/upload")
REAL = 4
"""Tests with their files, which are drawn, and which the worker analyses and draws over and over."""
ROUNDS = 30


@dataclass(frozen=True, slots=True)
class Served:
    """The program on a history: a connection to it, and the number of its process."""

    connection: HTTPConnection
    process: int

    def asked(self, path: str, etag: str = "") -> tuple[int, str, bytes, float]:
        """Status, ETag and body of one page, and how long it took [ms]."""
        began = time.perf_counter()
        sent = {"Accept-Encoding": "gzip"} | ({"If-None-Match": etag} if etag else {})
        self.connection.request("GET", path, headers=sent)
        answer = self.connection.getresponse()
        body = answer.read()
        took = 1000 * (time.perf_counter() - began)
        if answer.getheader("Content-Encoding") != "gzip":
            body = gzip.compress(body, 6)
        return answer.status, answer.getheader("ETag") or "", body, took


@contextmanager
def served(database: Path, log: Path) -> Iterator[Served]:
    """The program on a history, with its worker."""
    with serving(database, log) as site, closing(HTTPConnection(urlsplit(site.url).netloc, timeout=60)) as connection:
        yield Served(connection, site.process.pid)


def processor_time(process: int | None = None) -> float:
    """Seconds of the processors that a process has used, or all together; NaN where the system does not tell."""
    try:
        if process is None:
            user, nice, system, _, _, *rest = map(int, Path("/proc/stat").read_text().split("\n")[0].split()[1:9])
            return (user + nice + system + sum(rest)) / os.sysconf("SC_CLK_TCK")
        said = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        return (int(said[11]) + int(said[12])) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return nan


def children(process: int) -> list[int]:
    """The processes that a process has started; none where the system does not tell."""
    files = Path(f"/proc/{process}/task").glob("*/children")
    return [int(one) for file in files for one in file.read_text().split()]


def used(site: Served) -> tuple[float, float, float]:
    """Seconds of the processors: of the server, of its worker, of everything else but this program."""
    server = processor_time(site.process)
    worker = sum(map(processor_time, children(site.process)))
    return server, worker, processor_time() - server - worker - time.process_time()


def times(site: Served, paths: list[str], again: bool = False) -> str:
    """Half of all, all but the slowest twentieth, the slowest [ms]; with `again` of answers that nothing has changed."""
    took = []
    site.asked(paths[0])
    etags = {path: site.asked(path)[1] for path in dict.fromkeys(paths)} if again else {}
    began, before = time.perf_counter(), used(site)
    for path in paths:
        status, _, _, one = site.asked(path, etags.get(path, ""))
        if status != (304 if again else 200):
            raise SystemExit(f"{path} answered {status}")
        took.append(one)
    lasted = time.perf_counter() - began
    server, worker, others = (now - then for now, then in zip(used(site), before, strict=True))
    clock = median(took), quantiles(took, n=20)[-1], max(took)
    shown = *clock, 1000 * server / len(paths), worker / lasted, others / lasted
    return "".join(f"{one:>10.1f}" for one in shown)


def real_tests(database: Path, folder: Path) -> tuple[int, list[int]]:
    """Import tests with their files, and draw them: the key of their series, and theirs."""
    tests = []
    with History(database, who="benchmark") as history:
        history.add_machine("Analysed")
        for k in range(REAL):
            shutil.copytree(SAMPLE, folder / f"test {k}")
            file = folder / f"test {k}" / "test.toml"
            said = file.read_text(encoding="utf-8").split("\n[about]\n")[0]
            file.write_text(f'{said}\n[about]\ndate = "2025-01-{k + 1:02d}"\nremarks = "{k}"\n', encoding="utf-8")
            added = history.add(file.parent, machine="Analysed").imported
            assert added is not None
            tests.append(added.test)
            history.draw(added.test)
    return added.series, tests


def analysed_beside(site: Served, database: Path, real: tuple[int, list[int]], pages: dict[str, list[str]]) -> None:
    """Print the times of pages while the worker analyses tests again, and draws them; stop if it had nothing to do."""
    series, tests = real
    with History(database, who="benchmark") as history:
        keys = []
        for k in range(ROUNDS):
            keys.append(history.put_job("recompute", {"series": series, "round": k}))
            keys.append(history.put_job("draw", {"test": tests[k % REAL], "again": True, "round": k}))
        while history.job(keys[0]).state == WAITING:
            time.sleep(0.05)
        for name, paths in pages.items():
            print(f"{name + ', while tests are analysed':<40}{times(site, paths)}", flush=True)
        states = [history.job(key).state for key in keys]
        done, left = states.count(DONE), states.count(WAITING)
        if not left or RUNNING not in states or done + left + 1 != len(keys):
            raise SystemExit(f"the worker was not busy all the while: of {len(keys)} jobs {states}")
        print(f"the worker was busy all the while: {done} jobs done, 1 running, {left} waiting")
        for key in reversed(keys):
            history.cancel_job(key)


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
        real = real_tests(database, folder)
        pages = {
            "fleet": ["/"] * TIMES,
            "machine": [f"/machines/{k % machines + 1}" for k in range(TIMES)],
            "test": [f"/tests/{real[1][k % REAL]}" for k in range(TIMES)],
            "tests of a machine": [f"/machines/{k % machines + 1}/tests" for k in range(TIMES)],
            "alarms": ["/alarms"] * TIMES,
        }
        with served(database, folder / "serve.log") as site:
            heads = ("median", "95 %", "slowest", "CPU", "worker", "others")
            print(f"{f'{machines} machines of {tests} tests':<40}{''.join(f'{one:>10}' for one in heads)}")
            print(f"{'':<40}{'[ms]':>10}{'[ms]':>10}{'[ms]':>10}{'[ms]':>10}{'[cores]':>10}{'[cores]':>10}", flush=True)
            for name, paths in pages.items():
                print(f"{name:<40}{times(site, paths)}", flush=True)
            for name in ("fleet", "machine"):
                print(f"{name + ', unchanged (304)':<40}{times(site, pages[name], again=True)}", flush=True)
            analysed_beside(site, database, real, {name: pages[name] for name in ("fleet", "machine")})
            print("\npage packed [kB]")
            for path in (*PACKED, pages["test"][0]):
                status, _, body, _ = site.asked(path)
                print(f"{path:<40}{len(body) / 1000:>10.1f}{'' if status == 200 else f'   ({status})'}", flush=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
