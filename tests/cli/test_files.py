"""The doors that look at files: inspect and calibrate."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import linregress, t

from elastogeo.formats import read_calibration

PRESSURE = np.array([1.0, 2, 3, 4, 5, 6, 5, 4, 3, 2, 1, 2, 3, 4, 5, 6])


def written(path: Path, **columns: np.ndarray) -> Path:
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns), *(",".join(f"{value:.6f}" for value in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def readings(tmp_path: Path) -> tuple[Path, Path]:
    random = np.random.default_rng(3)
    force = 126 * PRESSURE - 14 + 2 * random.standard_normal(len(PRESSURE))
    dial = 2.33 * PRESSURE + 0.4 + 0.05 * random.standard_normal(len(PRESSURE))
    cell = written(tmp_path / "cell.csv", pressure_bar=PRESSURE, force_N=force)
    return cell, written(tmp_path / "dial.csv", pressure_bar=PRESSURE, displacement_um=dial)


def test_a_calibration_is_the_regression_of_its_readings(elastogeo, readings, tmp_path):
    """Against scipy's regression, slope and its interval; the file that is written holds the line at its ends."""
    code, out, err = elastogeo("calibrate", *readings, "-o", tmp_path / "gauge.toml", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    force = np.loadtxt(readings[0], delimiter=",", skiprows=1)[:, 1]
    expected = linregress(PRESSURE, force)
    slope = found["force"]["slope_N_per_bar"]
    assert slope["value"] == pytest.approx(expected.slope)
    assert slope["standard_uncertainty"] == pytest.approx(expected.stderr)
    half = t.ppf(0.975, len(force) - 2) * expected.stderr
    assert slope["interval95"] == pytest.approx([expected.slope - half, expected.slope + half])
    assert slope["interval95"][0] < 126 < slope["interval95"][1]
    post = found["setup"]["deflection_um_per_bar"]
    assert abs(post["value"] - 2.33) < 3 * post["standard_uncertainty"]
    made = read_calibration(tmp_path / "gauge.toml")
    assert made.force.force == pytest.approx((expected.intercept + expected.slope, expected.intercept + 6 * expected.slope))
    assert made.setup_deflection.value == pytest.approx(post["value"] / 1000)


def test_the_load_cell_enters_the_uncertainty(elastogeo, readings):
    plain, cell = (
        json.loads(elastogeo("calibrate", readings[0], *more, "--json")[1])["force"]["slope_N_per_bar"]
        for more in ((), ("--load-cell", "0.01"))
    )
    assert cell["standard_uncertainty"] == pytest.approx(np.hypot(plain["standard_uncertainty"], 0.01 * plain["value"]))


def test_a_calibration_says_what_friction_and_a_bend_do(elastogeo, tmp_path):
    rising = np.sign(np.diff(PRESSURE, prepend=0.0))
    stuck = written(tmp_path / "f.csv", pressure_bar=PRESSURE, force_N=126 * PRESSURE - 14 - 8 * rising + 0.01 * PRESSURE**2)
    code, out, _ = elastogeo("calibrate", stuck, "--report", tmp_path / "r")
    assert code == 0
    assert re.search(r"look  same force rising and falling: With rising pressure the force is 1[4-6] N smaller", out)
    assert (tmp_path / "r" / "report.html").stat().st_size > 5000
    bent = written(tmp_path / "b.csv", pressure_bar=PRESSURE, force_N=126 * PRESSURE + 3 * PRESSURE**2)
    assert "The readings bend" in elastogeo("calibrate", bent)[1]


def test_dials_at_ball_and_roller_calibrate_a_ball_roller_device(elastogeo, tmp_path):
    """Tables 6.5, 6.6 of the thesis: the machine's increments and what a ball-roller test is to subtract."""
    dials = Path(__file__).parents[2] / "examples" / "indicator-test" / "dials.csv"
    code, out, err = elastogeo("calibrate", dials, "--resolution-um", "1", "-o", tmp_path / "rollers.toml", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    increments = [one["stiffness_N_per_um"] for one in found["springs"]["machine"]["increments"]]
    assert increments == pytest.approx([10.9, 15.0, 14.7, 14.6], abs=0.06)
    rollers = read_calibration(tmp_path / "rollers.toml").setup_compliance
    assert [1e-3 / value for value in rollers.compliance] == pytest.approx([18.9, 17.3, 16.3, 15.8, 14.5])
    assert found["setup"]["standard_uncertainty_um_per_N"] == pytest.approx(rollers.standard_uncertainty * 1000)


def test_what_is_no_calibration_is_refused(elastogeo, readings, tmp_path):
    other = written(tmp_path / "o.csv", angle_deg=PRESSURE, radial_um=PRESSURE)
    code, out, err = elastogeo("calibrate", other)
    assert (code, out) == (2, "")
    assert "hold angle, radial; they need pressure_bar, and either force_N" in err
    assert "two sets of readings hold a force" in elastogeo("calibrate", readings[0], readings[0])[2]
    (tmp_path / "there.toml").write_text("")
    assert "is there already" in elastogeo("calibrate", readings[0], "-o", tmp_path / "there.toml")[2]
    assert (tmp_path / "there.toml").read_text() == ""


def test_inspect_says_what_is_missing_and_how_to_map_it(elastogeo, tmp_path):
    log = written(tmp_path / "log.csv", time_s=np.arange(5) / 100, X_act=np.arange(5.0), X_cur=np.ones(5))
    code, out, err = elastogeo("inspect", log)
    assert (code, err) == (0, "")
    assert "[[channels]]" in out
    assert 'channel = "X_cur"' in out
    found = json.loads(elastogeo("inspect", log, "--json")[1])
    assert found["schema"] == "elastogeo.inspection/1"
    assert [column["name"] for column in found["columns"]] == ["X_act", "X_cur"]
    assert found["columns"][0]["rate_Hz"] == pytest.approx(100)
    assert found["duration_s"] == pytest.approx(0.04)


def test_inspect_maps_nothing_that_is_understood(elastogeo, readings):
    code, out, _ = elastogeo("inspect", readings[0])
    assert code == 0
    assert "2 columns, understood as they stand" in out
    assert "[[channels]]" not in out


def test_inspect_knows_documents_and_refuses_what_it_does_not_know(elastogeo, tmp_path):
    elastogeo("new", tmp_path / "t")
    assert "It is a test file (TOML)" in elastogeo("inspect", tmp_path / "t")[1]
    (tmp_path / "x.bin").write_bytes(bytes(range(256)) * 10)
    code, out, err = elastogeo("inspect", tmp_path / "x.bin")
    assert (code, out) == (2, "")
    assert "x.bin" in err
