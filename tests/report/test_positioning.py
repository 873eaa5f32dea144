"""A positioning test on paper: values with U in the right unit, the JSON with its numbers, the picture, the sentences."""

from __future__ import annotations

import json
import re
from math import pi

import numpy as np
import pytest
from matplotlib.figure import Figure

from elastogeo.identification import PositioningResults, evaluate_positioning, identify
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import Imperfection, KnownInfluence, MachineTest, Positioning, Question, Run
from elastogeo.report import html_page, view_of
from elastogeo.report.drawing.style import house_style
from elastogeo.report.drawing.svg import drawn
from elastogeo.report.positioning.document import POSITIONING_SCHEMA, positioning_json
from elastogeo.sources import simulate

TARGETS = (-190.0, -120.0, -35.0, 42.0, 117.0, 180.0)


def evaluated(setup: Positioning, topology: str = "wFXYZt", noise: float = 2e-4, **values: float) -> PositioningResults:
    machine = Machine("<mill>", parse_topology(topology), tool=(0.0, 0.0, -50.0))
    known = (KnownInfluence("sensor-scale", "laser", relative=2e-6),)
    blank = MachineTest("test", machine, setup, (Run("run", {}),), Question(), influences=known)
    return evaluate_positioning(simulate(blank, values, Imperfection(noise=noise, angle_noise=noise), 3, exact=False))


@pytest.fixture(scope="module")
def linear() -> PositioningResults:
    return evaluated(Positioning("X", targets=TARGETS), E_XX1=2e-5, B_XX=0.004)


@pytest.fixture(scope="module")
def rotary() -> PositioningResults:
    degrees = np.deg2rad([0.0, 40.0, 95.0, 130.0, 190.0, 240.0, 300.0, 350.0])
    return evaluated(Positioning("C", targets=tuple(degrees)), "wCFXYZt", noise=2e-7, E_CCc1=2e-5, B_CC=5e-6)


def test_the_first_screen_has_the_answer(linear: PositioningResults) -> None:
    view = view_of(linear)
    assert view.kind == "Positioning test"
    assert view.sentence.startswith("Positioning of X: A = ")
    assert [value.name for value in view.values] == ["A", "E", "R", "B", "M"]
    shown = {value.name: value for value in view.values}
    estimate = linear.values["B"].estimate
    assert estimate is not None
    assert shown["B"].unit == "µm"
    value, expanded = (float(part) for part in shown["B"].value.split(" ± "))
    assert value == pytest.approx(1000 * estimate.value, rel=0.05)
    assert expanded == pytest.approx(1000 * estimate.expanded(), rel=0.05)
    assert ("Axis", "X, 6 targets from −190 to 180 mm, 5 cycles") in view.head
    assert any(note.startswith("Abbe: read 50.0 mm off the frame of X; 1 µrad of E_BX is") for note in view.notes)


def test_a_rotary_axis_is_shown_in_seconds_of_arc_over_degrees(rotary: PositioningResults) -> None:
    view = view_of(rotary)
    shown = {value.name: value for value in view.values}
    assert shown["B"].unit == "″"
    assert float(shown["B"].value.split(" ± ")[0]) == pytest.approx(5e-6 * 180 * 3600 / pi, rel=0.3)
    assert any("from 0 to 350 °" in text for _, text in view.head)
    drift = next(check.sentence for check in view.checks if check.name == "free of drift")
    assert "″ one way" in drift


def test_the_document_has_every_number_and_survives_json(linear: PositioningResults, rotary: PositioningResults) -> None:
    document = json.loads(json.dumps(positioning_json(linear), allow_nan=False))
    assert document["schema"] == POSITIONING_SCHEMA == "elastogeo.positioning/1"
    assert (document["axis"], document["unit"], document["target_unit"], document["along"]) == ("X", "um", "mm", True)
    by_name = {entry["name"]: entry for entry in document["values"]}
    assert list(by_name) == list(linear.values)
    for name, value in linear.values.items():
        assert by_name[name]["value"] == pytest.approx(1000 * value.value)
        assert by_name[name]["measurement_uncertainty"] == pytest.approx(1000 * value.measurement)
    assert [one["target"] for one in document["targets"]] == list(TARGETS)
    assert document["joints"]["schema"] == "elastogeo.identification/1"
    assert json.loads(json.dumps(positioning_json(rotary)))["unit"] == "arcsec"


def test_every_key_of_the_document_is_described(linear: PositioningResults) -> None:
    import elastogeo.report.positioning.document as module

    document = positioning_json(linear)
    keys = set(document) | set(document["values"][0]) | set(document["values"][0]["contributions"][0])
    keys |= set(document["targets"][0])
    described = set(re.findall(r"\w+", module.__doc__ or ""))
    assert keys - {"schema", "software"} <= described


def one_way(cycles: int) -> PositioningResults:
    target = np.tile(TARGETS, cycles)
    random = np.random.default_rng(5)
    columns = {"target": target, "direction": -np.ones(len(target)), "deviation": 1e-3 * random.standard_normal(len(target))}
    machine = Machine("m", parse_topology("wFXYZt"))
    return evaluate_positioning(MachineTest("test", machine, Positioning("X"), (Run("run", columns),)))


@pytest.mark.parametrize("cycles", [1, 5])
def test_one_direction_and_one_cycle_are_shown_without_what_they_lack(cycles: int) -> None:
    view = view_of(one_way(cycles))
    assert {value.name for value in view.values} == ({"E−"} if cycles == 1 else {"A−", "E−", "R−"})
    assert all(("±" in value.value) == (cycles > 1) for value in view.values)
    assert "nan" not in " ".join(" ".join(cells) for table in view.tables for cells in table.rows).lower()
    assert view.picture is not None
    assert b"</svg>" in drawn(view.picture)


def test_the_picture_shows_readings_means_limits_and_spans(linear: PositioningResults) -> None:
    view = view_of(linear)
    assert view.picture is not None
    with house_style():
        figure = view.picture.draw()
    assert isinstance(figure, Figure)
    (axes,) = figure.axes
    dots = [line for line in axes.get_lines() if line.get_linestyle() == "None"]
    assert sum(len(line.get_xdata()) for line in dots) == 60
    means = next(line for line in axes.get_lines() if line.get_label() == "mean, +")
    np.testing.assert_allclose(means.get_ydata(), 1000 * linear.targets.mean[:, 0])
    spans = [text.get_text() for text in axes.texts if "=" in text.get_text()]
    assert [text[:2] for text in spans] == ["A ", "E ", "M "]


def test_the_page_holds_no_markup_of_names(linear: PositioningResults) -> None:
    view = view_of(linear)
    page = html_page(view, {name: drawn(picture) for name, picture in view.pictures.items()})
    assert "<mill>" not in page
    assert "&lt;mill&gt;" in page


def test_angles_are_shown_as_angles_in_an_identification_too() -> None:
    """0.2 urad/mm over the travel are 74 microradians, never micrometres; the document says null rather than um."""
    found = evaluated(Positioning("X", about=(0.0, 1.0, 0.0), targets=TARGETS), noise=4e-7, E_BX1=2e-7)
    assert found.joints is not None
    view = view_of(found.joints)
    parameters = view.tables[0]
    first = dict(zip(parameters.headings, parameters.rows[0], strict=True))
    assert float(first["peak to peak [µrad]"]) == pytest.approx(370 * 0.2, rel=0.1)
    assert "RMSE [µrad]" in view.tables[1].headings
    document = view.document
    assert document["rmse_um"] is None
    assert document["parameters"][0]["peak_to_peak_um"] is None
    assert document["levels"][0]["rmse_um"] is None
    assert document["tests"][0]["rmse_urad"] == pytest.approx(0.4, rel=0.5)
    assert view.picture is not None
    with house_style():
        (axes,) = view.picture.draw().axes
    assert axes.get_ylabel() == "reading (µrad)"
    assert axes.get_xlabel() == "target (mm)"


def test_the_resolution_of_angles_is_judged_and_shown_as_an_angle() -> None:
    """1 urad: the backlash of 0.1 urad is below it, the pitch of 74 urad over the travel is not."""
    setup = Positioning("X", about=(0.0, 1.0, 0.0), targets=TARGETS)
    machine = Machine("m", parse_topology("wFXYZt"))
    blank = MachineTest("test", machine, setup, (Run("run", {}),), Question(("E_BX1", "B_BX")), resolution=1e-6)
    found = identify(simulate(blank, {"E_BX1": 2e-7, "B_BX": 1e-7}, Imperfection(angle_noise=2e-8), 3, exact=False))
    view = view_of(found)
    said = next(check.sentence for check in view.checks if check.name == "above resolution")
    assert said.startswith("B_BX (0.1 µrad) moves the readings by less than their resolution of 1 µrad")
    assert ("Resolution", "1.00 µrad") in view.head
    assert view.document["test"]["resolution_um"] is None
