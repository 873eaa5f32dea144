"""A section through a map as a page shows it: what is said, what is drawn, what is not known."""

from __future__ import annotations

import numpy as np
import pytest

from elastogeo.observe import Question, with_questions
from elastogeo.prediction import ElementMap, map_elements, section_of
from elastogeo.report import view_of
from elastogeo.report.drawing.plots import Band, Line, Mark, Text
from elastogeo.report.predictions.section_plot import levels_of, refined, section_plot
from tests.prediction.circles import MIDDLE, circles

ALONG = {"X": (-200.0, 200.0, 5), "Y": (-150.0, 150.0, 4), "Z": (-100.0, 50.0, 3)}


@pytest.fixture(scope="module")
def found() -> ElementMap:
    return map_elements(circles(reciprocal=True), ALONG)


@pytest.fixture(scope="module")
def little() -> ElementMap:
    return map_elements(with_questions(circles(MIDDLE[:1]), Question(parameters=("C_XXX", "C_YYY"), reciprocal=True)), ALONG)


def test_the_answer_is_the_softest_and_the_stiffest_place_with_u(found: ElementMap) -> None:
    section = section_of(found, "XY", 0, (0, 0, 1))
    view = view_of(section)
    soft = section.softest
    assert soft is not None
    assert f"X {soft.commands['X']:g}".replace("-", "−") in view.sentence
    said = float(view.values[0].value.split(" ± ")[0])
    assert said == pytest.approx(1 / section.compliance.max() / 1000, rel=0.01)
    half = float(view.values[0].value.split(" ± ")[1])
    assert half == pytest.approx(soft.expanded / 1000, rel=0.05)
    assert "at Z −100 mm" in view.subtitle
    assert view.origin.startswith("Simulated")


def test_a_row_is_a_place_and_says_on_what_it_rests(little: ElementMap) -> None:
    rows = view_of(section_of(little, "XY", 1, assumed=True)).rows
    assert len(rows) == 5 * 4
    assert {row["rests_on"] for row in rows} == {"assumption"}
    assert all(row["Z_mm"] == -25.0 for row in rows)
    grey = view_of(section_of(little, "XY", 1)).rows
    assert {(row["stiffness_N_per_um"], row["rests_on"]) for row in grey} == {(None, "")}


def test_what_no_test_tells_has_no_number_and_is_grey(little: ElementMap) -> None:
    section = section_of(little, "XY", 1, (0, 0, 1))
    view = view_of(section)
    assert view.sentence.startswith("Nothing is known of the stiffness along Z")
    assert view.values[-1].value == "0"
    assert {shape.kind for shape in section_plot(section, "").shapes if isinstance(shape, Band)} == {"untold"}


def test_what_rests_on_rigid_joints_is_said_and_dotted(little: ElementMap) -> None:
    section = section_of(little, "XY", 1, assumed=True)
    said = " ".join(view_of(section).advice)
    assert "rests on an assumption" in said
    assert f"{len(little.rigid)} compliances" in said
    dots = [shape for shape in section_plot(section, "").shapes if isinstance(shape, Mark) and shape.kind == "paper"]
    assert len(dots) == section.resting.sum()


def test_contours_run_where_the_field_is_at_their_level(found: ElementMap) -> None:
    section = section_of(found, "XY", 1)
    plot = section_plot(section, "")
    levels = levels_of(section.stiffness / 1000)
    assert [shape.text for shape in plot.shapes if isinstance(shape, Text) and shape.kind == "contour"]
    frame = next(shape for shape in plot.shapes if isinstance(shape, Line) and shape.kind == "line").points
    (left, top), (_, bottom), (right, _), *_ = frame
    field = section.stiffness / 1000
    for line in (shape for shape in plot.shapes if isinstance(shape, Line) and shape.kind == "contour"):
        for x, y in line.points:
            a, b = (x - left) / (right - left) * 4, (bottom - y) / (bottom - top) * 3
            i, j = min(int(a), 3), min(int(b), 2)
            p, q = a - i, b - j
            four = field[i : i + 2, j : j + 2]
            value = (1 - p) * ((1 - q) * four[0, 0] + q * four[0, 1]) + p * ((1 - q) * four[1, 0] + q * four[1, 1])
            assert min(abs(value - level) for level in levels) < 0.1 * (levels[1] - levels[0])


def test_between_places_of_which_one_is_not_known_nothing_is_interpolated() -> None:
    field = np.array([[1.0, 3.0], [np.nan, 3.0]])
    fine = refined(field, 2, ends=False)
    assert fine[0, 0] == 1.0
    assert np.isnan(fine[1, 0])
    assert fine[1, 1] == 3.0
    assert refined(np.array([[1.0, 3.0], [5.0, 7.0]]), 2, ends=True)[1, 1] == 4.0


def test_levels_are_round_and_within() -> None:
    assert levels_of(np.array([10.2, 14.9])) == pytest.approx([11, 12, 13, 14])
    assert levels_of(np.array([5.0, 5.0])) == []
    assert levels_of(np.array([np.nan])) == []
