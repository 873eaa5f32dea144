"""A frame of displacement sensors about the tool: the full small twist of the tool relative to the workpiece.

The Stiffness Workspace System (thesis 6.2, ref. 5) applies a force of known size and direction and reads twelve displacement
sensors. Each reads `n . t + (r x n) . w`: translation t and rotation w of the body that it touches, at
the lever r from the tool point. `sensor_twist` gives the twist itself; here the readings become
observations, from which joint compliances are identified.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import MM_OR_RAD, Array, AxisCommands, Machine, Point, loop_frames, workpiece_ball
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations
from elastogeo.observe.run import Run
from elastogeo.observe.setup import SetupFact
from elastogeo.observe.static_loads.load import commands_row, static_commands
from elastogeo.observe.static_loads.static_load import StaticLoad
from elastogeo.observe.template import FORCE, Template


@dataclass(frozen=True, slots=True)
class Sensor:
    """A displacement sensor of a frame.

    Attributes
    ----------
    point : tuple of 3 float [mm]
        Where it touches the body, from the tool point.
    direction : 3-vector
        In which a displacement of the body counts as positive.
    """

    point: Point
    direction: Direction

    def __post_init__(self) -> None:
        """Refuse a sensor without place or direction."""
        if not np.isfinite(self.point).all():
            raise InputError(f"the point of a sensor is {self.point} mm; it must be three finite numbers")
        unit_vector(self.direction, "the direction of a sensor")


def sensitivities(sensors: Sequence[Sensor]) -> Array:
    """What each sensor reads per unit of each twist component at the tool point, shape (k, 6) [mm/mm, mm/rad].

    Raises
    ------
    InputError
        If there is no sensor.
    """
    if not sensors:
        raise InputError("the frame has no sensor; give each as [[setup.sensors]] with point_mm and direction")
    n = np.array([unit_vector(sensor.direction, "the direction of a sensor") for sensor in sensors])
    return np.hstack([n, np.cross([sensor.point for sensor in sensors], n)])


_SENSORS = (
    ((60, -40, 30), (1, 0, 0)),
    ((60, 40, 30), (1, 0, 0)),
    ((60, 0, -50), (1, 0, 0)),
    ((-40, 60, 20), (0, 1, 0)),
    ((40, 60, 30), (0, 1, 0)),
    ((-45, -30, 90), (0, 0, 1)),
    ((40, -35, 90), (0, 0, 1)),
    ((0, 50, 90), (0, 0, 1)),
)
_SETUP = """\
[setup]
direction = [1, 2, -2]           # of the force on the tool
lever_mm = [15, -10, -40]        # from the tool point to where it acts
pose = { @CENTRE@ }            # where the machine stands
""" + "".join(
    f"\n[[setup.sensors]]\npoint_mm = {list(point)}\ndirection = {list(direction)}\n" for point, direction in _SENSORS
)

_SIMULATION = """\
readings = 24

[imperfection]
noise_um = 0.05
resolution_um = 0.1

[values]                         # true parameters, in mm, N, rad
C_XXX = 6e-5
C_YYY = 4e-5
C_CXX = 2e-8
"""


@instrument("sensor-frame")
@dataclass(frozen=True, slots=True)
class SensorFrame(StaticLoad):
    """Set-up of a frame of displacement sensors.

    A run stands still and has one column per sensor, `displacement_1`, `displacement_2`, ..., zeroed without load; runs at
    several places name them by columns of axis positions (`x_mm`, `c_deg`). Each of its rows is one observation of every
    sensor, sensor after sensor.

    Attributes
    ----------
    sensors : tuple of Sensor
        They hang on the workpiece side and touch a body on the tool side.
    direction : 3-vector or None
        Of the force on the tool; None if the runs record `force_x`, `force_y`, `force_z`.
    pose : mapping of str to float [mm, rad]
        Axis commands; an axis not named is at zero.
    lever : tuple of 3 float [mm]
        From the tool point to where the force acts.
    in_workpiece : bool
        Whether points, directions, lever and components of the force are given in the (turned) workpiece frame rather than
        in the foundation.
    tool : tuple of 3 float or None [mm]
        Tool point in the frame of the last tool-branch carriage; None for the machine's own.
    ramp : bool
        For the simulation alone: whether a run without a column of its force loads to it and unloads (one turn of the
        simulation's angle is one cycle), rather than being read at this force throughout.
    """

    sensors: tuple[Sensor, ...]
    direction: Direction | None = None
    pose: AxisCommands = field(default_factory=dict)
    lever: Point = (0.0, 0.0, 0.0)
    in_workpiece: bool = False
    tool: Point | None = None
    ramp: bool = True

    extra: ClassVar = "twist"
    template: ClassVar = Template(
        title="Frame of displacement sensors",
        setup=_SETUP,
        columns="force_N (of every reading), displacement_1_um to displacement_8_um",
        simulation=_SIMULATION,
        machine="huron_kx8",
        levels=(300.0, 600.0),
        repeats=3,
        influences=FORCE,
    )

    def __post_init__(self) -> None:
        """Refuse a frame without sensors, and a direction that is none."""
        sensitivities(self.sensors)
        self.check_direction()

    @property
    def readings(self) -> tuple[str, ...]:
        """Columns of the sensors."""
        return tuple(f"displacement_{k}" for k in range(1, len(self.sensors) + 1))

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """The compliances: which sums of them one place and one direction of the force show, the answer says."""
        return ("compliance",)

    def facts(self) -> tuple[SetupFact, ...]:
        """How many sensors, the direction of the force, where the machine stands."""
        along = [] if self.direction is None else [SetupFact("direction of the force", (self.direction,))]
        return (SetupFact("sensors", len(self.sensors)), *along, SetupFact("pose", self.pose, MM_OR_RAD))

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to: every sensor's readings, one sensor after the other.

        The sensitive direction of a sensor is a twist, `(n, r x n)`: its rotation counts in mm per rad, so that the reading
        is a displacement.

        Raises
        ------
        InputError
            If the run lacks a column or a force, moves, or has a value that is no finite number.
        """
        place = static_commands(machine, run, self.pose)
        commands = np.repeat(commands_row(machine, place), self.instants_of(run), axis=0)
        tool = self.tool_point(machine)
        frame = loop_frames(machine, commands[:1], tool).workpiece if self.in_workpiece else None
        seen = sensitivities(self.sensors)
        if frame is not None:
            seen = np.hstack([frame.vector(seen[:, :3]), frame.vector(seen[:, 3:])])
        lines = np.repeat(seen, len(commands), axis=0)
        return self.observed(machine, run, commands, lines, workpiece_ball(machine, place, tool), frame)
