"""A document that is made when it is first read: once, and the same whoever reads it."""

from __future__ import annotations

import json

from elastogeo.changes import FleetPart, Trend
from elastogeo.report import pdf_page, view_of
from elastogeo.report.changes.fleets import part_view
from elastogeo.report.later import Later, LaterRows
from tests.report.changes.cases import guideway
from tests.report.changes.fleet_cases import shop


def test_it_is_made_once_and_only_when_it_is_read():
    made = []
    document = Later(lambda: made.append(1) or {"rows": [{"a": 1}, {"a": 2}]})
    rows = LaterRows(lambda: document["rows"])
    assert made == []
    assert json.loads(json.dumps(dict(document))) == {"rows": [{"a": 1}, {"a": 2}]}
    assert (list(rows), len(rows), rows[-1], rows[1:]) == ([{"a": 1}, {"a": 2}], 2, {"a": 2}, [{"a": 2}])
    assert document == {"rows": [{"a": 1}, {"a": 2}]}
    assert made == [1]


def test_an_entry_that_is_there_already_does_not_make_the_rest():
    made = []
    document = Later(lambda: made.append(1) or {"map": [1, 2], "section": "XY"}, {"section": "XY"})
    assert document["section"] == "XY"
    assert made == []
    assert dict(document) == {"map": [1, 2], "section": "XY"}


def test_what_is_shown_of_a_fleet_makes_no_document(monkeypatch):
    def fail(*_):
        raise AssertionError("the document was made though nobody read it")

    monkeypatch.setattr(part_view, "fleet_json", fail)
    view = view_of(FleetPart(shop()))
    assert view.table("machines").rows
    assert view.sentence


def test_a_trend_says_its_points_as_rows_too():
    view = view_of(Trend(guideway(), ""))
    assert list(view.rows) == view.document["chart"]["points"]
    assert len(view.rows) == len(guideway().series)


def test_what_is_made_later_is_a_report_for_the_file_too():
    assert pdf_page(view_of(guideway())).startswith(b"%PDF-")
