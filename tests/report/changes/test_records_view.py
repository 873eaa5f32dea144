"""What is shown of recomputed series, kept plans and campaigns."""

import json
from math import inf

import pytest

from elastogeo.changes import (
    Differing,
    KeptCampaign,
    KeptPlan,
    KeptPlans,
    Recomputed,
    RecomputedTest,
    due_on,
    recomputed_same,
)
from elastogeo.report import html_page, view_of

NOW = 20_600.0
SAME = RecomputedTest("Mill 3: circle XY", 1, "in May", "1.0", "1.0", True)
CLOSE = RecomputedTest("Mill 3: circle XY", 2, "in June", "1.0", "1.0", False)
APART = RecomputedTest(
    "Mill 3: circle XY", 3, "in July", "1.0", "1.0", False, (Differing("document.values[0]", "100.0", "101.0", 0.01),)
)
FAILED = RecomputedTest("Mill 3: circle XY", 4, "in August", "1.0", "1.0", True, (), "test.toml: cannot be read")
MENDED = RecomputedTest("Mill 3: circle XY", 5, "in fall", "1.0", "1.0", False, (), "", True)
SWITCHED = RecomputedTest("Mill 3: circle XY", 6, "in May", "1.0", "2.0", False, (Differing("document.a", "1", "'x'", inf),))
FIRST = RecomputedTest("Mill 3: circle XY", 7, "in May", "", "2.0", False)


def recomputed(*tests: RecomputedTest, **switched: tuple[str, str]) -> Recomputed:
    return Recomputed("shop.db", tests, switched, (), (recomputed_same(tests),))


@pytest.mark.parametrize(
    ("result", "sentence", "supported"),
    [
        (recomputed(), "There is nothing to compute again: the history holds no test.", True),
        (recomputed(SAME, FAILED), "2 of 2 tests came out the same to the last bit.", True),
        (
            recomputed(SAME, CLOSE),
            "1 of 2 tests came out the same to the last bit; 1 in all but last digits, as another platform may.",
            True,
        ),
        (recomputed(SAME, APART), "1 of 2 tests came out the same to the last bit; 1 differ.", False),
        (recomputed(MENDED), "1 that could not be analysed before can be now.", True),
        (recomputed(SWITCHED, FIRST, mill=("1.0", "2.0")), "1 series counts with a new version.", True),
    ],
)
def test_a_recomputation_says_what_came_out(result: Recomputed, sentence: str, supported: bool) -> None:
    view = view_of(result)
    assert (view.sentence, view.supported) == (sentence, supported)
    assert json.loads(json.dumps(view.document, allow_nan=False))["schema"] == "elastogeo.recomputation/1"
    assert sentence in html_page(view)


def test_what_differs_comes_first_with_its_place() -> None:
    view = view_of(recomputed(SAME, CLOSE, FAILED, APART))
    assert [row[4] for row in view.tables[0].rows] == [
        "1 entry differs, by up to 1.0 %", "the same error: test.toml: cannot be read", "the same but for last digits",
        "the same bits",
    ]  # fmt: skip
    assert view.tables[1].rows == (("3", "document.values[0]", "100.0", "101.0"),)
    (check,) = view.checks
    assert "1 of 4 tests differ, first 'in July' at document.values[0]" in check.sentence


def test_a_new_version_is_no_difference_that_alarms() -> None:
    view = view_of(recomputed(SWITCHED, mill=("1.0", "2.0")))
    assert len(view.tables) == 1
    assert view.notes == ("mill was computed by elastogeo 1.0, and counts with 2.0 now.",)
    assert view.checks[0].passed is None


def plan(name: str, due: float | None, done: float | None = None) -> KeptPlan:
    return KeptPlan(3, "Mill 3", name, NOW - 50, due_on(due, 7.0, NOW), done, ("xy", "yz"), 24.4, {})


def test_plans_say_what_is_overdue() -> None:
    plans = (
        plan("spring", NOW - 10),
        plan("soon", NOW),
        plan("later", NOW + 3),
        plan("some day", None),
        plan("old", None, NOW),
    )
    view = view_of(KeptPlans("shop.db", NOW, plans))
    assert view.sentence == "1 of 4 open plans is overdue: spring (Mill 3)."
    assert [row[5].partition(" (")[0] for row in view.tables[0].rows] == [
        "overdue by 3 days", "due 27 May 2026, the grace runs", "due 30 May 2026", "no date", "done 27 May 2026",
    ]  # fmt: skip
    entries = view.document["plans"]
    assert [one["state"] for one in entries] == ["overdue", "due", "not due", "no date", "done"]
    assert entries[0]["due"] == "2026-05-17T00:00:00Z"
    assert view.tables[0].rows[0][3:5] == ("xy and yz", "24")


@pytest.mark.parametrize(
    ("plans", "sentence"),
    [
        ((), "No plan is open."),
        ((plan("a", None, NOW),), "No plan is open."),
        ((plan("a", NOW),), "1 plan is open, none overdue."),
    ],
)
def test_plans_without_any_late_say_so(plans: tuple[KeptPlan, ...], sentence: str) -> None:
    assert view_of(KeptPlans("shop.db", NOW, plans)).sentence == sentence


def campaign(**given: object) -> KeptCampaign:
    parameter = {"name": "C_XXX", "value": 61.92, "unit": "nm/N", "interval95": [61.8, 62.0], "separated": True}
    whole = {"parameters": [parameter, {**parameter, "name": "C_YYY", "interval95": None}], "test": {"simulated": "a truth"}}
    known = {"key": 1, "machine": "Mill 3", "name": "spring", "made_at": NOW, "software": "1.0", "tests": {"xy": 4, "yz": 5}}
    return KeptCampaign(**{**known, "supported": True, "error": "", "document": whole, **given})


@pytest.mark.parametrize(
    ("given", "ending"),
    [
        ({}, "support what was asked."),
        ({"supported": False}, "do not support what was asked."),
        ({"same_bits": True}, "it is the same to the last bit."),
        ({"same_bits": False}, "it differs in last digits only."),
        ({"same_bits": False, "differing": (Differing("document.a", "1", "2", 0.5),)}, "it differs."),
        ({"document": None, "error": "test.toml: cannot be read"}, "cannot be read"),
    ],
)
def test_a_campaign_says_what_its_tests_support(given: dict[str, object], ending: str) -> None:
    view = view_of(campaign(**given))
    assert view.sentence.endswith(ending)
    assert json.loads(json.dumps(view.document, allow_nan=False))["schema"] == "elastogeo.campaign-kept/1"


def test_a_simulated_campaign_says_so_beside_its_numbers() -> None:
    view = view_of(campaign())
    assert view.origin == "Simulated: a truth"
    alone = "a test alone"
    assert view.tables[0].rows == (("C_XXX", "61.92 ± 0.10", "nm/N", alone), ("C_YYY", "61.9", "nm/N", alone))
    assert view.tables[0].note == "Without ±: the runs are too few for an uncertainty."
    assert view.tables[1].keys == (4, 5)


def test_parts_have_a_line_of_their_own() -> None:
    assert str(APART) == "test 3, in July: 1 entry differs, by up to 1.0 %"
    assert str(plan("spring", NOW - 10)) == "spring, Mill 3: overdue by 3 days (was due 17 May 2026)"
    assert str(APART.differing[0]) == "document.values[0]: 100.0 is now 101.0"
