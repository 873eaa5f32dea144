"""`elastogeo compensate`: from a positioning test to the files of a control, at the terminal and as JSON."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

import elastogeo as eg
from elastogeo.cli.prediction.compensate import compensate
from elastogeo.errors import InputError
from elastogeo.formats import new_test, read_compensation, simulate
from elastogeo.machine import Line


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = new_test(tmp_path_factory.mktemp("compensate") / "axis-x", instrument="positioning").parent
    simulate(made, write=True)
    return made


def call(*arguments: object) -> tuple[int, str]:
    app = typer.Typer()
    app.command()(compensate)
    done = CliRunner().invoke(app, [str(argument) for argument in arguments])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.exit_code, done.stdout


def test_the_terminal_says_before_and_after_and_the_files_are_there(folder: Path, tmp_path: Path) -> None:
    code, text = call(folder, "--output", tmp_path / "out", "--set", "type=1")
    assert code == 0
    for words in ("Simulated: elastogeo, seed 1", "E_XX falls from ", "to at most ", "sign sure: ", "error falls for sure"):
        assert words in text
    table = read_compensation(tmp_path / "out" / "x.comp")[0]
    assert table.name == "E_XX"
    assert table.value[0].max() < -0.005  # the simulated scale is 25 um/m, its bow 8e-8: X falls short at -200


def test_json_is_one_object_and_nothing_is_written_without_a_folder(folder: Path) -> None:
    code, text = call(folder, "--json", "--control", "csv", "--zero", "X_mm=0.6")
    document = json.loads(text)
    assert code == 0
    assert document["schema"] == "elastogeo.compensation/1"
    error = document["errors"][0]
    assert error["zero_at"] == 0.6
    for point in error["points"]:
        assert point["after"] == pytest.approx(point["before"] + point["correction"])
        assert abs(point["after"]) < 1e-6
    assert document["files"]["errors.csv"]["text"].startswith("error,axis,component")


def test_the_report_has_its_files(folder: Path, tmp_path: Path) -> None:
    code, _ = call(folder, "--report", tmp_path / "report")
    assert code == 0
    assert {path.name for path in (tmp_path / "report").iterdir()} >= {"report.html", "report.pdf", "compensation-E_XX.svg"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--set", "type"], "--set is 'type'; give a name and a value, as in type=1"),
        (["--zero", "X=0"], "--zero is 'X=0'; name the axis with its unit, X_mm"),
        (["--zero", "X_mm=near"], "--zero of X is 'near'; give a number, as in X_mm=0"),
        (["--control", "abacus"], "no compensation files are known of a control 'abacus'"),
        (["--set", "colour=red"], "LinuxCNC screw compensation has no setting 'colour'"),
    ],
)
def test_wrong_options_are_refused(folder: Path, arguments: list[str], message: str) -> None:
    with pytest.raises(InputError, match=message):
        call(folder, *arguments)


def test_a_program_is_moved_and_written(tmp_path: Path) -> None:
    """Of the example of a ball bar: the new program is read again, and goes elsewhere than the old one."""
    example = Path(__file__).resolve().parents[2] / "examples" / "ball-bar-diagnosis"
    part = tmp_path / "part.ngc"
    part.write_text("G21 G17 G90\nG0 X50 Y0\nG3 X50 Y0 I-50 J0 F600\nG1 X20 F900\nM2\n", encoding="ascii")
    arguments = ["--program", part, "--output", tmp_path / "out", "--flavour", "linuxcnc", "-p", "E_XX1", "-p", "E_YY1"]
    code, text = call(example, *arguments, "--report", tmp_path / "report")
    assert code == 0
    for words in (
        "Compensated path",
        "The deviation along x and y falls from",
        "Not compensated",
        "no parameter was asked for",
    ):
        assert words in text
    again = eg.read_program(tmp_path / "out" / "part.ngc")
    ends = [block.to["X"] for block in again.blocks if isinstance(block, Line) and "X" in block.to]
    assert ends[-1] != pytest.approx(20.0, abs=1e-4)
    assert ends[-1] == pytest.approx(20.0, abs=2e-3)
    assert {path.name for path in (tmp_path / "report").iterdir()} >= {"along-the-path.svg", "from-above.svg", "report.pdf"}
    code, text = call(example, *arguments[:2], "-p", "E_XX1", "-p", "E_YY1", "--json")
    document = json.loads(text)
    assert document["schema"] == "elastogeo.path_compensation/1"
    assert document["components"] == ["x", "y"]
    assert document["points"][0]["before_um"][2] is None
