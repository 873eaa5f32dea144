"""A nest of displacement sensors about a ball, the R-test: location errors and error motions of rotary axes.

The ball sits on one end of the structural loop (in the spindle, or on the table), the nest on the other. Rotary axes turn
and the linear axes follow, so that on a perfect machine the ball never moves in the nest: in static poses, or in continuous
motion as in the tests K1 to K4 of ISO 10791-6. What the ball moves is read by three sensors or more, in any directions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import MM_OR_RAD, Array, AxisCommands, Block, LoopFrames, Machine, Motion, Point, follow, loop_frames
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector, unit_vectors
from elastogeo.observe.displacements import MOST_DISPLACEMENT, check_displacements, read_by, recorded
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.nests.beginning import TEMPLATE, template_for
from elastogeo.observe.nests.motion import BallMotion, planned_commands
from elastogeo.observe.observations import Observations, check_observations
from elastogeo.observe.procedure import Procedure, change_of_level, ordered
from elastogeo.observe.programs import Followed, FollowedRun, following_blocks
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup, SetupFact
from elastogeo.observe.template import Template

ENDS = {"tool": "t", "workpiece": "w"}
"""The two ends of the loop, and the letter of the offsets there: `E_Xt0`, `E_Xw0`."""

STANDING = 1e-7
"""A step of an axis [mm, rad] that is smaller is rounding: the axis stood."""

_LEAST_IN_MOTION = 3

MOST_TURNS = 10.0
"""Turns of a rotary axis that a run may have."""


@instrument("sphere-nest")
@dataclass(frozen=True, slots=True)
class SphereNest(Setup):
    """Set-up of a nest of displacement sensors about a ball.

    A run has one column per sensor, `displacement_1`, `displacement_2`, ..., and the commands of its rotary axes as columns
    named as the axes (`a_deg`, `c_deg`); or a column `angle` that counts along `motions`. Linear axes follow the ball; where
    their columns (`x_mm`) are recorded too, what they miss it by is subtracted from the readings. Each row is one
    observation of every sensor, sensor after sensor. The sensors need not be zeroed: zeros of the sensors are offsets of the
    end that carries the nest, so that this end is known only if the nest was calibrated in place.

    Poses count as taken at standstill, each axis in the sense in which it came from the pose before, for its backlash. A run
    in continuous motion records `time_s` too: velocities follow, for servo lag; let it hold one motion, without a jump.

    Attributes
    ----------
    sensors : tuple of 3-vector
        Directions in which a displacement of the ball in the nest counts as positive, in the frame of the end that carries
        the nest (at zero rotary commands, those of the machine); they need not be orthogonal.
    centre : mapping of str to float [mm, rad]
        Axis commands at which the ball sits in the nest; they set its place on the table.
    nest : str
        The end that carries the nest: `workpiece` (ball in the spindle) or `tool` (ball on the table).
    known : tuple of str
        The ends whose point is known, `tool`, `workpiece`, or both: nobody asks for their offsets but the question.
    motions : tuple of BallMotion
        Of a run that does not record its rotary axes: one after the other over a full turn of its `angle`.
    preload : 3-vector or None
        Direction of the force of a run on the tool, fixed in the nest; None for a nest that presses with no force.
    tool : tuple of 3 float or None [mm]
        Tool point in the frame of the last tool-branch carriage; None for the machine's own.
    """

    sensors: tuple[Direction, ...]
    centre: AxisCommands = field(default_factory=dict)
    nest: str = "workpiece"
    known: tuple[str, ...] = ("tool",)
    motions: tuple[BallMotion, ...] = ()
    preload: Direction | None = None
    tool: Point | None = None

    extra: ClassVar = "ball-deviations"
    limits: ClassVar = ("sensor",)
    template: ClassVar = TEMPLATE

    def __post_init__(self) -> None:
        """Refuse directions that are none, and ends that are none."""
        unit_vectors(self.sensors, "sensor")
        if self.preload is not None:
            unit_vector(self.preload, "the direction of the preload")
        for end in (self.nest, *self.known):
            if end not in ENDS:
                raise InputError(f"{end!r} is no end of the structural loop; write tool or workpiece")

    @classmethod
    def template_for(cls, machine: Machine) -> Template:
        """With motions and errors of the machine's own rotary axes."""
        return template_for(machine)

    @property
    def readings(self) -> tuple[str, ...]:
        """Columns of the sensors."""
        return tuple(f"displacement_{k}" for k in range(1, len(self.sensors) + 1))

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have; beside them its rotary axes, or its angle."""
        return self.readings

    @property
    def file_units(self) -> Mapping[str, str]:
        """Positions of linear axes stand in millimetres."""
        return dict.fromkeys("xyz", "mm")

    @property
    def pose_quantity(self) -> str:
        """The number of the reading: several axes move, and none of them need go one way."""
        return "reading"

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """The location errors of every rotary axis, and the offsets of the ends that are not known."""
        return ("rotary-axes", *(f"E_[XYZ]{letter}0" for end, letter in ENDS.items() if end not in self.known))

    def facts(self) -> tuple[SetupFact, ...]:
        """Directions of the sensors, where the nest is, what is known, the centre, the preload."""
        preload = [] if self.preload is None else [SetupFact("direction of the preload", (self.preload,))]
        return (
            SetupFact("sensors", self.sensors),
            SetupFact("nest", self.nest),
            SetupFact("known", ", ".join(self.known) or "neither end"),
            SetupFact("centre", self.centre, MM_OR_RAD),
            *preload,
        )

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to: every sensor's readings, one sensor after the other.

        Raises
        ------
        InputError
            If the run lacks a column, does not say where its rotary axes are, or has a value that is no finite number.
        PathError
            If the linear axes cannot follow the ball.
        """
        columns = recorded(run, self.readings)
        count, sensors = len(columns[self.readings[0]]), len(self.sensors)
        tool = np.array(machine.tool if self.tool is None else self.tool)
        rotary = self._rotary(machine, run, count)
        still = np.zeros((count, 3))
        planned = follow(machine, self.centre, Motion(still, still, still, rotary, dict.fromkeys(rotary, 0.0)), tool)
        commands = _with_recorded(machine, run, planned.position)
        velocity, acceleration = _rates(run, commands)
        frames = loop_frames(machine, commands, tool)
        directions = self._directions(frames, count)
        missed = frames.point - frames.workpiece.point(planned.ball)
        _check_followed(run, missed)
        correction = np.concatenate([np.sum(direction * missed, axis=1) for direction in directions])
        translation = np.concatenate(directions)
        observations = Observations(
            run=run.name,
            force=run.force or 0.0,
            pose=np.tile(np.arange(1.0, count + 1), sensors),
            commands=np.asfortranarray(np.tile(commands, (sensors, 1))),
            velocity=np.asfortranarray(np.tile(velocity, (sensors, 1))),
            acceleration=np.asfortranarray(np.tile(acceleration, (sensors, 1))),
            centre=np.array([self.centre.get(axis, 0.0) for axis in machine.axes]),
            direction=np.asfortranarray(np.hstack([translation, np.zeros_like(translation)])),
            wrench=np.asfortranarray(np.tile(self._wrench(run, frames, count), (sensors, 1))),
            reading=np.concatenate([columns[name] for name in self.readings]) - correction,
            correction=correction,
            tool=tool,
            workpiece=planned.ball,
            sense=np.asfortranarray(np.tile(_senses(commands), (sensors, 1))),
            instant=np.tile(np.arange(float(count)), sensors),
        )
        check_observations(observations)
        check_displacements(run, self.readings)
        return observations

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the displacements that the sensors would give at its poses, which it then records."""
        count = max(map(len, run.columns.values()), default=0)
        places = self._rotary(machine, run, count)
        linear = {axis: run.columns[axis.lower()] for axis in machine.axes if axis in "XYZ" and axis.lower() in run.columns}
        columns = {axis.lower(): values for axis, values in {**linear, **places}.items()}
        columns |= {"time": run.columns["time"]} if "time" in run.columns else {}
        zeros = dict.fromkeys(self.readings, np.zeros(count))
        blank = self.observe(machine, replace(run, columns={**columns, **zeros}))
        true = respond(replace(blank, wrench=blank.wrench * imperfection.force_factor(random)))
        read = read_by(imperfection, true - blank.reading, len(self.sensors), random)
        return replace(run, columns={**columns, **dict(zip(self.readings, read, strict=True))})

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:
        """Rotary axes from pose to pose, the linear axes follow the ball; a run with times goes on without a halt."""
        tool = None if self.tool is None else np.array(self.tool)
        test = Followed(machine, self.centre, tool, "Sphere nest", "bring the ball into the nest")
        made: list[FollowedRun] = []
        last: Run | None = None
        for run in ordered(runs, procedure.order):
            recorded_axes = any(axis.lower() in run.columns for axis in machine.axes)
            turn = np.arange(n := max(procedure.poses or 1, 1) * max(len(self.motions), 1)) * 2 * np.pi / n
            planned = run if recorded_axes else replace(run, columns={"angle": turn})
            count = max(map(len, planned.columns.values()), default=0)
            halts = "time" not in run.columns and (recorded_axes or procedure.poses > 0)
            rotary = self._rotary(machine, planned, count)
            made.append(FollowedRun(run.name, rotary, change_of_level(run, last), halts))
            last = run
        return following_blocks(test, made, procedure)

    def _rotary(self, machine: Machine, run: Run, count: int) -> dict[str, Array]:
        """Commands of the rotary axes, shape (m,) [rad]: those that the run records; if none, those of the motions."""
        axes = [joint.name for joint in machine.joints if joint.is_rotary]
        found = {axis: np.asarray(run.columns[axis.lower()]) for axis in axes if axis.lower() in run.columns}
        if not found and not self.motions:
            raise InputError(
                f"run {run.name!r} does not say where its rotary axes are: record their commands (a_deg, c_deg), or say the "
                f"[[setup.motions]]"
            )
        if not found:
            found = planned_commands(self.motions, self.centre, recorded(run, ["angle"])["angle"])
        for axis, values in found.items():
            machine.index(axis)
            if len(values) != count:
                raise InputError(f"run {run.name!r} has {count} readings and {len(values)} positions of {axis}")
            if not np.isfinite(values).all():
                row = int(np.flatnonzero(~np.isfinite(values))[0])
                raise InputError(f"run {run.name!r}: the position of {axis} at reading {row + 1} is no finite number")
            if np.ptp(values) > MOST_TURNS * 2 * np.pi:
                raise InputError(
                    f"run {run.name!r}: {axis} spans {np.ptp(values) / (2 * np.pi):.3g} turns; are they degrees given as "
                    f"radians?"
                )
        return found

    def _directions(self, frames: LoopFrames, count: int) -> list[Array]:
        """In which each sensor sees the tool move relative to the workpiece, shape (m, 3) each."""
        carrier, sign = (frames.workpiece, 1.0) if self.nest == "workpiece" else (frames.tool, -1.0)
        vectors = unit_vectors(self.sensors, "sensor")
        return [sign * np.broadcast_to(carrier.vector(vector), (count, 3)) for vector in vectors]

    def _wrench(self, run: Run, frames: LoopFrames, count: int) -> Array:
        """Of the preload on the tool, shape (m, 6) [N, N mm]."""
        wrench = np.zeros((count, 6))
        if not run.force:
            return wrench
        if self.preload is None:
            raise InputError(
                f"run {run.name!r} has a force of {run.force:g} N and the set-up no direction of it; say preload = [0, 0, 1]"
            )
        carrier = frames.workpiece if self.nest == "workpiece" else frames.tool
        wrench[:, :3] = run.force * carrier.vector(unit_vector(self.preload, "the direction of the preload"))
        return wrench


def _with_recorded(machine: Machine, run: Run, position: Array) -> Array:
    """Commands, shape (m, n), with the positions [mm] of the linear axes where the run records them."""
    for axis in machine.axes:
        values = run.columns.get(axis.lower())
        if axis in "XYZ" and values is not None:
            if not np.isfinite(values).all():
                raise InputError(f"run {run.name!r}: a position of axis {axis} is no finite number; take the reading out")
            position[:, machine.index(axis)] = values
    return position


def _rates(run: Run, commands: Array) -> tuple[Array, Array]:
    """Velocities and accelerations of the axes, shape (m, n), by differences over the recorded time; zero without one."""
    if "time" not in run.columns:
        return np.zeros_like(commands), np.zeros_like(commands)
    time = recorded(run, ["time"])["time"]
    late = np.flatnonzero(~(np.diff(time) > 0))
    if len(time) != len(commands) or len(time) < _LEAST_IN_MOTION or len(late):
        at = f"; it does not grow after reading {int(late[0]) + 1}" if len(late) else ""
        raise InputError(
            f"run {run.name!r} has {len(commands)} readings and {len(time)} times{at}; a motion takes {_LEAST_IN_MOTION} "
            f"readings or more at times that grow, or leave the column out for poses taken at standstill"
        )
    velocity = np.gradient(commands, time, axis=0)
    return velocity, np.gradient(velocity, time, axis=0)


def _senses(commands: Array) -> Array:
    """In which sense each axis came to each pose, shape (m, n): 1, -1, as before where it stood, 0 before it first moved."""
    step = np.diff(commands, axis=0, prepend=commands[:1])
    moved = np.where(np.abs(step) > STANDING, np.sign(step), 0.0)
    row = np.maximum.accumulate(np.where(moved != 0, np.arange(len(commands))[:, np.newaxis], 0), axis=0)
    return np.asarray(np.take_along_axis(moved, row, axis=0))


def _check_followed(run: Run, missed: Array) -> None:
    """Refuse positions at which the ball cannot be in the nest."""
    worst = np.abs(missed).max(axis=1)
    if worst.max() > MOST_DISPLACEMENT:
        raise InputError(
            f"run {run.name!r}: the linear axes miss the ball by {worst.max():.4g} mm at reading {int(worst.argmax()) + 1}; "
            f"correct the centre of the set-up, the machine's offsets, or the unit of the positions"
        )
