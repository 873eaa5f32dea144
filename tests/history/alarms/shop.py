"""A shop in the store: machines with series and tests, written as rows, and alarms by hand."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime, timedelta

from sqlalchemy import Connection, insert, select

from elastogeo.history.store import Store, write
from elastogeo.history.store.schema import (
    alarm_step,
    analysis,
    baseline,
    indicator,
    instrument,
    machine,
    outbox,
    recipient,
    series,
    test,
)

START = datetime(2026, 3, 2, 8, 0, tzinfo=UTC)
SOFTWARE = "1"
DAY = timedelta(days=1)


def key_of(connection: Connection, table: object, **values: object) -> int:
    key = connection.execute(insert(table).values(**values)).inserted_primary_key  # type: ignore[arg-type]
    assert key is not None
    return int(key[0])


def make_series(store: Store, name: str = "C50 no. 3", interval: float | None = None) -> int:
    """A machine with one series; the key of the series."""
    with write(store) as connection:
        own = key_of(connection, machine, name=name, made_at=START)
        values = {"name": "XY 200", "recipe": {"of": name}, "recipe_sha256": name, "software": SOFTWARE}
        return key_of(connection, series, machine=own, interval_days=interval, **values)


def make_instrument(store: Store, serial: str = "LB-1") -> int:
    with write(store) as connection:
        return key_of(connection, instrument, serial=serial, kind="loaded-ball-bar", made_at=START)


def make_test(
    store: Store,
    of: int,
    at: datetime,
    values: Mapping[str, tuple[str, float]],
    imported: datetime | None = None,
    by: int | None = None,
    repeats: int | None = None,
) -> int:
    """A simulated test with its analysis: by indicator its kind and value."""
    with write(store) as connection:
        count = len(connection.execute(select(test.c.id)).all())
        own = key_of(
            connection,
            test,
            series=of,
            sha256=f"{count:064x}",
            name=f"test {count}",
            at=at,
            imported_at=at if imported is None else imported,
            origin="simulated",
            from_what="numbers",
            instrument=by,
            repeats=repeats,
            about={},
        )
        made = key_of(
            connection,
            analysis,
            test=own,
            software=SOFTWARE,
            settings={},
            inputs_sha256=f"{count:064x}",
            made_at=at,
            supported=True,
        )
        for name, (kind, value) in values.items():
            key_of(connection, indicator, analysis=made, name=name, kind=kind, value=value, standard_uncertainty=None)
        return own


def set_baseline(store: Store, of: int, tests: list[int], since: datetime, at: datetime | None = None) -> None:
    with write(store) as connection:
        key_of(connection, baseline, series=of, tests=tests, since=since, set_at=at or since, who="A. Miller", why="new")


def add_log(store: Store, address: str = "logging", digest: bool = False, by: str = "log") -> int:
    with write(store) as connection:
        return key_of(connection, recipient, channel=by, address=address, digest=digest, active=True)


def messages(store: Store) -> list[tuple[str, str, int]]:
    """State, subject and recipient of all messages, oldest first."""
    with write(store) as connection:
        rows = connection.execute(select(outbox).order_by(outbox.c.id)).all()
    return [(row.state, row.content["subject"], row.recipient) for row in rows]


def steps(store: Store) -> list[tuple[int, str]]:
    """Alarm and state of all steps, oldest first."""
    with write(store) as connection:
        rows = connection.execute(select(alarm_step.c.alarm, alarm_step.c.state).order_by(alarm_step.c.id))
        return [(row.alarm, row.state) for row in rows]
