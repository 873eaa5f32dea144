"""A test on disk: simulated, written, read back, identified; and what is refused."""

import hashlib
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import (
    example_test,
    full_turn,
    new_test,
    poses_of,
    read_simulation,
    read_test,
    write_runs,
)
from elastogeo.formats.documents.machine_tests import read_test_document
from elastogeo.identification import identify
from elastogeo.machine import Workpiece
from elastogeo.sources import simulate


@pytest.fixture
def folder(tmp_path):
    new_test(tmp_path / "t", "hermle_c50", (36.0, 742.0), 2)
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


def test_simulated_runs_carry_their_mark_and_every_run_its_hash(folder):
    """The mark stands in the files: it is there for a test that does not say that its runs are simulated."""
    test, truth = simulated(folder)
    written = write_runs(folder, test, truth.seed)
    assert 'simulated = "' not in (folder / "test.toml").read_text().replace("# simulated", "")
    back = read_test(folder)
    assert back.simulated == "elastogeo, seed 1"
    assert [run.simulated for run in back.runs] == ["elastogeo, seed 1"] * 4
    assert [run.file for run in back.runs] == [f"runs/{run.name}.csv" for run in back.runs]
    assert [run.sha256 for run in back.runs] == [hashlib.sha256(path.read_bytes()).hexdigest() for path in written]
    measured = written[0].read_text().splitlines(keepends=True)
    written[0].write_text("".join(line for line in measured if "simulated" not in line))
    mixed = read_test(folder)
    assert mixed.runs[0].simulated == ""
    assert mixed.simulated == "elastogeo, seed 1"


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
        new_test(folder, "hermle_c50", (36.0,), 1)


def test_two_runs_of_one_name_are_refused(folder):
    text = (folder / "test.toml").read_text().replace("742N-2", "742N-1")
    (folder / "test.toml").write_text(text)
    with pytest.raises(InputError, match="names the run '742N-1' twice"):
        read_test(folder, full_turn(36))


def test_a_wrong_sense_is_refused(folder):
    (folder / "test.toml").write_text(
        (folder / "test.toml").read_text().replace("repeat = 1", 'sense = "left"\nrepeat = 1', 1)
    )
    with pytest.raises(FormatError, match="sense is 'left'; write ccw"):
        read_test_document(folder)


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_simulated_runs_say_their_truth(folder, suffix):
    """Every digit of it."""
    file = folder / "test.toml"
    file.write_text(file.read_text().replace(".csv", suffix))
    truth = read_simulation(folder / "simulation.toml")
    values = {**truth.values, "E_C(0Y)X": 1e-5 / 3, "E_XX1": 0.0}
    test = simulate(read_test(folder, poses_of(truth)), values)
    write_runs(folder, test, truth.seed)
    assert test.truth == values
    back = read_test(folder)
    assert back.truth == values
    assert identify(back)["C_XXX"].truth == values["C_XXX"]


@pytest.mark.parametrize("text", ["C_XXX", "C_XXX=soft", "=1e-5", "C_XXX=nan", "C_XXX=1e-5 C_XXX=2e-5"])
def test_a_truth_that_is_none_is_refused(folder, text):
    test, truth = simulated(folder)
    for path in write_runs(folder, test, truth.seed):
        path.write_text(re.sub("truth: .*", f"truth: {text}", path.read_text()))
    with pytest.raises(FormatError, match=r"36N-1.csv: the truth of this simulated run is .* not a list of name=value"):
        read_test(folder)


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


def test_the_example_says_that_it_is_reconstructed_and_from_what():
    test = read_test(example_test())
    assert "Tables 5.7, 5.8 and 4.7" in test.reconstructed
    assert test.simulated == ""


def test_the_simulated_example_says_that_it_is_simulated_and_from_what():
    test = read_test(example_test().with_name("hermle-c50-ldbb"))
    assert "Not measured: simulated from" in test.simulated
    assert "Tables 5.5 and 5.6" in test.simulated
    assert sorted({run.pressure for run in test.runs}) == [0.4, 1, 2, 3, 4, 5, 6]
    assert [len([r for r in test.runs if r.pressure == p]) for p in (3, 4)] == [5, 5]


LOG = "Time [ms],X1_Pos,X1_Cur,Phase\n" + "".join(f"{2 * k},{k / 8},{k / 4 - 1},run\n" for k in range(50))
CHANNELS = """
[[channels]]
quantity = "angle"
channel = "X1_Pos"
unit = "deg"

[[channels]]
quantity = "radial"
channel = "X1_Cur"
unit = "um"
delay_ms = 4
"""


def with_logs(folder, text=LOG, more="", runs=""):
    """The test, each run of which is a log instead."""
    (folder / "runs").mkdir()
    names = ("36N-1", "36N-2", "742N-1", "742N-2")
    for name in names:
        (folder / "runs" / f"{name}.csv").write_text(text.replace(",run\n", f",{name}\n"))
    document = (folder / "test.toml").read_text().replace("repeat = ", f"{runs}\nrepeat = ")
    (folder / "test.toml").write_text(document + more)
    return folder


def test_a_test_that_names_channels_reads_its_runs_as_logs(folder):
    run = read_test(with_logs(folder, more=CHANNELS)).runs[0]
    assert list(run.columns) == ["time", "angle", "radial"]
    steps = np.arange(48)
    np.testing.assert_allclose(run.columns["time"], 0.002 * steps, atol=1e-15)
    np.testing.assert_allclose(run.columns["angle"], np.deg2rad(steps / 8), atol=1e-15)
    np.testing.assert_allclose(run.columns["radial"], ((steps + 2) / 4 - 1) / 1000, atol=1e-15)


def test_a_run_may_be_a_part_of_a_log(folder):
    run = read_test(with_logs(folder, more=CHANNELS, runs="start_ms = 20\nend_s = 0.04")).runs[-1]
    np.testing.assert_allclose(run.columns["angle"], np.deg2rad(np.arange(10, 21) / 8))
    np.testing.assert_allclose(run.columns["radial"], (np.arange(12, 23) / 4 - 1) / 1000)
    np.testing.assert_allclose(run.columns["time"], 0.002 * np.arange(11), atol=1e-15)


def test_the_clock_of_a_test_is_that_of_logs_without_one(folder):
    text = "\n".join(line.partition(",")[2] for line in LOG.splitlines()) + "\n"
    with_logs(folder, text, CHANNELS)
    with pytest.raises(FormatError, match=r"36N-1\.csv, channel 'X1_Pos': the file keeps no clock"):
        read_test(folder)
    (folder / "test.toml").write_text((folder / "test.toml").read_text() + "\n[clock]\nsample_time_ms = 4\n")
    np.testing.assert_allclose(read_test(folder).runs[0].columns["time"][:3], [0, 0.004, 0.008])


def test_a_log_that_is_no_run_is_told_from_its_content(folder):
    text = '{"Header": {"SignalListHFData": [{"Name": "CYCLE"}, {"Name": "angle_deg"}], "CycleTimeMs": 2}, "Payload": []}'
    with pytest.raises(FormatError, match=r"36N-1\.csv: its Payload holds no row of HFData"):
        read_test(with_logs(folder, text))


def test_a_run_of_readings_is_read_as_before(folder):
    test, truth = simulated(folder)
    write_runs(folder, test, truth.seed)
    assert "time" not in read_test(folder).runs[0].columns


@pytest.mark.parametrize(
    ("more", "runs", "message"),
    [
        (CHANNELS.replace('"um"', '"Ampere"'), "", "channels 2: the unit 'Ampere' of radial is not known"),
        (CHANNELS.replace("delay_ms", "delay"), "", "channels 2, delay has no unit; write for example delay_s"),
        (CHANNELS.replace("channel =", "chanel ="), "", "chanel is not known; did you mean channel?"),
        (CHANNELS + "[clock]\nlongest_gap_s = 0\n", "", "clock: longest_gap is 0.0 s; it must be above zero"),
        (CHANNELS, "start_s = 3\nend_s = 2", "the run begins at 3 s and ends at 2 s; let it end later"),
        (CHANNELS, "start_s = 3", "angle has 0 samples from 3 s to inf s; it is recorded from 0 s to 0.098 s"),
        ("", "start_s = 0.01", "no channel says what it is and its unit"),
    ],
)
def test_what_a_test_says_wrongly_of_a_log_is_told(folder, more, runs, message):
    with_logs(folder, more=more, runs=runs)
    with pytest.raises(FormatError) as caught:
        read_test(folder)
    assert message in str(caught.value)


def test_a_weight_on_the_table_is_in_kilograms(tmp_path):
    folder = tmp_path / "t"
    shutil.copytree(example_test().with_name("one-level"), folder)
    with (folder / "test.toml").open("a") as file:
        file.write("\n[workpiece]\nmass_kg = 250\ncentre_mm = [0, 100, 50]\n")
    assert read_test(folder).workpiece == Workpiece(0.25, (0.0, 100.0, 50.0))
    (folder / "test.toml").write_text((folder / "test.toml").read_text().replace("mass_kg = 250", "mass_kg = -1"))
    with pytest.raises(InputError, match="the mass not negative"):
        read_test(folder)
    (folder / "test.toml").write_text((folder / "test.toml").read_text().replace("mass_kg = -1\n", ""))
    assert read_test(folder).workpiece == Workpiece(None, (0.0, 100.0, 50.0))
