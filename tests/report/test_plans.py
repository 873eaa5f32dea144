"""The view of a plan: answer first, pictures that draw, a document of plain numbers."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.planning import Means, Plan, candidates
from elastogeo.report import sentence_of, view_of
from elastogeo.report.drawing.style import house_style
from elastogeo.report.plans.rows import what_of, where_of

HERMLE = eg.read_machine("hermle_c50")


@pytest.fixture(scope="module")
def planned() -> Plan:
    return eg.plan(Means(HERMLE, readings=12), tests=4, count=25)


def test_the_answer_comes_first(planned: Plan) -> None:
    view = view_of(planned)
    assert re.match(
        r"4 tests in \d+ min determine \d+ of at most 56 combinations of 180 compliances, \d+ of them", view.sentence
    )
    assert len(view.values) in (4, 5)
    assert [row[0] for row in view.tables[0].rows] == ["1", "2", "3", "4"]
    assert "nan" not in str(planned).lower()
    assert len(repr(planned)) < 500
    assert len(str(planned).splitlines()) < 40


def test_every_picture_draws(planned: Plan) -> None:
    pictures = view_of(planned).pictures
    assert list(pictures) == ["volume", "growth", "knowledge"]
    with house_style():
        drawn = {name: picture.draw() for name, picture in pictures.items()}
    volume = drawn["volume"]
    marks = [text.get_text() for text in volume.axes[0].texts]
    assert marks == ["1", "2", "3", "4"]
    titles = [ax.get_title() for ax in drawn["knowledge"].axes]
    assert titles == ["joint X", "joint Y", "joint Z", "joint A", "joint C"]


def test_the_document_has_plain_numbers_and_the_same_ones(planned: Plan) -> None:
    found = json.loads(planned.to_json())
    assert found["schema"] == "elastogeo.plan/1"
    assert found["rank"] == planned.rank
    assert len(found["tests"]) == 4
    assert found["tests"][0]["commands"]["X"][0] <= found["tests"][0]["commands"]["X"][1]
    assert len(found["parameters"]) == 180
    assert {p["known"] for p in found["parameters"]} <= {"alone", "sum", "unseen"}
    assert [p["name"] for p in found["parameters"] if p["standard_uncertainty"] is None] == [
        p.name for p in planned.parameters if p.known == "unseen"
    ]


def test_the_worst_uncertainty_is_shown_with_its_unit(planned: Plan) -> None:
    """A plan that supports all says U of 95 %, twice the standard uncertainty, in nm/N."""
    tool = replace(planned.tools[0], share=1.0, median=1e-6, worst=1.25e-6)
    sure = replace(planned, tools=(tool,), supported=1.0)
    values = {value.name: value for value in view_of(sure).values}
    assert (values["U"].value, values["U"].unit) == ("2.50", "nm/N")
    assert values["supported"].value == "100"


def test_checks_say_what_to_do(planned: Plan) -> None:
    said = {check.name: sentence_of(check) for check in planned.verdict}
    assert "will be supported in 0 % of the volume" in said["workspace supported"]
    assert re.search(r"\d+ more tests? supports? all of it|draw more candidates", said["workspace supported"])
    assert np.isfinite(planned.tools[0].worst_with_prior)


@pytest.mark.parametrize(
    ("instrument", "words"),
    [
        ("static-force", "force and sensor"),
        ("displacement-probes", "3 forces, 3 probes"),
        ("sensor-frame", "3 forces, 8 sensors"),
        ("joint-probe", "probe across"),
        ("ball-bar", "R 1[05]0 mm"),
    ],
)
def test_a_test_of_any_instrument_is_said_in_words(instrument: str, words: str) -> None:
    for one in candidates(Means(HERMLE, readings=12), [instrument], 3):
        assert re.search(words, what_of(one))
        assert re.search(r"X −?\d+", where_of(one))


def test_a_ball_roller_test_is_said_in_words() -> None:
    test = eg.read_test("examples/ball-roller")
    (one,) = candidates(Means(test.machine, devices={"ball-roller": test.setup}), ["ball-roller"], 1)
    assert what_of(one).startswith("XY circle, R ")


def test_what_was_asked_for_is_on_the_first_screen_and_why_on_the_page() -> None:
    view = view_of(eg.plan(Means(HERMLE, readings=12), parameters="C_XXX", count=10))
    values = {value.name: value for value in view.values}
    assert values["C_XXX"].value.startswith("U = ")
    assert values["C_XXX"].unit in ("nm/N", "pm/N")
    points = " ".join(point for section in view.sections for point in section.points)
    assert "No test between tool and workpiece tells C_XXX by itself" in points
