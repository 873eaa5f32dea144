"""What every set-up has that stands still while a force acts at the tool and displacement sensors are read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from elastogeo.machine import Array, AxisCommands, Block, Frame, Machine, Point
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.displacements import check_displacements, read_by, recorded
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.observations import Observations, check_observations
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup
from elastogeo.observe.static_loads.load import (
    force_columns,
    force_level,
    force_sizes,
    force_vectors,
    planned,
    static_program,
    with_lever,
)


class StaticLoad(Setup):
    """A set-up whose readings are displacements under a force at the tool, while the machine stands.

    Attributes
    ----------
    direction : 3-vector or None
        Of the force on the tool; None if the runs record `force_x`, `force_y`, `force_z`.
    pose : mapping of str to float [mm, rad]
        Axis commands; an axis not named is at zero.
    lever : tuple of 3 float [mm]
        From the tool point to where the force acts.
    tool : tuple of 3 float or None [mm]
        Tool point in the frame of the last tool-branch carriage; None for the machine's own.
    ramp : bool
        For the simulation alone: whether a run without a column of its force loads to it and unloads (one turn of the
        simulation's angle is one cycle), rather than being read at this force throughout.
    """

    __slots__ = ()

    direction: Direction | None
    pose: AxisCommands
    lever: Point
    tool: Point | None
    ramp: bool

    limits: ClassVar = ("force", "sensor")

    @property
    def readings(self) -> tuple[str, ...]:
        """Columns of the sensors: by default there is one."""
        return ("displacement",)

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have; `force` may be left out of a run that is given its force as a whole."""
        return (*force_columns(self.direction), *self.readings)

    @property
    def pose_quantity(self) -> str:
        """The size of the force."""
        return "force"

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:
        """To the pose of each run, and a stop there."""
        title = self.template.title if self.template else type(self).__name__
        return static_program(machine, runs, self.pose, title, procedure)

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the displacements that the sensors would give at its forces."""
        columns = self.planned_columns(machine, run)
        count = max(map(len, (columns or run.columns).values()), default=0)
        zeros = dict.fromkeys(self.readings, np.zeros(count))
        blank = self.observe(machine, replace(run, columns={**columns, **zeros}))
        true = respond(replace(blank, wrench=blank.wrench * imperfection.force_factor(random)))
        read = read_by(imperfection, true - blank.reading, len(self.readings), random)
        return replace(run, columns={**columns, **dict(zip(self.readings, read, strict=True))})

    def planned_columns(self, machine: Machine, run: Run) -> dict[str, Array]:
        """The columns of a run that is to be simulated, without readings: where it stands, and its forces."""
        return planned(machine, run, self.direction, ramp=self.ramp)

    def check_direction(self) -> None:
        """Refuse a direction of the force that is none."""
        if self.direction is not None:
            unit_vector(self.direction, "the direction of the force")

    def tool_point(self, machine: Machine) -> Array:
        """The tool point in the frame of the last tool-branch carriage, shape (3,) [mm]."""
        return np.array(machine.tool if self.tool is None else self.tool)

    def instants_of(self, run: Run) -> int:
        """How often the sensors of a run are read.

        Raises
        ------
        InputError
            If the run lacks a column, they differ in length, or there is no reading.
        """
        return len(recorded(run, self.quantities, optional="force")[self.readings[0]])

    def observed(
        self,
        machine: Machine,
        run: Run,
        commands: Array,
        lines: Array,
        workpiece: Array,
        turned: Frame | None = None,
        span: tuple[str, ...] | None = None,
    ) -> Observations:
        """The observations of a run: every sensor's readings, one sensor after the other.

        Parameters
        ----------
        machine : Machine
        run : Run
        commands : array, shape (m, n) [mm, rad]
            At every instant.
        lines : array, shape (k m, 6)
            Sensitive direction of each of k sensors at every instant, sensor after sensor.
        workpiece : array, shape (3,) or (k m, 3) [mm]
        turned : Frame, optional
            In which lever and components of the force are given, if not in the foundation.
        span : tuple of str, optional
            The joints across which the sensors read.

        Raises
        ------
        InputError
            If a force is not known, or a number is not finite.
        """
        count, sensors = len(commands), len(self.readings)
        lever, force = np.array([self.lever]), force_vectors(run, self.direction, count, run.force)
        sizes = force_sizes(force, self.direction)
        if turned is not None:
            lever, force = turned.vector(lever), turned.vector(force)
        stands = np.asfortranarray(np.tile(commands, (sensors, 1)))
        observations = Observations(
            run=run.name,
            force=force_level(sizes, run.force),
            pose=np.tile(sizes, sensors),
            commands=stands,
            velocity=np.zeros_like(stands),
            acceleration=np.zeros_like(stands),
            centre=np.array([self.pose.get(axis, 0.0) for axis in machine.axes]),
            direction=np.asfortranarray(lines),
            wrench=np.asfortranarray(np.tile(with_lever(force, lever), (sensors, 1))),
            reading=np.concatenate([run.columns[name] for name in self.readings]),
            correction=np.zeros(count * sensors),
            tool=self.tool_point(machine),
            workpiece=workpiece,
            span=span,
            instant=np.tile(np.arange(float(count)), sensors) if sensors > 1 else None,
        )
        check_observations(observations)
        check_displacements(run, self.readings)
        return observations
