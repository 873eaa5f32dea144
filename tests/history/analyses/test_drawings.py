"""Drawings of tests: made once, of every instrument, and of the analysis that is kept."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import func, select

import elastogeo as eg
from elastogeo.errors import InputError
from elastogeo.history.analyses import analyse, draw, drawing_of
from elastogeo.history.analyses import drawings as module
from elastogeo.history.store import Store, open_store, read, schema
from elastogeo.report import View, view_kept, view_of
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test


def drawn(store: Store, test: int) -> dict[str, Any]:
    key = draw(store, test)
    with read(store) as connection:
        found = drawing_of(connection, key)
    assert found is not None
    return found


@pytest.fixture
def plain_store(tmp_path: Path) -> Store:
    return open_store(str(tmp_path / "h.db"), create=True, who="the tests")


def test_a_drawing_is_made_once_and_again_when_asked(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    test = keep_test(store, keep_series(store), files_of(EXAMPLES / "static-rig"))
    asked = []
    monkeypatch.setattr(
        module, "ask_again", lambda *given: (asked.append(given), {}, {"schema": module.SCHEMA, "view": len(asked)}, "")[1:]
    )
    assert [drawn(store, test)["view"] for _ in range(2)] == [1, 1]
    assert draw(store, test) == analyse(store, test)
    draw(store, test, again=True)
    assert drawn(store, test)["view"] == 2
    with read(store) as connection:
        assert connection.execute(select(func.count()).select_from(schema.drawing)).scalar_one() == 1
    monkeypatch.setattr(module, "SCHEMA", "elastogeo.drawing/99")
    with read(store) as connection:
        assert drawing_of(connection, 1) is None


def test_a_drawing_is_the_view_of_the_test(plain_store: Store) -> None:
    folder = EXAMPLES / "static-probes"
    test = keep_test(plain_store, keep_series(plain_store), files_of(folder))
    found = drawn(plain_store, test)
    view = view_of(eg.evaluate_static(eg.read_test(folder)))
    again = view_kept(found["view"]).view
    assert (again.sentence, again.checks) == (view.sentence, view.checks)
    assert [table.title for table in again.tables] == [table.title for table in view.tables]
    assert (found["causes"], len(found["rows"]), found["differing"]) == (None, len(view.rows), 0)
    assert set(found["view"]["pictures"]) == set(view.pictures)


def test_raw_files_that_say_something_else_are_told(plain_store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    test = keep_test(plain_store, keep_series(plain_store), files_of(EXAMPLES / "static-probes"))
    analyse(plain_store, test)
    whole = module.view_of

    def otherwise(result: object) -> View:
        view = whole(result)
        return replace(view, document={**view.document, "rank": 99})

    monkeypatch.setattr(module, "view_of", otherwise)
    found = drawn(plain_store, test)
    assert (found["same_bits"], found["differing"]) == (False, 1)


def test_a_circle_is_drawn_with_its_causes(plain_store: Store) -> None:
    folder = EXAMPLES / "ball-bar-diagnosis"
    found = drawn(plain_store, keep_test(plain_store, keep_series(plain_store), files_of(folder)))["causes"]
    diagnosis = eg.diagnose(eg.read_test(folder))
    machine = [fault for fault in diagnosis.faults if fault.axis]
    assert [cause["names"] for cause in found["causes"]] == [list(fault.names) for fault in machine]
    assert [polar["force_N"] for polar in found["polars"]] == sorted(diagnosis.circularity, key=abs, reverse=True)
    assert {run["direction"] for run in found["columns"]["runs"].values()} == {"ccw", "cw"}
    assert json.loads(json.dumps(found, allow_nan=False)) == found


def test_what_could_not_be_analysed_is_not_drawn(plain_store: Store) -> None:
    test = keep_test(plain_store, keep_series(plain_store), {"test.toml": b"no test"})
    with pytest.raises(InputError, match=f"test {test} could not be analysed, so there is nothing to draw: test.toml"):
        draw(plain_store, test)
    with read(plain_store) as connection:
        assert drawing_of(connection, 1) is None
