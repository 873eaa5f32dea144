"""A test comes in: its files are kept under their hashes, then one transaction says which machine, recipe and day it is of.

The same test a second time changes nothing, whatever its folder is called now; so two programs that import one folder at
once make one test. Files are kept before the database names them: a crash between leaves files that nothing names, no more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from sqlalchemy import Connection, func, insert, select, update

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import TestWithFiles, read_with_files
from elastogeo.history.intake.days import Day, day_of
from elastogeo.history.intake.instruments import instrument_of, overdue
from elastogeo.history.intake.machines import KnownMachine, machine_named, machine_of
from elastogeo.history.intake.recipes import Recipe, alike, differing, origin_of, recipe_of
from elastogeo.history.intake.repeats import WasSuspect, repeated_by
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import baseline, blob, machine, series, set_aside, test, test_file
from elastogeo.machine import About
from elastogeo.observe import MachineTest
from elastogeo.version import VERSION

FEW = 1
"""Settings, at most, by which a new series differs from one of the machine for a person to be told: it may be a slip."""


@dataclass(frozen=True, slots=True)
class Imported:
    """What became of a test that came in.

    Attributes
    ----------
    test, series : int
        Their keys.
    machine, name, series_name : str
    at : datetime
        When it was measured.
    new : bool
        False if the history had it already: nothing was changed.
    new_series : bool
        Whether it is the first of its recipe on this machine.
    repeats : int or None
        The suspect test that it repeats.
    notes : tuple of str
        What a person should know of it, as sentences.
    """

    test: int
    series: int
    machine: str
    name: str
    series_name: str
    at: datetime
    new: bool
    new_series: bool = False
    repeats: int | None = None
    notes: tuple[str, ...] = field(default=())


def import_test(
    store: Store,
    path: str | Path | TestWithFiles,
    *,
    machine: str | None = None,
    who: str,
    repeats: str | int | None = None,
    date: str = "",
    undated: str = "",
    instrument: str = "",
    source: str = "",
    was_suspect: WasSuspect | None = None,
) -> Imported:
    """Import one test.

    Parameters
    ----------
    store : Store
    path : str, Path or TestWithFiles
        A folder with a `test.toml` or `drive.toml`, such a file, or a test that was read so.
    machine : str, optional
        Name of the machine; without it the test must say its serial number.
    who : str
        Who imports it.
    repeats : str or int, optional
        The test that this one repeats: its key, `last`, or `none`; without it, it is found where the series waits for one.
    date : str
        When it was measured, if the test does not say it.
    undated : str
        When it counts as measured if neither says it.
    instrument : str
        Serial number of the instrument, if the test does not say it: a campaign may.
    source : str
        Where it came from, as it is to be noted, if its path says nothing: that of an upload.
    was_suspect : callable, optional
        As of `repeated_by`.

    Raises
    ------
    FormatError
        If a file is not what it must be, or changes meanwhile.
    InputError
        If the test has no date or one that cannot be, the machine is not known or not said, the test is another machine's,
        or it repeats none that is there.
    StoreError
        If the history cannot be written; nothing of the test is in it then.
    """
    found = path if isinstance(path, TestWithFiles) else read_with_files(path)
    about = found.test.about
    if instrument and not about.instrument_serial:
        about = replace(about, instrument_serial=instrument)
    sha256 = found.sha256
    with read(store) as connection:
        known = _known(connection, sha256, machine, found)
        if known:
            return known
        day = _day(found, about, date, undated)
        machine_of(connection, machine, about.machine_serial.strip(), str(found.path))
    _keep(store, found)
    with write(store) as connection:
        known = _known(connection, sha256, machine, found)
        if known:
            return known
        of = machine_of(connection, machine, about.machine_serial.strip(), str(found.path))
        return _write(
            connection, found, about, sha256, day, of, who, source or str(found.path),
            lambda key, at: repeated_by(connection, key, at, repeats, was_suspect),
        )  # fmt: skip


def _known(connection: Connection, sha256: str, named: str | None, found: TestWithFiles) -> Imported | None:
    """The test if the history has it; refused if it is another machine's than the one that is named."""
    row = connection.execute(
        select(
            test.c.id,
            test.c.series,
            machine.c.name.label("machine"),
            machine.c.id.label("machine_key"),
            test.c.name,
            series.c.name.label("series_name"),
            test.c.at,
            test.c.repeats,
        )
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
        .where(test.c.sha256 == sha256)
    ).one_or_none()
    if row is None:
        return None
    if named is not None and machine_named(connection, named).key != row.machine_key:
        raise InputError(
            f"{found.path}: is in the history as test {row.id} of {row.machine!r}; if it is of {named!r}, set that one "
            f"aside, write machine_serial under [about] of this one, and import it again"
        )
    said = select(set_aside.c.aside, set_aside.c.who).where(set_aside.c.test == row.id).order_by(set_aside.c.id.desc())
    last = connection.execute(said.limit(1)).one_or_none()
    notes = (f"it was set aside by {last.who}",) if last and last.aside else ()
    return Imported(
        row.id, row.series, row.machine, row.name, row.series_name, row.at, False, repeats=row.repeats, notes=notes
    )


def _day(found: TestWithFiles, about: About, date: str, undated: str) -> Day:
    if about.date:
        said = day_of(about.date, f"{found.path}: date under [about]", now())
        if date and day_of(date, "--date", now()).at.date() != said.at.date():
            raise InputError(f"{found.path}: says that it was measured on {about.date}, not on {date}; leave --date out")
        return said
    if not (date or undated):
        raise InputError(
            f"{found.path}: does not say when it was measured; write date = 2026-03-01 under [about], or with time and zone "
            f"2026-03-01T14:30:00+01:00; or give the date where you import it (a watch takes --dates-of-files)"
        )
    return day_of(date or undated, "--date" if date else f"{found.path}: when its files were written", now())


def _keep(store: Store, found: TestWithFiles) -> None:
    """Keep the files, which must still be those that were read."""
    kept = store.files.put_all(place for place, _ in found.files.values())
    for sha256, (place, was) in zip(kept, found.files.values(), strict=True):
        if sha256 != was:
            raise FormatError(f"{place}: changed while it was imported; nothing was imported, do it again when it is whole")


def _write(
    connection: Connection,
    found: TestWithFiles,
    about: About,
    sha256: str,
    day: Day,
    of: KnownMachine,
    who: str,
    source: str,
    repeat: Callable[[int, datetime], tuple[int | None, bool]],
) -> Imported:
    """The rows of a test that is new."""
    read_test = found.test
    key, series_name, new_series, said = _series(connection, of, recipe_of(read_test), who)
    at = _after_those_of_the_day(connection, key, day)
    instrument, note = instrument_of(connection, about, _kind(found), (place for place, _ in found.files.values()), who)
    repeated, by_itself = repeat(key, at)
    row = {
        "series": key,
        "sha256": sha256,
        "name": read_test.name,
        "at": at,
        "zone": day.zone,
        "imported_at": now(),
        "origin": origin_of(read_test),
        "from_what": read_test.simulated or getattr(read_test, "reconstructed", ""),
        "temperature": _temperature(found, about),
        "instrument": instrument,
        "repeats": repeated,
        "who": about.operator,
        "about": {**about.said(), "imported_from": source},
    }
    number = connection.execute(insert(test).values(row).returning(test.c.id)).scalar_one()
    _name_files(connection, number, found)
    kept = {name: row[name] for name in ("sha256", "name", "series", "repeats")}
    audit.record(connection, who, "import", f"test {number}", new={**kept, "at": at.isoformat(), "from": source})
    notes = [said, note, *_remarks(connection, key, at, day, instrument, about)]
    if repeated is not None and by_itself:
        notes.append(
            f"test {repeated} was suspect, so this one counts as its repeat; if it is none, import it with --repeats none"
        )
    if not of.kind and isinstance(read_test, MachineTest):
        connection.execute(update(machine).where(machine.c.id == of.key).values(kind=read_test.machine.name))
    return Imported(
        number, key, of.name, read_test.name, series_name, at, True, new_series, repeated, tuple(filter(None, notes))
    )


def _series(connection: Connection, of: KnownMachine, recipe: Recipe, who: str) -> tuple[int, str, bool, str]:
    """The series of a recipe on a machine, made if it is new: its key and name, whether it is new, and a note."""
    exact = connection.execute(
        select(series.c.id, series.c.name).where(series.c.machine == of.key, series.c.recipe_sha256 == recipe.sha256)
    ).one_or_none()
    if exact:
        return exact.id, exact.name, False, ""
    others = connection.execute(
        select(series.c.id, series.c.name, series.c.recipe).where(series.c.machine == of.key).order_by(series.c.id)
    ).all()
    for other in others:
        if alike(other.recipe, recipe.document):
            return other.id, other.name, False, ""
    names = {other.name for other in others}
    name = next(one for one in _numbered(recipe.name) if one not in names)
    row = {"machine": of.key, "name": name, "recipe": dict(recipe.document), "recipe_sha256": recipe.sha256}
    key = connection.execute(insert(series).values(**row, software=VERSION).returning(series.c.id)).scalar_one()
    audit.record(connection, who, "add series", f"series {key}", new={"machine": of.name, "name": name})
    near = [(other.name, differing(other.recipe, recipe.document)) for other in others]
    close = [(other, where) for other, where in near if len(where) <= FEW]
    note = ""
    if close:
        other, where = close[0]
        note = f"it begins a new series: it differs from {other!r} in {', '.join(where)}"
    return key, name, True, note


def _numbered(name: str) -> Iterator[str]:
    yield name
    number = 2
    while True:
        yield f"{name} ({number})"
        number += 1


def _after_those_of_the_day(connection: Connection, key: int, day: Day) -> datetime:
    """A day without a time of day counts as after the tests of that day that are there already."""
    if not day.whole:
        return day.at
    morning = day.at - timedelta(hours=12)
    latest = connection.execute(
        select(func.max(test.c.at)).where(
            test.c.series == key, test.c.at >= morning, test.c.at < morning + timedelta(days=1)
        )
    ).scalar()
    return day.at if latest is None else max(day.at, latest)


def _name_files(connection: Connection, number: int, found: TestWithFiles) -> None:
    sizes = {sha256: place.stat().st_size for place, sha256 in found.files.values()}
    there = set(connection.execute(select(blob.c.sha256).where(blob.c.sha256.in_(sizes))).scalars())
    new = [{"sha256": sha256, "size": size, "made_at": now()} for sha256, size in sizes.items() if sha256 not in there]
    if new:
        connection.execute(insert(blob), new)
    named = [{"test": number, "path": path, "sha256": sha256} for path, (_, sha256) in found.files.items()]
    connection.execute(insert(test_file), named)


def _kind(found: TestWithFiles) -> str:
    return found.test.instrument if isinstance(found.test, MachineTest) else "feed-drives"


def _temperature(found: TestWithFiles, about: About) -> float | None:
    """Of the machine [degC]: as the test says it, else as its set-up or its runs do."""
    if about.temperature is not None or not isinstance(found.test, MachineTest):
        return about.temperature
    setup = found.test.setup
    body: Any = getattr(setup, setup.warm) if setup.warm else None
    if body is None:
        return None
    return float(np.mean([body.at(run.machine_temperature).temperature for run in found.test.runs]))


def _remarks(
    connection: Connection, key: int, at: datetime, day: Day, instrument: int | None, about: About
) -> Iterator[str]:
    """What a person should know: the order of days, calibrations that ran out, clocks."""
    since = connection.execute(
        select(baseline.c.since).where(baseline.c.series == key).order_by(baseline.c.id.desc()).limit(1)
    ).scalar()
    if since is not None and at < since:
        yield f"it was measured before the baseline begins ({since:%Y-%m-%d}), so it is kept and shown but not judged"
    if instrument is not None:
        due = overdue(connection, instrument, at)
        if due is not None:
            yield f"the calibration of instrument {about.instrument_serial} had run out on {due:%Y-%m-%d}"
    if not day.zone and not day.whole:
        yield "its time says no zone and counts as UTC"
    latest = connection.execute(select(test.c.imported_at).order_by(test.c.id.desc()).limit(1).offset(1)).scalar()
    if latest is not None and latest - now() > timedelta(hours=1):
        yield (
            f"the clock of this computer stands {_long(latest - now())} before the last import; set it, or new tests will "
            f"be refused as lying in the future"
        )


def _long(span: timedelta) -> str:
    return f"{span.days} days" if span.days > 1 else f"{span.total_seconds() / 3600:.0f} hours"
