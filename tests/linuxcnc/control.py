"""LinuxCNC as a control: a whole run of it without a screen, on a machine whose axes have errors that are known.

The machine is in HAL, in the control's own real-time thread: of each axis the motor follows its command exactly, and what it
carries stands where a screw with an error and a nut with play put it. The screw is a `lincurve`; the nut stays where it was
until the screw has taken up the play (`limit1`, whose input is its own last output). The control sees the motor only, as an
encoder on a motor does. A sampler records, 1000 times a second, command, motor and nut of each axis.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pytest

from elastogeo.formats import read_log
from tests.linuxcnc.unpacked import is_debian, linuxcnc_or_skip, may_run_headless

MOST_POINTS = 16
"""Points of a `lincurve`."""

PERIOD = 0.001
"""Of the servo thread [s]."""

SPEED, ACCELERATION = 1000.0, 4000.0
"""Limits of an axis [mm/s, mm/s^2]."""


@dataclass(frozen=True)
class Axis:
    """An axis of the machine.

    Attributes
    ----------
    letter : str
    position, error : sequence of float [mm]
        Of the motor, ascending; and by how much the nut is too far there without play.
    play : float [mm]
        Of the nut on the screw: half of it is missing in either direction.
    settings : mapping of str to object
        More lines of its joint in the ini file: COMP_FILE, COMP_FILE_TYPE, BACKLASH.
    """

    letter: str
    position: Sequence[float] = (-300.0, 300.0)
    error: Sequence[float] = (0.0, 0.0)
    play: float = 0.0
    settings: Mapping[str, object] = field(default_factory=dict)

    def true_error(self, position, sense):
        """The error [mm] of the nut where the motor stands, come to in a direction."""
        return np.interp(position, self.position, self.error) - self.play / 2 * sense


@dataclass(frozen=True)
class Recorded:
    """What was recorded, by axis letter, shape (m,) each [mm]: the control's command, where the motor went, where the nut
    was."""

    command: Mapping[str, np.ndarray]
    motor: Mapping[str, np.ndarray]
    actual: Mapping[str, np.ndarray]


def headless_or_skip() -> Path:
    """The unpacked folder; leaves the test out where no mount namespace can be made, and says so."""
    if not may_run_headless() and not (is_debian() and os.geteuid() == 0):
        pytest.skip("LinuxCNC as a control: it takes Debian, root and mount namespaces")
    if not may_run_headless():
        pytest.skip("LinuxCNC as a control: this machine lets no mount namespace be made")
    return linuxcnc_or_skip()


def run_control(
    axes: Sequence[Axis], program: str, folder: Path, acceleration: float = ACCELERATION, seconds: float = 40.0
) -> Recorded:
    """Run a program on the control, from power on to its end, and read back what was recorded.

    Parameters
    ----------
    axes : sequence of Axis
        One for each joint.
    program : str
        Of the LinuxCNC dialect.
    folder : Path
        To run in; files that the axes' settings name are there.
    acceleration : float [mm/s^2]
        Of each axis.
    seconds : float
        After which it is given up.
    """
    root = headless_or_skip()
    files = {
        "machine.ini": _ini(axes, acceleration),
        "machine.hal": _hal(axes),
        "program.ngc": program,
        "tools.tbl": "T1 P1 Z0 D0 ;\n",
        "operate.py": _OPERATOR,
        "run.sh": _SCRIPT,
    }
    for name, content in files.items():
        (folder / name).write_text(content, encoding="ascii")
    (folder / "operate.py").chmod(0o755)
    for path in (folder, *folder.iterdir()):
        shutil.chown(path, 65534, 65534)
    command = ["unshare", "-m", "-p", "-i", "-n", "-f", "--kill-child", "--mount-proc", "bash", "run.sh", str(root)]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, timeout=seconds)
    except subprocess.TimeoutExpired as late:
        raise AssertionError(f"LinuxCNC did not end within {seconds:g} s:\n{(late.stdout or b'')[-2000:]!r}") from None
    trace = folder / "trace.txt"
    assert (folder / "done").exists(), f"the program did not end:\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return _recorded(trace, axes)


def standing(command: np.ndarray, least: int = 60) -> np.ndarray:
    """The last sample of each stop of an axis that is so many samples long, shape (stops,); a pause is no second stop."""
    moved = np.flatnonzero(np.abs(np.diff(command)) > 1e-9)
    ends = np.append(moved, len(command) - 1)
    long = np.diff(ends, prepend=-1) >= least
    return ends[long]


def _recorded(trace: Path, axes: Sequence[Axis]) -> Recorded:
    """The three signals of each axis, from the recording as the program's own reader has it."""
    channels = [channel.values for name, channel in read_log(trace).channels.items() if name != "sample"]
    assert len(channels) == 3 * len(axes)
    parts = [{axis.letter: channels[3 * k + part] for k, axis in enumerate(axes)} for part in range(3)]
    return Recorded(*parts)


def _ini(axes: Sequence[Axis], acceleration: float) -> str:
    letters = "".join(axis.letter for axis in axes)
    parts = [
        f"""[EMC]
VERSION = 1.1
MACHINE = machine
DEBUG = 0
[DISPLAY]
DISPLAY = ./operate.py
[TASK]
TASK = milltask
CYCLE_TIME = 0.010
[RS274NGC]
PARAMETER_FILE = variables.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 1.0
SERVO_PERIOD = {round(PERIOD * 1e9)}
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.100
TOOL_TABLE = tools.tbl
[HAL]
HALFILE = machine.hal
[KINS]
KINEMATICS = trivkins coordinates={letters}
JOINTS = {len(axes)}
[TRAJ]
COORDINATES = {" ".join(letters)}
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = {SPEED:g}
MAX_LINEAR_VELOCITY = {2 * SPEED:g}
NO_FORCE_HOMING = 1
"""
    ]
    for k, axis in enumerate(axes):
        limits = f"MIN_LIMIT = -1000\nMAX_LIMIT = 1000\nMAX_VELOCITY = {SPEED:g}\nMAX_ACCELERATION = {acceleration:g}\n"
        own = "".join(f"{name} = {value}\n" for name, value in axis.settings.items())
        parts.append(f"[AXIS_{axis.letter}]\n{limits}")
        parts.append(
            f"[JOINT_{k}]\nTYPE = LINEAR\nHOME = 0\nHOME_SEQUENCE = 0\nFERROR = 100\nMIN_FERROR = 100\n{limits}{own}"
        )
    return "".join(parts)


def _hal(axes: Sequence[Axis]) -> str:
    count = len(axes)
    lines = [
        "loadrt [KINS]KINEMATICS",
        "loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS",
        f"loadrt lincurve count={count} personality={','.join([str(MOST_POINTS)] * count)}",
        f"loadrt limit1 count={count}",
        f"loadrt sum2 count={2 * count}",
        f"loadrt sampler depth=60000 cfg={'fff' * count}",
        "addf motion-command-handler servo-thread",
        "addf motion-controller servo-thread",
        "net stop iocontrol.0.user-enable-out iocontrol.0.emc-enable-in",
        "net asked iocontrol.0.tool-prepare iocontrol.0.tool-prepared",
        "net change iocontrol.0.tool-change iocontrol.0.tool-changed",
    ]
    for k, axis in enumerate(axes):
        lines += [
            f"net motor-{k} joint.{k}.motor-pos-cmd joint.{k}.motor-pos-fb lincurve.{k}.in sampler.0.pin.{3 * k + 1}",
            f"net command-{k} joint.{k}.pos-cmd sampler.0.pin.{3 * k}",
            f"net screw-{k} lincurve.{k}.out sum2.{2 * k}.in0 sum2.{2 * k + 1}.in0",
            f"net least-{k} sum2.{2 * k}.out limit1.{k}.min",
            f"net most-{k} sum2.{2 * k + 1}.out limit1.{k}.max",
            f"net nut-{k} limit1.{k}.out limit1.{k}.in sampler.0.pin.{3 * k + 2}",
            f"setp sum2.{2 * k}.in1 {-axis.play / 2!r}",
            f"setp sum2.{2 * k + 1}.in1 {axis.play / 2!r}",
            *(f"setp lincurve.{k}.{name}-val-{i:02d} {value!r}" for name, i, value in _curve(axis)),
            f"addf lincurve.{k} servo-thread",
            f"addf sum2.{2 * k} servo-thread",
            f"addf sum2.{2 * k + 1} servo-thread",
            f"addf limit1.{k} servo-thread",
        ]
    return "\n".join([*lines, "addf sampler.0 servo-thread", ""])


def _curve(axis: Axis):
    """The points of a screw; those that it does not need lie beyond its end."""
    assert 2 <= len(axis.position) == len(axis.error) <= MOST_POINTS
    places = [*map(float, axis.position)]
    values = [float(place + error) for place, error in zip(axis.position, axis.error, strict=True)]
    for i in range(MOST_POINTS):
        beyond = max(i - len(places) + 1, 0)
        k = min(i, len(places) - 1)
        yield "x", i, places[k] + beyond
        yield "y", i, values[k] + beyond


_SCRIPT = """\
# In namespaces of its own: its files, locks, shared memory, ports and processes are seen by nobody else and end with it.
set -e
mount --bind "$PWD" /mnt
mount -t overlay overlay -o lowerdir="$1"/usr:/usr /usr
mount -t overlay overlay -o lowerdir="$1"/etc:/etc /etc
mount -t tmpfs tmpfs /tmp
cd /mnt
exec setpriv --reuid=65534 --regid=65534 --clear-groups env HOME="$PWD" linuxcnc -r machine.ini
"""

_OPERATOR = """\
#!/usr/bin/python3
# What a person does at the control: power on, start, wait for the end; the sampler records from start to end.
import signal, subprocess, sys, time
import linuxcnc

command, state, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()

def wait(condition, seconds, what):
    end = time.time() + seconds
    while time.time() < end:
        state.poll()
        found = errors.poll()
        if found:
            print("error", found, flush=True)
        if condition():
            return
        time.sleep(0.01)
    sys.exit("no " + what)

command.state(linuxcnc.STATE_ESTOP_RESET)
wait(lambda: state.task_state != linuxcnc.STATE_ESTOP, 5, "reset")
command.state(linuxcnc.STATE_ON)
wait(lambda: state.task_state == linuxcnc.STATE_ON, 5, "power")
command.home(-1)
wait(lambda: all(state.homed[: state.joints]), 5, "home")
command.mode(linuxcnc.MODE_AUTO)
command.wait_complete()
command.program_open("program.ngc")
sampler = subprocess.Popen(["halsampler", "-t", "trace.txt"])
time.sleep(0.2)
command.auto(linuxcnc.AUTO_RUN, 1)
wait(lambda: state.interp_state != linuxcnc.INTERP_IDLE, 5, "start")
wait(lambda: state.interp_state == linuxcnc.INTERP_IDLE, 600, "end")
time.sleep(0.2)
sampler.send_signal(signal.SIGINT)
sampler.wait(5)
open("done", "w").close()
"""
