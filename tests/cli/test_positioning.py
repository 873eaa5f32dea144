"""`elastogeo positioning`: a new test, simulated, evaluated, reported; what is refused at the door."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from elastogeo.cli.answers.positioning import positioning
from elastogeo.errors import InputError
from elastogeo.formats import new_test, simulate

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = new_test(tmp_path_factory.mktemp("positioning") / "new", instrument="positioning").parent
    simulate(made, write=True)
    return made


def call(*arguments: object) -> tuple[int, str]:
    app = typer.Typer()
    app.command()(positioning)
    done = CliRunner().invoke(app, [str(argument) for argument in arguments])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.exit_code, done.stdout


def test_the_terminal_shows_values_parameters_and_verdict(folder: Path) -> None:
    code, text = call(folder)
    assert code == 0
    for words in ("Simulated: elastogeo, seed 1", "Positioning of X: A = ", "mean reversal", "E_XX1", "free of drift"):
        assert words in text


def test_json_is_one_object(folder: Path) -> None:
    code, text = call(folder, "--json")
    document = json.loads(text)
    assert code == 0
    assert document["schema"] == "elastogeo.positioning/1"
    by_name = {value["name"]: value for value in document["values"]}
    low, high = by_name["mean B"]["interval95"]
    assert low <= -3.0 <= high  # the simulated backlash


def test_the_report_has_its_files(folder: Path, tmp_path: Path) -> None:
    code, _ = call(folder, "--report", tmp_path / "report")
    assert code == 0
    files = {path.name for path in (tmp_path / "report").iterdir()}
    assert files >= {"report.html", "report.pdf", "report.json", "deviations.svg"}


def test_another_instrument_is_refused() -> None:
    with pytest.raises(InputError, match="values of ISO 230-2 take the instrument positioning"):
        call(EXAMPLES / "static-rig")


def test_identify_says_where_the_values_of_the_standard_are(folder: Path) -> None:
    from elastogeo.formats import read_test
    from elastogeo.identification import identify
    from elastogeo.report import view_of

    assert "The values of ISO 230-2 (A, E, R, B, M): elastogeo positioning." in view_of(identify(read_test(folder))).notes


def test_a_file_of_targets_is_seen_as_a_run(folder: Path) -> None:
    from elastogeo.formats import inspect_file

    found = inspect_file(folder / "runs" / "1.csv")
    assert found.kind == "run"
    assert [column.quantity for column in found.columns] == ["cycle", "direction", "target", "position"]
