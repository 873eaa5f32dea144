"""A program that imports tests and is killed again and again at random instants: `URL FOLDER KILLS SEED [whole]`.

One process loads everything and makes a child for each trial, so that a kill costs the import only. With `whole` a child
also analyses and judges. At the end it prints, as JSON, what was acknowledged, what is there, and what is wrong.
"""

import json
import os
import random
import signal
import sys
import time
from collections import Counter
from pathlib import Path

from sqlalchemy import select

import elastogeo as eg
from elastogeo.history.intake.imports import import_test
from elastogeo.history.store import audit, open_store, read
from elastogeo.history.store.schema import test, test_file
from tests.history.intake.small_tests import write_test

EACH = 2
"""Tests that a child is to import."""


def bring(url: str, folders: list[Path], whole: bool, tell) -> None:
    with eg.History(url, who="A. Nobody") as history:
        for folder in folders:
            if whole:
                key = history.add(folder, machine="Mill 3").imported.test
            else:
                key = import_test(history.store, folder, machine="Mill 3", who="A. Nobody").test
            tell(f"{key}\n".encode())


def child(url: str, folders: list[Path], whole: bool, delay: float | None) -> tuple[list[int], float]:
    """What a child that is killed after a while (None: never) acknowledged, and how long it took."""
    out, into = os.pipe()
    began = time.monotonic()
    pid = os.fork()
    if pid == 0:
        try:
            bring(url, folders, whole, lambda line: os.write(into, line))
        except BaseException as error:  # noqa: BLE001 - a child must not go on as its parent
            os.write(2, repr(error).encode())
            os._exit(1)
        os._exit(0)
    os.close(into)
    if delay is not None:
        time.sleep(delay)
        os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    with os.fdopen(out) as lines:
        return [int(line) for line in lines], time.monotonic() - began


def faults(url: str, acknowledged: list[int]) -> list[str]:
    """What is wrong with the history."""
    store = open_store(url)
    with read(store) as connection:
        wrong = [f"audit {finding}" for finding in audit.verify(connection)]
        keys = set(connection.execute(select(test.c.id)).scalars())
        files = connection.execute(select(test_file.c.test, test_file.c.sha256)).all()
    wrong += [f"lost test {key}" for key in acknowledged if key not in keys]
    counts = Counter(row.test for row in files)
    wrong += [f"test {key} has {counts[key]} files" for key in keys if counts[key] != 3]
    for row in files:
        store.files.read(row.sha256)
    store.close()
    return wrong


def load(place: Path, folder: Path, whole: bool) -> None:
    """Import what an import needs, so that no child has to."""
    url = str(place / "other.db")
    with eg.History(url, create=True, who="A. Nobody") as other:
        other.add_machine("Mill 3")
    bring(url, [folder], whole, lambda _: None)


def main() -> None:
    url, place, kills, seed = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    whole, draw = "whole" in sys.argv, random.Random(seed)
    numbers = [[EACH * k + j for j in range(EACH)] for k in range(kills + 1)]
    pairs = [[write_test(place / str(n), date="2025-03-01", seed=n) for n in pair] for pair in numbers]
    load(place, pairs[0][0], whole)
    acknowledged, longest = child(url, pairs[0], whole, None)
    wrong: list[str] = []
    for pair in pairs[1:]:
        acknowledged += child(url, pair, whole, draw.uniform(0.0, 1.5 * longest))[0]
        wrong += faults(url, acknowledged)
    again = child(url, [folder for pair in pairs for folder in pair], whole, None)[0]
    wrong += faults(url, acknowledged)
    print(json.dumps({"acknowledged": acknowledged, "again": again, "wrong": wrong}))


if __name__ == "__main__":
    main()
