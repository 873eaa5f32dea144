"""Figures and tables of local estimates, of the linear model and of a known truth: what is drawn is what was computed."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from elastogeo.formats import example_test, read_test
from elastogeo.identification import identify
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import Imperfection, MachineTest, Positioning, Question, Run
from elastogeo.report import html_page, view_of
from elastogeo.report.drawing.style import GREEN, GREY, INK
from elastogeo.sources import simulate

GEOMETRY = {"E_XX1": -1.3e-4, "E_YX2": 4.3e-7, "E_YY1": -9.9e-5, "E_Xt0": 0.004}
FALLING = {"C_XXX": 6.2e-5, "C_YYY": 4.6e-5, "CF1_XXX": -2e-8, "CF1_YYY": 1e-8, **GEOMETRY}
FORCES = (100.0, 300.0, 500.0, 700.0)


def figure(result, name):
    return view_of(result).pictures[name].draw()


def tables(result, title):
    """The tables of a section by the beginning of their titles."""
    sections = [section for section in view_of(result).sections if section.title.startswith(title)]
    return {table.title.partition(" (")[0]: table for section in sections for table in section.tables}


def number(text: str) -> float:
    return float(text.replace("−", "-"))


@pytest.fixture(scope="module")
def falling(make_test):
    """Compliances that change, without noise: a constant model is wrong, the linear one exact."""
    test = make_test("wCAFYXZSt", FORCES, readings=90)
    test = replace(test, question=Question(("elasto-geometric-xy",), set_up_per_run=False))
    return identify(simulate(test, FALLING, exact=False))


def fitted(result, forces) -> np.ndarray:
    """Least squares over these levels by numpy alone, from columns and measured traces."""
    columns = np.vstack([one.columns for one in result.responses if one.force in forces])
    readings = np.concatenate([trace.measured for trace in result.traces if trace.force in forces])
    scale = np.linalg.norm(columns, axis=0)
    return np.linalg.lstsq(columns / scale, readings, rcond=None)[0] / scale


def test_a_local_trace_is_the_columns_times_the_local_values(falling) -> None:
    ax = figure(falling, "local-traces").axes[0]
    magnification = float(re.search(r"magnified (\d+) times", ax.texts[-1].get_text())[1])
    drawn = [np.hypot(*line.get_data()) for line in ax.lines if line.get_color() == INK and len(line.get_xdata()) > 50]
    expected = []
    for one, trace in zip(falling.responses, falling.traces, strict=True):
        rows = np.column_stack([np.ones_like(one.pose), np.cos(one.pose), np.sin(one.pose)])
        centre = np.linalg.lstsq(rows, trace.measured, rcond=None)[0]
        for pair in pairwise(FORCES):
            if one.force in pair:
                expected.append(one.columns @ fitted(falling, pair) - rows[:, 1:] @ centre[1:])
    assert len(drawn) == len(expected) == 2 * (len(FORCES) - 1)
    for line, values in zip(drawn, expected, strict=True):
        assert line[:90] == pytest.approx(150 + magnification * values, abs=1e-3)


def test_geometry_that_seems_to_change_is_measured_on_the_figure(falling) -> None:
    """Compliances that change make the local geometry differ; by how much is on its panel."""
    axes = figure(falling, "local-separation").axes
    geometric = np.array([bool(p.axis) and not p.elastic for p in falling.parameters])
    columns = falling.responses[0].columns[:, geometric]
    traces = [columns @ fitted(falling, pair)[geometric] for pair in pairwise(FORCES)]
    largest = 1000 * np.ptp(traces, axis=0).max()
    assert largest > 1
    assert float(re.search(r"by up to ([\d.]+) µm", axes[2].get_title())[1]) == pytest.approx(largest, rel=5e-3)
    legend = [text.get_text() for text in axes[0].figure.legends[0].get_texts()]
    assert legend == ["100 and 300 N", "300 and 500 N", "500 and 700 N"]


def test_local_geometry_of_a_constant_machine_is_one_line(make_test) -> None:
    test = make_test("wCAFYXZSt", FORCES, readings=36)
    test = replace(test, question=Question(("elasto-geometric-xy",)))
    result = identify(simulate(test, {"C_XXX": 6.2e-5, "C_YYY": 4.6e-5, **GEOMETRY}, exact=False))
    title = figure(result, "local-separation").axes[2].get_title()
    assert float(re.search(r"by up to ([\d.e-]+) µm", title)[1]) < 1e-6


def test_parts_add_up_to_the_predicted_trace(falling) -> None:
    axes = figure(falling, "parts").axes
    assert axes[0].get_title(loc="left") == "compliance, greatest parts"
    solid = [line for ax in axes for line in ax.lines if line.get_linestyle() == "-" and line.get_color() != INK]
    machine = [p for p in falling.parameters if p.axis]
    assert len(solid) == len(machine)
    own = [k for k, p in enumerate(falling.parameters) if not p.axis]
    strongest, trace = falling.responses[-1], falling.traces[-1]
    set_up = strongest.columns[:, own] @ falling.solution.values[own]
    assert sum(line.get_ydata() for line in solid) == pytest.approx(1000 * (trace.predicted - set_up), abs=1e-6)
    said = dict(text.get_text().split(", ") for ax in axes for text in ax.get_legend().get_texts())
    for p in machine:
        assert number(said[p.name].removesuffix(" µm").split(" ×")[0]) == pytest.approx(
            float(f"{1000 * abs(p.peak_to_peak):.2e}".split("e")[0]) if "×" in said[p.name] else 1000 * abs(p.peak_to_peak),
            rel=6e-3,
        )


def test_the_line_of_the_linear_model_is_the_truth(falling) -> None:
    panels = {ax.get_title(loc="left"): ax for ax in figure(falling, "local").axes}
    for name, gain, factor in (("C_XXX", -2e-8, 1e6), ("C_YYY", 1e-8, 1e6)):
        (line,) = (line for line in panels[name].lines if line.get_color() == GREEN)
        assert list(line.get_xdata()) == [100.0, 700.0]
        assert line.get_ydata() == pytest.approx([factor * (FALLING[name] + gain * force) for force in (100, 700)])
    (line,) = (line for line in panels["E_XX1"].lines if line.get_color() == GREEN)
    assert line.get_ydata() == pytest.approx([-130.0, -130.0])


def test_the_table_of_the_linear_model_holds_the_truth(falling) -> None:
    table = tables(falling, "Does anything change")["Compliances that change linearly with the force"]
    rows = {row[0]: row for row in table.rows}
    assert [number(cell) for cell in rows["C_XXX"][3:5]] == [60.0, 48.0]
    assert number(rows["C_XXX"][6]) == -20
    assert number(rows["C_YYY"][6]) == 13
    assert rows["E_XX1"][3:] == ("−130", "−130", "–", "–")


def test_the_three_columns_of_table_5_9(falling) -> None:
    table = tables(falling, "Does anything change")["Fit by constant, linear and local compliance"]
    assert [row[0] for row in table.rows] == ["100", "300", "500", "700", "all"]
    for row, level in zip(table.rows, falling.levels, strict=False):
        measured = next(trace.measured for trace in falling.traces if trace.force == level.force)
        assert number(row[4]) == pytest.approx(100 - 100 * level.rmse / np.ptp(measured), abs=0.006)
        assert number(row[5]) == 100.0
        assert number(row[4]) < number(row[6]) <= 100


def test_truth_estimate_and_difference_of_a_simulated_test(make_test) -> None:
    """Tables 4.2, 4.3 and 4.5: six sums are recovered, eighteen compliances are not."""
    truth = {"C_XXX": 1.1e-4, "C_XXY": 4.4e-4, "C_YYX": 2.2e-4, "C_YYY": 5.5e-4, "C_XCX": 1.3e-6}
    result = identify(simulate(make_test("wFYXt", [100.0], readings=72), truth, exact=False))
    found = tables(result, "Simulated and identified")
    row = next(row for row in found[""].rows if row[0] == "C_XXX")
    assert row[1:4] == ("nm/N", "550.0", "550")
    assert row[6] == "–"
    by_name = {row[0]: row for row in found["Each by itself"].rows}
    assert by_name["C_XXX"][1:] == ("nm/N", "110.0", "275.0")
    assert by_name["C_YYX"][1:] == ("nm/N", "220.0", "385.0")
    (note,) = (note for note in view_of(result).notes if "simulated" in note)
    assert note == "The readings are simulated; the estimates have no interval that could hold the true values."


def test_what_was_simulated_beside_the_model_is_named(separated) -> None:
    words = " ".join(view_of(separated).notes)
    assert re.search(r"\d+ of 15 intervals of 95 % hold the true value", words)
    assert "not in the model" not in words
    runs = tuple(replace(run, truth={**run.truth, "E_XX3": 1e-9, "E_YY3": 0.0}) for run in separated.test.runs)
    test = replace(separated.test, runs=runs)
    other = replace(separated, campaign=replace(separated.campaign, tests=dict.fromkeys(separated.campaign.tests, test)))
    assert "Simulated, but not in the model: E_XX3." in " ".join(view_of(other).notes)


def test_measured_readings_have_no_truth_to_show(poor) -> None:
    assert "Simulated and identified" not in [section.title for section in view_of(poor).sections]


def test_singular_values_and_the_null_set_are_on_the_page(poor) -> None:
    page = html_page(view_of(poor))
    words = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", page))
    found = poor.confounding
    assert found.null == ("C_XCX", "C_YCX", "C_CXX", "C_CYX", "C_CCX")
    assert f"changes no reading {', '.join(found.null)}" in words
    shown = re.search(r"singular values, scaled ([\d., e−-]+)", words)[1]
    values = [number(text) for text in shown.strip().split(", ")]
    columns = poor.responses[0].columns
    expected = np.linalg.svd(columns / np.linalg.norm(columns, axis=0), compute_uv=False)
    assert values == pytest.approx(expected, rel=6e-3)
    assert f"rank {found.rank} of {len(found.labels)}" in words


@pytest.mark.parametrize(
    ("example", "pictures"),
    [
        ("static-frame", {"parts", "local", "local-traces"}),
        ("static-force", {"parts", "local", "local-traces"}),
        ("one-level", {"parts"}),
    ],
)
def test_readings_that_go_around_no_circle_have_the_same_figures(example, pictures) -> None:
    result = identify(read_test(example_test().parent / example))
    drawn = {name: picture.draw() for name, picture in view_of(result).pictures.items() if name in pictures}
    assert set(drawn) == pictures
    assert all(ax.lines for name in drawn for ax in drawn[name].axes)
    assert GREY not in {line.get_color() for line in drawn["parts"].axes[0].lines}


def test_local_values_stand_over_their_forces_with_their_uncertainty(separated) -> None:
    panels = {ax.get_title(loc="left"): ax for ax in figure(separated, "local").axes}
    (ends,) = (line for line in panels["C_XXX"].lines if line.get_marker() == "_")
    (dots,) = (line for line in panels["C_XXX"].lines if line.get_marker() == "o")
    found = [local.solution.estimate("C_XXX") for local in separated.local]
    assert list(dots.get_xdata()) == [np.mean(local.forces) for local in separated.local]
    assert dots.get_ydata() == pytest.approx([1e6 * one.value for one in found])
    low, high = np.split(np.asarray(ends.get_ydata()), 2)
    assert (high - low) / 2 == pytest.approx([1e6 * one.standard_uncertainty for one in found])
    assert (high + low) / 2 == pytest.approx(dots.get_ydata())


def test_the_table_of_local_estimates(falling) -> None:
    """Where a falling compliance is taken for a constant, each pair of levels sees the chord, C0 + C1 (F1 + F2)."""
    table = tables(falling, "Does anything change")["Local estimates"]
    assert table.headings[2:] == ("100 and 300 N", "300 and 500 N", "500 and 700 N")
    row = next(row for row in table.rows if row[0] == "C_XXX")
    assert [number(cell) for cell in row[2:]] == pytest.approx(
        [62 - 0.02 * 400, 62 - 0.02 * 800, 62 - 0.02 * 1200], abs=0.06
    )


@pytest.fixture(scope="module")
def reconstructed():
    """The thesis's real test, from its printed tables."""
    return identify(read_test(example_test().parent / "hermle-c50-reconstructed"))


FIGURES_5_9_AND_5_10 = {
    "C_XXX": "0.045",
    "C_YYY": "0.034",
    "C_XYX": "0.00058",
    "C_CXY": "0.0022",
    "C_CYY": "0.0014",
    "C_CCY": "0.0045",
    "E_XX1": "0.019",
    "E_YY1": "0.014",
    "E_YX2": "0.0074",
    "E_XY2": "0.012",
    "E_C(0Y)X": "0.00017",
}
"""Peak to peak [mm] at 742 N of the global parameters, as printed in 5.7.1."""

FIGURES_5_13_AND_5_14 = {
    "C_XXX": "0.048",
    "C_YYY": "0.036",
    "C_XYX": "0.0018",
    "C_CXY": "0.0064",
    "C_CYY": "0.001",
    "C_CCY": "0.0036",
    "E_XX1": "0.022",
    "E_YY1": "0.017",
    "E_YX2": "0.012",
    "E_XY2": "0.014",
    "E_C(0Y)X": "0.00082",
}
"""The same of the local parameters of 616 and 742 N, as printed in 5.7.2."""


def prints_as(value: float, printed: str) -> bool:
    """Whether a value [mm] is within 5 % of one that prints as this, rounded or cut off."""
    unit = 10.0 ** -len(printed.partition(".")[2])
    return 0.95 * (float(printed) - unit / 2) <= value <= 1.05 * (float(printed) + unit)


def test_parts_are_those_of_figures_5_9_to_5_14(reconstructed) -> None:
    spans = {"-": {}, ":": {}}
    for ax in figure(reconstructed, "parts").axes:
        lines = [line for line in ax.lines if line.get_color() != INK]
        names = [text.get_text().partition(",")[0] for text in ax.get_legend().get_texts()]
        for name, whole, local in zip(names, lines[::2], lines[1::2], strict=True):
            spans["-"][name] = np.ptp([0.0, *whole.get_ydata()]) / 1000
            spans[":"][name] = np.ptp([0.0, *local.get_ydata()]) / 1000
    assert {n: v for n, v in spans["-"].items() if not prints_as(v, FIGURES_5_9_AND_5_10[n])} == {}
    assert {n: v for n, v in spans[":"].items() if not prints_as(v, FIGURES_5_13_AND_5_14[n])} == {}
    assert set(spans["-"]) == set(FIGURES_5_9_AND_5_10)


def test_local_geometry_varies_by_half_of_the_global_one_as_figure_5_12_says(reconstructed) -> None:
    """At most 0.0085 mm beside 0.019 mm in the thesis; 7.8 um beside 19.1 um of its traces."""
    title = figure(reconstructed, "local-separation").axes[2].get_title()
    assert 0.85 * 8.5 < float(re.search(r"by up to ([\d.]+) µm", title)[1]) < 8.5
    title = figure(reconstructed, "separation").axes[2].get_title()
    assert prints_as(float(re.search(r"([\d.]+) µm peak to peak", title)[1]) / 1000, "0.019")


def test_a_linear_compliance_explains_what_the_reconstruction_says(reconstructed) -> None:
    """0.917 um with thirteen parameters, 0.655 um with nineteen (shared reference, "Fewer parameters explain more")."""
    table = tables(reconstructed, "Does anything change")["Fit by constant, linear and local compliance"]
    assert table.rows[-1][:3] == ("all", "0.917", "0.655")
    fits = np.array([[number(cell) for cell in row[4:]] for row in table.rows[:-1]])
    assert (fits[:, 2] > fits[:, 0]).all()


def test_readings_that_are_angles_are_shown_as_angles() -> None:
    machine = Machine("mill", parse_topology("wFXYZt"), tool=(0.0, 0.0, -50.0))
    setup = Positioning("X", about=(0.0, 1.0, 0.0), targets=(-190.0, -120.0, -35.0, 42.0, 117.0, 180.0))
    blank = MachineTest("angles", machine, setup, (Run("run", {}),), Question(("E_BX1",)))
    result = identify(simulate(blank, {"E_BX1": 2e-7}, Imperfection(angle_noise=4e-7), 1, exact=False))
    drawn = figure(result, "parts")
    assert "deviation (µrad)" in [text.get_text() for text in drawn.texts]
    (entry,) = (text.get_text() for text in drawn.axes[0].get_legend().get_texts())
    assert entry.endswith(" µrad")
    solid = next(line for line in drawn.axes[0].lines if line.get_color() != INK)
    assert np.ptp(solid.get_ydata()) == pytest.approx(370 * 0.2, rel=0.1)
