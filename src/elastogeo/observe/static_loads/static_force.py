"""A force between tool and workpiece and a displacement sensor beside it: force ramps, loading cycles, weights.

ISO 230-1:2012 as thesis 6.2 reports it (the standard's own text was not seen): the static load is applied between tool and
workpiece, and the displacement is measured in the direction of the force. `elastogeo.identification.static_tests` looks at
its loading and unloading branches; here the run becomes observations, from which joint compliances are identified.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from elastogeo.machine import MM_OR_RAD, Array, AxisCommands, Block, Machine, Point, loop_frames, workpiece_ball
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.displacements import check_displacements, recorded
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations, check_observations
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup, SetupFact
from elastogeo.observe.static_loads.load import (
    axes_along,
    commands_row,
    force_columns,
    force_level,
    force_sizes,
    force_vectors,
    planned,
    static_commands,
    static_program,
    with_lever,
)
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
class StaticForce(Setup):
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
    limits: ClassVar = ("force", "sensor")
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
        if self.direction is not None:
            unit_vector(self.direction, "the direction of the force")

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have; `force` may be left out of a run that is given its force as a whole."""
        return (*force_columns(self.direction), "displacement")

    @property
    def pose_quantity(self) -> str:
        """The size of the force."""
        return "force"

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
        columns = recorded(run, self.quantities, optional="force")
        count = len(columns["displacement"])
        tool = np.array(machine.tool if self.tool is None else self.tool)
        place = static_commands(machine, run, self.pose)
        commands = np.repeat(commands_row(machine, place), count, axis=0)
        frame = loop_frames(machine, commands[:1], tool).workpiece
        sensor, lever = self.sensitive_direction()[np.newaxis], np.array([self.lever])
        force = force_vectors(run, self.direction, count, run.force)
        sizes = force_sizes(force, self.direction)
        if self.in_workpiece:
            sensor, lever, force = frame.vector(sensor), frame.vector(lever), frame.vector(force)
        observations = Observations(
            run=run.name,
            force=force_level(sizes, run.force),
            pose=sizes,
            commands=commands,
            velocity=np.zeros_like(commands),
            acceleration=np.zeros_like(commands),
            centre=np.array([self.pose.get(axis, 0.0) for axis in machine.axes]),
            direction=np.asfortranarray(np.repeat(np.hstack([sensor, np.zeros((1, 3))]), count, axis=0)),
            wrench=with_lever(force, lever),
            reading=columns["displacement"],
            correction=np.zeros(count),
            tool=tool,
            workpiece=workpiece_ball(machine, place, tool),
        )
        check_observations(observations)
        check_displacements(run, ["displacement"])
        return observations

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:
        """To the pose of each run, and a stop there."""
        return static_program(machine, runs, self.pose, self.template.title, procedure)

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the displacements that the sensor would give at its forces."""
        columns = planned(machine, run, self.direction, ramp=self.ramp)
        count = max(map(len, (columns or run.columns).values()), default=0)
        blank = self.observe(machine, replace(run, columns={**columns, "displacement": np.zeros(count)}))
        true = respond(replace(blank, wrench=blank.wrench * imperfection.force_factor(random)))
        return replace(run, columns={**columns, "displacement": imperfection.noisy(true - blank.reading, random)})
