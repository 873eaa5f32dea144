"""A test of the demo fleet as a folder: what an instrument's computer writes, marked as simulated throughout."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from pathlib import Path

from elastogeo.formats import Simulation, simulate
from elastogeo.history.fleets.stories import Story
from elastogeo.machine import AxisCommands
from elastogeo.observe import Imperfection

FROM_WHAT = "a test of the demo fleet; nothing was measured"
IMPERFECT = Imperfection(noise=1e-4, resolution=1e-4, eccentricity=5e-4, force_scatter=0.002)
FORCES = (50, 250, 500)
READINGS = 90
SCHEMA = "elastogeo.simulation/1"

_TEST = """\
schema = "elastogeo.test/1"
name = "Monthly test, loaded circle in XY"
machine = "{model}"
instrument = "loaded-ball-bar"
"""
_ABOUT = """\
resolution_um = 0.1
simulated = "{simulated}"

[about]
date = "{at}"
operator = "demo"
place = "{place}"
machine_serial = "{machine}"
instrument_serial = "{bar}"
temperature_degC = {temperature:.1f}
"""
_CIRCLE = """
[setup]
feed_mm_min = 2000

[setup.circle]
radius_mm = 150
plane = "XY"
centre = { X_mm = 0, Y_mm = 0, Z_mm = 0, A_deg = 0, C_deg = 0 }

[question]
parameters = ["loaded-xy", "B_XX", "B_YY"]
"""
_RUN = """
[[runs]]
file = "runs/{force}-{sense}.csv"
force_N = {force}
sense = "{sense}"
repeat = 1
"""


def write_test(folder: Path, story: Story, at: datetime, temperature: float, values: Mapping[str, float], seed: int) -> Path:
    """Write a test of a machine, with simulated readings.

    Parameters
    ----------
    folder : Path
        It must not exist.
    at : datetime
        When it is measured.
    temperature : float [degC]
    values : mapping of str to float
        What is true of the machine then.
    seed : int
        Of the noise of the readings.

    Returns
    -------
    Path
        The folder.
    """
    folder.mkdir(parents=True)
    text = _TEST.format(model=story.model) + about(story, at, temperature) + _CIRCLE
    runs = (_RUN.format(force=force, sense=sense) for force in FORCES for sense in ("cw", "ccw"))
    (folder / "test.toml").write_text(text + "".join(runs), encoding="utf-8")
    read_by_instrument(folder, values, seed)
    return folder


def about(story: Story, at: datetime, temperature: float) -> str:
    """What a test file says of the day it was measured on [degC], and that nothing was measured."""
    return _ABOUT.format(
        simulated=FROM_WHAT,
        at=at.isoformat(timespec="minutes"),
        place=story.place,
        machine=story.serial,
        bar=story.bar,
        temperature=temperature,
    )


def read_by_instrument(
    folder: Path,
    values: Mapping[str, float],
    seed: int,
    imperfection: Imperfection = IMPERFECT,
    centre: AxisCommands | None = None,
) -> None:
    """Write the readings of the runs that a test names, simulated; polynomials count from `centre`, or the test's own."""
    truth = Simulation(SCHEMA, values, seed, READINGS, exact=False, imperfection=imperfection, centre=centre or {})
    simulate(folder, truth, write=True)
