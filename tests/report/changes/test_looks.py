"""What a person looks at: a part of a fleet, one indicator, what a search found."""

import json
from collections import Counter
from dataclasses import replace

import pytest
from matplotlib.colors import to_hex

from elastogeo.changes import ALARM, OVERDUE, STEADY, WATCH, FleetPart, Found, FoundEntry, Trend
from elastogeo.report import view_of
from elastogeo.report.changes.answers import worst_of
from elastogeo.report.changes.trends.figures import trend_figure
from elastogeo.report.changes.trends.plot import trend_plot
from elastogeo.report.drawing.plots import Mark
from elastogeo.report.drawing.style import house_style
from tests.report.changes.cases import collision, guideway, many, nothing, suspect
from tests.report.changes.fleet_cases import NOW, SOFTER, fleet_of, large, row

SHOP = fleet_of(
    row("Mill 1", ALARM, NOW - 90, place="hall 1", model="C50", key=1, **SOFTER),
    row("Mill 2", STEADY, place="hall 2", model="C50", key=2, overdue=3.0),
    row("Mill 3", WATCH, place="hall 2", model="KX8", key=3),
)


def test_a_part_shows_what_fits_and_counts_what_else_could_be_asked():
    view = view_of(FleetPart(SHOP, place="hall 2"))
    assert [cells[0] for cells in view.table("machines").rows] == ["Mill 2", "Mill 3"]
    assert view.table("machines").keys == (2, 3)
    assert [one["name"] for one in view.document["rows"]] == [one["name"] for one in view.rows] == ["Mill 2", "Mill 3"]
    states = dict(zip(view.table("states").keys, view.table("states").rows, strict=True))
    assert {state: int(cells[1]) for state, cells in states.items() if cells[1] != "0"} == {STEADY: 1, WATCH: 1, OVERDUE: 1}
    halls = view.table("halls")
    assert halls.rows == (("hall 1", "1"), ("hall 2", "2"))
    assert halls.strong == (1,)
    assert view.table("models").rows == (("C50", "1"), ("KX8", "1"))
    assert view.sentence == view_of(SHOP).sentence


def test_overdue_are_those_in_another_state_too():
    assert [one.machine for one in FleetPart(SHOP, state=OVERDUE).machines] == ["Mill 2"]
    assert [one.machine for one in FleetPart(SHOP, state=STEADY).machines] == ["Mill 2"]
    assert (
        view_of(FleetPart(SHOP, model="KX8", state=ALARM))
        .table("machines")
        .note.endswith("No machine fits what is asked for.")
    )


def test_a_hundred_machines_are_shown_and_the_document_holds_all_that_fit():
    fleet = large()
    view = view_of(FleetPart(fleet, first=150))
    table = view.table("machines")
    assert [cells[0] for cells in table.rows] == [one.machine for one in fleet.machines[150:]]
    assert "Machines 151 to 200 of 200" in table.note
    assert len(view.document["rows"]) == 200


def test_each_row_has_a_strip_of_its_indicators_in_shape_and_words():
    strips = view_of(FleetPart(SHOP)).table("machines").sparks
    marks = [shape for shape in strips[0].shapes if isinstance(shape, Mark)]
    assert [(mark.shape, mark.kind) for mark in marks] == [("square", "bad"), ("up", "care"), *(("circle", "good"),) * 6]
    assert marks[0].title == "stiffness X: alarm, at 2.1 of its limit"
    assert strips[0].alternative == "Indicators: 1 alarm, 1 watch, 6 steady"


@pytest.mark.parametrize("case", [guideway, collision, suspect, many])
def test_figure_and_plain_shapes_mark_the_same_tests_alike(case):
    verdict = case()
    one = worst_of(verdict)
    shapes = {"o": "circle", "D": "diamond", "s": "square", "x": "cross", "^": "up", "v": "down"}
    with house_style():
        lines = [line for line in trend_figure(verdict, one).axes[0].lines if line.get_marker() in shapes]
    drawn = Counter()
    for line in lines:
        hollow = line.get_marker() == "o" and to_hex(line.get_markerfacecolor()) == "#ffffff"
        drawn["ring" if hollow else shapes[line.get_marker()]] += len(line.get_xdata())
    plain = Counter(shape.shape for shape in trend_plot(verdict, one).shapes if isinstance(shape, Mark))
    off = sum(plain[edge] for edge in ("up", "down"))
    assert sum(plain.values()) == len(verdict.series)
    assert plain["square"] == drawn["square"]
    assert plain["diamond"] == drawn["diamond"]
    assert plain["circle"] == drawn["circle"]
    assert plain["ring"] + off == drawn["ring"]


def test_a_trend_is_of_the_indicator_that_is_asked_for_and_of_its_last_days():
    verdict = guideway()
    view = view_of(Trend(verdict, "backlash Y", 365.0, first=2))
    assert view.title == "Backlash Y"
    column = verdict.series.indicators.index("backlash Y")
    assert [point["value"] for point in view.rows] == list(verdict.series.value[:, column])
    assert view.table("tests").keys == verdict.series.tests[::-1][2:]
    marks = [shape for shape in view.picture.plain().shapes if isinstance(shape, Mark)]
    assert len(marks) == sum(day >= verdict.series.date[-1] - 365 for day in verdict.series.date)
    assert json.loads(json.dumps(dict(view.document), allow_nan=False))["schema"] == "elastogeo.trend/1"


def test_a_trend_of_nothing_says_so():
    view = view_of(Trend(replace(nothing(), indicators=())))
    assert view.picture is None
    assert view.sentence == "No test determines an indicator yet."
    assert list(view.rows) == []


def test_the_answer_says_what_changed_and_why_in_words_that_a_page_sets_bold():
    for case in (guideway, collision, suspect):
        view = view_of(case())
        assert view.strong
        assert view.strong[0] in view.sentence
    assert view_of(nothing()).strong == ()


def test_a_search_counts_what_it_found_and_says_when_there_is_more():
    entries = (
        FoundEntry("machines", 3, "Mill 3", "C50", 3),
        FoundEntry("series", 7, "circle", "Mill 3", 3),
        FoundEntry("tests", 9, "circle in May", "Mill 3", 3, NOW),
        FoundEntry("tests", 8, "circle in April", "Mill 3", 3, NOW - 30),
    )
    view = view_of(Found("mill", entries, ("tests",)))
    assert view.sentence == "Found: 1 machine, 1 series and more than 2 tests."
    assert view.table("series").keys == ("3?series=7",)
    assert view.table("tests").keys == (9, 8)
    assert "write more words" in view.table("tests").note
    assert str(entries[0]) == "machines: Mill 3 (C50)"
    assert view_of(Found("xyz", ())).sentence.startswith("Nothing is called so.")
