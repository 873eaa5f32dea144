"""Everything as files and back, bit for bit, from either database into either."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from sqlalchemy import insert, select, text

from elastogeo.cli import main
from elastogeo.errors import StoreError
from elastogeo.history.store import Store, audit, now, open_store, read, write
from elastogeo.history.store.frozen import frozen
from elastogeo.history.store.schema import FROZEN, alarm, analysis, indicator, machine, metadata
from elastogeo.history.upkeep import export, restore
from elastogeo.history.upkeep.manifests import SCHEMA
from tests.history.upkeep.stores import exported, raw, rows

Place = dict[str, str]


@pytest.mark.parametrize("other", ["truncate", "postgresql"])
def test_everything_comes_back_bit_for_bit_on_either_database(
    full: Store, tmp_path: Path, other: str, place_for: Callable[[str], Place], opened: Callable[[Place], Store]
) -> None:
    with write(full) as connection:  # an alarm that a later one holds back
        connection.execute(insert(alarm).values(opened_at=now()))
        connection.execute(alarm.update().where(alarm.c.id == 1).values(held_by=2))
    said = export(full, tmp_path / "export")
    place = place_for(other)
    back = restore(tmp_path / "export", **place)
    assert (back.rows, back.files, back.size) == (said.rows, said.files, said.size) == (said.rows, 3, 283)
    assert set(said.rows) == set(metadata.tables)
    assert {name for name, count in said.rows.items() if not count} == {"session", "token"}
    with opened(place) as restored:
        assert rows(restored) == exported(full)
        assert raw(restored) == raw(full)
        with read(restored) as connection:
            assert audit.verify(connection) == ()
            assert frozen(connection) == set(FROZEN)
        with write(restored) as connection:  # new rows get keys after the last
            assert connection.execute(insert(alarm).values(opened_at=now()).returning(alarm.c.id)).scalar() == 3
            assert audit.record(connection, "me", "note", "x") == said.rows["audit"] + 1


SHARED = [HealthCheck.function_scoped_fixture]
words = st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=12)
numbers = st.floats(allow_nan=False) | st.sampled_from([5e-324, 1.7976931348623157e308, 0.1 + 0.2, -0.0, 1e23, float("inf")])
documents = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | words,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(words, inner, max_size=3),
    max_leaves=8,
)


@given(names=st.lists(words, unique=True, max_size=4), values=st.lists(numbers, max_size=6), document=documents)
@settings(
    max_examples=8, deadline=None, phases=[Phase.generate], suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@pytest.mark.parametrize("kind", ["truncate"])
def test_awkward_values_come_back(
    full: Store, tmp_path_factory: pytest.TempPathFactory, names: list[str], values: list[float], document: object
) -> None:
    with write(full) as connection:
        number = connection.execute(select(audit.audit.c.number).order_by(audit.audit.c.number.desc()).limit(1)).scalar()
        for name in names:
            connection.execute(insert(machine).values(name=f"{number} {name}", place=name, made_at=now()))
        row = {"software": f"{number}", "settings": {"x": document}, "document": [document], "made_at": now(), "test": 1}
        row |= {"inputs_sha256": "x", "supported": False}
        key = connection.execute(insert(analysis).values(row).returning(analysis.c.id)).scalar_one()
        for k, value in enumerate(values):
            connection.execute(insert(indicator).values(analysis=key, name=f"{k}", kind="none", value=value))
        audit.record(connection, "me", "note", "x", old=document, why="".join(names))
    folder = tmp_path_factory.mktemp("awkward")
    export(full, folder / "export")
    restore(folder / "export", folder / "h.db")
    with open_store(folder / "h.db") as restored, read(restored) as connection:
        assert audit.verify(connection) == ()
        found = connection.execute(select(indicator.c.value).where(indicator.c.analysis == key).order_by(indicator.c.id))
        assert list(map(repr, found.scalars())) == [repr(value + 0.0) for value in values]
        kept = connection.execute(select(analysis.c.document, analysis.c.settings).where(analysis.c.id == key)).one()
        assert tuple(kept) == ([document], {"x": document})
    assert rows(restored) == exported(full)


def test_awkward_rows_cross_between_databases(
    full: Store, tmp_path: Path, kind: str, place_for: Callable[[str], Place], opened: Callable[[Place], Store]
) -> None:
    awkward = ["", "'; DROP TABLE machine; --", "\n\r\u2028\x85\x1c", "=1+1", "\U0001f600", "\ufeff", "\\N", "%s %(x)s :x"]
    with write(full) as connection:
        for name in awkward:
            connection.execute(insert(machine).values(name=name, place=name, made_at=now()))
        for k, value in enumerate([5e-324, 1.7976931348623157e308, 0.1, -1 / 3, float("inf"), -0.0]):
            connection.execute(insert(indicator).values(analysis=1, name=f"{k}", kind="none", value=value))
    export(full, tmp_path / "export")
    place = place_for("truncate" if kind == "postgresql" else "postgresql")
    restore(tmp_path / "export", **place)
    with opened(place) as restored:
        assert rows(restored) == exported(full)


def lines(folder: Path) -> dict[str, list[str]]:
    return {path.stem: path.read_text(encoding="utf-8").split("\n")[:-1] for path in (folder / "tables").iterdir()}


@pytest.mark.parametrize("kind", ["truncate"])
def test_an_export_is_files_that_any_program_reads(full: Store, tmp_path: Path) -> None:
    export(full, tmp_path / "export")
    found = lines(tmp_path / "export")
    (row,) = map(json.loads, found["indicator"])
    assert row == {"id": 1, "analysis": 1, "name": "indicator.name", "kind": "indicator.kind"} | {
        "value": 1.0, "standard_uncertainty": 1.0,
    }  # fmt: skip
    assert json.loads(found["test"][0])["at"] == 1_772_438_400_000_000  # 2026-03-02 08:00 UTC
    manifest = json.loads((tmp_path / "export" / "manifest.json").read_bytes())
    assert (manifest["schema"], manifest["content"], manifest["revision"]) == (SCHEMA, "rows", "0002")
    assert {name: of["rows"] for name, of in manifest["tables"].items()} == {name: len(of) for name, of in found.items()}


@pytest.mark.parametrize("kind", ["truncate"])
def test_nothing_is_written_over(full: Store, url: str, tmp_path: Path) -> None:
    export(full, tmp_path / "export")
    before = sorted(path.name for path in tmp_path.iterdir())
    with pytest.raises(StoreError, match="export: is there already; name a folder that is not there yet"):
        export(full, tmp_path / "export")
    with pytest.raises(StoreError, match=r"there is no folder .*; make it first"):
        export(full, tmp_path / "none" / "export")
    with pytest.raises(StoreError, match="a history is restored only where there is nothing: name another place"):
        restore(tmp_path / "export", url)
    (tmp_path / "raw").mkdir()
    (tmp_path / "raw" / "mine.txt").write_text("mine")
    with pytest.raises(StoreError, match=r"mine\.txt: is there already; a history is restored only where there is nothing"):
        restore(tmp_path / "export", tmp_path / "h.db", files=tmp_path / "raw")
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*before, "raw"])


@pytest.mark.parametrize("kind", ["postgresql"])
def test_a_database_that_holds_a_history_is_left_alone(full: Store, url: str, tmp_path: Path) -> None:
    export(full, tmp_path / "export")
    before = rows(full)
    with pytest.raises(StoreError, match="holds a history already; name a place that holds nothing"):
        restore(tmp_path / "export", url, files=tmp_path / "other")
    assert rows(full) == before


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_copy_with_one_bit_changed_is_refused_and_nothing_is_made(full: Store, tmp_path: Path) -> None:
    export(full, tmp_path / "export")
    for path in sorted((tmp_path / "export").rglob("*")):
        if not path.is_file() or path.stat().st_size == 0:
            continue
        whole = path.read_bytes()
        path.chmod(0o644)
        changed = bytearray(whole)
        changed[len(whole) // 2] ^= 4
        path.write_bytes(changed)
        with pytest.raises(StoreError, match=r"damaged|was changed|is no row of it|cannot be read|schema"):
            restore(tmp_path / "export", tmp_path / "h.db")
        assert not (tmp_path / "h.db").exists()
        path.write_bytes(whole)
    restore(tmp_path / "export", tmp_path / "h.db")  # what the attempts left is not in the way


@pytest.mark.parametrize("kind", ["truncate"])
def test_what_is_no_copy_or_too_new_is_refused_by_name(full: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(StoreError, match="there is no such folder; name the folder of a backup or of an export"):
        restore(tmp_path / "none", tmp_path / "h.db")
    with pytest.raises(StoreError, match=r"is no backup and no export: it has no manifest\.json"):
        restore(tmp_path, tmp_path / "h.db")
    monkeypatch.setattr("elastogeo.history.upkeep.exports.REVISIONS", ("0001", "0002", "0999"))
    export(full, tmp_path / "newer")
    with pytest.raises(StoreError, match=r"was written by a newer elastogeo \(.*, schema 0999; .* knows 0002 and older\)"):
        restore(tmp_path / "newer", tmp_path / "h.db")
    monkeypatch.undo()
    export(full, tmp_path / "export")
    os.remove(tmp_path / "export" / "tables" / "test.jsonl")
    with pytest.raises(StoreError, match=r"test\.jsonl: No such file or directory; take another copy"):
        restore(tmp_path / "export", tmp_path / "h.db")


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_damaged_raw_file_is_named_and_not_copied(full: Store, tmp_path: Path) -> None:
    path = full.files.path(next(iter(full.files.all())))
    path.chmod(0o644)
    path.write_bytes(b"other")
    with pytest.raises(StoreError, match=f"{path.name}: was changed: its content no longer has the hash of its name"):
        export(full, tmp_path / "export")
    path.unlink()
    with pytest.raises(StoreError, match=f"{path.name}: is missing; put it back from a backup"):
        export(full, tmp_path / "export")
    assert [one.name for one in tmp_path.iterdir() if "export" in one.name] == []


@pytest.mark.parametrize("kind", ["truncate"])
def test_a_row_that_is_none_is_named_by_its_line(full: Store, tmp_path: Path) -> None:
    export(full, tmp_path / "export")
    path = tmp_path / "export" / "tables" / "machine.jsonl"
    path.write_bytes(path.read_bytes() + b'{"id": 2}\n')
    with pytest.raises(StoreError, match="line 2 of the table machine is no row of it: its columns are others"):
        restore(tmp_path / "export", tmp_path / "h.db")
    with read(full) as connection:
        assert connection.execute(text("SELECT count(*) FROM machine")).scalar() == 1


Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def elastogeo(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run a command line in this process: its exit code, standard output and standard error."""

    def run(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["elastogeo", *arguments])
        return (main(), *capsys.readouterr())

    return run


@pytest.mark.parametrize("kind", ["truncate"])
def test_export_and_restore_from_the_command_line(full: Store, url: str, tmp_path: Path, elastogeo: Run) -> None:
    code, out, err = elastogeo("history", "export", str(tmp_path / "export"), "--store", url)
    assert (code, err) == (0, "")
    assert out.startswith(f"Exported: {tmp_path / 'export'}\n")
    assert ", 3 raw files (283 bytes)" in out
    code, out, _ = elastogeo("history", "restore", str(tmp_path / "export"), str(tmp_path / "h.db"), "--json")
    said = json.loads(out)
    assert (code, said["schema"], said["place"]) == (0, "elastogeo.history-copied/1", str(tmp_path / "h.db"))
    assert said["rows"]["audit"] == len(rows(full)["audit"])
    code, out, err = elastogeo("history", "restore", str(tmp_path / "export"), url)
    assert (code, out) == (2, "")
    assert "a history is restored only where there is nothing: name another place" in err
