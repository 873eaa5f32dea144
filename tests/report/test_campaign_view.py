"""What is shown of several tests: the tests, what each adds, what they tell together; and that it is simulated."""

from __future__ import annotations

from pathlib import Path

import pytest

from elastogeo.formats import read_campaign
from elastogeo.identification import Identification, identify
from elastogeo.report.view import view_of

EXAMPLE = Path(__file__).parents[2] / "examples" / "hermle-c50-campaign"


@pytest.fixture(scope="module")
def two() -> Identification:
    return identify(
        read_campaign([EXAMPLE / "xy", EXAMPLE / "zx"]), parameters=["C_XXX", "C_YYY", "C_ZZZ", "E_XX1", "E_ZZ1"]
    )


def test_the_first_screen_says_what_the_tests_tell_together(two) -> None:
    view = view_of(two)
    assert view.subtitle == "xy + zx"
    assert view.origin == "Simulated for this example; see README.md beside campaign.toml."
    assert "only by the 2 tests together" in view.sentence
    assert dict(view.head)["Tests"] == "xy, zx"
    assert dict(view.head)["Runs"] == "12, with 864 readings"


def test_every_test_has_its_row_and_every_level_its_test(two) -> None:
    tests, _, levels = view_of(two).tables
    assert [row[0] for row in tests.rows] == ["xy", "zx"]
    rank = tests.headings.index("rank")
    assert [row[rank] for row in tests.rows] == [str(part.rank) for part in two.tests]
    assert [(row[0], row[1]) for row in levels.rows] == [(t, f) for t in ("xy", "zx") for f in ("112", "364", "742")]


def test_the_document_has_the_entries_of_each_test(two) -> None:
    document = two.to_dict()
    assert document["test"]["name"] == "xy + zx"
    assert document["test"]["runs"] == 12
    assert len(document["test"]["files"]) == 12
    assert document["test"]["files"][0]["run"] == "xy/112N-1"
    for entry, part in zip(document["tests"], two.tests, strict=True):
        assert entry["id"] == part.name
        assert entry["rank"] == part.rank
        assert entry["rmse_um"] == 1000 * part.rmse
        assert entry["scatter_um"] == pytest.approx(1000 * part.scatter)
        assert entry["information"] == {name: shares[part.name] for name, shares in two.information.items()}
    assert document["together"] == list(two.together)


def test_the_report_is_written(two, tmp_path) -> None:
    page = two.report(tmp_path / "report")
    assert "The tests" in page.read_text(encoding="utf-8")
