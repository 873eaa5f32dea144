"""What `inspect_file` says of files whose content the test wrote itself."""

from pathlib import Path

import numpy as np
import pytest

from elastogeo.errors import FormatError
from elastogeo.formats import Inspected, inspect_file
from elastogeo.formats.guessed_names import guessed_quantity
from elastogeo.formats.log_files import log_formats
from elastogeo.formats.run_files import run_formats


def inspected(folder: Path, text: str, name: str = "file.txt") -> Inspected:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return inspect_file(path)


def test_a_log_says_channels_units_first_values_count_and_rate(tmp_path: Path) -> None:
    text = "time_ms,position_x_mm,CURRENT|1\n" + "".join(f"{2 * k},{k / 2},{-k}\n" for k in range(8))
    found = inspected(tmp_path, text)
    assert (found.kind, found.format, found.problem) == ("log", "delimited text", "")
    assert found.duration == pytest.approx(0.014)
    position, current = found.columns
    assert (position.quantity, position.unit, position.guess) == ("position_x", "mm", "")
    assert (position.count, position.first, position.low, position.high) == (8, (0.0, 0.5, 1.0, 1.5, 2.0), 0.0, 3.5)
    assert position.rate == pytest.approx(500)
    assert (current.quantity, current.unit, current.guess) == ("", "", "current")
    assert found.channels == (
        {"quantity": "position_x", "channel": "position_x_mm"},
        {"quantity": "current", "channel": "CURRENT|1", "unit": ""},
    )


def test_a_run_is_a_run_and_needs_no_mapping(tmp_path: Path) -> None:
    found = inspected(tmp_path, "angle_deg,radial_um\n0.0,1.5\n90.0,-2.5\n")
    assert (found.kind, found.format, found.problem, dict(found.renamed)) == ("run", "delimited text", "", {})
    assert [(c.name, c.unit, c.first) for c in found.columns] == [
        ("angle_deg", "deg", (0.0, 90.0)),
        ("radial_um", "um", (1.5, -2.5)),
    ]


def test_documents_and_folders_say_what_they_are(tmp_path: Path) -> None:
    (tmp_path / "test.toml").write_text('schema = "elastogeo.test/1"\nname = "a test"\n', encoding="utf-8")
    assert inspect_file(tmp_path).kind == "test"
    assert inspect_file(tmp_path).metadata["name"] == "a test"
    (tmp_path / "other.toml").write_text("a = 1\n", encoding="utf-8")
    with pytest.raises(FormatError, match=r"other\.toml: is TOML, but says no schema of elastogeo"):
        inspect_file(tmp_path / "other.toml")
    empty = tmp_path / "empty"
    empty.mkdir()
    with pytest.raises(FormatError, match=r"is a folder without test\.toml, campaign\.toml, drive\.toml or parts of a"):
        inspect_file(empty)


@pytest.mark.parametrize("name", sorted(log_formats()))
def test_every_format_of_logs_is_told_by_its_name(name: str, tmp_path: Path) -> None:
    path = tmp_path / "a file"
    path.write_bytes(log_formats()[name].sample())
    found = inspect_file(path)
    assert (found.format, found.kind) == (name, "log")
    assert all(np.isfinite(column.count) and column.count for column in found.columns)


@pytest.mark.parametrize("name", sorted(run_formats()))
def test_every_format_of_runs_is_told_by_its_name(name: str, tmp_path: Path) -> None:
    path = tmp_path / "a file"
    path.write_bytes(run_formats()[name].sample())
    found = inspect_file(path)
    assert (found.format, found.kind, found.problem) == (name, "run", "")
    assert found.columns


GUESSES = {
    "Strom X [A]": "current_x",
    "X1_CurrentFeedback": "current_x",
    "Lageistwert X-Achse": "position_x",
    "vitesse_y": "velocity_y",
    "SollPosition X": "",
    "Drehmoment Z": "torque_z",
    "Winkel": "angle",
    "Status": "",
}


@pytest.mark.parametrize("name", GUESSES)
def test_names_of_other_languages_are_guessed_and_commands_are_not_taken_for_readings(name: str) -> None:
    assert guessed_quantity(name) == GUESSES[name]


def test_a_guess_respects_the_unit() -> None:
    assert guessed_quantity("Strom X", "mm") == ""


@pytest.mark.parametrize(
    "header", ["pressure_bar,force_N", "pressure_bar,displacement_um", "engagement_um,force_N,ball_um,roller_um"]
)
def test_readings_for_a_calibration_are_no_log(tmp_path, header: str) -> None:
    rows = "\n".join(",".join(str(k + n) for n in range(header.count(",") + 1)) for k in range(1, 6))
    (tmp_path / "readings.csv").write_text(f"{header}\n{rows}\n")
    found = inspect_file(tmp_path / "readings.csv")
    assert (found.kind, found.channels, dict(found.renamed)) == ("readings", (), {})
    assert all(column.quantity for column in found.columns)
