"""The trend as plain shapes: every test where its value and date put it, no word on another, no word outside."""

import json
from dataclasses import replace

import numpy as np
import pytest

from elastogeo.changes import ALARM
from elastogeo.report import plot_of, plot_svg, view_of
from elastogeo.report.changes.answers import worst_of
from elastogeo.report.changes.trends.plot import spark_plot, trend_plot
from elastogeo.report.drawing.plots import Band, Circle, Line, Mark, Text
from tests.report.changes.cases import CASES, collision, guideway, healthy, many, nothing, suspect

DRAWN = [name for name in CASES if name != "nothing"]
LETTER = 7.4
"""Width of a letter of 12 px DejaVu Sans, measured over the words of a trend."""


def plots(name):
    verdict = CASES[name]()
    one = worst_of(verdict)
    return verdict, one, [trend_plot(verdict, one), trend_plot(verdict, one, narrow=True)]


@pytest.mark.parametrize("name", DRAWN)
def test_no_word_lies_on_another_or_outside(name):
    for plot in plots(name)[2]:
        words = [shape for shape in plot.shapes if isinstance(shape, Text) and shape.kind != "paper"]
        boxes = []
        for word in words:
            wide = len(word.text) * LETTER
            left = word.x - {"start": 0, "middle": wide / 2, "end": wide}[word.anchor]
            boxes.append((word.text, left, left + wide, word.y - 9, word.y + 3))
        for text, left, right, top, bottom in boxes:
            assert -1 <= left < right <= plot.width + 1, text
            assert 0 <= top < bottom <= plot.height, text
        for k, (text, left, right, top, bottom) in enumerate(boxes):
            for other, a, b, c, d in boxes[:k]:
                assert right <= a or b <= left or bottom <= c or d <= top, (text, other)


@pytest.mark.parametrize("name", DRAWN)
def test_every_test_lies_where_the_ticks_put_its_value_and_the_dates_its_day(name):
    verdict, one, (plot, narrow) = plots(name)
    column = verdict.series.indicators.index(one.name)
    for drawn in (plot, narrow):
        marks = {mark.link: mark for mark in drawn.shapes if isinstance(mark, Mark)}
        assert set(marks) == set(verdict.series.tests)
        ticks = [(shape.y - 4, float(shape.text.replace("−", "-"))) for shape in drawn.shapes if is_value(shape)]
        assert len(ticks) >= 3
        slope, start = np.polyfit([y for y, _ in ticks], [value for _, value in ticks], 1)
        factor = {"N/mm": 1e-3, "mm": 1e3, "mm/mm": 1e6, "rad": 1e6}[one.kind.unit]
        for k, test in enumerate(verdict.series.tests):
            mark, value = marks[test], verdict.series.value[k, column] * factor
            if mark.shape not in ("up", "down"):
                assert start + slope * mark.y == pytest.approx(value, abs=abs(slope) * 0.1)
        by_day = sorted((verdict.series.date[k], marks[test].x) for k, test in enumerate(verdict.series.tests))
        day, x = np.array(by_day).T
        assert np.allclose(np.diff(x), np.diff(day) * (x[-1] - x[0]) / (day[-1] - day[0]))


def is_value(shape):
    return isinstance(shape, Text) and shape.anchor == "end" and shape.x < 40


def test_an_alarm_is_told_by_shape_and_word_and_what_is_pointed_at_says_what_it_is():
    verdict, _, (plot, narrow) = plots("guideway")
    last = next(mark for mark in plot.shapes if isinstance(mark, Mark) and mark.link == verdict.series.tests[-1])
    assert (last.shape, last.kind) == ("square", "bad")
    value = f"{verdict.series.value[-1, 0] * 1e-3:.2f} N/µm"
    assert value in last.title
    assert "% off the baseline" in last.title
    assert last.title.endswith("in alarm")
    words = {shape.text for shape in plot.shapes if isinstance(shape, Text)}
    assert any(word.startswith("alarm ") for word in words)
    assert any(word.startswith("tolerance ") for word in words)
    assert any(word.startswith("baseline: 10 tests") for word in words)
    assert {"A", "B", "C"} <= words
    said = {entry.text for entry in plot.legend}
    assert {"baseline", "in alarm", "running mean"} <= said
    assert any(text.startswith("drift −") and "a year; limit reached in" in text for text in said)
    assert narrow.legend == plot.legend


def test_a_drift_stays_within_the_chart_and_ends_where_its_line_and_its_limit_meet():
    verdict, one, (plot, _) = plots("guideway")
    (cone,) = [shape for shape in plot.shapes if isinstance(shape, Band) and shape.kind == "cone"]
    (line,) = [shape for shape in plot.shapes if isinstance(shape, Line) and shape.kind == "orange"]
    for _, y in (*cone.points, *line.points):
        assert 43.9 <= y <= plot.height - 23.9
    (limit,) = [shape for shape in plot.shapes if isinstance(shape, Line) and shape.kind == "bad" and shape.dashes]
    (x0, y0), (x1, y1) = line.points
    crossing = x0 + (limit.points[0][1] - y0) * (x1 - x0) / (y1 - y0)
    drift, marks = one.drift, {mark.link: mark.x for mark in plot.shapes if isinstance(mark, Mark)}
    day, tests = verdict.series.date, verdict.series.tests
    scale = (marks[tests[-1]] - marks[tests[0]]) / (day[-1] - day[0])
    expected = day[0] + (crossing - marks[tests[0]]) / scale
    steep = drift.end + (one.lower - drift.at_end) / drift.per_year * 365.2425
    assert expected == pytest.approx(steep, abs=2.0)


def test_the_last_year_shows_its_tests_and_one_without_any_shows_all():
    verdict = guideway()
    one = worst_of(verdict)
    since = float(verdict.series.date[-1]) - 365
    shown = {mark.link for mark in trend_plot(verdict, one, since).shapes if isinstance(mark, Mark)}
    assert shown == {test for test, day in zip(verdict.series.tests, verdict.series.date, strict=True) if day >= since}
    assert 5 < len(shown) < len(verdict.series)
    every = {mark.link for mark in trend_plot(verdict, one, since + 1e6).shapes if isinstance(mark, Mark)}
    assert every == set(verdict.series.tests)


def test_events_that_would_cover_each_other_lie_in_rows():
    plot = plots("collision")[2][0]
    circles = [shape for shape in plot.shapes if isinstance(shape, Circle)]
    assert len(circles) == len(collision().events)
    for k, one in enumerate(circles):
        for other in circles[:k]:
            assert np.hypot(one.x - other.x, one.y - other.y) >= 18


@pytest.mark.parametrize("name", DRAWN)
def test_every_indicator_has_a_small_trend_whose_last_value_is_marked_by_its_state(name):
    verdict = CASES[name]()
    table = view_of(verdict).table("indicators")
    assert table.keys == tuple(one.name for one in verdict.indicators)
    assert len(table.sparks) == len(table.rows)
    for one, spark in zip(verdict.indicators, table.sparks, strict=True):
        assert spark == spark_plot(verdict, one)
        mark = next(shape for shape in spark.shapes if isinstance(shape, Mark))
        assert mark.kind == ("bad" if one.state == ALARM else "ink" if one.state not in ("watch", "suspect") else "care")
        line = next(shape for shape in spark.shapes if isinstance(shape, Line))
        assert (mark.x, mark.y) == line.points[-1]
        value = verdict.series.value[~verdict.series.aside, verdict.series.indicators.index(one.name)]
        value = value[np.isfinite(value)][-24:]
        assert len(line.points) == len(value)
        heights = [-y for _, y in line.points]
        assert list(np.argsort(heights, kind="stable")) == list(np.argsort(value, kind="stable"))


def test_what_no_test_determines_is_drawn_empty():
    verdict = healthy()
    value = verdict.series.value.copy()
    value[:, 0] = np.nan
    empty = replace(verdict, series=replace(verdict.series, value=value))
    assert spark_plot(empty, empty.indicators[0]).shapes == ()
    assert "nan" not in plot_svg(trend_plot(empty, empty.indicators[0])).lower()


def test_a_page_finds_tables_by_name_with_the_keys_of_their_rows():
    verdict = suspect()
    view = view_of(verdict)
    assert view.table("tests").keys == verdict.series.tests[::-1]
    assert view.table("nothing of this name") is None
    assert view.picture.plain().to_dict() == trend_plot(verdict, worst_of(verdict)).to_dict()
    assert view.picture.narrow().width < view.picture.plain().width
    assert view_of(nothing()).picture is None


def test_a_trend_is_kept_as_json_and_its_element_is_small():
    verdict = many()
    plot = trend_plot(verdict, worst_of(verdict))
    assert plot_of(json.loads(json.dumps(plot.to_dict(), allow_nan=False))) == plot
    assert len(plot_svg(plot)) < 400 * len(verdict.series) + 12_000
