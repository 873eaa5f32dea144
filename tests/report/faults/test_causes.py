"""What a page says of the causes of a circle, and how it draws the trace."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from math import atan2, hypot

import numpy as np
import pytest

from elastogeo.formats import read_test
from elastogeo.identification import cause_parts, diagnose, identify
from elastogeo.observe import Imperfection, Question
from elastogeo.report import causes_document, plot_of, plot_svg
from elastogeo.report.drawing.plots import Line, Mark, Text
from elastogeo.report.faults.columns import for_a_page
from elastogeo.sources import simulate
from tests.history.analyses.kept import EXAMPLES


@pytest.fixture(scope="module")
def told(separated):
    return causes_document(separated)


def test_every_cause_is_a_row_and_the_set_up_is_none(told, separated) -> None:
    machine = {p.name for p in separated.parameters if p.axis}
    assert {name for cause in told["causes"] for name in cause["names"]} >= machine
    assert not {name for cause in told["causes"] for name in cause["names"]} & {"E_Xt0", "E_Yt0"}
    lengths = [cause["length"] for cause in told["causes"]]
    assert lengths == sorted(lengths, reverse=True)
    assert (lengths[0], len(told["columns"]["causes"])) == (100.0, len(lengths))
    assert {cause["kind"] for cause in told["causes"]} == {"compliance", "geometry"}
    assert json.loads(json.dumps(told, allow_nan=False))["columns"] == told["columns"]


def test_what_cannot_be_told_apart_is_said_with_the_cause(make_test) -> None:
    test = replace(make_test("wFYXt", (100.0, 400.0), readings=24, repeats=2), question=Question(("loaded-xy",)))
    result = identify(simulate(test, {"C_XXX": 6e-5, "C_YYY": 5e-5}, Imperfection(noise=7e-5), seed=1))
    found = causes_document(result)
    first = next(cause for cause in found["causes"] if cause["names"][0] == "C_XXX")
    others = [name for name in result["C_XXX"].stands_for if name != "C_XXX"]
    assert others
    assert all(name in first["together"] for name in others)


def test_a_drawing_is_true_to_its_scale() -> None:
    diagnosis = diagnose(read_test(EXAMPLES / "ball-bar-diagnosis"))
    parts = for_a_page(cause_parts(diagnosis))
    polar = causes_document(diagnosis)["polars"][0]
    plot = plot_of(polar["plot"])
    lines = [shape for shape in plot.shapes if isinstance(shape, Line) and shape.kind in ("blue", "orange")]
    assert [line.kind for line in lines] == ["blue", "orange"]
    assert sum(isinstance(shape, Mark) for shape in plot.shapes) == 2
    for line, sense in zip(lines, (1, -1), strict=True):
        run = next(run for run in parts.runs if run.force == polar["force_N"] and run.sense == sense)
        first = np.column_stack([np.cos(run.angle), np.sin(run.angle), np.ones_like(run.angle)])
        centre = np.linalg.lstsq(first, run.measured, rcond=None)[0]
        centred = 1000 * (run.measured - first[:, :2] @ centre[:2])
        x, y = np.array(line.points).T[:, : len(run.angle)]
        drawn = [hypot(a - polar["centre"][0], b - polar["centre"][1]) for a, b in zip(x, y, strict=True)]
        assert (np.array(drawn) - polar["radius"]) / polar["per_um"] == pytest.approx(centred, abs=0.02 / polar["per_um"])
        turned = [atan2(polar["centre"][1] - b, a - polar["centre"][0]) for a, b in zip(x, y, strict=True)]
        assert np.cos(turned) == pytest.approx(np.cos(run.angle), abs=1e-4)
        assert np.sin(turned) == pytest.approx(np.sin(run.angle), abs=1e-4)


def test_all_forces_have_one_magnification_and_stay_inside(told) -> None:
    assert len({(polar["radius"], polar["per_um"]) for polar in told["polars"]}) == 1
    for polar in told["polars"]:
        plot = plot_of(polar["plot"])
        points = [point for shape in plot.shapes if isinstance(shape, Line) for point in shape.points]
        assert all(0 <= x <= plot.width and 0 <= y <= plot.height for x, y in points)
        assert f"{polar['title']}, magnified" in plot_svg(plot)
        texts = [shape for shape in plot.shapes if isinstance(shape, Text)]
        written = sorted(shape.y for shape in texts if re.fullmatch(r"[+−]\d.*|0 µm", shape.text))
        assert min(np.diff(written)) >= 24, "values of rings do not cover each other, on a phone neither"


def test_a_cause_has_as_many_digits_as_its_uncertainty(told) -> None:
    known = [cause for cause in told["causes"] if cause["uncertainty"]]
    assert known
    for cause in known:
        assert len(cause["distortion"].partition(".")[2]) == len(cause["uncertainty"].partition(".")[2]), cause


def test_the_lead_adds_up(told, separated) -> None:
    elastic = 100 * sum(p.share for p in separated.parameters if p.elastic)
    assert f"ompliance makes {elastic:.0f} %" in told["lead"] or f"ompliance {elastic:.0f} %" in told["lead"]
    assert "742 N" in told["lead"]


def test_other_results_have_no_causes(poor) -> None:
    assert causes_document(object()) is None
    assert causes_document(poor)["columns"]["runs"]
