"""`elastogeo history init` and `audit`, and what the trail's view says."""

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from sqlalchemy import text

from elastogeo.changes import AuditFault, AuditTrail, trail_whole
from elastogeo.cli import main
from elastogeo.history.store import Store, audit, open_store, write
from elastogeo.history.store.frozen import thaw
from elastogeo.history.store.trail import audit_trail
from elastogeo.report import view_of

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def elastogeo(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run a command line in this process: its exit code, standard output and standard error."""

    def run(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["elastogeo", *arguments])
        return (main(), *capsys.readouterr())

    return run


def test_init_makes_a_history_once(place: str, kind: str, elastogeo: Run) -> None:
    code, out, err = elastogeo("history", "init", place)
    assert (code, err) == (0, "")
    assert out.startswith("Made: ")
    assert ("PostgreSQL" if kind == "postgresql" else f"journal {kind}") in out
    assert elastogeo("history", "init", "--store", place)[1].startswith("There already, nothing was changed: ")


def test_init_takes_the_place_that_the_variable_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, elastogeo: Run
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ELASTOGEO_STORE", "shop.db")
    assert elastogeo("history", "init", "--who", "A. Miller")[0] == 0
    assert {path.name for path in tmp_path.iterdir()} >= {"shop.db", "shop.db.files"}
    code, out, _ = elastogeo("history", "audit", "--json")
    assert code == 0
    assert json.loads(out)["rows"][0]["who"] == "A. Miller"


def test_audit_shows_the_last_rows_of_what_was_asked(store: Store, url: str, elastogeo: Run) -> None:
    with write(store) as connection:
        for k in range(1, 6):
            audit.record(connection, "A. Miller", "set aside", f"test {k}", old=False, new=True, why="ball not seated")
    code, out, _ = elastogeo("history", "audit", "--store", url, "--last", "2", "--json")
    found = json.loads(out)
    assert code == 0
    assert (found["schema"], found["count"], found["faults"]) == ("elastogeo.audit/1", 6, [])
    assert [(row["number"], row["subject"]) for row in found["rows"]] == [(6, "test 5"), (5, "test 4")]
    assert found["head"] == found["rows"][0]["sha256"]
    one = json.loads(elastogeo("history", "audit", "--store", url, "--subject", "test 3", "--json")[1])["rows"]
    assert [(row["number"], row["why"], row["old"], row["new"]) for row in one] == [(4, "ball not seated", False, True)]
    by = json.loads(elastogeo("history", "audit", "--store", url, "--by", "the tests", "--json")[1])["rows"]
    assert [row["what"] for row in by] == ["migrate"]
    shown = elastogeo("history", "audit", "--store", url)[1]
    assert "The audit trail holds 6 rows and is as it was written." in shown
    assert "ball not seated" in shown


def test_audit_names_what_was_tampered_with_and_ends_with_1(store: Store, url: str, elastogeo: Run) -> None:
    with write(store) as connection:
        for k in range(3):
            audit.record(connection, "A. Miller", "note", f"{k}")
    with write(store) as connection:
        thaw(connection)
        connection.execute(text("UPDATE audit SET why = 'none' WHERE number = 2"))
        connection.execute(text("DELETE FROM audit WHERE number = 4"))
    code, out, _ = elastogeo("history", "audit", "--store", url)
    assert code == 1
    assert "row 2 was changed, the rows from 4 on were cut off. Compare it with a backup." in out


def test_the_sentence_counts_what_it_does_not_name() -> None:
    faults = [AuditFault(3, "moved", 4), AuditFault(4, "moved", 3), *(AuditFault(k, "missing") for k in range(5, 11))]
    trail = AuditTrail("shop.db", 9, "", (), tuple(faults), (trail_whole(9, faults),))
    (said,) = view_of(trail).checks
    assert said.sentence.startswith("Not as it was written: row 3 stood at 4, row 4 stood at 3, row 5 was deleted, row 6")
    assert said.sentence.endswith("row 7 was deleted, and 3 more. Compare it with a backup.")
    assert not view_of(trail).supported


def test_a_history_that_is_not_there_is_refused(elastogeo: Run, tmp_path: Path) -> None:
    code, out, err = elastogeo("history", "audit", "--store", str(tmp_path / "none.db"))
    assert (code, out) == (2, "")
    assert "there is no history here; make one with: elastogeo history init" in err


def test_the_trail_of_an_empty_place_is_that_it_was_made(place: str) -> None:
    with open_store(place, create=True, who="A. Miller") as store:
        trail = audit_trail(store)
    assert [(row.who, row.what) for row in trail.rows] == [("A. Miller", "migrate")]
    assert trail.verdict[0].passed
