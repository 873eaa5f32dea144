"""What a person is shown of a verdict: the answer first, true to the numbers, on every page that there may be."""

import json
import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from elastogeo.changes import ALARM, Drift, DueDate, Event, OpenAlarm
from elastogeo.cli.screen import show_view
from elastogeo.report import html_page, view_of
from elastogeo.report.changes.answers import drift_said
from elastogeo.report.changes.events import letter
from elastogeo.report.changes.trends.dates import date_ticks
from elastogeo.report.changes.words import change_said, changed, to_place_of
from elastogeo.report.days import date_said, days_said, iso_date
from elastogeo.report.drawing.style import house_style
from elastogeo.report.drawing.svg import drawn
from tests.report.changes.cases import CASES, DAY_ONE, collision, guideway, healthy, many, nothing, suspect, two_tests

SIZES = {"stiffness X": 16_100.0}


@pytest.mark.parametrize("name", CASES)
def test_every_case_says_its_answer_and_makes_a_document(name, capsys):
    verdict = CASES[name]()
    view = view_of(verdict)
    document = json.loads(json.dumps(dict(view.document), allow_nan=False))
    assert document["schema"] == "elastogeo.change/1"
    assert document["state"] == verdict.state
    assert document["sentence"] == view.sentence
    assert verdict.state in view.badge.text.lower()
    assert "nan" not in f"{view.sentence} {view.advice} {view.values} {view.tables}".lower()
    assert "Simulated" in view.origin
    show_view(view)
    shown = capsys.readouterr().out
    assert view.sentence in shown
    assert view.badge.mark in shown


@pytest.mark.parametrize("name", CASES)
def test_every_page_draws_and_no_word_lies_on_another(name):
    """Words of the trend, by their boxes as matplotlib measures them."""
    view = view_of(CASES[name]())
    assert html_page(view).count('<p class="badge') == 1
    if view.picture is None:
        assert name == "nothing"
        return
    with house_style():
        figure = view.picture.draw()
        FigureCanvasAgg(figure).draw()
    boxes = [(text.get_text(), text.get_window_extent()) for text in _texts(figure)]
    overlapping = [(one, other) for k, (one, a) in enumerate(boxes) for other, b in boxes[:k] if a.overlaps(b) and a != b]
    assert overlapping == []
    width, height = figure.canvas.get_width_height()
    assert [text for text, box in boxes if box.x0 < -1 or box.x1 > width + 1 or box.y0 < -1 or box.y1 > height + 1] == []


def _texts(figure):
    axes = figure.axes[0]
    legend = [text for box in figure.legends for text in box.get_texts()]
    low, high = axes.get_ylim()
    values = [text for at, text in zip(axes.get_yticks(), axes.get_yticklabels(), strict=True) if low <= at <= high]
    every = [*axes.texts, axes.title, *axes.get_xticklabels(), *values, *legend, axes._left_title]
    return [text for text in every if text.get_text() and text.get_visible()]


def test_the_sentence_of_a_guideway_says_size_side_date_and_component():
    verdict = guideway()
    view, worst = view_of(verdict), verdict.changed[0]
    lost = -100 * worst.change / worst.mean
    assert view.sentence.startswith(f"Hermle C50 no. 3 is {lost:.0f} % softer in X than its baseline (95 %: ")
    assert f"since {date_said(worst.change_point.date)}, and it goes on" in view.sentence
    assert view.sentence.endswith("this points to the X guideway, or to what this series cannot tell from it.")
    low, high = (float(x) for x in re.search(r"95 %: ([\d.]+) to ([\d.]+) %", view.sentence).groups())
    assert low < lost < high
    assert "This series cannot tell the X guideway from the X carriage." in view.advice
    assert view.advice[-1].startswith("Next: acknowledge the alarm and look at the X guideway")
    assert view.document["points_to"] == ["guideway X"]


def test_the_strongest_alarm_is_the_picture_and_the_first_value():
    view = view_of(guideway())
    assert view.picture.caption.startswith("Stiffness X over time.")
    assert view.values[0].name == "Stiffness X"
    assert view.document["chart"]["indicator"] == "stiffness X"
    assert view.document["chart"]["baseline"]["tests"] == 10


def test_the_table_of_indicators_says_state_in_words_and_shape():
    rows = {row[0]: row for row in view_of(guideway()).tables[0].rows}
    assert rows["Stiffness X"][6] == "■ alarm"
    assert rows["Stiffness Y"][6] == "● steady"
    assert rows["Stiffness X"][3] == "N/µm"
    assert rows["Squareness XY"][3] == "µrad"


def test_marks_of_tests_follow_the_indicator_that_moved():
    document = view_of(collision()).document["chart"]
    assert [point["mark"] for point in document["points"]] == ["baseline"] * 10 + ["judged"] * 8 + ["suspect", "alarm"]
    events = document["events"]
    assert [event["letter"] for event in events] == list("ABCDE")
    assert events[0]["kind"] == "crash"


def test_a_test_set_aside_stays_in_the_table_with_its_reason():
    view = view_of(guideway())
    tests = next(section for section in view.sections if section.title == "Tests").tables[0]
    row = next(row for row in tests.rows if row[1] == "test 20")
    assert row[6:] == ("○ set aside", "set aside")


def test_a_suspect_test_asks_for_a_repeat_and_names_no_alarm():
    view = view_of(suspect())
    assert "may have changed" in view.sentence
    assert "more backlash in Y" in view.sentence
    assert "Repeat" in view.document["next"]
    assert "■" not in f"{view.badge}{view.tables}"


def test_an_acknowledged_alarm_says_who_and_why():
    view = view_of(collision())
    assert view.badge.text.endswith(", acknowledged")
    assert ("Acknowledged", "A. Smith, 24 May 2025: rails are measured on Monday") in view.head
    assert "A. Smith acknowledged it" in view.advice[-1]


def test_an_alarm_held_back_under_an_instrument_says_so():
    held = replace(guideway(), alarm=OpenAlarm(DAY_ONE, held_by="LDBB 0042"))
    assert "moved alike with instrument LDBB 0042" in view_of(held).advice[0]


def test_without_causes_no_component_is_named():
    view = view_of(replace(guideway(), causes=(), cannot_tell=()))
    assert "points to" not in view.sentence
    assert "guideway" not in f"{view.sentence}{view.advice}"


def test_a_component_that_explains_little_is_not_called_the_cause():
    verdict = guideway()
    weak = replace(verdict, causes=(replace(verdict.causes[0], share=0.3),))
    view = view_of(weak)
    assert view.sentence.endswith("no single component explains it.")
    assert view.document["points_to"] == []


def test_due_dates_are_said():
    steady = healthy()
    late = replace(steady, due=DueDate(steady.now - 19, 7.0, "overdue", 12.0))
    assert "is overdue by 12 days" in view_of(late).advice[-1]
    assert view_of(replace(steady, due=None)).advice == ()
    coming = replace(steady, due=DueDate(DAY_ONE + 366, 7.0, "not due"))
    assert view_of(coming).advice == ("Next: test again on 9 December 2024.",)


def test_a_limit_that_is_passed_is_not_foretold():
    one = guideway().changed[0]
    passed = replace(one.drift, limit_at=None)
    assert "has passed its tolerance" in drift_said(one, passed)
    endless = replace(one.drift, limit_at_interval=(one.drift.end + 100, np.inf))
    assert "to no end that can be said" in drift_said(one, endless)
    never = replace(one.drift, limit=np.nan, limit_at=None)
    assert drift_said(one, never).endswith("a year.")


@pytest.mark.parametrize(
    ("name", "kind", "change", "said"),
    [
        ("stiffness X", "stiffness", -1.0, "is 5 % softer in X"),
        ("stiffness at 45 deg", "stiffness", -1.0, "is 5 % softer at 45 deg"),
        ("stiffness Y at the ends of X", "stiffness", 1.0, "is 5 % stiffer in Y at the ends of X"),
        ("squareness XY", "squareness", 1.0, "shows the angle between X and Y 5 % smaller"),
        ("squareness XY", "squareness", -1.0, "shows the angle between X and Y 5 % larger"),
        ("scale difference XY", "scale", 1.0, "travels 5 % further in X against Y"),
        ("scale X", "scale", -1.0, "travels 5 % less far in X"),
        ("straightness X in Y", "straightness", -1.0, "bends 5 % more towards −Y along X"),
        ("straightness X", "straightness", 1.0, "is 5 % less straight along X"),
        ("backlash Y", "backlash", 1.0, "has 5 % more backlash in Y"),
        ("circular deviation", "circular deviation", 1.0, "has 5 % more circular deviation"),
        ("systematic deviation X", "positioning", -1.0, "has 5 % less systematic deviation in X"),
        ("friction X", "friction, A", 1.0, "has 5 % more friction in X"),
    ],
)
def test_a_change_is_said_in_the_words_of_its_kind(name, kind, change, said):
    assert changed(name, kind, change, "5 %") == said


def test_two_hundred_tests_are_drawn_and_the_table_says_what_it_leaves_out():
    view = view_of(many())
    tests = next(section for section in view.sections if section.title == "Tests").tables[0]
    assert len(tests.rows) == 60
    assert tests.note == "140 older tests are in the JSON."
    assert len(view.document["chart"]["points"]) == 200
    assert len(drawn(view.picture)) < 300_000


def test_a_series_without_tests_or_with_two_has_a_page():
    assert "has no test yet" in view_of(nothing()).sentence
    assert view_of(nothing()).picture is None
    view = view_of(two_tests())
    assert "2 tests and no baseline" in view.sentence
    assert view.document["next"] == "Make 4 more tests, then set a baseline of 6 tests or more."
    assert view.document["chart"]["baseline"] is None


def test_components_that_are_alike_are_named_once():
    verdict = guideway()
    first, second = verdict.causes
    alike = replace(first, component="carriage X", alike=("guideway X",), score=first.score)
    several = replace(verdict, causes=(first, alike, replace(second, component="rotary axis C", score=0.8, share=0.9)))
    assert view_of(several).sentence.endswith("this points to the X guideway or the C axis.")
    assert view_of(several).document["points_to"] == ["guideway X", "rotary axis C"]


def test_many_simulations_are_named_by_the_first_and_their_number():
    verdict = guideway()
    named = replace(verdict, series=replace(verdict.series, simulated="\n".join(f"seed {k}" for k in range(12))))
    assert view_of(named).origin == "Simulated: seed 0 and 11 more"
    assert view_of(named).document["simulated"].count("seed") == 12


def test_no_change_has_no_sign():
    one = guideway()["stiffness Y"]
    assert change_said(replace(one, change=1e-9, change_interval=(-300.0, 300.0))) == "0.0 %"
    assert change_said(replace(one, change=-200.0, change_interval=(-500.0, 100.0))).startswith("−")


def test_free_text_is_shown_as_text():
    odd = Event("note", DAY_ONE + 3, '<script>alert("x")</script> & [bold]', "<b>")
    page = html_page(view_of(replace(guideway(), events=(odd,))))
    assert "<script>alert" not in page
    assert "&lt;script&gt;" in page


def test_a_test_that_determines_nothing_of_an_indicator_is_left_out_of_its_trend():
    verdict = guideway()
    value = verdict.series.value.copy()
    value[12] = np.nan
    view = view_of(replace(verdict, series=replace(verdict.series, value=value)))
    assert view.document["chart"]["points"][12]["value"] is None
    ElementTree.fromstring(drawn(view.picture))


def test_more_events_than_letters_have_letters_still():
    assert [letter(k) for k in (0, 25, 26, 27, 51, 52)] == ["A", "Z", "AA", "AB", "AZ", "BA"]


def test_dates_are_said_as_a_calendar_has_them():
    assert date_said(0.0) == "1 January 1970"
    assert date_said(19_700.0) == "9 December 2023"
    assert iso_date(20_000.5) == "2024-10-04T12:00:00Z"
    assert iso_date(float("inf")) is None
    assert [days_said(x) for x in (0.0, 0.2, 1.0, 1.5)] == ["0 days", "1 day", "1 day", "2 days"]


@pytest.mark.parametrize("span", [1.0, 8.0, 40.0, 90.0, 400.0, 1200.0, 9000.0])
def test_an_axis_of_time_has_two_to_six_dates_inside_it(span):
    ticks = date_ticks(DAY_ONE, DAY_ONE + span)
    assert 1 <= len(ticks) <= 6
    assert min(ticks) >= DAY_ONE
    assert max(ticks) <= DAY_ONE + span
    assert len(set(ticks.values())) == len(ticks)


@pytest.mark.parametrize(
    ("value", "step", "said"),
    [(14.3127, 0.21, "14.31"), (-0.0001, 0.2, "0.00"), (123.4, 26.0, "123"), (-2.5, 0.1, "−2.50"), (0.5, 0.0, "0.500")],
)
def test_a_value_is_written_to_the_place_that_its_scatter_needs(value, step, said):
    assert to_place_of(value, step) == said


def test_parts_say_themselves_in_one_line():
    verdict = guideway()
    assert str(verdict["stiffness X"]).startswith("stiffness X: ■ alarm, 13.98 N/µm, −10.6 % (95 %: ")
    for part in (*verdict.steps, *verdict.causes, *verdict.events, verdict.change_point, verdict.alarm, verdict.due):
        assert "\n" not in repr(part)
        assert repr(part)
    assert isinstance(verdict["stiffness X"].drift, Drift)
    assert "a year" in repr(verdict["stiffness X"].drift)
    assert verdict.state == ALARM
    assert "■ Alarm since" in repr(verdict)
