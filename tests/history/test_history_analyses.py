"""Plans and recomputations through the door of the history and on the command line."""

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import elastogeo as eg
from elastogeo.cli import main
from elastogeo.history.analyses import analyse, campaign_text, keep_campaign
from elastogeo.history.store import open_store
from tests.history.analyses.kept import EXAMPLES, files_of, keep_series, keep_test
from tests.history.conftest import Clock

PLAN = {"schema": "elastogeo.plan/1", "tests": [{"name": "xy"}], "minutes": 12.0}
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def plan_file(tmp_path: Path) -> Path:
    file = tmp_path / "spring.json"
    file.write_text(json.dumps(PLAN), encoding="utf-8")
    return file


@pytest.fixture
def shop(tmp_path: Path) -> str:
    """A history with one machine and one test that was analysed, in a file of SQLite."""
    url = str(tmp_path / "shop.db")
    with open_store(url, create=True, who="the tests") as store:
        analyse(store, keep_test(store, keep_series(store), files_of(EXAMPLES / "static-rig")))
    return url


@pytest.fixture
def run(shop: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """A command of the group on that history: its exit code, standard output and standard error."""

    def do(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["elastogeo", "history", *map(str, arguments), "--store", shop])
        code = main()
        out, err = capsys.readouterr()
        return code, out, err

    return do


def test_plans_are_kept_listed_and_done_on_the_command_line(run: Run, plan_file: Path, standing_clock: Clock) -> None:
    code, out, _ = run("plan", plan_file, "--machine", "Mill 3", "--due", "2026-03-20", "--grace", 2)
    assert (code, "1 plan is open, none overdue." in out) == (0, True)
    standing_clock.advance(days=25)
    code, out, _ = run("plan", "--json")
    (entry,) = json.loads(out)["plans"]
    assert (code, entry["name"], entry["machine"], entry["state"]) == (0, "spring", "Mill 3", "overdue")
    assert entry["due"] == "2026-03-20T12:00:00Z"
    code, out, _ = run("plan", "--done", entry["number"], "--why", "on Sunday")
    assert (code, "No plan is open." in out) == (0, True)


def test_a_plan_needs_its_machine(run: Run, plan_file: Path) -> None:
    code, out, err = run("plan", plan_file)
    assert (code, out) == (2, "")
    assert "say --machine with its name" in err
    code, _, err = run("plan", plan_file, "--machine", "Mill 9")
    assert (code, "Mill 9" in err) == (2, True)


@pytest.mark.parametrize(
    ("content", "message"),
    [(None, "cannot be opened"), ("{", "is no JSON"), ("[]", "holds no JSON object"), ("{}", "a document without a schema")],
)
def test_what_is_no_plan_file_is_refused(run: Run, tmp_path: Path, content: str | None, message: str) -> None:
    file = tmp_path / "plan.json"
    if content is not None:
        file.write_text(content, encoding="utf-8")
    code, _, err = run("plan", file, "--machine", "Mill 3")
    assert (code, message in err) == (2, True)


def test_what_is_no_date_is_refused(run: Run, plan_file: Path) -> None:
    code, _, err = run("plan", plan_file, "--machine", "Mill 3", "--due", "1 May")
    assert (code, "the due date is '1 May'; write 2026-05-01" in err) == (2, True)


def test_a_plan_of_this_program_is_kept_as_it_is(shop: str) -> None:
    found = eg.plan(eg.read_machine("hermle_c50"), tests=1, count=3)
    with eg.History(shop, who="A. Miller") as history:
        number = history.keep_plan(found, machine="Mill 3", name="summer", due="2026-05-01T08:00+02:00")
        (kept,) = history.plans("Mill 3").plans
    assert (kept.key, kept.name, len(kept.tests)) == (number, "summer", 1)
    assert kept.document == json.loads(found.to_json())
    assert kept.due.at == pytest.approx(20_574.25)


def test_recomputing_says_the_same_bits_and_exits_with_0(run: Run) -> None:
    code, out, _ = run("recompute")
    assert (code, "1 of 1 tests came out the same to the last bit." in out) == (0, True)


def test_what_differs_by_the_same_version_exits_with_1(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """As after a change of the program without a change of its version."""
    monkeypatch.setattr("elastogeo.history.analyses.computation.view_of", Changed)
    code, out, _ = run("recompute", "--json")
    assert code == 1
    (test,) = json.loads(out)["tests"]
    assert test["same_bits"] is False
    assert test["differing"]


class Changed:
    """What a changed program would show."""

    supported = True

    def __init__(self, result: object) -> None:
        self.document = {"schema": type(result).__name__, "value": 1.0}


def test_a_new_version_judges_the_series_again_and_tells_nobody(shop: str, monkeypatch: pytest.MonkeyPatch) -> None:
    judged: list[tuple[int, int | None]] = []
    monkeypatch.setattr(
        "elastogeo.history.records.assess", lambda _, series, live=None: judged.append((series, live)), raising=True
    )
    for module in ("analysing", "recomputing"):
        monkeypatch.setattr(f"elastogeo.history.analyses.{module}.VERSION", "99.0")
    with eg.History(shop) as history:
        found = history.recompute()
    assert found.switched == {"Mill 3: circle XY": (eg.__version__, "99.0")}
    assert judged == [(1, None)]


def test_campaigns_are_listed_shown_and_asked_again(run: Run, shop: str) -> None:
    machine = {"../machine.toml": (EXAMPLES / "three-axis-campaign" / "machine.toml").read_bytes()}
    with open_store(shop) as store:
        files = {name: files_of(EXAMPLES / "three-axis-campaign" / name) | machine for name in ("1-xy", "2-yz")}
        tests = {name: keep_test(store, 1, found, name=name) for name, found in files.items()}
        keep_campaign(store, campaign_text("spring", tests, ["C_XXX", "C_YYY"]), tests)
    code, out, _ = run("campaign")
    assert (code, re.findall(r"^spring\s+Mill 3\s.*\s2\s+not supported\s+1$", out, re.MULTILINE) != []) == (0, True)
    code, out, _ = run("campaign", 1)
    assert (code, "Campaign: spring, Mill 3" in out, "Computed again" in out) == (1, True, False)
    code, out, _ = run("campaign", 1, "--recompute", "--json")
    kept = json.loads(out)
    assert (code, kept["same_bits"], kept["tests"]) == (1, True, tests)
    code, _, err = run("campaign", 2)
    assert (code, "there is no campaign 2" in err) == (2, True)


def test_a_history_without_campaigns_says_so(run: Run) -> None:
    assert "No campaign is kept" in run("campaign")[1]
    assert json.loads(run("campaign", "--json")[1])["campaigns"] == []
