"""Analysing: the raw record answers as the files on disk do, once a version, and an error is kept as one."""

import hashlib
import json
from pathlib import Path

import pytest
from sqlalchemy import select

import elastogeo as eg
from elastogeo.changes import KINDS, Indicator, Signatures, indicators_of, signatures_of
from elastogeo.errors import ElastogeoError, InputError, StoreError
from elastogeo.history.analyses import analyse
from elastogeo.history.analyses import analysing as analysing_module
from elastogeo.history.analyses.computation import computed
from elastogeo.history.analyses.raw import RawFile, laid_out
from elastogeo.history.analyses.verbs import VERBS, asked_of
from elastogeo.history.series_of import series_of
from elastogeo.history.store import Files, Store, audit, read, schema
from elastogeo.history.store.columns import canonical
from elastogeo.observe import instruments
from elastogeo.report import view_of
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test


def row_of(store: Store, key: int) -> dict[str, object]:
    with read(store) as connection:
        return dict(connection.execute(select(schema.analysis).where(schema.analysis.c.id == key)).mappings().one())


def indicators_in(store: Store, key: int) -> list[tuple[str, str, float, float | None]]:
    kept = schema.indicator.c
    asked = select(kept.name, kept.kind, kept.value, kept.standard_uncertainty).where(kept.analysis == key).order_by(kept.id)
    with read(store) as connection:
        return [tuple(row) for row in connection.execute(asked)]


def test_the_store_says_what_the_files_say(store: Store) -> None:
    folder = EXAMPLES / "static-rig"
    test = keep_test(store, keep_series(store), files_of(folder))
    key = analyse(store, test, "A. Miller")
    result = eg.evaluate_static(eg.read_test(folder))
    row = row_of(store, key)
    assert row["document"] == json.loads(json.dumps(view_of(result).document))
    assert row["document_sha256"] == hashlib.sha256(canonical(row["document"]).encode()).hexdigest()
    assert (row["software"], row["supported"], row["error"]) == (eg.__version__, True, None)
    wanted = indicators_of(result)
    assert wanted
    assert indicators_in(store, key) == [(w.name, w.kind.name, w.value, w.standard_uncertainty) for w in wanted]
    settings = row["settings"]
    assert isinstance(settings, dict)
    assert (settings["verb"], settings["question"]["robust"], settings["made_with"]["python"][0]) == ("static", False, "3")
    with read(store) as connection:
        said = connection.execute(select(schema.audit).order_by(schema.audit.c.number.desc())).mappings().first()
        assert said is not None
        assert (said["who"], said["what"], said["subject"]) == ("A. Miller", "analyse", f"test {test}")
        assert said["new"]["document_sha256"] == row["document_sha256"]
        assert audit.verify(connection) == ()


def test_what_faults_would_do_is_kept_beside_what_is_watched(store: Store) -> None:
    key = analyse(store, keep_test(store, keep_series(store), files_of(EXAMPLES / "ball-bar-diagnosis")))
    result = eg.identify(eg.read_test(EXAMPLES / "ball-bar-diagnosis"))
    wanted = signatures_of(result)
    assert wanted is not None
    kept = row_of(store, key)["signatures"]
    assert isinstance(kept, dict)
    assert Signatures.of_document(kept) == wanted
    with read(store) as connection:
        assert series_of(connection, 1).signatures == wanted


def test_a_test_is_analysed_once_by_a_version(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    test = keep_test(store, keep_series(store), {"test.toml": b"no test"})
    key = analyse(store, test)
    assert analyse(store, test) == key
    monkeypatch.setattr(analysing_module, "VERSION", "99.0")
    other = analyse(store, test)
    assert other != key
    assert row_of(store, other)["software"] == "99.0"


def test_an_error_is_kept_with_its_message_and_without_the_place_where_it_was_read(store: Store) -> None:
    key = analyse(store, keep_test(store, keep_series(store), {"test.toml": b"schema = 7"}))
    row = row_of(store, key)
    assert (row["document"], row["document_sha256"], row["supported"]) == (None, None, False)
    assert str(row["error"]).startswith("test.toml")
    assert "elastogeo-" not in str(row["error"])
    assert indicators_in(store, key) == []


def test_a_fault_of_the_program_is_kept_as_one(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("of nothing")

    monkeypatch.setattr("elastogeo.history.analyses.computation.asked_of", broken)
    key = analyse(store, keep_test(store, keep_series(store), {"test.toml": b""}))
    assert row_of(store, key)["error"] == "a fault of elastogeo; report it with this test: ZeroDivisionError: of nothing"


@pytest.mark.parametrize("error", [MemoryError(), OSError(28, "No space left on device")])
def test_what_says_nothing_of_the_test_is_not_kept(store: Store, monkeypatch: pytest.MonkeyPatch, error: Exception) -> None:
    def broken(*_: object) -> None:
        raise error

    test = keep_test(store, keep_series(store), {"test.toml": b""})
    with monkeypatch.context() as patch:
        patch.setattr("elastogeo.history.analyses.computation.asked_of", broken)
        with pytest.raises(type(error)):
            analyse(store, test)
    with read(store) as connection:
        assert connection.execute(select(schema.analysis)).first() is None


def test_unsupported_is_kept_as_such_with_its_document(store: Store) -> None:
    key = analyse(store, keep_test(store, keep_series(store), files_of(EXAMPLES / "one-level")))
    row = row_of(store, key)
    assert (row["supported"], row["error"]) == (False, None)
    assert row["document"] is not None


def test_an_uncertainty_that_nothing_shows_is_kept_as_unknown(store: Store) -> None:
    key = analyse(store, keep_test(store, keep_series(store), files_of(EXAMPLES / "static-probes")))
    assert {u for _, _, _, u in indicators_in(store, key)} == {None}


def test_an_indicator_without_a_number_is_not_kept(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        "elastogeo.history.analyses.computation.indicators_of",
        lambda _: (Indicator("X", KINDS["scale"], float("nan"), 1.0), Indicator("Y", KINDS["scale"], 2e-6, float("nan"))),
    )
    key = analyse(store, keep_test(store, keep_series(store), files_of(EXAMPLES / "static-rig")))
    assert indicators_in(store, key) == [("Y", "scale", 2e-6, None)]


def test_a_test_that_is_not_there_is_refused(store: Store) -> None:
    with pytest.raises(InputError, match="there is no test 7"):
        analyse(store, 7)


def test_a_damaged_raw_file_is_no_error_of_the_test(store: Store) -> None:
    test = keep_test(store, keep_series(store), {"test.toml": b"whole"})
    path = store.files.path(hashlib.sha256(b"whole").hexdigest())
    path.chmod(0o644)
    path.write_bytes(b"whol3")
    with pytest.raises(StoreError, match="was changed"):
        analyse(store, test)
    with read(store) as connection:
        assert connection.execute(select(schema.analysis)).first() is None


def test_analyses_do_not_depend_on_where_they_are_made(tmp_path: Path) -> None:
    """The same bits from another folder, in another order of files."""
    one, other = Files(tmp_path / "one"), Files(tmp_path / "a longer name" / "other")
    for made in (one, other):
        made.folder.mkdir(parents=True)
    raw = []
    for path, content in files_of(EXAMPLES / "static-rig").items():
        raw.append(RawFile(path, one.put(content)))
        other.put(content)
    first, second = computed(one, raw), computed(other, raw[::-1])
    assert first.document_sha256 == second.document_sha256
    assert first.inputs_sha256 == second.inputs_sha256
    assert first.error is None
    assert computed(one, raw, attempt=2).inputs_sha256 != first.inputs_sha256
    assert computed(one, raw[:-1]).inputs_sha256 != first.inputs_sha256


def test_files_beside_the_folder_of_the_test_lie_beside_it_again(tmp_path: Path) -> None:
    files = Files(tmp_path)
    raw = [RawFile("test.toml", files.put(b"t")), RawFile("../../machine.toml", files.put(b"m"))]
    with laid_out(files, raw) as folder:
        assert (folder / "test.toml").read_bytes() == b"t"
        assert (folder.parents[1] / "machine.toml").read_bytes() == b"m"
        top = folder.parents[2]
    assert not top.exists()


def test_a_path_that_leads_out_is_refused(tmp_path: Path) -> None:
    files = Files(tmp_path)
    raw = [RawFile((tmp_path / "b").as_posix(), files.put(b"x"))]
    with pytest.raises(StoreError, match="leads out of its test"), laid_out(files, raw):
        raise AssertionError("was laid out")
    assert not (tmp_path / "b").exists()


def test_every_instrument_has_a_verb_and_is_watched() -> None:
    """By what its set-up says it shows; a new one that shows what is not known here is identified."""
    shown = {setup.extra for setup in instruments().values()}
    assert set(VERBS) <= shown
    assert shown - set(VERBS) == {"", "ball-deviations"}


@pytest.mark.parametrize(
    ("folder", "verb"),
    [("static-rig", "static"), ("one-level", "identify"), ("ball-bar-diagnosis", "identify")],
)
def test_the_verb_is_that_of_the_instrument(folder: str, verb: str) -> None:
    assert asked_of(EXAMPLES / folder, ["test.toml"]).verb == verb


def test_what_is_no_test_is_refused_with_what_it_holds(tmp_path: Path) -> None:
    with pytest.raises(ElastogeoError, match=r"none of the files test\.toml, drive\.toml; it holds notes\.txt"):
        asked_of(tmp_path, ["notes.txt"])
