"""A machine with several series, and a fleet: the worst first, nothing that needs somebody left out."""

import json
from dataclasses import replace

import numpy as np
import pytest

from elastogeo.changes import ALARM, OVERDUE, STEADY
from elastogeo.report import html_page, view_of
from elastogeo.report.changes.fleets.rows import row_said
from tests.report.changes.fleet_cases import (
    FLEETS,
    MACHINES,
    NOW,
    SOFTER,
    fleet_of,
    large,
    moved,
    overdue,
    row,
    several_series,
    shop,
    untested,
)


@pytest.mark.parametrize("name", [*FLEETS, *MACHINES])
def test_every_case_has_a_page_and_a_document_that_say_the_same(name):
    view = view_of({**FLEETS, **MACHINES}[name]())
    document = json.loads(json.dumps(dict(view.document), allow_nan=False))
    page = html_page(view)
    assert document["schema"] in ("elastogeo.fleet/1", "elastogeo.machine/1")
    assert view.sentence.replace("'", "&#39;") in page
    assert "nan" not in f"{view.sentence}{view.advice}{view.values}{view.tables}".lower()
    assert ("Simulated" in page) is (name != "untested")


def test_the_fleet_counts_every_state_and_lists_the_worst_first():
    view = view_of(shop())
    assert view.badge.text == "Alarm: 1 machine"
    assert {value.name: value.value for value in view.values} == {
        "■ Alarm": "1", "◆ Suspect": "1", "▲ Watch": "1", "● Steady": "1", "◷ Overdue": "1", "– No baseline": "1",
    }  # fmt: skip
    assert [line[1] for line in view.tables[0].rows] == [
        "■ alarm", "◆ suspect", "◷ overdue", "▲ watch", "– no baseline", "● steady",
    ]  # fmt: skip
    assert view.sentence == "Hermle C50 no. 3 is 11 % softer in X; no other machine is in alarm."


def test_the_document_of_a_fleet_holds_what_its_page_lists():
    document = view_of(shop()).document
    assert set(document) >= {"counts", "rows", "facets"}
    first = document["rows"][0]
    assert set(first) >= {"id", "name", "hall", "state", "since", "sentence", "strip", "last", "due"}
    assert first["sentence"] == "11 % softer in X; points to the X guideway"
    assert [one["state"] for one in first["strip"]][:2] == ["alarm", "watch"]
    assert document["facets"]["hall"] == {"hall 1": 4, "hall 2": 2}
    assert document["facets"]["state"][ALARM] == 1


def test_an_instrument_with_which_three_machines_moved_is_said_before_them():
    view = view_of(moved())
    assert view.alert == (
        "3 machines moved alike in stiffness X and stiffness Y with instrument LDBB 0042 since 26 July 2026 (Mill 1, Mill 2 "
        "and Mill 3); Mill 9 did not: check the instrument before the machines.",
    )
    assert view.sentence.startswith("Instrument LDBB 0042 seems to have changed, not the machines tested with it")
    assert "held back under instrument LDBB 0042" in view.document["rows"][0]["sentence"]
    assert view.document["instruments"][0]["p_value"] == 0.61


def test_an_alarm_of_another_cause_is_counted_beside_those_held_back():
    fleet = moved()
    own = row("Mill 20", ALARM, NOW - 3, **SOFTER)
    view = view_of(fleet_of(*fleet.machines, own, instruments=fleet.instruments))
    assert "1 machine is in alarm besides" in view.sentence


def test_a_large_fleet_shows_a_hundred_and_says_how_many_more():
    view = view_of(large())
    assert len(view.tables[0].rows) == 100
    assert "Machines 1 to 100 of 200; the JSON holds all." in view.tables[0].note
    assert len(view.document["rows"]) == 200
    assert view.sentence == "All 200 machines are as the baseline shows."


def test_an_empty_fleet_says_what_to_do():
    view = view_of(fleet_of())
    assert view.sentence == "There is no machine yet: add one, then import its tests."
    assert view.badge is None
    assert view.document["rows"] == []
    html_page(view)


def test_a_change_without_numbers_and_a_late_test_are_still_said():
    assert row_said(row("A", ALARM, NOW)) == "changed"
    late = row("B", STEADY, overdue=0.4)
    assert row_said(late) == "test overdue by 1 day"
    unknown = row("C", ALARM, **{**SOFTER, "mean": np.nan})
    assert "nan" not in row_said(unknown)


def test_a_machine_shows_its_worst_series_and_lists_all():
    machine = several_series()
    view, worst = view_of(machine), view_of(machine.series[0])
    assert view.kind == "Machine"
    assert view.sentence == worst.sentence
    assert view.picture.caption == worst.picture.caption
    assert [line[1] for line in view.tables[0].rows] == ["■ alarm", "● steady", "– no baseline"]
    assert "ball bar, YZ, R 100 mm: overdue by 12 days." in view.advice
    document = view.document
    assert set(document) >= {"machine", "series", "verdict", "indicators", "chart", "tests", "due"}
    assert set(document["verdict"]) >= {"state", "since", "sentence", "points_to", "cannot_tell", "next_test"}
    assert set(document["indicators"][0]) >= {"code", "now", "u", "change", "change95", "state", "spark"}
    assert set(document["chart"]) >= {"points", "baseline", "expected", "running_mean", "tolerance", "drift", "events"}
    assert set(document["chart"]["drift"]) >= {"per_year", "limit_at", "limit_at95"}
    assert document["chart"]["expected"] == np.asarray(machine.series[0].changed[0].expected).tolist()
    assert len(document["tests"]) == 34 + 24 + 9


def test_a_machine_of_one_series_needs_no_table_of_series():
    machine = replace(several_series(), series=several_series().series[:1], overdue={})
    assert view_of(machine).tables[0].headings[0] == "indicator"


def test_a_late_machine_says_so_in_its_state():
    view = view_of(overdue())
    assert view.badge.text == "Test overdue by 12 days"
    assert view.document["state"] == OVERDUE
    assert view.document["due"].startswith("2026-08-16")


def test_a_machine_without_tests_has_a_page():
    view = view_of(untested())
    assert "has no test yet" in view.sentence
    assert view.document["series"] == []
    assert view.document["verdict"] == {}
