"""`elastogeo map`: from a test to the compliance at the tool, at the terminal, as JSON and as a report."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from elastogeo.cli.prediction.map import map as map_command
from elastogeo.errors import InputError
from elastogeo.formats import new_test, simulate

PLANE = ["-p", "C_[XYC][XYC][XY]", "-p", "E_XX1", "-p", "E_YY1", "--at", "Z_mm=0"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A simulated loaded circle in the XY plane."""
    made = new_test(tmp_path_factory.mktemp("map") / "xy").parent
    simulate(made, write=True)
    return made


def call(*arguments: object) -> tuple[int, str]:
    app = typer.Typer()
    app.command()(map_command)
    done = CliRunner().invoke(app, [str(argument) for argument in arguments])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.exit_code, done.stdout


def test_json_holds_the_map_over_its_grid(folder: Path) -> None:
    grid = ["--along", "X_mm=-100:100:3", "--along", "Y_mm=-100:100:5"]
    code, text = call(folder, *PLANE, *grid, "--direction", "X", "--least-stiffness", "10", "--json")
    document = json.loads(text)
    assert code == 0
    assert document["schema"] == "elastogeo.compliance_map/1"
    assert {axis: len(values) for axis, values in document["axes"].items()} == {"X": 3, "Y": 5}
    compliance, expanded = (np.array(document[name]) for name in ("compliance_nm_per_N", "expanded_nm_per_N"))
    assert compliance.shape == expanded.shape == (3, 5)
    assert document["stands"]["Z"] == 0
    assert (np.abs(compliance[:, 2] - 60.0) < 2 * expanded[:, 2]).all()  # simulated with C_XXX = 6e-5 mm/N
    assert document["softest"]["compliance"]["value"] == pytest.approx(compliance.max())
    assert document["limit"]["passed"] is True
    assert document["softest"]["stiffness"]["value"] == pytest.approx(1e3 / compliance.max())


def test_the_terminal_says_where_it_is_softest_and_what_counts_as_rigid(folder: Path) -> None:
    code, text = call(folder, *PLANE, "--along", "Y_mm=-100:100:5", "--direction", "1,0,0", "--at", "X_mm=0")
    assert code == 0
    for words in (
        "Simulated: elastogeo, seed 1",
        "The tool gives way most, by ",
        "along X",
        "Not asked for, and so taken as rigid",
    ):
        assert words in text


def test_what_the_test_does_not_tell_ends_with_1_and_no_number(folder: Path) -> None:
    code, text = call(folder, "-p", "C_???", "-p", "E_XX1", "-p", "E_YY1", "--along", "Z_mm=100:200:2", "--direction", "Z")
    assert code == 1
    assert "The tests do not tell how stiff the machine is at the tool in this volume" in text


def test_the_report_has_its_pictures(folder: Path, tmp_path: Path) -> None:
    grid = ["--along", "X_mm=-100:100:3", "--along", "Y_mm=-100:100:3"]
    code, _ = call(folder, *PLANE, *grid, "--direction", "Y", "--report", tmp_path / "report")
    assert code == 0
    assert {path.name for path in (tmp_path / "report").iterdir()} >= {
        "report.html",
        "report.pdf",
        "slices.svg",
        "uncertainty.svg",
        "volume.html",
    }


def test_what_is_not_told_is_hatched_and_null_in_every_file(folder: Path, tmp_path: Path) -> None:
    """Beside the plane of the circle nothing is told of Z: the files are written all the same."""
    grid = ["--along", "X_mm=-100:100:3", "--along", "Y_mm=-100:100:3", "--at", "Z_mm=100", "-p", "C_???", "-p", "E_??1"]
    code, _ = call(folder, *grid, "--direction", "Z", "--report", tmp_path / "none")
    assert code == 1
    document = json.loads((tmp_path / "none" / "report.json").read_text(encoding="utf-8"))
    assert document["compliance_nm_per_N"] == document["expanded_nm_per_N"] == [[None] * 3] * 3
    assert (tmp_path / "none" / "report.pdf").stat().st_size > 1000
    code, text = call(folder, *grid, "--direction", "Z", "--prior", "--report", tmp_path / "prior")
    assert code == 1
    assert "Where the tests do not tell, values rest on a prior" in text
    assert "pattern" in (tmp_path / "prior" / "slices.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        (["--along", "X=-1:1:3"], "--along is 'X=-1:1:3'; name the axis with its unit, X_mm, as in X_mm=-200:200:21"),
        (["--along", "X_mm=-1:1"], "give first, last and how many, as in -200:200:21"),
        (["--along", "X_mm=-1:1:3:4"], "give first, last and how many, as in -200:200:21"),
        (["--at", "X_mm=here"], "--at of X is 'here'; give a number"),
        (["--at", "X_mm=1", "--at", "X_mm=2"], "--at gives X_mm twice; give it once"),
        (["--direction", "1,a,0"], "--direction is '1,a,0'; give numbers, as in 1,1,0"),
    ],
)
def test_what_is_no_grid_is_refused(folder: Path, wrong: list[str], why: str) -> None:
    with pytest.raises(InputError, match=why):
        call(folder, *wrong)
