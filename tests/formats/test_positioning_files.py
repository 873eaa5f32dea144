"""Run files of positioning tests: directions as people write them, units that fit the axis, files and back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import FormatError
from elastogeo.formats import new_test, read_run, read_test, simulate
from elastogeo.formats.runs.parquet import write_parquet
from elastogeo.identification import identify

TEST = """\
schema = "elastogeo.test/1"
name = "positioning"
machine = "hermle_c50"
instrument = "positioning"
[setup]
axis = "{axis}"
targets_{unit} = [1, 22, 61, 95]
cycles = 2
{more}
[[runs]]
file = "run.csv"
"""


def folder_with(tmp_path: Path, run: str, axis: str = "X", unit: str = "mm", more: str = "") -> Path:
    (tmp_path / "test.toml").write_text(TEST.format(axis=axis, unit=unit, more=more), encoding="utf-8")
    if run:
        (tmp_path / "run.csv").write_text(run, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(("plus", "minus"), [("+", "-"), ("1", "-1"), ("+1", "-1"), ("↑", "↓"), ("Forward", "Backward")])
def test_directions_are_read_as_people_write_them(tmp_path: Path, plus: str, minus: str) -> None:
    rows = f"target_mm,direction,position_mm\n0,{plus},0.001\n10,{plus},10.002\n10,{minus},10.003\n0,{minus},0.001\n"
    (tmp_path / "run.csv").write_text(rows, encoding="utf-8")
    assert read_run(tmp_path / "run.csv").column("direction").tolist() == [1, 1, -1, -1]


def test_a_word_that_is_no_direction_is_refused_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text("target_mm,direction,position_mm\n0,+,0.1\n9,sideways,9.1\n", encoding="utf-8")
    with pytest.raises(FormatError, match="line 3, column direction: 'sideways' is not a number"):
        read_run(tmp_path / "run.csv")


def test_a_sign_alone_is_no_reading(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text("target_mm,direction,position_mm\n0,+,0.1\n9,+,-\n", encoding="utf-8")
    with pytest.raises(FormatError, match="line 3, column position_mm: '-' is not a number"):
        read_run(tmp_path / "run.csv")


ROWS = "0,+,0.001\n10,+,10.002\n20,+,20.001\n20,-,20.003\n10,-,10.001\n0,-,0.001\n"


@pytest.mark.parametrize(
    ("axis", "header", "message"),
    [
        ("X", "target_deg,direction,position_mm", "has the unit deg; with the set-up of this test write target_mm"),
        ("C", "target_mm,direction,position_deg", "has the unit mm; with the set-up of this test write target_deg"),
        ("C", "target_deg,direction,position_um", "column 'position' has the unit um; with the set-up of this test write"),
        ("X", "target_mm,direction_mm,position_mm", "column 'direction' has the unit mm; .* write direction without a unit"),
    ],
)  # fmt: skip
def test_units_of_another_dimension_are_refused(tmp_path: Path, axis: str, header: str, message: str) -> None:
    folder = folder_with(tmp_path, f"{header}\n{ROWS}", axis, "mm" if axis == "X" else "deg")
    with pytest.raises(FormatError, match=message):
        read_test(folder)


@pytest.mark.parametrize("unit", ["mm", "um", "in"])
def test_any_unit_of_length_gives_the_same_deviations(tmp_path: Path, unit: str) -> None:
    scale = {"mm": 1.0, "um": 1e3, "in": 1 / 25.4}[unit]
    lines = [line.split(",") for line in ROWS.split()]
    rows = "\n".join(f"{float(target) * scale!r},{side},{float(read) * scale!r}" for target, side, read in lines)
    test = read_test(folder_with(tmp_path, f"target_{unit},direction,position_{unit}\n{rows}\n"))
    (seen,) = test.observations()
    assert_allclose(seen.reading, [0.001, 0.002, 0.001, 0.003, 0.001, 0.001], atol=1e-12)


@pytest.mark.parametrize(
    ("axis", "unit", "more", "header", "truth"),
    [
        ("X", "mm", "", "position_mm", "E_XX1"),
        ("C", "deg", "", "position_deg", "E_CC1"),
        ("X", "mm", "direction = [0, 1, 0]", "deviation_um", "E_YX2"),
        ("X", "mm", "about = [0, 0, 1]", "deviation_arcsec", "E_CX1"),
    ],
)
def test_a_simulated_test_comes_back_through_its_files(
    tmp_path: Path, axis: str, unit: str, more: str, header: str, truth: str
) -> None:
    folder = folder_with(tmp_path, "", axis, unit, more)
    values = {"E_XX1": 1e-5, "E_CC1": 2e-5, "E_YX2": 3e-7, "E_CX1": 4e-7}
    simulation = f'schema = "elastogeo.simulation/1"\nexact = false\n[values]\n{truth} = {values[truth]}\n'
    (folder / "simulation.toml").write_text(simulation, encoding="utf-8")
    in_memory = simulate(folder, write=True)
    assert header in (folder / "run.csv").read_text(encoding="utf-8")
    test = read_test(folder)
    for one, other in zip(test.observations(), in_memory.observations(), strict=True):
        assert np.ptp(one.reading) > 1e-7
        assert_allclose(one.reading, other.reading, atol=2e-12)
    assert identify(test)[truth].value == pytest.approx(values[truth], rel=1e-4)


def test_parquet_keeps_the_units_too(tmp_path: Path) -> None:
    folder = folder_with(tmp_path, "")
    data = write_parquet({"target_deg": [0.0, 1.0], "position_mm": [0.0, 1.0]}, {})
    (folder / "run.csv").write_bytes(data)
    with pytest.raises(FormatError, match="has the unit deg"):
        read_test(folder)


def test_a_new_positioning_test_simulates_and_is_supported(tmp_path: Path) -> None:
    folder = new_test(tmp_path / "new", instrument="positioning").parent
    found = identify(simulate(folder))
    assert set(found) == {"E_XX1", "E_XX2", "E_XX3", "B_XX"}
    assert found["B_XX"].interval is not None


def test_the_temperature_stands_in_the_test_file(tmp_path: Path) -> None:
    warm = "axis_at = { temperature_degC = 22, expansion_um_per_m = 11.5, temperature_uncertainty_degC = 0.3 }"
    test = read_test(folder_with(tmp_path, f"target_mm,direction,position_mm\n{ROWS}", more=warm))
    (seen,) = test.observations()
    assert_allclose(seen.correction, 23e-6 * np.array([-10, 0, 10, 10, 0, -10]), atol=1e-15)
    assert [one.label for one in seen.influences] == ["temperature of the axis"]


@pytest.mark.parametrize(
    ("axis", "stated", "message"),
    [
        ("C", "resolution_um = 0.1", "resolution_um is no resolution of its readings; write resolution_arcsec, since"),
        ("X", "resolution_arcsec = 0.1", "resolution_arcsec is no resolution of its readings; write resolution_um, since"),
    ],
)
def test_a_resolution_of_another_dimension_is_refused(tmp_path: Path, axis: str, stated: str, message: str) -> None:
    unit = "mm" if axis == "X" else "deg"
    folder = folder_with(tmp_path, f"target_{unit},direction,position_{unit}\n{ROWS}", axis, unit)
    text = (folder / "test.toml").read_text(encoding="utf-8")
    (folder / "test.toml").write_text(text.replace("[setup]", f"{stated}\n[setup]"), encoding="utf-8")
    with pytest.raises(FormatError, match=message):
        read_test(folder)


def test_the_resolution_of_an_angular_sensor_is_an_angle(tmp_path: Path) -> None:
    folder = folder_with(tmp_path, f"target_deg,direction,position_deg\n{ROWS}", "C", "deg")
    text = (folder / "test.toml").read_text(encoding="utf-8")
    (folder / "test.toml").write_text(text.replace("[setup]", "resolution_arcsec = 0.36\n[setup]"), encoding="utf-8")
    assert read_test(folder).resolution == pytest.approx(np.deg2rad(1e-4))
