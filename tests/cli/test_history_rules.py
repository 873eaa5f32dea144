"""`elastogeo history rules`: the rule tried out, on any machine and on one's own."""

import json

import pytest

from elastogeo.history import History
from elastogeo.history.store import open_store
from tests.history.alarms.shop import DAY, START, make_series, make_test

FEW = ("--machines", 200, "--tests", 12)


@pytest.fixture
def shop(tmp_path):
    """A history with ten tests of one machine, two weeks apart, the last one far off; its path."""
    path = tmp_path / "shop.db"
    store = open_store(path, create=True, who="the tests")
    of = make_series(store)
    for k in range(10):
        off = (0, 1, -1, 2, -2, 1, 0, -1, 0, -40)[k]
        make_test(store, of, START + 14 * k * DAY, {"stiffness X": ("stiffness", 16_000.0 + 100 * off)})
    store.close()
    return path


def test_any_machine_is_simulated_and_said_to_be(elastogeo):
    code, out, _ = elastogeo("history", "rules", *FEW, "--interval", 10)
    assert code == 0
    assert "Of 200 simulated machines that do not change" in out
    assert "alarm at least once in 12 tests (120 days)" in out
    assert "1 test, 10 days" in out
    assert "not in 12 tests" in out
    code, out, _ = elastogeo("history", "rules", *FEW, "--json")
    found = json.loads(out)
    assert found["schema"] == "elastogeo.rules/1"
    assert 0 <= found["false_alarms95"][0] <= found["false_alarms"] <= found["false_alarms95"][1] <= 1
    assert found["recorded"] is None
    assert any(one["most"] is None for one in found["faults"])


def test_alpha_is_what_false_alarms_are_made_from(elastogeo):
    rates = []
    for alpha in ("0.0001", "0.05"):
        rates.append(json.loads(elastogeo("history", "rules", *FEW, "--alpha", alpha, "--json")[1])["false_alarms"])
    assert rates[0] < 0.05 < 0.2 < rates[1]


def test_one_s_own_series_gives_scatter_interval_and_what_was_recorded(shop, elastogeo):
    words = ("history", "rules", "C50 no. 3", "--store", shop)
    code, _, err = elastogeo(*words)
    assert code == 2
    assert "has no baseline; set one first" in err
    with History(shop) as history:
        history.set_baseline("C50 no. 3", why="new machine", first=8)
    code, out, _ = elastogeo(*words, *FEW)
    assert code == 0
    assert "alpha 0.005" in out
    assert "Recorded after the baseline: 2 tests, 1 beyond a limit" in out
    found = json.loads(elastogeo(*words, *FEW, "--json")[1])
    assert found["interval_days"] == 14
    assert found["baseline_tests"] == 8
    assert [one["name"] for one in found["indicators"]] == ["stiffness X"]
    assert found["indicators"][0]["relevance"] == pytest.approx(0.03)


def test_a_baseline_too_short_for_any_alarm_is_not_supported(elastogeo):
    code, _, err = elastogeo("history", "rules", "--baseline", 5)
    assert code == 1
    assert "below 6 nothing is ever suspect" in err


def test_the_report_and_the_line_of_a_fault(tmp_path, elastogeo):
    from elastogeo.changes import try_rule

    code, _, _ = elastogeo("history", "rules", *FEW, "--report", tmp_path / "out")
    assert code == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Simulated" in page
    found = try_rule(machines=20, tests=3)
    assert repr(found.faults[0]).startswith("stiffness X, step of ")
    assert found.to_dict()["schema"] == "elastogeo.rules/1"
