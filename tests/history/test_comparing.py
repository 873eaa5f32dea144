"""Two tests of a history against each other: the kept numbers say what asking both files again says."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.changes import FEW_RUNS, NOT_ANALYSED, NOTHING_IN_COMMON, OTHER_MACHINE
from elastogeo.errors import InputError
from elastogeo.history.analyses import analyse
from elastogeo.history.comparing import determined_by
from elastogeo.history.store import write
from elastogeo.report import view_of
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test

FOLDER = EXAMPLES / "three-axis-campaign"


@pytest.fixture(scope="module")
def history(tmp_path_factory: pytest.TempPathFactory) -> Iterator[eg.History]:
    """Two circles of one machine in two series, one of another machine, a static test, and one that was not analysed."""
    with eg.History(tmp_path_factory.mktemp("compare") / "h.db", create=True, who="the tests") as history:
        store = history.store
        machine = {"../machine.toml": (FOLDER / "machine.toml").read_bytes()}
        circles = keep_series(store), keep_series(store, name="circle XY, elsewhere")
        for series, name, day in ((circles[0], "1-xy", 0), (circles[1], "4-xy", 5), (circles[0], "1-xy", 9)):
            keep_test(store, series, files_of(FOLDER / name) | machine, day, name=f"{name} of day {day}")
        other = keep_series(store, machine="Mill 4")
        keep_test(store, other, files_of(FOLDER / "1-xy") | machine, 1)
        keep_test(store, keep_series(store, name="static"), files_of(EXAMPLES / "static-force"), 2)
        keep_test(store, circles[0], files_of(FOLDER / "1-xy") | machine, 30, name="not analysed")
        for test in (1, 2, 3, 4, 5):
            analyse(store, test)
        yield history


def test_the_kept_results_compare_as_the_files_do(history: eg.History) -> None:
    kept = history.compare(2, 1)
    direct = eg.compare(eg.read_test(FOLDER / "1-xy"), eg.read_test(FOLDER / "4-xy"))
    assert (kept.before.key, kept.after.key, kept.refusal, kept.unjudged) == (1, 2, "", "")
    assert [one.difference.name for one in kept.parameters] == [one.name for one in direct.differences]
    for one, other in zip(kept.parameters, direct.differences, strict=True):
        found = one.difference
        assert (found.before, found.after, found.unit) == (other.before, other.after, other.unit)
        assert found.change.value == other.change.value
        assert found.change.standard_uncertainty == pytest.approx(other.change.standard_uncertainty, rel=1e-12)
        assert found.change.degrees_of_freedom == pytest.approx(other.change.degrees_of_freedom, rel=1e-9)
        assert found.p_value == pytest.approx(other.p_value, rel=1e-9)
    assert kept.joint is not None
    assert kept.joint.p_value == pytest.approx(direct.joint.p_value, rel=1e-6)
    assert (kept.joint.q, kept.joint.degrees_of_freedom) == (direct.joint.q, pytest.approx(direct.joint.degrees_of_freedom))
    shown, said = view_of(kept).table("parameters"), view_of(direct).tables[0]
    assert shown is not None
    assert shown.rows == said.rows


def test_both_circles_are_there_as_they_were_read(history: eg.History) -> None:
    kept = history.compare(1, 2)
    assert kept.radius == 100.0
    assert kept.axes == ("X", "Y")
    assert {(trace.later, trace.sense) for trace in kept.traces} == {(False, 1), (True, 1)}
    run = eg.read_test(FOLDER / "1-xy").observations()[0]
    trace = next(one for one in kept.traces if not one.later and one.run == run.run)
    np.testing.assert_array_equal(trace.deviation, run.reading)
    names = view_of(kept).pictures
    assert list(names) == [f"circles-{force:g}" for force in sorted({one.force for one in kept.traces}, reverse=True)]


def test_settings_that_differ_are_told_and_the_recipe_among_them_marked(history: eg.History) -> None:
    with write(history.store) as connection:
        connection.exec_driver_sql("""UPDATE series SET recipe = '{"setup": {"radius": 100.0}}' WHERE id = 1""")
        connection.exec_driver_sql("""UPDATE series SET recipe = '{"setup": {"radius": 150.0}}' WHERE id = 2""")
    kept = history.compare(1, 2)
    assert [(one.name, one.before, one.after, one.in_recipe) for one in kept.settings] == [
        ("setup.radius", 100.0, 150.0, True)
    ]
    view = view_of(kept)
    assert "two recipes, which differ by radius" in view.advice[0]
    assert view.badge is not None
    assert view.badge.text == "No baseline to judge by"


def test_what_does_not_compare_says_why_in_a_sentence(history: eg.History) -> None:
    for pair, refusal, sentence in (
        ((1, 4), OTHER_MACHINE, "These tests are of two machines, Mill 3 and Mill 4: what differs is no change of one"),
        ((1, 5), NOTHING_IN_COMMON, "These tests determine nothing in common (circle XY; static)"),
        ((1, 6), NOT_ANALYSED, "was not analysed by the version its chart counts with: run elastogeo history recompute"),
    ):
        found = history.compare(*pair)
        view = view_of(found)
        assert found.refusal == refusal
        assert sentence in view.sentence
        assert view.badge is not None
        assert view.badge.text == "Not comparable"
        assert view.document["comparable"] is False
        assert not found.parameters
        assert not found.traces
    with pytest.raises(InputError, match="there is no test 99"):
        history.compare(1, 99)
    with pytest.raises(InputError, match="this is one test; choose another"):
        history.compare(1, 1)


def test_equal_tests_of_one_series_differ_by_nothing(history: eg.History) -> None:
    found = history.compare(1, 3)
    assert found.one_recipe
    assert found.indicators
    assert {one.change.value for one in found.indicators} == {0.0}
    assert found.joint is not None
    assert found.joint.p_value == pytest.approx(1.0)
    assert found.verdict[0].passed is True
    assert "no baseline" in view_of(found).advice[0]
    assert not view_of(replace(found, unjudged=FEW_RUNS, parameters=(), joint=None)).table("parameters")


def test_a_kept_result_without_its_correlation_judges_nothing() -> None:
    document = eg.identify(eg.read_test(Path(FOLDER / "1-xy"))).to_dict()
    assert determined_by(document).judged
    assert not determined_by(document | {"correlation": None}).judged
