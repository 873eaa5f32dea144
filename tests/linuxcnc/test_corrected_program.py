"""LinuxCNC makes a contour on axes whose errors are known, as it was programmed and with its points moved: what the nut
does is nearer to the contour by as much as was predicted."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.formats import program_text, read_program_bytes
from elastogeo.machine import Machine, parse_topology, path_of_program
from elastogeo.observe import MachineTest
from tests.linuxcnc import test_screw_compensation as screws
from tests.linuxcnc.control import Axis, Recorded, headless_or_skip, run_control

PLACES = np.linspace(-230.0, 230.0, 12)
AXES = (
    Axis("X", PLACES, 9e-5 * PLACES + 2e-7 * PLACES**2, 0.006),
    Axis("Y", PLACES, -6e-5 * PLACES - 1.5e-7 * PLACES**2, 0.004),
    Axis("Z"),
)
"""Scales and bows, and nuts with play."""

CONTOUR = """\
G21 G17 G90
G0 X-70 Y-70
G1 X-60 Y-60 F3000
G1 X40
G3 X60 Y-40 I0 J20 F1500
G1 Y60 F3000
G1 X-40
G3 X-60 Y40 I0 J-20 F1500
G1 Y-60 F3000
M2
"""
"""Both axes come in + to its beginning, so that the nuts lie where the first lines have them."""

CONTROL = 2.0e-3
"""By how much [mm] control and program may leave the path: 1 um of blending (G64 P0.001), 0.5 um of lines, and rounding."""


def known(folder: Path) -> object:
    """What five cycles of a sensor with 0.3 um of noise say of X and of Y, by parameters."""
    recorded = run_control(AXES, screws.stops(screws.cycle()), folder)
    random = np.random.default_rng(11)
    tests = {letter: screws.read_by_a_sensor(recorded, letter, 5, 3e-4, random) for letter in "XY"}
    machine = Machine("simulated", parse_topology("wFXYZt"))
    return eg.identify({name.lower(): MachineTest(name, machine, test.setup, test.runs) for name, test in tests.items()})


def distances(recorded: Recorded) -> np.ndarray:
    """Of the nut from the contour as it was meant, at every fifth sample on it, shape (m,) [mm]."""
    machine = Machine("simulated", parse_topology("wFXYZt"))
    meant = path_of_program(read_program_bytes(CONTOUR.encode(), "contour"), machine, 0.5).commands[:, :2]
    meant = np.vstack([[-60.0, -60.0], meant[np.argmax(meant[:, 0] > -60 + 1e-9) :]])
    command = recorded.command["X"]
    there = int(np.argmax(command < -69.9))
    rows = np.arange(there + int(np.argmax(command[there:] > -59.9)), len(command), 5)
    nut = np.column_stack([recorded.actual["X"], recorded.actual["Y"]])[rows]
    return np.array([_from(point, meant[:-1], np.diff(meant, axis=0)) for point in nut])


def _from(point: np.ndarray, start: np.ndarray, side: np.ndarray) -> float:
    """Distance of a point from the nearest of some sides."""
    share = np.clip(np.sum((point - start) * side, axis=1) / np.sum(side**2, axis=1), 0, 1)
    return float(np.hypot(*(start + share[:, np.newaxis] * side - point).T).min())


@pytest.mark.nightly
def test_the_contour_is_nearer_by_as_much_as_predicted(tmp_path: Path) -> None:
    headless_or_skip()
    for name in ("known", "before", "after"):
        (tmp_path / name).mkdir()
    program = read_program_bytes(CONTOUR.encode(), "contour")
    found = eg.compensate_path(known(tmp_path / "known"), program)
    assert found.components == ("x", "y")
    corrected = program_text(found.program, "linuxcnc")
    before = distances(run_control(AXES, program_text(program, "linuxcnc"), tmp_path / "before"))
    after = distances(run_control(AXES, corrected, tmp_path / "after"))
    assert len(before) > 500
    far, near = (float(np.quantile(one, 0.99)) for one in (before, after))  # the control rounds the sharp corner besides
    assert far == pytest.approx(np.nanmax(np.abs(found.before.value[:, 3])), abs=CONTROL)
    assert near < np.nanmax(np.abs(found.value[:, 3]) + found.expanded[:, 3]) + CONTROL
    assert near < 0.35 * far
    assert np.median(after) < 0.1 * np.median(before)
