"""A server of the pages and a worker that are killed again and again at random instants: `URL FOLDER KILLS SEED`.

One process loads everything and makes a server and a worker for each trial, so that a kill costs little. A client of its own
sends tests, some slowly, waits until they were looked at, confirms, and waits until they are in; it notes what was
acknowledged. At the end the server and the worker are left alive until every job is over; what is wrong is printed as JSON.
"""

from __future__ import annotations

import http.client
import json
import os
import random
import signal
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import uvicorn
from sqlalchemy import select

import elastogeo as eg
from elastogeo.history import History
from elastogeo.history.jobs import Worker
from elastogeo.history.parcels import staging, sweep_parcels
from elastogeo.history.store import read
from elastogeo.history.store.schema import analysis, job, test
from elastogeo.web import Settings, application
from tests.history.intake.small_tests import write_test
from tests.history.parcels.archives import packed
from tests.web.browsing import free_port

HEADERS = {"Accept": "application/json", "Content-Type": "application/zip"}
FORM = {"Accept": "application/json", "Content-Type": "application/x-www-form-urlencoded"}
MACHINE = "Mill 3"
STILL = 60.0
"""Seconds in which nothing changes, after which nothing will."""


class Client:
    """Sends parcels and follows them; notes what was acknowledged to it."""

    def __init__(self, port: int, parcels: list[bytes]) -> None:
        self.port, self.parcels = port, parcels
        self.next = 0
        self.looks: dict[int, int] = {}
        self.imports: dict[int, int] = {}
        self.broken = 0
        self.over = threading.Event()

    def run(self) -> None:
        """Until the server answers no more, or it is asked to end."""
        with suppress(OSError, http.client.HTTPException, ValueError):
            while not self.over.is_set():
                for parcel, look in list(self.looks.items()):
                    if parcel not in self.imports:
                        self.confirm(parcel, look)
                if self.next < len(self.parcels):
                    self.send(self.next)
                else:
                    time.sleep(0.05)

    def send(self, parcel: int) -> None:
        """Send a parcel, every third one slowly; only an answer is an acknowledgement."""
        data = self.parcels[parcel]
        try:
            found = self._ask("POST", f"/upload?name={parcel}.zip", self._slowly(data) if parcel % 3 == 2 else data, HEADERS)
        except (OSError, http.client.HTTPException):
            self.broken += 1
            raise
        self.looks[parcel] = found["job"]
        self.next += 1

    def confirm(self, parcel: int, look: int) -> None:
        """Wait until a parcel was looked at, and confirm it."""
        while not self.over.is_set():
            found = self._ask("GET", f"/jobs/{look}.json")
            if found["state"] in ("done", "failed"):
                break
            time.sleep(0.02)
        if found["state"] == "done":
            form = f"serial=&machine={MACHINE.replace(' ', '+')}&named=&date="
            self.imports[parcel] = self._ask("POST", f"/jobs/{look}/import", form.encode(), FORM)["job"]

    def _slowly(self, data: bytes) -> Iterator[bytes]:
        for at in range(0, len(data), 1 + len(data) // 8):
            yield data[at : at + 1 + len(data) // 8]
            time.sleep(0.05)

    def _ask(self, method: str, path: str, body: Any = None, headers: Any = {}) -> Any:  # noqa: B006
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        try:
            connection.request(method, path, body, headers, encode_chunked=False)
            answer = connection.getresponse()
            text = answer.read()
            if answer.status != 200:
                raise AssertionError(f"{method} {path}: {answer.status} {text[:300]!r}")
            return json.loads(text)
        finally:
            connection.close()


def tests_of(parcel: int) -> int:
    """How many tests a parcel holds."""
    return 1 + parcel % 2


def forked(work: Callable[[], object]) -> int:
    """A child that does some work, and ends; its number."""
    pid = os.fork()
    if pid:
        return pid
    try:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        work()
    except BaseException as error:  # noqa: BLE001 - a child must not go on as its parent
        os.write(2, f"{error!r}\n".encode())
        os._exit(1)
    os._exit(0)


def alive(port: int) -> None:
    """Wait until the server answers."""
    for _ in range(400):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
        try:
            connection.request("GET", "/health")
            connection.getresponse().read()
        except OSError:
            time.sleep(0.02)
        else:
            return
        finally:
            connection.close()
    raise AssertionError("the server does not answer")


def trial(history: History, app: Any, client: Client, during: Callable[[], None], kills: list[int]) -> None:
    """Start a server and a worker, let the client work, do something meanwhile, and kill both, in this order."""
    history.resume_jobs()  # as `elastogeo serve` does
    history.close()  # no connection goes into a child

    def serve() -> None:
        uvicorn.Server(uvicorn.Config(app, port=client.port, log_level="critical")).run()

    pids = [forked(serve), forked(lambda: Worker(history.store, tidy=sweep_parcels).run())]
    try:
        alive(client.port)
        client.over.clear()
        thread = threading.Thread(target=client.run)
        thread.start()
        during()
    finally:
        for which in kills:
            os.kill(pids[which], signal.SIGKILL)
            time.sleep(0.01)
        for pid in pids:
            os.waitpid(pid, 0)
    client.over.set()
    thread.join()


def states(history: History) -> dict[int, tuple[str, str, str]]:
    """Of every job its kind, state and error."""
    with read(history.store) as connection:
        return {row.id: (row.kind, row.state, row.error) for row in connection.execute(select(job))}


def faults(history: History, client: Client) -> list[str]:
    """What is lost, double or damaged."""
    found = states(history)
    wrong = [f"job {key}: {said}" for key, said in found.items() if said[1] != "done"]
    wrong += [f"lost look {key}" for key in client.looks.values() if found.get(key, ("",))[0] != "look"]
    wrong += [f"lost import {key}" for key in client.imports.values() if found.get(key, ("",))[0] != "import"]
    if len(client.imports) != len(client.parcels):
        wrong.append(f"{len(client.imports)} of {len(client.parcels)} parcels were confirmed")
    with read(history.store) as connection:
        tests = connection.execute(select(test.c.id)).scalars().all()
        analysed = Counter(connection.execute(select(analysis.c.test)).scalars())
        parcels = Counter(
            one["parcel"] for one in connection.execute(select(job.c.asked).where(job.c.kind == "import")).scalars()
        )
    sent = sum(map(tests_of, range(len(client.parcels))))
    if len(tests) != sent:
        wrong.append(f"{len(tests)} tests of {sent}")
    wrong += [f"test {key} was analysed {analysed[key]} times" for key in tests if analysed[key] != 1]
    wrong += [f"parcel {name} was imported by {count} jobs" for name, count in parcels.items() if count > 1]
    for n, key in client.imports.items():
        result = history.job(key).result or {}
        if (
            len(result.get("tests", [])) != tests_of(n)
            or result.get("errors")
            or not all(one["new"] for one in result["tests"])
        ):
            wrong.append(f"import {key} says {result}")
    verified = history.verify()
    wrong += [f"verify: {check.name}" for check in verified.verdict if check.passed is not True]
    staging._BROKEN_OFF = staging._OLD = 0.0
    sweep_parcels(history.store)
    wrong += [f"left over: {path.name}" for path in (history.store.files.folder / "parcels").iterdir()]
    return wrong


def load(place: Path, parcel: Path) -> None:
    """Import what an import needs, so that no child has to."""
    with eg.History(place / "other.db", create=True, who="A. Nobody") as other:
        other.add_machine(MACHINE)
        assert other.add(parcel, machine=MACHINE).imported is not None
        application(Settings(other.store.url, who="A. Nobody"), other.store)


def main() -> None:
    url, place, kills, seed = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    draw = random.Random(seed)
    parcels = []
    for n in range(kills):
        for k in range(tests_of(n)):
            write_test(place / str(n) / str(k), date="2025-03-01", seed=2 * n + k)
        files = sorted(path for path in (place / str(n)).rglob("*") if path.is_file())
        parcels.append(packed([(path.relative_to(place / str(n)).as_posix(), path.read_bytes()) for path in files]))
    load(place, place / "0" / "0")
    with eg.History(url, who="A. Nobody") as history:
        history.add_machine(MACHINE)
        app = application(Settings(url, who="A. Nobody"), history.store)
        client = Client(free_port(), parcels)
        for _ in range(kills):
            delay = draw.uniform(0.0, 0.8)
            trial(history, app, client, lambda delay=delay: time.sleep(delay), draw.choice([[0, 1], [1, 0]]))
        at_the_end = len(client.imports)

        def until_over() -> None:
            found, until = None, 0.0
            while True:
                before, found = found, (states(history), len(client.imports))
                over = all(state not in ("waiting", "running") for _, state, _ in found[0].values())
                if (over and found[1] == len(parcels)) or (found == before and time.monotonic() > until):
                    return
                until = until if found == before else time.monotonic() + STILL
                time.sleep(0.1)

        trial(history, app, client, until_over, [0, 1])
        told = {"wrong": faults(history, client), "broken": client.broken, "confirmed_before": at_the_end}
        print(json.dumps({**told, "looks": len(client.looks), "jobs": len(states(history))}))


if __name__ == "__main__":
    main()
