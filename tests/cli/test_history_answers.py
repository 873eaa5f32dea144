"""`elastogeo history list` and `show`: what a maintenance engineer reads of simulated machines."""

import json

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.history.alarms.assessing import assess
from elastogeo.history.store import open_store
from tests.history.alarms.shop import DAY, START, make_series, make_test


@pytest.fixture(scope="module")
def shop(tmp_path_factory):
    """A machine whose X guideway goes soft, one that stays as it was, one without a baseline; the path of the history."""
    path = tmp_path_factory.mktemp("shop") / "shop.db"
    store = open_store(path, create=True, who="the tests")
    random = np.random.default_rng(3)
    for name, fault, tests in (("Mill 3", 0.012, 20), ("Mill 4", 0.0, 16), ("Mill 5", 0.0, 3)):
        of = make_series(store, name, interval=30.0)
        for k in range(tests):
            soft = 1 - fault * max(k - 11, 0)
            values = {
                "stiffness X": ("stiffness", 16_000 * soft * (1 + 0.006 * random.standard_normal())),
                "backlash X": ("backlash", 1e-3 + 1e-4 * random.standard_normal()),
            }
            make_test(store, of, START + 10 * k * DAY, values)
        with eg.History(path, who="the tests") as history:
            if tests > 10:
                history.set_baseline(name, first=10, why="as delivered")
        assess(store, of)
    store.close()
    return path


def test_list_shows_the_fleet_the_worst_first(shop, elastogeo):
    code, out, err = elastogeo("history", "list", "--store", shop)
    assert (code, err) == (0, "")
    assert "Mill 3 is " in out
    assert "Simulated: numbers" in out
    lines = [line for line in out.splitlines() if line.startswith("Mill ") and "2026" in line]
    named = [line[:6] for line in lines if not line.startswith("Mill 3 is")]
    assert named[0] == "Mill 3"
    assert sorted(named) == ["Mill 3", "Mill 4", "Mill 5"]
    assert "■ alarm" in lines[-3]


def test_list_gives_the_document_of_the_fleet(shop, elastogeo):
    code, out, _ = elastogeo("history", "list", "--store", shop, "--json")
    document = json.loads(out)
    assert code == 0
    assert document["schema"] == "elastogeo.fleet/1"
    states = {row["name"]: row["state"] for row in document["rows"]}
    assert states["Mill 3"] == "alarm"
    assert {row["id"] for row in document["rows"]} == {1, 2, 3}


def test_show_says_what_changed_and_what_to_do(shop, elastogeo):
    code, out, err = elastogeo("history", "show", "Mill 3", "--store", shop)
    assert (code, err) == (0, "")
    assert "softer in X than its baseline" in out
    assert "Next: " in out
    assert "■ Alarm since" in out
    steady = elastogeo("history", "show", "Mill 4", "--store", shop)[1]
    assert "Mill 4 is as its baseline shows it" in steady


def test_show_writes_the_report_and_the_document(shop, elastogeo, tmp_path):
    code, _, _ = elastogeo("history", "show", "Mill 3", "xy", "--store", shop, "--report", tmp_path / "r")
    assert code == 0
    assert {"report.html", "report.pdf", "report.json", "trend.svg"} <= {file.name for file in (tmp_path / "r").iterdir()}
    document = json.loads(elastogeo("history", "show", "Mill 3", "xy", "--store", shop, "--json")[1])
    assert document["schema"] == "elastogeo.change/1"
    assert document["series"] == "XY 200"
    assert json.loads((tmp_path / "r" / "report.json").read_text())["sentence"] == document["sentence"]


def test_the_fleet_and_the_machine_say_the_same_of_a_series(shop):
    with eg.History(shop) as history:
        row = next(row for row in history.fleet().machines if row.machine == "Mill 3")
        verdict = history.verdict("Mill 3")
        machine = history.machine("Mill 3")
    assert (row.state, row.since) == (verdict.state, verdict.since)
    assert row.change == pytest.approx(verdict[row.indicator].change)
    assert machine.series[0].state == verdict.state
    assert verdict.series.machine == "Mill 3"


def test_what_is_not_there_is_said_with_what_is(shop, elastogeo, tmp_path):
    code, out, err = elastogeo("history", "show", "Mil 3", "--store", shop)
    assert (code, out) == (2, "")
    assert "did you mean 'Mill 3'?" in err
    code, _, err = elastogeo("history", "list", "--store", tmp_path / "none.db")
    assert code == 2
    assert "elastogeo history init" in err
