"""The report of a ball-roller test: the figures and tables of chapter 6 that its results have."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from elastogeo import calibrate, read_run
from elastogeo.identification import StiffnessMap
from elastogeo.report import View, view_of
from elastogeo.report.drawing.svg import drawn
from studies.roller_samples import Mapped

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def found() -> StiffnessMap:
    """With a rig, a dynamometer, and a path that is 4 um off."""
    return Mapped(rig=1.0, dynamometer=1.0, path=0.004).draw((1, 2))


@pytest.fixture(scope="module")
def view(found) -> View:
    return view_of(found)


def table(view: View, section: str, number: int = 0):
    return next(one for one in view.sections if one.title == section).tables[number]


def test_the_first_screen_names_direction_interval_and_every_kind(view) -> None:
    names = [value.name for value in view.values]
    assert names[0].startswith("softest, at ")
    assert names[1].startswith("stiffest, at ")
    assert names[2:] == ["increments", "secants (Eq. 6.5)"]
    assert re.fullmatch(r"95 %: [\d.]+ to [\d.]+ N/µm; compliance [\d.]+ ± [\d.]+ µm/N", view.values[0].meaning)
    # 4 um of path softens the secants, the least most (6.5); the spring is 1 / 0.07 = 14.3 N/um throughout
    secants = [float(word) for word in view.values[3].value.split(" to ")]
    increments = [float(word) for word in view.values[2].value.split(" to ")]
    assert secants[0] < 12.5 < 13.5 < secants[1] < 14.2
    assert increments == pytest.approx([14.3, 14.3], abs=0.5)


def test_every_figure_of_the_chapter_is_drawn(view) -> None:
    assert list(view.pictures)[:5] == ["stiffness", "levels", "rig", "torques", "dynamometer"]
    page = "".join(drawn(view.pictures[name]).decode() for name in list(view.pictures)[:5])
    for words in ("secant (Eq. 6.5)", "load of the ball", "Coulomb friction", "dynamometer", "predicted (Eq. 6.16)", "+X"):
        assert f">{words}<" in page, words


def test_stiffness_by_engagement_stands_beside_what_was_commanded(view) -> None:
    shown = table(view, "Stiffness by engagement")
    assert shown.headings[0] == "engagement [µm]"
    assert [row[0] for row in shown.rows] == ["40", "80", "120", "160", "200"]


def test_the_rig_without_with_and_predicted(view) -> None:
    """Figures 6.13, 6.14: 1 / 2.65 N/um is added, 0.377 um/N."""
    shown = table(view, "With the rig")
    assert [row[0] for row in shown.rows] == [f"secant at {at} µm" for at in (40, 80, 120, 160, 200)] + ["modelled"]
    for name, without, predicted, _ in shown.rows:
        assert float(predicted) - float(without.split()[0]) == pytest.approx(0.377, abs=1e-3), name
    assert float(shown.rows[-1][3].split()[0]) == pytest.approx(0.447, abs=0.02)


def test_forces_stand_beside_those_of_the_dynamometer(view) -> None:
    shown = table(view, "Against the dynamometer")
    assert [row[0] for row in shown.rows] == ["40", "80", "120", "160", "200"]
    for _, runs, dynamometer, current, apart in shown.rows:
        assert runs == "4"
        assert float(current) == pytest.approx(float(dynamometer), rel=0.02)
        assert float(apart) < 20


def test_the_document_holds_what_the_figures_show(view) -> None:
    entries = view.document
    assert entries["engagements_um"] == pytest.approx([40, 80, 120, 160, 200])
    motor = entries["torques"][0]
    assert (motor["axis"], motor["unit"], motor["run"]) == ("X", "N m", "200um-1-1")
    assert motor["peak"]["coulomb"] == pytest.approx(1.55, rel=0.01)
    assert len(motor["angle_deg"]) == len(motor["recorded"]) == len(motor["parts"]["load"]) < 300
    parts = [sum(values) for values in zip(*motor["parts"].values(), strict=True) if None not in values]
    recorded = [value for value in motor["recorded"] if value is not None]
    assert np.sqrt(np.mean(np.subtract(parts, recorded) ** 2)) < 0.08
    rig = entries["rig"]
    assert len(rig["directions"]) == 24
    for entry in rig["directions"]:
        assert entry["predicted_um_per_N"] == pytest.approx(entry["without_um_per_N"] + entry["rig_um_per_N"])
    assert {entry["column"] for entry in entries["dynamometer"]["runs"]} == {"force_x", "force_y"}


def test_the_indicator_test_shows_its_tables_and_what_to_use() -> None:
    """Tables 6.5 and 6.6 of the thesis, from its readings."""
    view = view_of(calibrate(read_run(EXAMPLES / "indicator-test" / "dials.csv").columns, resolution=1e-3))
    assert view.sentence.startswith(
        "At 200 µm the machine gives way by 111 µm (55.5 %), ball and roller bearing by 89 µm (44.5 %)"
    )
    deflections, secants, increments = view.tables
    assert deflections.rows[-1] == ("200", "1290", "3", "86", "89", "111", "55.5")
    assert [row[0] for row in secants.rows] == ["40", "80", "120", "160", "200"]
    assert secants.rows[0][1] == "∞"
    assert [float(row[4].split()[0]) for row in secants.rows] == pytest.approx([6.3, 8.3, 10.1, 11.1, 11.6], abs=0.05)
    assert [float(row[2].split()[0]) for row in increments.rows] == [10.9, 15.0, 14.6, 14.6]
    assert (view.values[0].name, view.values[0].value.split()[0]) == ("machine, increment", "14.6")
    assert not view.document["springs"]["ball"]["secants"][0]["stiffness_N_per_um"]
    assert "machine, increment" in drawn(view.picture).decode()


def test_only_repeats_give_an_interval() -> None:
    columns = read_run(EXAMPLES / "indicator-test" / "dials.csv").columns
    shown = "".join(value.value for value in view_of(calibrate(columns, resolution=1e-3)).values)
    assert "±" not in shown, "read once: the resolution alone is no interval"
    twice = {name: np.concatenate([values, values]) for name, values in columns.items()}
    repeated = view_of(calibrate(twice, resolution=1e-3))
    assert all("±" in value.value for value in repeated.values)
    assert dict(view_of(calibrate(columns)).head)["Resolution"] == "not stated"
