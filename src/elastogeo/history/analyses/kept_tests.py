"""One test of the store as its page wants it."""

from __future__ import annotations

from typing import Any

from sqlalchemy import Connection, Row, case, select

from elastogeo.changes import KeptAnalysis, KeptFile, KeptTest, SetAside
from elastogeo.errors import InputError
from elastogeo.history.series_of import baseline_tests, days
from elastogeo.history.store import Store, read
from elastogeo.history.store.schema import (
    analysis,
    blob,
    calibration,
    instrument,
    machine,
    series,
    set_aside,
    test,
    test_file,
)
from elastogeo.version import VERSION


def kept_test(connection: Connection, key: int) -> KeptTest:
    """What the store knows of a test.

    Raises
    ------
    InputError
        If there is no such test.
    """
    row = connection.execute(
        select(
            test,
            series.c.name.label("series_name"),
            series.c.software.label("counts_with"),
            machine.c.name.label("machine_name"),
            machine.c.id.label("machine_key"),
            instrument.c.serial,
        )
        .join(series, series.c.id == test.c.series)
        .join(machine, machine.c.id == series.c.machine)
        .outerjoin(instrument, instrument.c.id == test.c.instrument)
        .where(test.c.id == key)
    ).one_or_none()
    if row is None:
        raise InputError(f"there is no test {key}")
    held = _calibration(connection, row)
    earlier, later = _neighbours(connection, row)
    return KeptTest(
        key=key,
        name=row.name,
        machine=row.machine_name,
        series=row.series_name,
        machine_key=row.machine_key,
        series_key=row.series,
        at=days(row.at),
        imported_at=days(row.imported_at),
        zone=row.zone,
        origin=row.origin,
        from_what=row.from_what,
        temperature=row.temperature,
        instrument=row.serial or "",
        calibration=held.certificate if held else "",
        calibrated_at=days(held.at) if held else None,
        calibration_due=days(held.due) if held and held.due else None,
        who=row.who,
        about=row.about,
        files=_files(connection, key),
        asides=_asides(connection, key),
        analysis=_analysis(connection, key),
        counts_with=row.counts_with,
        previous=earlier,
        following=later,
        baseline=_baseline(connection, row),
        repeats=row.repeats,
    )


def raw_file(store: Store, key: int, number: int) -> tuple[str, bytes]:
    """The name and the content of a raw file of a test, checked against its hash.

    Parameters
    ----------
    store : Store
    key : int
        Of the test.
    number : int
        Which of its files, in the order of their paths, from 1.

    Raises
    ------
    InputError
        If there is no such test or file.
    StoreError
        If the file is missing or damaged.
    """
    with read(store) as connection:
        files = _files(connection, key)
    if not 1 <= number <= len(files):
        raise InputError(f"test {key} has {len(files)} raw files; there is none of number {number}")
    chosen = files[number - 1]
    return chosen.path, store.files.read(chosen.sha256)


def _files(connection: Connection, key: int) -> tuple[KeptFile, ...]:
    found = connection.execute(
        select(test_file.c.path, test_file.c.sha256, blob.c.size)
        .join(blob, blob.c.sha256 == test_file.c.sha256)
        .where(test_file.c.test == key)
    )
    return tuple(sorted((KeptFile(*row) for row in found), key=lambda file: file.path))


def _asides(connection: Connection, key: int) -> tuple[SetAside, ...]:
    said = select(set_aside).where(set_aside.c.test == key).order_by(set_aside.c.id)
    return tuple(SetAside(row.aside, days(row.at), row.who, row.why) for row in connection.execute(said))


def _analysis(connection: Connection, key: int) -> KeptAnalysis | None:
    """That of this version, else the last one."""
    chosen = (
        select(analysis)
        .where(analysis.c.test == key)
        .order_by(case((analysis.c.software == VERSION, 0), else_=1), analysis.c.id.desc())
        .limit(1)
    )
    row = connection.execute(chosen).one_or_none()
    if row is None:
        return None
    return KeptAnalysis(
        key=row.id,
        software=row.software,
        made_at=days(row.made_at),
        supported=row.supported,
        error=row.error or "",
        settings=row.settings,
        inputs_sha256=row.inputs_sha256,
        document_sha256=row.document_sha256 or "",
        document=row.document,
    )


def _calibration(connection: Connection, row: Row[Any]) -> Row[Any] | None:
    """The last calibration of the instrument before the test was measured."""
    if row.instrument is None:
        return None
    before = calibration.c.at <= row.at
    held = select(calibration).where(calibration.c.instrument == row.instrument, before).order_by(calibration.c.at.desc())
    return connection.execute(held.limit(1)).one_or_none()


def _neighbours(connection: Connection, row: Row[Any]) -> tuple[int | None, int | None]:
    """The tests of the series before and after a test in time."""
    of_series = select(test.c.id).where(test.c.series == row.series)
    earlier = (test.c.at < row.at) | ((test.c.at == row.at) & (test.c.id < row.id))
    later = (test.c.at > row.at) | ((test.c.at == row.at) & (test.c.id > row.id))
    before = of_series.where(earlier).order_by(test.c.at.desc(), test.c.id.desc()).limit(1)
    after = of_series.where(later).order_by(test.c.at, test.c.id).limit(1)
    return connection.execute(before).scalar_one_or_none(), connection.execute(after).scalar_one_or_none()


def _baseline(connection: Connection, row: Row[Any]) -> int | None:
    """The last test in time of the series' baseline that is not this one."""
    others = baseline_tests(connection, row.series) - {row.id}
    found = select(test.c.id).where(test.c.id.in_(others)).order_by(test.c.at.desc(), test.c.id.desc()).limit(1)
    return connection.execute(found).scalar_one_or_none()
