"""Drive files and logs with units in their headers: what they become, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import TorqueModel, identify_balance
from elastogeo.errors import FormatError, InputError
from elastogeo.formats.documents.feed_drives import read_drives
from elastogeo.formats.recording_files import PartHead, RecordedChannel, Samples, encode_part, part_name

STEP = 0.002


def motion(samples: int = 3000) -> dict[str, np.ndarray]:
    """A simulated X axis: slow enough for a cut-off of 30 Hz to keep all of it."""
    time = STEP * np.arange(samples)
    turns = [(2 * np.pi * f, size) for f, size in ((0.5, 20.0), (1.3, 4.0), (2.9, 1.0))]
    x = sum(size * np.sin(w * time) for w, size in turns)
    v = sum(size * w * np.cos(w * time) for w, size in turns)
    a = sum(-size * w**2 * np.sin(w * time) for w, size in turns)
    return {"time_s": time, "position_x_mm": x, "velocity_x_mm_s": v, "acceleration_x_mm_s2": a}


def write(path: Path, columns: dict[str, np.ndarray]) -> Path:
    rows = [
        ",".join(columns),
        *(",".join(f"{float(value)!r}" for value in row) for row in zip(*columns.values(), strict=True)),
    ]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def log(path: Path, *left: str, friction: float = 4.0, **more: np.ndarray) -> Path:
    """A log with the named columns. Its current is 0.004 a + 0.02 v + friction tanh(v / 2) + 0.3."""
    m = motion()
    v = m["velocity_x_mm_s"]
    current = 0.004 * m["acceleration_x_mm_s2"] + 0.02 * v + friction * np.tanh(v / 2) + 0.3
    columns = {name: values for name, values in m.items() if name.partition("_")[0] in ("time", *left)}
    return write(path, {**columns, "current_x_A": current, **more})


def drive_file(folder: Path, text: str) -> Path:
    path = folder / "drive.toml"
    path.write_text(f'schema = "elastogeo.drive/1"\nname = "a mill"\n{text}', encoding="utf-8")
    return path


def test_a_log_with_units_needs_no_drive_file(tmp_path: Path) -> None:
    path = log(tmp_path / "run_1.csv", "position", "velocity", "acceleration")
    test = read_drives([path])
    (record,) = test.records
    assert (record.run, record.axis, record.effort_unit) == ("run_1", "X", "A")
    assert_allclose(record.acceleration, motion()["acceleration_x_mm_s2"])


def test_what_is_missing_of_the_motion_is_differentiated_and_said(tmp_path: Path) -> None:
    for left in (("position",), ("velocity",), ("position", "velocity")):
        test = read_drives([log(tmp_path / "run.csv", *left)])
        (record,) = test.records
        inside = slice(300, -300)
        at = np.searchsorted(motion()["time_s"], record.time[inside] - 1e-9)
        assert_allclose(record.velocity[inside], motion()["velocity_x_mm_s"][at], atol=0.01)
        assert_allclose(record.acceleration[inside], motion()["acceleration_x_mm_s2"][at], atol=0.7)
        (note,) = [note for note in test.notes if "low-pass" in note]
        assert "a zero-phase low-pass of 30 Hz, through which the effort goes as well" in note
        assert "so the inertia is too large by" in note


def test_a_balance_from_positions_alone_is_that_of_the_simulation(tmp_path: Path) -> None:
    text = 'logs = ["run_*.csv"]\n[model]\nsmooth_speed_mm_s = 2\ncutoff_Hz = 20\n'
    for k, friction in enumerate((4.0, 4.0)):
        log(tmp_path / f"run_{k}.csv", "position", friction=friction)
    test = read_drives([drive_file(tmp_path, text)])
    fit = identify_balance(test.of("X"), test.model)
    expected = {"inertia": 0.004, "viscous": 0.02, "coulomb": 4.0, "constant": 0.3}
    assert fit.determined == pytest.approx(expected, rel=0.02)


def test_a_drive_file_says_channels_drives_model_and_held_out_runs(tmp_path: Path) -> None:
    m = motion()
    for k in range(3):
        columns = {
            "Xpos": m["position_x_mm"] * 1000,
            "Xvel": m["velocity_x_mm_s"],
            "Xacc": m["acceleration_x_mm_s2"],
            "I|1": m["velocity_x_mm_s"],
        }
        write(tmp_path / f"run_{k}.csv", columns)
    channels = "".join(
        f'[[channels]]\nquantity = "{quantity}"\nchannel = "{name}"\nunit = "{unit}"\n'
        for quantity, name, unit in (
            ("position_x", "Xpos", "um"),
            ("velocity_x", "Xvel", "mm_s"),
            ("acceleration_x", "Xacc", "mm_s2"),
            ("current_x", "I|1", "mA"),
        )
    )
    text = f"""
logs = ["run_0.csv", "run_*.csv"]
held_out = ["run_2"]
simulated = "sines"
{channels}
[clock]
sample_time_ms = 2
[[drives]]
axis = "X"
torque_constant_N_m_per_A = 1.65
pitch_mm = 10
sense = -1
[model]
least_speed_mm_min = 12
search = ["delay"]
compare = false
[[known]]
axis = "X"
parameter = "inertia"
value = 3.5
unit = "N mm s^2/mm"
"""
    drive_file(tmp_path, text)
    test = read_drives([tmp_path], held_out=["run_1"])
    record = test.records[0]
    assert test.runs == ("run_0", "run_1", "run_2")
    assert test.held_out == ("run_2", "run_1")
    assert (test.name, test.simulated, test.searched, test.compare) == ("a mill", "sines", ("delay",), False)
    assert test.model.least_speed == pytest.approx(0.2)
    assert test.known == {"X": {"inertia": 3.5}}
    assert record.effort_unit == "N mm"
    assert_allclose(record.position, m["position_x_mm"], atol=1e-9)
    assert_allclose(record.effort, -1650 * m["velocity_x_mm_s"] / 1000)


def test_a_load_has_the_direction_pattern_of_the_circle(tmp_path: Path) -> None:
    """Eqs. 6.7 and 6.8: cos theta for X, sin theta for Y."""
    time = STEP * np.arange(2000)
    theta = 0.5 * time + 0.1
    columns = {"time_s": time}
    for name, at, centre in (("x", np.cos, 100.0), ("y", np.sin, -50.0)):
        columns |= {f"position_{name}_mm": centre + 30 * at(theta), f"velocity_{name}_mm_s": time * 0 + 1.0}
        columns |= {f"acceleration_{name}_mm_s2": time * 0, f"current_{name}_A": theta}
    write(tmp_path / "bare.csv", columns)
    write(tmp_path / "loaded.csv", columns)
    text = 'logs = ["*.csv"]\n[[loads]]\nname = "40 um"\nruns = ["loaded"]\ncentre_mm = [100, -50]\n'
    test = read_drives([drive_file(tmp_path, text)])
    patterns = {(r.run, r.axis): r.disturbance for r in test.records}
    assert patterns["bare", "X"] == {}
    assert_allclose(patterns["loaded", "X"]["40 um"], np.cos(theta), atol=1e-12)
    assert_allclose(patterns["loaded", "Y"]["40 um"], np.sin(theta), atol=1e-12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('logs = ["none_*.csv"]', r"no log matches 'none_\*.csv' in .*; copy the logs there, or correct the path"),
        ("logs = []", "names no log"),
        ('logs = ["r*/a.csv"]', "write a file, or a pattern in its last part"),
        ('logs = ["a.csv"]\naxes = ["Y"]', "the logs have no current, torque or force of axis Y"),
        ('logs = ["a.csv"]\nheld_out = ["b"]', "the run 'b' is to be held out, but there are a"),
        ('logs = ["a.csv"]\n[model]\nsearch = ["inertia"]', "model.search has 'inertia'; name some of smooth_speed"),
        ('logs = ["a.csv"]\n[model]\nterms = ["friction"]', "no term 'friction'"),
        ('logs = ["a.csv"]\n[model]\nleast_speed = 1', "least_speed has no unit; write for example least_speed_mm_s"),
        (
            'logs = ["a.csv"]\n[[known]]\naxis = "X"\nparameter = "inertia"\nvalue = 1\nunit = "kg"',
            "inertia of axis X is given in 'kg'; write it in 'A s\\^2/mm'",
        ),
        (
            'logs = ["a.csv"]\n[[known]]\naxis = "X"\nparameter = "mass"\nvalue = 1.0\nunit = "kg"',
            "'mass' is none of the parameters inertia, viscous",
        ),
        (
            'logs = ["a.csv"]\n[[known]]\naxis = "Y"\nparameter = "inertia"\nvalue = 1.0\nunit = "A"',
            "there is no record of axis 'Y', there are X",
        ),
        ('logs = ["a.csv"]\n[[loads]]\nname = "l"\nruns = ["c"]', "a load acts in the run 'c', but the logs are a"),
        ('logs = ["a.csv"]\n[[loads]]\nname = "l"\nruns = ["a"]', "needs the positions of X and Y at the same times"),
        ('logs = ["a.csv"]\n[[loads]]\nname = "l"\nruns = ["a"]\naxes = ["X", "X"]', "acts in the plane of two axes"),
    ],
)
def test_what_a_drive_file_may_not_say(tmp_path: Path, text: str, message: str) -> None:
    log(tmp_path / "a.csv", "position", "velocity", "acceleration")
    with pytest.raises((FormatError, InputError), match=message):
        read_drives([drive_file(tmp_path, text)])


def test_logs_that_hold_no_drive_are_refused(tmp_path: Path) -> None:
    full = log(tmp_path / "full.csv", "position")
    with pytest.raises(FormatError, match="is a drive file, which names its logs; give it alone"):
        read_drives([drive_file(tmp_path, 'logs = ["full.csv"]'), full])
    bare = {name: values for name, values in motion().items() if "position" in name or "time" in name}
    with pytest.raises(FormatError, match="no channel is the current, torque or force of a drive"):
        read_drives([write(tmp_path / "bare.csv", bare)])
    with pytest.raises(FormatError, match="has the effort of axis X, but neither its position nor its velocity"):
        read_drives([log(tmp_path / "blind.csv")])
    other = tmp_path / "other"
    other.mkdir()
    with pytest.raises(FormatError, match="two logs are called full; a run is named after its file"):
        read_drives([full, log(other / "full.csv", "position")])
    short = {name: values[:10] for name, values in bare.items()} | {"current_x_A": np.ones(10)}
    with pytest.raises(FormatError, match="no segment of the record has the 16 samples"):
        read_drives([write(tmp_path / "short.csv", short)])
    with pytest.raises(FormatError, match="cannot be opened"):
        read_drives([tmp_path / "missing.csv"])
    (tmp_path / "wrong.toml").write_text('schema = "elastogeo.test/1"\n', encoding="utf-8")
    with pytest.raises(FormatError, match=r'begin the file with schema = "elastogeo\.drive/1"'):
        read_drives([tmp_path / "wrong.toml"])


def test_the_sense_of_a_motor_counts_without_its_constant_too(tmp_path: Path) -> None:
    log(tmp_path / "a.csv", "position", "velocity", "acceleration")
    plain = read_drives([tmp_path / "a.csv"]).records[0]
    (turned,) = read_drives([drive_file(tmp_path, 'logs = ["a.csv"]\n[[drives]]\naxis = "X"\nsense = -1\n')]).records
    assert turned.effort_unit == "A"
    assert_allclose(turned.effort, -plain.effort)


def test_percent_of_rated_torque_gives_percent_or_with_the_rated_torque_newton_millimetres(tmp_path: Path) -> None:
    m = motion()
    for k in range(2):
        load = 100 * (0.02 * m["velocity_x_mm_s"] / 50 + 0.1)
        write(tmp_path / f"run_{k}.csv", {**{name: m[name] for name in m}, "LOAD|X": load})
    text = 'logs = ["run_*.csv"]\n[[channels]]\nquantity = "torque_x"\nchannel = "LOAD|X"\nunit = "%"\n'
    motions = "".join(f'[[channels]]\nquantity = "{kind}_x"\n' for kind in ("position", "velocity", "acceleration"))
    fit = identify_balance(read_drives([drive_file(tmp_path, text + motions)]).of("X"))
    assert fit.effort_unit == "%"
    assert fit.determined["viscous"] == pytest.approx(0.04)
    rated = text + "rated_torque_N_m = 25\n" + motions
    fit = identify_balance(read_drives([drive_file(tmp_path, rated)]).of("X"))
    assert fit.effort_unit == "N mm"
    assert fit.determined["viscous"] == pytest.approx(0.04 / 100 * 25_000)


def test_a_current_in_percent_and_a_motor_constant_ask_for_the_rated_current(tmp_path: Path) -> None:
    log(tmp_path / "run.csv", "position", "velocity", "acceleration")
    text = (tmp_path / "run.csv").read_text(encoding="utf-8").replace("current_x_A", "current_x [%]")
    (tmp_path / "run.csv").write_text(text, encoding="utf-8")
    drives = '[[drives]]\naxis = "X"\ntorque_constant_N_m_per_A = 1.5\npitch_mm = 10\n'
    with pytest.raises(FormatError, match=r"current_x is in % of a rated current.*write rated_current_A"):
        read_drives([drive_file(tmp_path, f'logs = ["run.csv"]\n{drives}')])


def recording(folder: Path, parts: int = 3) -> Path:
    """A recording of the simulated axis, in parts as the recorder writes them."""
    m = motion()
    values = [m["position_x_mm"], 0.004 * m["acceleration_x_mm_s2"] + 0.02 * m["velocity_x_mm_s"] + 0.3]
    channels = tuple(
        RecordedChannel(name, unit, f"ns=2;s={name}", 0, None) for name, unit in (("position_x", "mm"), ("current_x", "A"))
    )
    folder.mkdir()
    for number, rows in enumerate(np.array_split(np.arange(len(m["time_s"])), parts), 1):
        count = len(rows)
        samples = Samples(
            np.repeat(np.arange(2, dtype=np.int32), count),
            np.tile(np.rint(m["time_s"][rows] * 1e9).astype(np.int64) + 10**18, 2),
            np.concatenate([one[rows] for one in values]),
            np.zeros(2 * count, dtype=np.uint32),
            np.zeros(2 * count, dtype=np.bool_),
        )
        (folder / part_name(number)).write_bytes(encode_part(PartHead("opc.tcp://machine", channels), samples))
    return folder


def test_a_recording_is_one_run_with_the_names_that_the_recorder_teaches(tmp_path: Path) -> None:
    folder = recording(tmp_path / "monday")
    test = read_drives(folder)
    assert test.runs == ("monday",)
    fit = identify_balance(test.of("X"), TorqueModel(("inertia", "viscous", "constant")))
    assert fit.determined == pytest.approx({"inertia": 0.004, "viscous": 0.02, "constant": 0.3}, rel=0.02)
    in_parts = read_drives(sorted(folder.iterdir()))
    assert in_parts.runs == ("monday",)
    assert_allclose(in_parts.records[0].effort, test.records[0].effort)
    assert len(read_drives(sorted(folder.iterdir())[:2]).records[0].time) < 0.7 * len(test.records[0].time)
    by_file = read_drives(drive_file(tmp_path, 'logs = ["monday"]\n[model]\nleast_speed_mm_s = 1\n'))
    assert by_file.runs == ("monday",)


def test_a_folder_that_is_neither_says_so(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"holds no drive\.toml and no parts of a recording; name the logs themselves"):
        read_drives(tmp_path)
