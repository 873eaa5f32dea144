"""The report of feed drives: the answer, the key values, who and when, and what is not shown."""

from __future__ import annotations

import re
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest

from elastogeo import identify_drives, read_drives
from elastogeo.report import View, view_of
from elastogeo.report.drawing.svg import drawn

DRIVE_FILE = """
schema = "elastogeo.drive/1"
name = "a mill"
logs = ["run_*.csv"]

[about]
date = "2026-03-01"
operator = "M. Curie"
machine_serial = "0815"
"""
AXES = {"x": (4.0, 0.15), "y": (3.0, 0.10)}
"""Coulomb [A] and viscous [A s/mm] friction."""


def write(folder: Path, seed: int, forward: bool = False, dead: str = "") -> None:
    """A simulated run of two axes; one may be dead."""
    random, time = np.random.default_rng(seed), 0.01 * np.arange(400)
    columns = {"time_s": time}
    for axis, (coulomb, viscous) in AXES.items():
        waves = [(random.uniform(0.2, 2.0), random.uniform(0, 6), random.uniform(3, 10)) for _ in range(4)]
        v = sum(size * np.sin(2 * np.pi * f * time + at) for f, at, size in waves)
        a = sum(size * 2 * np.pi * f * np.cos(2 * np.pi * f * time + at) for f, at, size in waves)
        v = v - v.min() + 1 if forward else v
        current = 0.01 * a + viscous * v + coulomb * np.sign(v) + 0.5 + 0.2 * random.standard_normal(len(time))
        columns |= {
            f"current_{axis}_A": current * (axis != dead),
            f"velocity_{axis}_mm_s": v,
            f"acceleration_{axis}_mm_s2": a,
        }
    rows = [",".join(f"{value:.9g}" for value in row) for row in zip(*columns.values(), strict=True)]
    (folder / f"run_{seed}.csv").write_text("\n".join([",".join(columns), *rows, ""]), encoding="utf-8")


def seen(folder: Path, **kind: object) -> View:
    for seed in range(3):
        write(folder, seed, **kind)
    (folder / "drive.toml").write_text(DRIVE_FILE, encoding="utf-8")
    return view_of(identify_drives(replace(read_drives(folder), compare=False)))


@pytest.fixture(scope="module")
def view(tmp_path_factory: pytest.TempPathFactory) -> View:
    return seen(tmp_path_factory.mktemp("drives"))


def test_the_first_screen_has_the_friction_of_every_axis_in_words(view: View) -> None:
    assert [value.name for value in view.values] == [
        "Coulomb friction, X",
        "Coulomb friction, Y",
        "viscous friction, X",
        "viscous friction, Y",
    ]
    shown = [float(value.value.split(" ± ")[0]) for value in view.values]
    assert shown == pytest.approx([4.0, 3.0, 0.15, 0.10], rel=0.1)
    words = "Friction and inertia of X, Y are identified; left-out runs are predicted to "
    said = re.match(words + r"(.*) A \(X\), (.*) A \(Y\) RMSE\.", view.sentence)
    assert said
    assert [float(value) for value in said.groups()] == pytest.approx([0.2, 0.2], rel=0.1)


def test_who_when_and_which_files(view: View, tmp_path: Path) -> None:
    head = dict(view.head)
    assert (head["Date"], head["Operator"], head["Machine serial number"]) == ("2026-03-01", "M. Curie", "0815")
    assert head["Runs"] == "3, 1200 samples of each axis, one every 10 ms"
    write(tmp_path, 1)
    files = view.document["test"]["files"]
    assert [entry["file"] for entry in files] == ["run_0.csv", "run_1.csv", "run_2.csv"]
    assert files[1]["sha256"] == sha256((tmp_path / "run_1.csv").read_bytes()).hexdigest()
    assert view.sections[-1].tables[0].rows[1] == ("run_1", "run_1.csv", files[1]["sha256"])


def test_a_column_that_holds_nothing_is_not_shown(view: View) -> None:
    assert view.tables[0].headings == ("term", "value ± U (95 %)", "unit", "what")
    assert view.tables[0].words == (0, 2, 3)


def test_the_axes_stand_below_each_other(view: View) -> None:
    svg = drawn(view.picture).decode()
    assert "X: friction over velocity" in svg
    assert "current less inertia [A]" in svg


def test_sums_are_said_to_be_sums(tmp_path: Path) -> None:
    """One direction: Coulomb friction and constant are one number, 4.5 A and 3.5 A."""
    view = seen(tmp_path, forward=True)
    assert view.sentence.startswith("Of X, Y some terms are determined as sums only.")
    assert view.picture is None
    sums = {value.name: float(value.value.split(" ± ")[0]) for value in view.values if " + " in value.name}
    assert sums == pytest.approx({"coulomb + constant, X": 4.5, "coulomb + constant, Y": 3.5}, rel=0.1)


def test_a_dead_axis_says_why_in_its_section(tmp_path: Path) -> None:
    view = seen(tmp_path, dead="y")
    assert "Y cannot be identified." in view.sentence
    section = next(section for section in view.sections if section.title == "Axis Y")
    (why,) = section.paragraphs
    assert why == "Axis Y cannot be identified, because its effort is 0 A in all 1200 samples: the channel is dead."
