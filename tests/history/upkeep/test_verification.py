"""What is not as it was written is named, and nothing else is."""

from __future__ import annotations

import hashlib
import json
import sys
import zlib
from collections.abc import Callable
from math import inf

import pytest
from sqlalchemy import text, update

from elastogeo.changes import KINDS, Indicator, StoreFault, Verified
from elastogeo.cli import main
from elastogeo.history.analyses.analysing import keep
from elastogeo.history.analyses.computation import Computed
from elastogeo.history.store import Store, audit, write
from elastogeo.history.store.frozen import freeze, thaw
from elastogeo.history.store.schema import analysis, campaign
from elastogeo.history.upkeep import verify
from elastogeo.history.upkeep.record_checks import _is_whole
from elastogeo.report import view_of
from tests.history.analyses.kept import keep_series, keep_test
from tests.history.upkeep.stores import RAW


def found(store: Store) -> list[tuple[str, str, str]]:
    return [(fault.check, fault.subject, fault.fault) for fault in verify(store).faults]


def tamper(store: Store, *statements: str) -> None:
    """By somebody who owns the database."""
    with write(store) as connection:
        thaw(connection)
        for statement in statements:
            connection.execute(text(statement))
        freeze(connection)


def test_a_whole_history_is_clean(full: Store) -> None:
    steps: list[str] = []
    checked = verify(full, steps.append)
    assert checked.faults == ()
    assert [check.passed for check in checked.verdict] == [True] * 8
    assert (checked.files, checked.size) == (3, sum(map(len, RAW)))
    assert checked.rows["machine"] == 1
    assert {"the database", "the audit trail", "raw files: 0 of 3"} <= set(steps)


def test_each_raw_file_with_a_bit_flipped_is_named(full: Store) -> None:
    for sha256 in full.files.all():
        path = full.files.path(sha256)
        whole = path.read_bytes()
        path.chmod(0o644)
        changed = bytearray(whole or b"\0")
        changed[len(whole) // 2] ^= 1
        path.write_bytes(changed)
        assert found(full) == [("raw files whole", f"raw file {sha256}", "changed")]
        path.unlink()
        assert found(full) == [("raw files whole", f"raw file {sha256}", "missing")]
        path.write_bytes(whole)
    assert found(full) == []


@pytest.mark.parametrize("kind", ["truncate"])
def test_each_bit_of_a_packed_document_counts(full: Store) -> None:
    """But the bits that fill the last byte of a packed stream, which say nothing: with them it is the same document."""
    with write(full) as connection:
        packed = bytes(connection.execute(text("SELECT document FROM analysis")).scalar_one())
    plain = zlib.decompress(packed)
    seal = hashlib.sha256(plain).hexdigest()
    missed = 0
    for bit in range(8 * len(packed)):
        changed = bytearray(packed)
        changed[bit // 8] ^= 1 << bit % 8
        whole = _is_whole(bytes(changed), seal)
        missed += whole
        assert not whole or zlib.decompress(bytes(changed)) == plain
        if bit % 50:
            continue
        with write(full) as connection:
            thaw(connection)
            connection.execute(text("UPDATE analysis SET document = :changed"), {"changed": bytes(changed)})
            freeze(connection)
        assert found(full) == ([] if whole else [("documents whole", "analysis 1", "changed")])
    assert missed < 8


def test_what_was_tampered_with_is_named(full: Store) -> None:
    tamper(full, "UPDATE plan SET document = NULL WHERE 1 = 0", "UPDATE analysis SET document_sha256 = 'a'")
    assert found(full) == [("documents whole", "analysis 1", "changed")]
    tamper(full, "UPDATE event SET note = 'none'", "UPDATE machine SET name = 'x'")
    assert len(found(full)) == 1  # what nothing seals is not known to be another
    tamper(full, "UPDATE calibration SET content = '{\"x\": 1}'")
    assert ("documents whole", "calibration 1", "changed") in found(full)


def test_edited_deleted_and_reordered_rows_of_the_trail_are_named(full: Store) -> None:
    with write(full) as connection:
        for k in range(4):
            audit.record(connection, "A. Miller", "note", f"{k}")
    tamper(full, "UPDATE audit SET who = 'B. Smith' WHERE number = 3")
    assert found(full) == [("audit trail whole", "audit row 3", "changed")]
    tamper(full, "DELETE FROM audit WHERE number = 5")
    assert found(full)[1:] == [("audit trail whole", "audit row 5", "missing")]
    tamper(
        full,
        "UPDATE audit SET number = 99 WHERE number = 4",
        "UPDATE audit SET number = 4 WHERE number = 6",
        "UPDATE audit SET number = 6 WHERE number = 99",
    )
    assert {fault.subject for fault in verify(full).faults} == {f"audit row {k}" for k in (3, 4, 5, 6)}


def test_what_a_test_and_an_analysis_were_when_they_came_in_is_held_against_them(full: Store) -> None:
    with write(full) as connection:
        row = connection.execute(text("SELECT sha256, name FROM test")).one()
        made = connection.execute(text("SELECT software, document_sha256 FROM analysis")).one()
        audit.record(connection, "me", "import", "test 1", new={"sha256": row.sha256, "name": row.name})
        audit.record(connection, "me", "analyse", "test 1", new={"analysis": 1, **made._asdict()})
    assert found(full) == []
    tamper(full, "UPDATE test SET name = 'another'", "UPDATE analysis SET software = '9.9'")
    assert found(full) == [("records agree", "test 1", "changed"), ("records agree", "analysis 1", "changed")]
    assert [fault.detail for fault in verify(full).faults] == ["name", "software"]
    tamper(full, "UPDATE test SET name = 'test.name'", "UPDATE test_file SET path = 'other.csv'")
    assert ("records agree", "test 1", "changed") in found(full)
    with write(full) as connection:
        audit.record(connection, "me", "import", "test 77", new={"sha256": "x"})
    assert ("records agree", "test 77", "missing") in found(full)


def test_what_the_charts_read_is_sealed(store: Store) -> None:
    """One bit of an indicator, or a whole other set of signatures, shows."""
    key = keep_test(store, keep_series(store), {"test.toml": b"x"})
    kinds = KINDS["stiffness"], KINDS["squareness"]
    indicators = (Indicator("stiffness X", kinds[0], 50_000.0, inf), Indicator("squareness XY", kinds[1], -0.0, 1e-6))
    keep(store, key, Computed({}, "i", {"values": [1.5]}, True, indicators, {"moved": [1.0]}, None), "A. Miller")
    files = hashlib.sha256(f"{hashlib.sha256(b'x').hexdigest()}  test.toml\n".encode()).hexdigest()
    tamper(store, f"UPDATE test SET sha256 = '{files}'")  # that of an import
    assert found(store) == []
    sane = "UPDATE indicator SET value = 50000.0 WHERE name = 'stiffness X'"
    tamper(store, "UPDATE indicator SET value = 50000.00000000001 WHERE name = 'stiffness X'")
    assert [fault.detail for fault in verify(store).faults] == ["indicators_sha256"]
    tamper(store, sane, "UPDATE indicator SET standard_uncertainty = 2e-6 WHERE name = 'squareness XY'")
    assert [fault.detail for fault in verify(store).faults] == ["indicators_sha256"]
    tamper(store, "UPDATE indicator SET standard_uncertainty = 1e-6 WHERE name = 'squareness XY'")
    assert found(store) == []
    with write(store) as connection:
        thaw(connection)
        connection.execute(update(analysis).values(signatures={"moved": [2.0]}))
        freeze(connection)
    assert [fault.detail for fault in verify(store).faults] == ["signatures_sha256"]


def test_a_campaign_has_the_document_that_its_hash_says(full: Store) -> None:
    document = {"values": [1.5]}
    seal = hashlib.sha256(b'{"values":[1.5]}').hexdigest()
    with write(full) as connection:
        connection.execute(update(campaign).values(content={"document": document, "document_sha256": seal}))
        audit.record(connection, "me", "keep campaign", "campaign 1", new={"document_sha256": "that of an older version"})
        audit.record(connection, "me", "recompute", "campaign 1", new={"document_sha256": seal})
    assert found(full) == []
    with write(full) as connection:
        connection.execute(update(campaign).values(content={"document": {"values": [2.5]}, "document_sha256": seal}))
    assert found(full) == [("records agree", "campaign 1", "changed")]
    other = hashlib.sha256(b'{"values":[2.5]}').hexdigest()
    with write(full) as connection:
        connection.execute(update(campaign).values(content={"document": {"values": [2.5]}, "document_sha256": other}))
    assert found(full) == [("records agree", "campaign 1", "changed")], "another hash with it is not what the trail says"


@pytest.mark.parametrize("kind", ["truncate", "wal"])
def test_a_row_that_names_none_and_a_table_without_its_refusal_are_named(full: Store) -> None:
    with full.engine.connect() as connection:
        connection.execution_options(writes=True, migrates=True)
        with connection.begin():
            connection.execute(text("INSERT INTO campaign_test (id, campaign, test) VALUES (5, 1, 99)"))
            connection.execute(text("DROP TRIGGER frozen_update_test"))
            connection.execute(text("DROP TRIGGER frozen_delete_test"))
    assert found(full) == [
        ("rows protected", "table test", "unprotected"),
        ("references whole", "campaign_test 5", "dangling"),
    ]


def test_stray_files_are_told_and_wrong_no_more_than_that(full: Store) -> None:
    sha256 = full.files.put(b"named by nobody")
    (full.files.folder / "note.txt").write_text("x")
    (full.files.folder / "incoming" / "half").write_bytes(b"half")
    checked = verify(full)
    assert found(full) == [
        ("no stray files", f"file {sha256[:2]}/{sha256}", "stray"),
        ("no stray files", "file note.txt", "stray"),
    ]
    assert view_of(checked).supported


def test_what_a_watch_notes_is_no_stray_file(full: Store) -> None:
    (full.files.folder / "watched").mkdir()
    (full.files.folder / "watched" / "0a1b.jsonl").write_text("{}\n")
    assert found(full) == []


def test_a_size_that_its_row_does_not_say_is_named(full: Store) -> None:
    sha256 = next(iter(full.files.all()))
    tamper(full, f"UPDATE blob SET size = size + 1 WHERE sha256 = '{sha256}'")
    assert found(full) == [("raw files whole", f"raw file {sha256}", "resized")]


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_damaged_database_is_named_and_nothing_else_is_said_of_it(full: Store, url: str) -> None:
    with write(full) as connection:
        root = connection.execute(text("SELECT rootpage FROM sqlite_master WHERE name = 'uq_machine_name'")).scalar()
        root = (
            root
            or connection.execute(
                text("SELECT rootpage FROM sqlite_master WHERE tbl_name = 'machine' AND type = 'index'")
            ).scalar()
        )
        page = connection.exec_driver_sql("PRAGMA page_size").scalar_one()
    full.close()
    with open(url, "r+b") as file:
        file.seek((root - 1) * page + page - 12)
        file.write(b"\x55" * 12)
    checked = verify(full)
    assert {fault.check for fault in checked.faults} == {"database sound"}
    assert [check.passed for check in checked.verdict] == [False, None, None, None, None, None]
    assert view_of(checked).checks[1].sentence == "Not tested: the database cannot be read."


Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def elastogeo(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run a command line in this process: its exit code, standard output and standard error."""

    def run(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["elastogeo", *arguments])
        return (main(), *capsys.readouterr())

    return run


@pytest.mark.parametrize("kind", ["truncate"])
def test_verify_ends_with_0_or_1_and_names_the_file(full: Store, url: str, elastogeo: Run) -> None:
    code, out, _ = elastogeo("history", "verify", "--store", url)
    assert code == 0
    assert "The history is as it was written: " in out
    sha256 = full.files.put(RAW[0])
    full.files.path(sha256).unlink()
    code, out, _ = elastogeo("history", "verify", "--store", url, "--json")
    said = json.loads(out)
    assert (code, said["schema"]) == (1, "elastogeo.verified/1")
    assert said["faults"][0]["subject"] == f"raw file {sha256}"
    code, out, _ = elastogeo("history", "verify", "--store", url)
    assert f"raw file {sha256} is missing" in out
    assert "Put the files back from a backup, by name." in out
    assert "1 fault in" in out


def test_the_view_counts_what_it_does_not_name() -> None:
    from elastogeo.changes import as_written

    faults = tuple(StoreFault("raw files whole", f"raw file {k}", "missing") for k in range(60))
    result = Verified("shop.db", {"machine": 1}, 0, 0, faults, (as_written("raw files whole", 60, faults),))
    view = view_of(result)
    assert view.tables[0].note == "10 more, in the JSON"
    assert "and 55 more" in view.checks[0].sentence
    assert not view.supported
