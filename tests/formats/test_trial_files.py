"""A test on disk: simulated, written, read back, identified; and what is refused."""

import shutil
import subprocess
import sys

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import (
    example_test,
    full_turn,
    poses_of,
    read_simulation,
    read_test,
    write_new_test,
    write_runs,
)
from elastogeo.formats.trial_files import read_test_document
from elastogeo.sources import simulate


@pytest.fixture
def folder(tmp_path):
    write_new_test(tmp_path / "t", "hermle_c50", (36.0, 742.0), 2)
    return tmp_path / "t"


def simulated(folder):
    truth = read_simulation(folder / "simulation.toml")
    return simulate(read_test(folder, poses_of(truth)), truth.values, truth.imperfection, truth.seed), truth


def test_simulated_runs_survive_the_file_to_its_nine_decimals(folder):
    test, truth = simulated(folder)
    write_runs(folder, test, truth.seed)
    back = read_test(folder)
    assert [run.name for run in back.runs] == ["36N-1", "36N-2", "742N-1", "742N-2"]
    for one, other in zip(test.runs, back.runs, strict=True):
        np.testing.assert_allclose(other.columns["radial"], one.columns["radial"], rtol=0, atol=1e-12)
        np.testing.assert_allclose(other.columns["angle"], one.columns["angle"], rtol=0, atol=1e-10)


def test_parquet_runs_are_read_like_csv_runs(folder):
    text = (folder / "test.toml").read_text()
    other = folder.parent / "p"
    shutil.copytree(folder, other)
    (other / "test.toml").write_text(text.replace(".csv", ".parquet"))
    for place in (folder, other):
        test, truth = simulated(place)
        write_runs(place, test, truth.seed)
    for one, two in zip(read_test(folder).runs, read_test(other).runs, strict=True):
        np.testing.assert_array_equal(one.columns["radial"], two.columns["radial"])


def test_a_recorded_run_is_never_overwritten(folder):
    (folder / "runs").mkdir()
    (folder / "runs" / "742N-1.csv").write_text("mine")
    test, truth = simulated(folder)
    with pytest.raises(FormatError, match=r"742N-1\.csv is there already.*never overwritten"):
        write_runs(folder, test, truth.seed)
    assert (folder / "runs" / "742N-1.csv").read_text() == "mine"
    assert len(list((folder / "runs").iterdir())) == 1


def test_an_ending_that_no_format_writes_is_refused(folder):
    (folder / "test.toml").write_text((folder / "test.toml").read_text().replace(".csv", ".xlsx"))
    test, truth = simulated(folder)
    with pytest.raises(FormatError, match=r"no format that elastogeo writes ends in '.xlsx'"):
        write_runs(folder, test, truth.seed)


def test_a_new_test_never_touches_a_folder_that_is_there(folder):
    with pytest.raises(FormatError, match="is there already; choose another name"):
        write_new_test(folder, "hermle_c50", (36.0,), 1)


def test_two_runs_of_one_name_are_refused(folder):
    text = (folder / "test.toml").read_text().replace("742N-2", "742N-1")
    (folder / "test.toml").write_text(text)
    with pytest.raises(InputError, match="names the run '742N-1' twice"):
        read_test(folder, full_turn(36))


def test_a_wrong_sense_is_refused(folder):
    (folder / "test.toml").write_text((folder / "test.toml").read_text().replace('sense = "ccw"', 'sense = "left"', 1))
    with pytest.raises(FormatError, match="sense is 'left'; write ccw"):
        read_test_document(folder)


def test_a_missing_run_file_is_refused_with_its_path(folder):
    with pytest.raises(FormatError, match=r"36N-1.csv: cannot be opened"):
        read_test(folder)


@pytest.mark.parametrize(("example", "runs"), [("hermle-c50-ldbb", 15), ("ball-bar-diagnosis", 6), ("one-level", 3)])
def test_the_examples_are_reproduced_byte_for_byte(example, runs, tmp_path):
    folder = example_test().parent
    command = [sys.executable, str(folder / "make_runs.py"), str(folder / example), str(tmp_path / "again")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{runs} runs in" in done.stdout
    assert "0 differ" in done.stdout


def test_the_example_says_that_it_is_simulated_and_from_what():
    test = read_test(example_test())
    assert "Not measured: simulated from" in test.simulated
    assert "Tables 5.5 and 5.6" in test.simulated
    assert sorted({run.pressure for run in test.runs}) == [0.4, 1, 2, 3, 4, 5, 6]
    assert [len([r for r in test.runs if r.pressure == p]) for p in (3, 4)] == [5, 5]
