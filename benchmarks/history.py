"""Time of what people wait for in a history: `python benchmarks/history.py [MACHINES TESTS] [truncate wal postgresql]`.

A history with so many machines of so many tests each (200 of 200), on every database: importing one test beside its
analysis, one machine's series with its verdict, the state of the fleet. Wanted are 100, 30 and 30 ms. Times are medians
over fifteen machines: of this process's processor, and of the clock in brackets, which holds what the disk takes, the server
of PostgreSQL and whoever else uses the cores. It is no test: nothing is asserted.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter, process_time

from full_history import APART, BEGAN, DATABASES, SAMPLE, full_history
from sqlalchemy import func, select, text

from elastogeo.history.alarms.assessing import assess
from elastogeo.history.alarms.judging import judged
from elastogeo.history.alarms.states import fleet
from elastogeo.history.intake.imports import import_test
from elastogeo.history.series_of import series_of
from elastogeo.history.store import Store, now, read, schema

SIZE = (200, 200)
TIMES = 15


Times = list[tuple[float, float]]
"""Of the processor and of the clock [s]."""


def imported(store: Store, machines: int, tests: int) -> Times:
    """Import of one new test of the sample's recipe, its files included."""
    took = []
    with tempfile.TemporaryDirectory() as folder:
        for k in range(TIMES):
            test = Path(folder) / f"test {k}"
            shutil.copytree(SAMPLE, test)
            file = test / "test.toml"
            at = BEGAN + tests * APART
            said = file.read_text(encoding="utf-8").split("\n[about]\n")
            about = f'date = "{at:%Y-%m-%d}"\nremarks = "{k} {at}"\n'
            file.write_text(f"{said[0]}\n[about]\n{about}", encoding="utf-8")
            began, clock = process_time(), perf_counter()
            found = import_test(store, test, machine=f"Mill {k % machines + 1}", who="benchmark")
            took.append((process_time() - began, perf_counter() - clock))
            if not found.new or found.new_series:
                raise SystemExit(f"test {k} was not new in a series that is there: {found}")
    return took


def timed(what: Callable[[int], object], machines: int) -> Times:
    """What is done for one machine after another."""
    took = []
    for k in range(TIMES):
        began, clock = process_time(), perf_counter()
        what(k * machines // TIMES + 1)
        took.append((process_time() - began, perf_counter() - clock))
    return took


def measured(database: str, machines: int, tests: int) -> str:
    """One line of the table."""
    with full_history(database, machines, tests) as store:
        for series in range(1, machines + 1):
            assess(store, series)

        def one_series(key: int) -> None:
            with read(store) as connection:
                series_of(connection, key)

        def verdict(key: int) -> None:
            with read(store) as connection:
                judged(connection, key, now())

        def machines_now(_: int) -> None:
            with read(store) as connection:
                fleet(connection, now())

        columns = (
            imported(store, machines, tests),
            timed(one_series, machines),
            timed(verdict, machines),
            timed(lambda key: assess(store, key), machines),
            timed(machines_now, machines),
        )
        with read(store) as connection:
            count = connection.execute(select(func.count()).select_from(schema.test)).scalar_one()
            mode = "" if database == "postgresql" else connection.execute(text("PRAGMA journal_mode")).scalar_one()
        size = sum(file.stat().st_size for file in store.files.folder.parent.rglob("*") if file.is_file()) / 1e6
    cells = "".join(f"{_cell(column):>18}" for column in columns)
    return f"{mode or database:>12}{count:>9}{cells}{size:>9.0f}"


def _cell(column: Times) -> str:
    processor, clock = (1000 * median(times) for times in zip(*column, strict=True))
    return f"{processor:.1f} ({clock:.1f})"


def main() -> None:
    """Print the table."""
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    machines, tests = numbers or SIZE
    heads = ("import", "series", "with verdict", "assess", "fleet")
    print(f"{'':>12}{'tests':>9}{''.join(f'{head:>18}' for head in heads)}{'MB':>9}   [ms of the processor (of the clock)]")
    for database in [word for word in sys.argv[1:] if not word.isdigit()] or DATABASES:
        print(measured(database, machines, tests), flush=True)


if __name__ == "__main__":
    main()
