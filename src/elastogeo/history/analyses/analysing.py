"""Analyse a test of the store: once for each version of the software."""

from __future__ import annotations

from sqlalchemy import Connection, insert, select

from elastogeo.history.analyses.computation import Computed, computed
from elastogeo.history.analyses.raw import raw_files
from elastogeo.history.seals import seal_of, seal_of_indicators
from elastogeo.history.store import Store, audit, now, read, write
from elastogeo.history.store.schema import analysis, indicator, series
from elastogeo.version import VERSION

PROGRAM = "elastogeo"
"""Who did what no person asked for."""


def analyse(store: Store, test: int, who: str = PROGRAM) -> int:
    """Analyse a test by this version of the software, if that has not been done.

    The raw files are laid out again in a temporary folder and asked as on the command line. What comes out is written in one
    transaction: the document, whether the data support it, the indicators. An error of the analysis is written too.

    Parameters
    ----------
    store : Store
    test : int
        Its key.
    who : str
        For the audit trail.

    Returns
    -------
    int
        Key of the analysis.

    Raises
    ------
    InputError
        If there is no such test.
    StoreError
        If a raw file is missing or damaged, or nothing can be written.
    """
    with read(store) as connection:
        raw = raw_files(connection, test)
        known = last_analysis(connection, test, VERSION)
    return known or keep(store, test, computed(store.files, raw), who)


def last_analysis(connection: Connection, test: int, software: str) -> int | None:
    """Key of the last analysis of a test by a version of the software; None if there is none."""
    found = (
        select(analysis.c.id)
        .where(analysis.c.test == test, analysis.c.software == software)
        .order_by(analysis.c.id.desc())
        .limit(1)
    )
    return connection.execute(found).scalar_one_or_none()


def unanalysed(connection: Connection, counting: int, key: int) -> str:
    """Why an analysis says nothing in its series: its error, or that the series counts with another version; else empty."""
    row = connection.execute(select(analysis.c.error, analysis.c.software).where(analysis.c.id == key)).one()
    counts = connection.execute(select(series.c.software).where(series.c.id == counting)).scalar_one()
    if row.error:
        return str(row.error)
    if counts != row.software:
        return f"the series counts with elastogeo {counts}, this is {row.software}: run elastogeo history recompute"
    return ""


def keep(store: Store, test: int, found: Computed, who: str) -> int:
    """Write an analysis in one transaction; its key, or that of the same one that another process wrote meanwhile."""
    with write(store) as connection:
        same = select(analysis.c.id).where(
            analysis.c.test == test, analysis.c.software == VERSION, analysis.c.inputs_sha256 == found.inputs_sha256
        )
        known = connection.execute(same).scalar_one_or_none()
        return known or _written(connection, test, found, who)


def _written(connection: Connection, test: int, found: Computed, who: str) -> int:
    row = {
        "test": test,
        "software": VERSION,
        "settings": found.settings,
        "inputs_sha256": found.inputs_sha256,
        "made_at": now(),
        "supported": found.supported,
        "error": found.error,
        "signatures": found.signatures,
        "document_sha256": found.document_sha256,
        "document": found.document,
    }
    key = int(connection.execute(insert(analysis).values(**row).returning(analysis.c.id)).scalar_one())
    told = [
        {
            "analysis": key,
            "name": one.name,
            "kind": one.kind.name,
            "value": one.value,
            "standard_uncertainty": one.standard_uncertainty if one.standard_uncertainty < float("inf") else None,
        }
        for one in found.indicators
    ]
    if told:
        connection.execute(insert(indicator), told)
    facts = {name: row[name] for name in ("software", "inputs_sha256", "document_sha256", "error", "supported")}
    facts["signatures_sha256"] = None if found.signatures is None else seal_of(found.signatures)
    facts["indicators_sha256"] = seal_of_indicators(
        (one["name"], one["kind"], one["value"], one["standard_uncertainty"]) for one in told
    )
    audit.record(connection, who, "analyse", f"test {test}", new={"analysis": key, **facts})
    return key
