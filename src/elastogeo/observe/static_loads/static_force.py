"""A force between tool and workpiece and a displacement sensor beside it: force ramps, loading cycles, weights.

ISO 230-1:2012 as thesis 6.2 reports it (the standard's own text was not seen): the static load is applied between tool and
workpiece, and the displacement is measured in the direction of the force. `elastogeo.identification.static_tests` looks at
its loading and unloading branches; here the run becomes observations, from which joint compliances are identified.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from elastogeo.machine import MM_OR_RAD, Array, AxisCommands, Machine, Point, loop_frames, workpiece_ball
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations
from elastogeo.observe.run import Run
from elastogeo.observe.setup import SetupFact
from elastogeo.observe.static_loads.load import axes_along, commands_row, static_commands
from elastogeo.observe.static_loads.static_load import StaticLoad
from elastogeo.observe.template import FORCE, Template

_SETUP = """\
[setup]
direction = [1, 0, 0]            # of the force on the tool; a weight pulls along [0, 0, -1]
# sensor = [1, 0, 0]             # in which the sensor counts as positive, if not along the force
pose = { @CENTRE@ }            # where the machine stands
"""

_SIMULATION = """\
readings = 120                   # 40 of each loading cycle, from zero to the run's force and back
end_deg = 1080

[imperfection]
noise_um = 0.05
resolution_um = 0.1

[values]                         # true parameters, in mm, N, rad
C_XXX = 6e-5
C_XXY = 1e-5
E_R0 = 0.002
"""


@instrument("static-force")
@dataclass(frozen=True, slots=True)
class StaticForce(StaticLoad):
    """Set-up of a static force with one displacement sensor.

    A run stands still; runs at several places name them by columns of axis positions (`x_mm`, `c_deg`). The sensor's zero is
    a parameter like others: ask for `E_R0` with the compliances, or zero the sensor without load.

    Attributes
    ----------
    direction : 3-vector or None
        Of the force on the tool; a weight pulls along (0, 0, -1). None if the runs record `force_x`, `force_y`, `force_z`.
    sensor : 3-vector or None
        Direction in which a displacement of the tool counts as positive; None for that of the force.
    pose : mapping of str to float [mm, rad]
        Axis commands; an axis not named is at zero.
    lever : tuple of 3 float [mm]
        From the tool point to where the force acts.
    in_workpiece : bool
        Whether directions, lever and components of the force are given in the (turned) workpiece frame rather than in the
        foundation.
    tool : tuple of 3 float or None [mm]
        Point whose displacement is read, in the frame of the last tool-branch carriage; None for the machine's own.
    ramp : bool
        For the simulation alone: whether a run without a column of its force loads to it and unloads (one turn of the
        simulation's angle is one cycle), rather than being read at this force throughout.
    """

    direction: Direction | None = None
    sensor: Direction | None = None
    pose: AxisCommands = field(default_factory=dict)
    lever: Point = (0.0, 0.0, 0.0)
    in_workpiece: bool = False
    tool: Point | None = None
    ramp: bool = True

    extra: ClassVar = "loading-cycles"
    template: ClassVar = Template(
        title="Static force and a displacement sensor",
        setup=_SETUP,
        columns="force_N (of every reading), displacement_um",
        simulation=_SIMULATION,
        machine="huron_kx8",
        levels=(250.0, 500.0, 750.0),
        repeats=2,
        influences=FORCE,
    )

    def __post_init__(self) -> None:
        """Refuse directions that are none."""
        self.sensitive_direction()
        self.check_direction()

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """The compliances in translation that force and sensor show, and the sensor's zero."""
        force = "XYZ" if self.direction is None else axes_along(self.direction)
        seen = force if self.sensor is None else axes_along(self.sensor)
        return (f"C_[{seen}][{force}]?", "E_R0")

    def sensitive_direction(self) -> Array:
        """Unit direction of the sensor, shape (3,).

        Raises
        ------
        InputError
            If neither sensor nor force has a direction, or it is none.
        """
        given = self.sensor if self.sensor is not None else self.direction
        return unit_vector((0.0, 0.0, 0.0) if given is None else given, "the direction of the sensor")

    def facts(self) -> tuple[SetupFact, ...]:
        """Directions of force and sensor, and where the machine stands."""
        along = [] if self.direction is None else [SetupFact("direction of the force", (self.direction,))]
        sensor = [] if self.sensor is None else [SetupFact("direction of the sensor", (self.sensor,))]
        return (*along, *sensor, SetupFact("pose", self.pose, MM_OR_RAD))

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to: the sensor reads along its direction, the wrench is that of the force.

        Raises
        ------
        InputError
            If the run lacks a column or a force, moves, or has a value that is no finite number.
        """
        place = static_commands(machine, run, self.pose)
        commands = np.repeat(commands_row(machine, place), self.instants_of(run), axis=0)
        tool = self.tool_point(machine)
        frame = loop_frames(machine, commands[:1], tool).workpiece if self.in_workpiece else None
        sensor = self.sensitive_direction()[np.newaxis]
        along = sensor if frame is None else frame.vector(sensor)
        lines = np.repeat(np.hstack([along, np.zeros((1, 3))]), len(commands), axis=0)
        return self.observed(machine, run, commands, lines, workpiece_ball(machine, place, tool), frame)
