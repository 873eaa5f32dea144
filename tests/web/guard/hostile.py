"""A fleet in which every text that anybody may write is an attack."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, select, update

import elastogeo as eg
from elastogeo.history.analyses.drawings import draw
from elastogeo.history.store import write
from elastogeo.history.store.columns import Document, Packed
from elastogeo.history.store.frozen import thaw
from elastogeo.history.store.schema import analysis, metadata
from tests.history.intake.small_tests import write_test

ATTACK = "=1+cmd|' /C calc'!A0\"'></textarea></title></script><img src=x onerror=alert(1)><script>alert(2)</script>{{7*7}}zq"
"""A formula, the end of an attribute, of a title and of a script, an image, a script, a template."""
NAMES = {
    "machine": ("name", "serial", "place"),
    "instrument": ("serial",),
    "series": ("name",),
    "test": ("name", "from_what", "who"),
    "campaign": ("name",),
    "plan": ("name",),
    "event": ("note", "who"),
    "baseline": ("who", "why"),
    "silence": ("who", "why"),
    "alarm_step": ("who", "why"),
    "tolerance": ("who", "why"),
    "set_aside": ("who", "why"),
    "audit": ("who", "why"),
    "recipient": ("address",),
    "calibration": ("certificate", "who"),
    "job": ("step", "error", "who"),
    "outbox": ("error",),
}
"""By table, what a person or a file says in it."""


def hostile(database: Path, work: Path) -> int:
    """Make a fleet hostile: first what persons and files say, through the doors, then all names that there are.

    Returns
    -------
    int
        The key of a hostile test that is drawn.
    """
    with eg.History(database, who=ATTACK) as history:
        machine = f"{ATTACK} 9"
        history.add_machine(machine, serial="H-9", place=ATTACK)
        added = history.add(_test(work), machine=machine)
        assert added.imported is not None
        history.add_event("repair", ATTACK, machine=machine)
        history.add_instrument(f"{ATTACK} 2", certificate=ATTACK, calibrated="2026-01-01")
        first = history.alarms().alarms[0].number
        history.acknowledge(first, ATTACK)
        history.silence(machine, datetime.now(UTC) + timedelta(days=2), ATTACK)
        test = added.imported.test
        draw(history.store, test)
        history.set_aside(1, ATTACK)
        history.put_job("look", {"parcel": "0" * 32})
        with write(history.store) as connection:
            thaw(connection)
            _rename(connection)
    return test


def _test(folder: Path) -> Path:
    """A small test that says so everywhere, its run files too."""
    said = ATTACK.replace("\\", "").replace('"', "'")
    place = write_test(folder / "hostile", name=said, operator=said, instrument_serial=f"{said} 3", remarks=said, place=said)
    text = (place / "test.toml").read_text(encoding="utf-8")
    for run in list((place / "runs").iterdir()):
        name = f"<img src=x onerror=alert(3)>{run.name}"
        run.rename(run.with_name(name))
        text = text.replace(f"runs/{run.name}", f"runs/{name}")
    (place / "test.toml").write_text(text, encoding="utf-8")
    return place


def _rename(connection: Connection) -> None:
    """Every name an attack, in the columns and in the documents that were made of them."""
    names: dict[str, str] = {}
    for name, columns in NAMES.items():
        table = metadata.tables[name]
        key = next(iter(table.primary_key.columns))
        for column in columns:
            for row in connection.execute(select(key, table.c[column])).all():
                if row[1] and ATTACK not in row[1]:
                    names[row[1]] = f"{ATTACK} {row[1]}"
                    connection.execute(update(table).where(key == row[0]).values({column: names[row[1]]}))
    names = {old: new for old, new in names.items() if len(old) > 3}
    for table in metadata.sorted_tables:
        key = next(iter(table.primary_key.columns))
        for column in table.columns:
            if isinstance(column.type, Document | Packed) and column.name not in ("recipe", "settings", "signatures"):
                for row in connection.execute(select(key, column)).all():
                    said = _renamed(row[1], names)
                    if said != row[1]:
                        connection.execute(update(table).where(key == row[0]).values({column.name: said}))
    assert connection.execute(select(analysis.c.id)).first()


def _renamed(value: Any, names: dict[str, str]) -> Any:
    if isinstance(value, dict):
        return {name: _renamed(one, names) for name, one in value.items()}
    if isinstance(value, list):
        return [_renamed(one, names) for one in value]
    return names.get(value, value) if isinstance(value, str) else value
