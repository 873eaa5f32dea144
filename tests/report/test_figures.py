"""Figures: they are there, they are the same twice, they stay small."""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from elastogeo.identification import diagnose
from elastogeo.machine import Machine, parse_topology
from elastogeo.report import MissingExtraError, html_page, save_report, view_of
from elastogeo.report.drawing.magnified import nice_step, thinned
from elastogeo.report.drawing.style import force_colours
from elastogeo.report.drawing.svg import drawn as svg_of
from elastogeo.report.drawing.svg import inline
from elastogeo.report.text import parameter_rows

ALWAYS = {"traces", "residuals", "contributions", "parts", "patterns"}
LOCAL = {"local", "local-traces"}


def figure(result, name):
    return view_of(result).pictures[name].draw()


def names(result):
    return set(view_of(result).pictures)


def test_every_figure_that_there_is_something_for(rich, poor, geometric, separated, mixed) -> None:
    assert names(rich) == {*ALWAYS, *LOCAL, "repeats"}
    assert names(poor) == ALWAYS
    assert names(geometric) == {*ALWAYS, *LOCAL, "separation", "local-separation", "models"}
    assert names(separated) == {*ALWAYS, *LOCAL, "separation", "local-separation", "models", "budget", "repeats"}
    assert names(mixed) == {*ALWAYS, "repeats"}
    assert "ranking" in names(diagnose(separated))


def test_files_are_the_same_bytes_twice_and_what_their_names_say(rich, tmp_path) -> None:
    save_report(view_of(rich), tmp_path / "one")
    save_report(view_of(rich), tmp_path / "two")
    files = sorted(path.name for path in (tmp_path / "one").iterdir())
    assert files == sorted([*(f"{name}.svg" for name in names(rich)), "report.html", "report.json", "report.pdf"])
    for name in files:
        data = (tmp_path / "one" / name).read_bytes()
        assert data == (tmp_path / "two" / name).read_bytes(), name
        if name.endswith(".svg"):
            assert ElementTree.fromstring(data).tag.endswith("svg")
            assert b"<dc:date>" not in data


def test_the_magnification_and_the_division_are_stated(rich) -> None:
    traces = figure(rich, "traces")
    notes = [text.get_text() for text in traces.axes[0].texts]
    assert "one division = 10 µm; deviations are magnified 2000 times" in notes
    legend = [text.get_text() for text in traces.axes[0].get_legend().get_texts()]
    levels = [f"CCW, {force} N" for force in (706, 580, 454, 328, 202, 76)]
    assert legend == [*levels, "predicted", "nominal circle", "start"]
    assert {"+X", "+Y", "−X", "−Y", "0 µm", "+10", "+20"} <= set(notes)


def test_traces_are_drawn_where_they_were_measured(poor) -> None:
    trace, ax = poor.traces[0], figure(poor, "traces").axes[0]
    magnification = float(re.search(r"magnified (\d+) times", ax.texts[-1].get_text())[1])
    drawn = next(line for line in ax.lines if len(line.get_xdata()) == 37 and line.get_linestyle() == "-")
    x, y = (np.asarray(data)[:-1] for data in drawn.get_data())
    rows = np.column_stack([np.ones_like(trace.pose), np.cos(trace.pose), np.sin(trace.pose)])
    centre = np.linalg.solve(rows.T @ rows, rows.T @ trace.measured)
    kept = trace.measured - rows[:, 1:] @ centre[1:]
    assert np.abs(kept - trace.measured).max() > 1e-6
    assert np.hypot(x, y) == pytest.approx(150 + magnification * kept)
    assert np.unwrap(np.arctan2(y, x)) == pytest.approx(trace.pose)


def bars_of(figure) -> list[tuple[float, float, float]]:
    """Length and 95 % interval of every bar, from the bottom."""
    ax = figure.axes[0]
    bars = [bar.get_width() for bar in ax.patches if bar.get_height() == pytest.approx(0.62)]
    whiskers = [line.get_xdata() for line in ax.lines if line.get_marker() == "|"]
    return [(length, *ends) for length, ends in zip(bars, whiskers, strict=True)]


def test_contributions_are_signed_and_ranked_with_their_intervals(separated) -> None:
    drawn = bars_of(figure(separated, "contributions"))
    ranked = sorted(separated.parameters, key=lambda p: abs(p.peak_to_peak))
    for (length, low, high), p in zip(drawn, ranked, strict=True):
        assert length == pytest.approx(1000 * p.peak_to_peak)
        assert (high - low) / abs(length) == pytest.approx((p.interval[1] - p.interval[0]) / abs(p.value))


def test_the_ranking_holds_the_faults_of_the_machine_only(separated) -> None:
    drawn = bars_of(figure(diagnose(separated), "ranking"))[::-1]
    faults = [fault for fault in diagnose(separated).faults if fault.axis]
    assert [length for length, _, _ in drawn] == pytest.approx([1000 * fault.distortion for fault in faults])
    for (_, low, high), fault in zip(drawn, faults, strict=True):
        if len(fault.names) == 1:
            assert fault.significant == (not low <= 0 <= high)


def test_separation_shows_the_parts_at_one_scale(separated) -> None:
    axes = figure(separated, "separation").axes
    titles = [ax.get_title().split("\n")[0] for ax in axes]
    assert titles == ["compliance and geometry", "compliance alone", "geometry alone"]
    spans = [float(re.search(r"([\d.]+) µm", ax.get_title())[1]) for ax in axes]
    level = separated.levels[-1]
    assert spans[1] == pytest.approx(1000 * (level.elastic[1] - level.elastic[0]), rel=5e-3)
    assert spans[2] == pytest.approx(1000 * (level.geometric[1] - level.geometric[0]), rel=5e-3)


def test_budget_bars_fill_the_whole_variance(separated) -> None:
    bars = figure(separated, "budget").axes[0].patches
    rows = {round(bar.get_y(), 6) for bar in bars}
    assert len(rows) == len(separated.parameters)
    for row in rows:
        assert sum(bar.get_width() for bar in bars if round(bar.get_y(), 6) == row) == pytest.approx(100)


def test_models_mark_the_supported_one_and_leave_out_what_is_not_known(separated) -> None:
    models = replace(separated.models, candidates=(replace(separated.models.candidates[0], left_out_level=None),))
    assert models.supported == "constant"
    ax = figure(replace(separated, models=models), "models").axes[0]
    assert [text.get_fontweight() for text in ax.get_yticklabels()] == ["bold"]
    assert [line.get_marker() for line in ax.lines if len(line.get_xdata()) == 1] == ["o", "D"]


def test_where_nothing_is_told_apart_bars_and_patterns_carry_sums(mixed) -> None:
    labels = figure(mixed, "contributions").axes[0].get_yticklabels()
    assert sorted(text.get_text().replace("\n", " ") for text in labels) == sorted(row.name for row in parameter_rows(mixed))
    titles = [ax.get_title().replace("\n", " ") for ax in figure(mixed, "patterns").axes]
    assert "C_XXX or E_XX1" in titles


def test_patterns_name_their_groups(rich) -> None:
    axes = figure(rich, "patterns").axes
    assert len(axes) == 6
    assert axes[0].get_title() == "like C_XXY"
    assert axes[-1].get_title() == "C_CCY"


def test_inline_figures_share_no_identifier_and_hold_no_address(rich) -> None:
    pictures = view_of(rich).pictures
    one, two = (inline(svg_of(pictures[name]), pictures[name]) for name in ("local", "repeats"))
    for svg, name in ((one, "local"), (two, "repeats")):
        assert svg.startswith("<svg")
        assert "http" not in svg
        ids = {element.get("id") for element in ElementTree.fromstring(svg).iter()} - {None}
        assert ids
        assert all(identifier.startswith(f"{name}-") for identifier in ids)
        for used in ElementTree.fromstring(svg).iter():
            if href := used.get("href"):
                assert href.removeprefix("#") in ids


@pytest.mark.parametrize(("largest", "step"), [(2877.0, 2000), (1000.0, 1000), (0.0146, 0.01), (7.0, 5), (0.2, 0.2)])
def test_nice_step(largest: float, step: float) -> None:
    assert nice_step(largest) == pytest.approx(step)


def test_thinning_keeps_the_extremes_and_the_order() -> None:
    pose = np.linspace(0, 6, 100_000)
    values = np.random.default_rng(0).standard_normal(100_000)
    values[77_777] = 9.0
    few_pose, few = thinned(pose, values, traces=10)
    assert len(few) < 4_000
    assert few.max() == 9.0
    assert few.min() == values.min()
    assert (np.diff(few_pose) > 0).all()


def test_each_level_has_its_own_colour() -> None:
    assert len(set(force_colours([76.0, 202.0, 328.0]).values())) == 3
    assert len(force_colours([100.0])) == 1


def test_importing_the_room_draws_nothing() -> None:
    heavy = ("matplotlib", "jinja2", "markupsafe", "typst")
    probe = f"import sys, elastogeo.report; print([n for n in {heavy} if n in sys.modules])"
    assert subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_without_matplotlib_it_says_what_to_install(poor, monkeypatch) -> None:
    for name in [name for name in sys.modules if name.partition(".")[0] == "matplotlib"]:
        monkeypatch.delitem(sys.modules, name)
    for module in [name for name in sys.modules if name.startswith("elastogeo.report.drawing.style")]:
        monkeypatch.delitem(sys.modules, module)

    class Absent:
        @staticmethod
        def find_spec(name: str, *_: object) -> None:
            if name.partition(".")[0] == "matplotlib":
                raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr(sys, "meta_path", [Absent, *sys.meta_path])
    with pytest.raises(MissingExtraError, match=r"needs matplotlib.*pip install 'elastogeo\[report\]'"):
        html_page(view_of(poor))


@pytest.mark.parametrize("topology", ["wCAFYXZSt", "wFYXt", "wCAYFXZt", "wXFZBt"])
def test_the_chain_of_a_machine_has_every_joint_between_foundation_and_ends(topology: str) -> None:
    drawn = view_of(Machine("m", parse_topology(topology))).pictures["chain"].draw()
    said = [text.get_text() for text in drawn.axes[0].texts]
    assert {"foundation", "workpiece", "tool"} <= set(said)
    axes = [letter for letter in topology if letter.isupper() and letter != "F"]
    assert sorted(letter for letter in said if len(letter) == 1 and letter.isupper()) == sorted(axes)
