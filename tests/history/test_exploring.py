"""The readings of a kept test beside what its kept parameters predict: the same as identifying its files says."""

from collections.abc import Iterator

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.changes import NO_READINGS, NOT_EXPLAINED
from elastogeo.errors import InputError
from elastogeo.history.analyses import analyse
from elastogeo.history.exploring import MOST, explore, thinned_run
from elastogeo.report import view_of
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test

BAR = EXAMPLES / "ball-bar-diagnosis"


@pytest.fixture(scope="module")
def history(tmp_path_factory: pytest.TempPathFactory) -> Iterator[eg.History]:
    """A ball bar with many readings, a static test, a test that was not analysed, and one of feed drives."""
    with eg.History(tmp_path_factory.mktemp("explore") / "h.db", create=True, who="the tests") as history:
        store = history.store
        keep_test(store, keep_series(store, name="bar"), files_of(BAR))
        keep_test(store, keep_series(store, name="static"), files_of(EXAMPLES / "static-force"))
        keep_test(store, keep_series(store, name="not analysed"), files_of(BAR), 3)
        keep_test(store, keep_series(store, name="drives"), {"drive.toml": b'name = "X"\n'}, 4)
        for test in (1, 2):
            analyse(store, test)
        yield history


def test_measured_and_predicted_are_those_of_the_identification(history: eg.History) -> None:
    found = history.explore(1)
    direct = eg.identify(eg.read_test(BAR))
    assert (found.refusal, found.quantity, len(found.runs)) == ("", "angle", len(direct.traces))
    for run, trace in zip(found.runs, direct.traces, strict=True):
        assert (run.run, run.force) == (trace.run, trace.force)
        np.testing.assert_array_equal(run.measured, trace.measured)
        np.testing.assert_allclose(run.predicted, trace.predicted, rtol=0, atol=1e-12)
    assert {run.sense for run in found.runs} == {1, -1}


def test_thinned_runs_keep_what_stands_out_and_say_so(history: eg.History) -> None:
    whole, found = history.explore(1), explore(history.store, 1, most=1000)
    assert whole.shown == whole.readings == 8640
    assert found.readings == 8640
    assert found.shown <= 1000
    for run, full in zip(found.runs, whole.runs, strict=True):
        assert run.predicted is not None
        assert full.predicted is not None
        left, every = run.measured - run.predicted, full.measured - full.predicted
        assert (left.min(), left.max()) == (every.min(), every.max())
        assert np.all(np.isin(run.pose, full.pose))
        assert thinned_run(full, 10_000) is full
    (note,) = view_of(found).notes
    assert note.startswith(f"{found.shown} of 8640 readings are shown")
    assert view_of(whole).notes == ()


def test_a_page_of_many_readings_stays_below_a_megabyte(history: eg.History) -> None:
    found = history.explore(1)
    assert len(found.to_json(indent=None)) / found.readings * MOST < 1_000_000


def test_a_static_test_counts_along_its_force(history: eg.History) -> None:
    found = history.explore(2)
    document = view_of(found).document
    assert found.runs
    assert {run.sense for run in found.runs} == {0}
    assert document["along"]["quantity"] != "angle"
    assert {run["direction"] for run in document["runs"]} == {""}


def test_what_was_not_analysed_has_readings_without_a_model(history: eg.History) -> None:
    found = history.explore(3)
    assert found.refusal == NOT_EXPLAINED
    assert {run.predicted is None for run in found.runs} == {True}
    assert "no model stands beside them" in view_of(found).sentence


def test_a_test_of_drives_and_a_missing_one_are_answered(history: eg.History) -> None:
    found = history.explore(4)
    assert (found.refusal, found.runs) == (NO_READINGS, ())
    assert "no readings that could be looked into" in view_of(found).sentence
    with pytest.raises(InputError, match="there is no test 99"):
        history.explore(99)
