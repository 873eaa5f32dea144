"""What a map or a plan of a machine rests on: its tests of the store, laid out again, and what they say of the machine."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, select

from elastogeo.errors import ElastogeoError, InputError, UnsupportedError
from elastogeo.formats import read_campaign, read_machine, read_test, shipped_machines
from elastogeo.history.analyses.kept_campaigns import beside, campaigns, kept_campaign
from elastogeo.history.analyses.raw import laid_out, raw_files
from elastogeo.history.series_of import days
from elastogeo.history.store import Store, read
from elastogeo.history.store.schema import analysis, campaign, machine, series, test
from elastogeo.history.store.schema import set_aside as aside
from elastogeo.machine import Machine
from elastogeo.observe import Campaign

IDENTIFIED = "identify"
"""The verb whose results tell compliances."""


@dataclass(frozen=True, slots=True)
class Basis:
    """Tests of a machine that were identified and support what was asked of them.

    Attributes
    ----------
    kind : str
        `campaign` or `test`.
    key : int
    name : str
    at : float [d]
        When the campaign was kept, or the test was measured.
    tests : int
        How many they are.
    """

    kind: str
    key: int
    name: str
    at: float
    tests: int


def bases(connection: Connection, of: int) -> tuple[Basis, ...]:
    """What is identified of a machine: its supported campaigns, the last first, then the last such test of each series."""
    kept = [kept_campaign(connection, key) for key in campaigns(connection, of)]
    sets = [Basis("campaign", one.key, one.name, one.made_at, len(one.tests)) for one in reversed(kept) if one.supported]
    rows = select(test.c.id, test.c.name, test.c.at, test.c.series, analysis.c.settings).join_from(
        test, analysis, analysis.c.test == test.c.id
    )
    asked = (
        rows.join(series, series.c.id == test.c.series)
        .where(series.c.machine == of, analysis.c.supported.is_(True), analysis.c.error.is_(None))
        .order_by(test.c.at.desc(), analysis.c.id.desc())
    )
    out = _set_aside(connection)
    found: dict[int, Basis] = {}
    for row in connection.execute(asked):
        if row.series not in found and row.id not in out and row.settings.get("verb") == IDENTIFIED:
            found[row.series] = Basis("test", row.id, row.name, days(row.at), 1)
    return (*sets, *found.values())


def _set_aside(connection: Connection) -> set[int]:
    """Keys of the tests that are set aside now."""
    last = {row.test: row.aside for row in connection.execute(select(aside.c.test, aside.c.aside).order_by(aside.c.id))}
    return {key for key, out in last.items() if out}


@contextmanager
def tests_of(store: Store, kind: str, key: int) -> Iterator[Campaign]:
    """The tests of a basis, read from their raw files.

    Raises
    ------
    InputError
        If there is no such test or campaign.
    StoreError
        If a raw file is missing or damaged.
    """
    if kind == "campaign":
        with read(store) as connection:
            content = _content(connection, key)
            raw = {folder: raw_files(connection, one) for folder, one in content["tests"].items()}
        with beside(store.files, content["campaign"], raw) as folder:
            yield read_campaign(folder)
        return
    with read(store) as connection:
        files = raw_files(connection, key)
    with laid_out(store.files, files) as folder:
        yield read_campaign(folder)


def _content(connection: Connection, key: int) -> dict[str, Any]:
    found = connection.execute(select(campaign.c.content).where(campaign.c.id == key)).scalar_one_or_none()
    if found is None:
        raise InputError(f"there is no campaign {key}")
    return dict(found)


@dataclass(frozen=True, slots=True)
class Definition:
    """A machine of the store, as a machine file describes it.

    Attributes
    ----------
    machine : Machine
    name : str
        Of a machine that ships with elastogeo; empty of one of a file.
    text : str
        Of that file.
    """

    machine: Machine
    name: str
    text: str = ""


def definition_of(store: Store, of: int) -> Definition:
    """A machine of the store: as its last test describes it, else the shipped one that its kind names.

    Raises
    ------
    InputError
        If neither says it.
    """
    with read(store) as connection:
        kind = connection.execute(select(machine.c.kind).where(machine.c.id == of)).scalar_one_or_none()
        if kind is None:
            raise InputError("there is no such machine")
        last = select(test.c.id).join(series, series.c.id == test.c.series).where(series.c.machine == of)
        keys = connection.execute(last.order_by(test.c.at.desc()).limit(1)).scalars().all()
        raw = [raw_files(connection, key) for key in keys]
    for files in raw:
        with laid_out(store.files, files) as folder:
            found = _defined_in(folder)
            if found is not None:
                return found
    if kind in shipped_machines():
        return Definition(read_machine(kind), kind)
    raise InputError(
        f"nothing describes this machine: it has no test yet, and its kind, {kind or 'which is not said'}, is none of "
        f"{', '.join(shipped_machines())}; import a test of it"
    )


def _defined_in(folder: Path) -> Definition | None:
    """The machine of a test that is laid out; None where it names none, or cannot be read."""
    import tomllib

    file = folder / "test.toml"
    if not file.is_file():
        return None
    try:
        named = str(tomllib.loads(file.read_text("utf-8-sig")).get("machine", ""))
        if named in shipped_machines():
            return Definition(read_machine(named), named)
        return Definition(read_test(folder).machine, "", (folder / named).read_text("utf-8-sig"))
    except (ElastogeoError, OSError, ValueError):
        return None


def map_basis(connection: Connection, of: int, kind: str = "", key: int = 0) -> Basis:
    """The basis that is asked for, or the first.

    Raises
    ------
    UnsupportedError
        If nothing is identified of the machine.
    InputError
        If there is no such basis.
    """
    found = bases(connection, of)
    if not found:
        raise UnsupportedError("nothing is identified of this machine yet, so there is nothing to map; plan and make tests")
    if not kind:
        return found[0]
    for one in found:
        if (one.kind, one.key) == (kind, key):
            return one
    raise InputError("this test or campaign is not identified, or of another machine; choose one that is listed")
