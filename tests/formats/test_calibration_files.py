"""Calibration files: written and read back, named by a test, in its observations; and what is refused."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from elastogeo.drive import SetupCompliance
from elastogeo.errors import FormatError
from elastogeo.formats import (
    CalibrationDocument,
    DeflectionDocument,
    calibration_text,
    example_test,
    read_calibration,
    read_test,
    write_calibration,
)
from elastogeo.identification.calibrations import calibrate_force
from elastogeo.machine import About
from elastogeo.observe import BallRoller, Calibration, LoadedBallBar

EXAMPLES = Path(__file__).parents[2] / "examples"

HEAD = 'schema = "elastogeo.calibration/1"\n'
FORCE = Calibration((0.4, 6.0), (36.4, 741.7), (0.8, 1.1), -0.25, 12.0, 0.002, 50.0)


def test_a_file_read_back_is_the_same(tmp_path: Path) -> None:
    about = About(date="2026-03-01", instrument='load cell "A\\B"', remarks="cold\nshop")
    document = CalibrationDocument(
        name="gauge 7", force=FORCE, setup_deflection=DeflectionDocument(2.33e-3, 4e-5, 9.0), about=about
    )
    (tmp_path / "g.toml").write_text(calibration_text(document))
    assert read_calibration(tmp_path / "g.toml") == document
    alone = CalibrationDocument(force=Calibration((1.0, 6.0), (112.0, 742.0)))
    (tmp_path / "h.toml").write_text(calibration_text(alone))
    assert read_calibration(tmp_path / "h.toml") == alone


def named(tmp_path: Path, more: str = "") -> Path:
    """The shipped example with its calibration in a file of its own."""
    folder = tmp_path / "t"
    shutil.copytree(example_test().with_name("hermle-c50-ldbb"), folder)
    text = (folder / "test.toml").read_text()
    start, end = text.index("[setup.calibration]"), text.index("[question]")
    text = text[:start] + text[end:]
    text = text.replace("[setup]\n", '[setup]\ncalibration = "gauge.toml"\n' + more)
    (folder / "test.toml").write_text(text)
    return folder


def test_a_test_names_its_calibration(tmp_path: Path) -> None:
    folder = named(tmp_path)
    document = CalibrationDocument(force=FORCE, setup_deflection=DeflectionDocument(2.33e-3, 4e-5, 9.0))
    (folder / "gauge.toml").write_text(calibration_text(document))
    setup = read_test(folder).setup
    assert isinstance(setup, LoadedBallBar)
    assert setup.calibration == FORCE
    assert setup.setup_deflection == pytest.approx(2.33e-3)
    assert setup.setup_deflection_uncertainty == pytest.approx(4e-5)
    assert setup.setup_deflection_degrees_of_freedom == 9.0


def test_what_was_calibrated_is_what_the_test_takes(tmp_path: Path) -> None:
    pressure = np.tile(np.linspace(0.4, 6, 7), 2)
    noise = np.random.default_rng(6).standard_normal(14)
    found = calibrate_force(pressure, 126 * pressure - 14 + noise, relative=0.003)
    folder = named(tmp_path)
    (folder / "gauge.toml").write_text(calibration_text(CalibrationDocument(force=found.calibration)))
    test = read_test(folder)
    assert isinstance(test.setup, LoadedBallBar)
    assert test.setup.calibration == found.calibration
    labels = [influence.label for influence in test.observations()[0].influences]
    assert labels == ["force calibration", "force calibration", "load cell"]


def test_what_is_no_calibration_is_refused(tmp_path: Path) -> None:
    folder = named(tmp_path, "setup_deflection_um_per_bar = 2.33\n")
    gauge = folder / "gauge.toml"
    with pytest.raises(FormatError, match=r"gauge\.toml: cannot be opened"):
        read_test(folder)
    gauge.write_text(HEAD)
    with pytest.raises(FormatError, match=r"gauge\.toml: holds no calibration; write a table \[force\]"):
        read_test(folder)
    gauge.write_text(calibration_text(CalibrationDocument(force=FORCE, setup_deflection=DeflectionDocument(2.33e-3))))
    with pytest.raises(FormatError, match=r"gauge\.toml: gives the deflection of the set-up, and the test gives setup_def"):
        read_test(folder)
    gauge.write_text(f"{HEAD}[force]\npressure_bar = [1, 6]\nforce_N = [1]\n")
    with pytest.raises(FormatError, match=r"gauge\.toml: force: a force calibration needs at least two pressures"):
        read_test(folder)


def test_a_ball_roller_test_names_the_indicator_test_of_its_set_up(tmp_path: Path) -> None:
    rollers = SetupCompliance(compliance=(5.3e-5, 6.9e-5), engagement=(0.04, 0.2), standard_uncertainty=6e-7)
    folder = tmp_path / "t"
    shutil.copytree(EXAMPLES / "ball-roller", folder)
    write_calibration(folder / "rollers.toml", rollers=rollers)
    assert read_calibration(folder / "rollers.toml").setup_compliance == rollers
    text = (folder / "test.toml").read_text()
    text = text.replace("[setup]\n", '[setup]\ncalibration = "rollers.toml"\n', 1)
    (folder / "test.toml").write_text(text)
    with pytest.raises(FormatError, match=r"rollers\.toml: gives the set-up's compliance, and the test gives \[setup"):
        read_test(folder)
    start = text.index("[setup.setup]")
    end = text.index("[", start + 20 + text[start + 20 :].index("\n\n"))
    (folder / "test.toml").write_text(text[:start] + text[end:])
    setup = read_test(folder).setup
    assert isinstance(setup, BallRoller)
    assert setup.setup == rollers
