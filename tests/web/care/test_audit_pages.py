"""A long audit trail is shown at once, and checked when somebody asks."""

from __future__ import annotations

import pytest

import elastogeo as eg
from elastogeo.web.asking import READER
from elastogeo.web.care import audit as page
from tests.web.care.conftest import Visit


def test_a_long_trail_is_checked_when_somebody_asks(
    visit: Visit, history: eg.History, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page, "QUICK", 2)
    for number in range(4):
        history.add_instrument(f"X-{number}")
    shown = visit(READER).get("/audit").text
    assert "whether all are as they were written was not looked at" in shown
    assert "Check the whole trail" in shown
    asked = visit(READER).get("/audit?check=true").text
    assert "is as it was written" in asked
    assert "Check the whole trail" not in asked


def test_older_rows_follow_page_by_page_without_one_lost(
    visit: Visit, history: eg.History, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page, "PAGE", 3)
    for number in range(7):
        history.add_instrument(f"X-{number}")
    found: list[int] = []
    before = ""
    for _ in range(20):
        rows = [row["number"] for row in visit(READER).get(f"/audit.json{before}").json()["rows"]]
        found += rows
        if len(rows) < 3:
            break
        before = f"?before={rows[-1]}"
    assert found == list(range(history.audit(1).count, 0, -1))
    assert "Older rows" in visit(READER).get("/audit").text


@pytest.mark.parametrize("query", ["before=0", "before=x", "before=-1", "who=" + "x" * 300])
def test_what_is_no_search_is_refused_without_an_echo(visit: Visit, query: str) -> None:
    answer = visit(READER).get(f"/audit?{query}")
    assert answer.status_code == 422
    assert "What was sent does not fit" in answer.text
    assert query.partition("=")[2] not in answer.text or len(query) < len("before=-10")


def test_a_subject_leads_to_its_page(visit: Visit, history: eg.History) -> None:
    history.acknowledge(1, "seen")
    history.add_instrument("X-1")
    shown = visit(READER).get("/audit").text
    assert '<a href="/alarms/1">alarm 1</a>' in shown
    assert '<a href="/instruments/2">instrument 2</a>' in shown
