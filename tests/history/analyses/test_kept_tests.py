"""One test of the history: its neighbours, its calibration, what was said of it, its raw files as they came in."""

from __future__ import annotations

from datetime import timedelta
from pathlib import Path

import pytest
from sqlalchemy import insert

import elastogeo as eg
from elastogeo.errors import InputError, StoreError
from elastogeo.history.analyses import analyse, kept_test, raw_file
from elastogeo.history.intake.asides import set_test_aside
from elastogeo.history.store import Store, read, schema, write
from elastogeo.report import view_of
from tests.history.analyses.kept import BEGAN, EXAMPLES, files_of, keep_series, keep_test

FILES = {"test.toml": b"no test", "runs/a.csv": b"1,2\n", "runs/b.csv": b""}


def test_a_test_knows_its_neighbours_in_time_and_its_files(store: Store) -> None:
    series = keep_series(store)
    late, early, middle = (keep_test(store, series, FILES, day=day) for day in (9.0, 1.0, 5.0))
    other = keep_test(store, keep_series(store, name="another"), FILES, day=4.0)
    with read(store) as connection:
        found = {key: kept_test(connection, key) for key in (late, early, middle, other)}
    assert [(found[key].previous, found[key].following) for key in (early, middle, late, other)] == [
        (None, middle), (early, late), (middle, None), (None, None),
    ]  # fmt: skip
    assert [(file.path, file.size) for file in found[late].files] == [("runs/a.csv", 4), ("runs/b.csv", 0), ("test.toml", 7)]
    assert found[late].analysis is None
    assert found[late].baseline is None
    assert view_of(found[late]).sentence == "This test has not been evaluated yet."
    with read(store) as connection, pytest.raises(InputError, match="there is no test 99"):
        kept_test(connection, 99)


def test_the_calibration_that_held_counts_not_a_later_one(store: Store) -> None:
    test = keep_test(store, keep_series(store), FILES, day=10.0)
    with write(store) as connection:
        bar = {"serial": "B-17", "kind": "loaded-ball-bar", "made_at": BEGAN}
        key = connection.execute(insert(schema.instrument).values(bar).returning(schema.instrument.c.id)).scalar_one()
        for day, due, name in ((-100, -5, "old"), (-50, 5, "held"), (20, 300, "later")):
            row = {"at": BEGAN + timedelta(days=day), "due": BEGAN + timedelta(days=due), "certificate": name}
            connection.execute(insert(schema.calibration).values(instrument=key, content={}, who="A", **row))
        copied = {"name": "with it", "sha256": "x", "series": 1, "imported_at": BEGAN, "origin": "measured", "about": {}}
        again = {**copied, "at": BEGAN + timedelta(days=10), "instrument": key}
        with_bar = connection.execute(insert(schema.test).values(again).returning(schema.test.c.id)).scalar_one()
    with read(store) as connection:
        found, without = kept_test(connection, with_bar), kept_test(connection, test)
    assert (found.instrument, found.calibration) == ("B-17", "held")
    assert (
        "calibrated 10 January 2026, certificate held; that ran out on 6 March 2026"
        in dict(view_of(found).head)["Instrument"]
    )
    assert (without.instrument, without.calibrated_at) == ("", None)


def test_setting_aside_is_a_story_with_reasons(store: Store) -> None:
    test = keep_test(store, keep_series(store), FILES)
    set_test_aside(store, test, who="A. Miller", why="ball not seated")
    with read(store) as connection:
        aside = kept_test(connection, test)
    assert aside.is_aside
    assert any("by A. Miller: ball not seated. It counts in no chart." in said for said in view_of(aside).alert)
    set_test_aside(store, test, who="B. Smith", why="it was", back=True)
    with read(store) as connection:
        back = kept_test(connection, test)
    assert [(one.aside, one.who, one.why) for one in back.asides] == [
        (True, "A. Miller", "ball not seated"), (False, "B. Smith", "it was"),
    ]  # fmt: skip
    assert not back.is_aside


def test_the_view_says_what_the_kept_document_says(store: Store) -> None:
    test = keep_test(store, keep_series(store), files_of(EXAMPLES / "static-probes"))
    analyse(store, test)
    with read(store) as connection:
        kept = kept_test(connection, test)
    view, result = view_of(kept), view_of(eg.evaluate_static(eg.read_test(EXAMPLES / "static-probes")))
    assert view.checks == result.checks
    assert view.supported == result.supported
    assert view.document["schema"] == "elastogeo.test/1"
    assert view.document["result"] == result.document["schema"]
    assert view.document["verdict"] == result.document["verdict"]
    assert {file["sha256"] for file in view.document["files"]} == {file.sha256 for file in kept.files}
    provenance = view.table("provenance")
    assert provenance is not None
    assert f"by elastogeo {eg.__version__}" in dict(provenance.rows)["evaluated"]


def test_an_error_is_the_answer(store: Store) -> None:
    test = keep_test(store, keep_series(store), {"test.toml": b"no test"})
    analyse(store, test)
    with read(store) as connection:
        view = view_of(kept_test(connection, test))
    assert view.sentence.startswith("This test could not be evaluated: test.toml")
    assert view.badge is not None
    assert (view.badge.tone, view.badge.text) == ("bad", "Could not be evaluated")


def test_raw_files_are_checked_when_they_go_out(store: Store) -> None:
    test = keep_test(store, keep_series(store), FILES)
    assert raw_file(store, test, 1) == ("runs/a.csv", b"1,2\n")
    for number in (0, 4, -1):
        with pytest.raises(InputError, match=f"test {test} has 3 raw files; there is none of number {number}"):
            raw_file(store, test, number)
    with read(store) as connection:
        place: Path = store.files.path(kept_test(connection, test).files[0].sha256)
    place.chmod(0o644)
    place.write_bytes(b"1,3\n")
    with pytest.raises(StoreError):
        raw_file(store, test, 1)
