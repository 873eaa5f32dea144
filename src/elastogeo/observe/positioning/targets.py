"""A positioning test (ISO 230-2): one axis goes to targets, from both sides and several times, and is read at standstill.

Along the axis a laser interferometer, a scale or a triangulation sensor reads its positioning; across it the same file holds
straightness, about a direction an angular error motion: only the sensitive direction differs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import (
    COMPONENTS,
    LINEAR,
    MM_OR_RAD,
    ROTARY,
    Array,
    AxisCommands,
    Block,
    LoopFrames,
    Machine,
    Point,
    Targets,
    loop_frames,
)
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.expansion import Expansion
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations, ObservedInfluence, check_observations
from elastogeo.observe.positioning.approaches import approaches, distinct
from elastogeo.observe.positioning.program import target_blocks
from elastogeo.observe.positioning.readings import check_readings, deviations
from elastogeo.observe.procedure import Procedure, ordered
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup, SetupFact
from elastogeo.observe.template import Template

ALONG = 0.9
"""Cosine of the sensitive direction and the motion of the axis from which a sensor counts as reading along it."""

SKEW = 0.01
"""Component of a sensitive direction that counts as none."""

FULL_TURN = 0.75
"""Share of a turn from which the errors of a rotary axis are asked for as harmonics."""

MOST_TURNS = 10.0
"""Turns that the targets of a rotary axis may span."""

_SETUP = """\
[setup]
axis = "X"
pose = { @CENTRE@ }            # where the other axes stand
# tool_mm = [0, 0, 0]            # where reflector or sensor sits in the last tool-side carriage, if not at the tool point
# direction = [0, 1, 0]          # in which the sensor reads, if not along the axis: straightness
# about = [0, 1, 0]              # about which an angular sensor reads
# axis_at = { temperature_degC = 22.5, expansion_um_per_m = 11.5, temperature_uncertainty_degC = 0.3 }   # to 20 degC
targets_mm = [-201.3, -148.2, -102.7, -49.1, 0.6, 51.4, 97.9, 152.2, 199.5]   # to plan and simulate; not evenly spaced
cycles = 5

"""

_SIMULATION = """\
[imperfection]
noise_um = 0.4
resolution_um = 0.1

[values]                         # true parameters, in mm, rad
E_XX1 = 2.5e-5
E_XX2 = -8e-8
B_XX = 0.003
"""

_INFLUENCES = """\
[[influences]]
kind = "sensor-scale"
label = "calibration of the laser"
relative = 0.5e-6                # half of the expanded uncertainty of its certificate

[[influences]]
kind = "sensor-scale"
label = "temperature of machine and air"
relative = 6e-6                  # 12 um/(m K) x 0.5 K

[[influences]]
kind = "sensor-scale"
label = "alignment of the beam"
relative = 3e-6                  # (1 mm over 400 mm)^2 / 2
distribution = "rectangular"

"""


@instrument("positioning")
@dataclass(frozen=True, slots=True)
class Positioning(Setup):
    """Set-up of a positioning test.

    A run has the columns `target` (command of the axis) and `position` (what the sensor reads, any zero) or `deviation` (the
    same less the target); `direction` (+ or -, the way in which the axis comes) and `cycle`, where the order of the
    targets does not show them. Every cycle counts as a run, with a zero of its own.

    Attributes
    ----------
    axis : str
        That moves.
    pose : mapping of str to float [mm, rad]
        Where the other axes stand; an axis not named is at zero. Of the axis itself: from where its command counts in
        polynomials, by default the middle of the targets.
    direction : 3-vector or None
        Of the displacement, tool relative to workpiece, that counts as positive; None for along the axis.
    about : 3-vector or None
        Axis of the rotation that counts as positive, for an angular sensor; of a rotary axis, by default its own.
    in_workpiece : bool
        Whether these are given in the (turned) workpiece frame rather than in the foundation.
    tool : tuple of 3 float or None [mm]
        Where the reflector or the sensor sits, in the frame of the last tool-branch carriage; None for the tool point.
    axis_at, sensor_at : Expansion or None
        Temperature of the machine along its axis, and of the sensor, with their expansions: lengths are then referred to
        20 °C (ISO 1). None for what is at 20 °C, or was corrected by the control or the laser.
    targets : tuple of float [mm, rad]
        Of a test that is planned or simulated.
    cycles : int
        Of such a test.
    """

    axis: str
    pose: AxisCommands = field(default_factory=dict)
    direction: Direction | None = None
    about: Direction | None = None
    in_workpiece: bool = False
    tool: Point | None = None
    axis_at: Expansion | None = None
    sensor_at: Expansion | None = None
    targets: Targets = ()
    cycles: int = 5

    loads: ClassVar = False
    extra: ClassVar = "positioning"
    limits: ClassVar = ("position sensor",)
    knowledge: ClassVar = ("axis_at", "sensor_at")
    corrections: ClassVar = ("axis_at", "sensor_at")
    warm: ClassVar = "axis_at"
    template: ClassVar = Template(
        title="Positioning test",
        setup=_SETUP,
        columns="cycle, direction (+ or -), target_mm, position_mm",
        simulation=_SIMULATION,
        level="",
        influences=_INFLUENCES,
    )

    def __post_init__(self) -> None:
        """Refuse an axis that is none, and directions that are none or two."""
        if self.axis not in LINEAR and self.axis not in ROTARY:
            raise InputError(f"the axis is {self.axis!r}; axes are {' '.join([*LINEAR, *ROTARY])}")
        if self.direction is not None and self.about is not None:
            raise InputError("a sensor reads a displacement or a rotation; say direction or about, not both")
        for name in ("direction", "about"):
            if getattr(self, name) is not None:
                unit_vector(getattr(self, name), f"the sensitive {name}")
        if (self.axis_at or self.sensor_at) and not (self.is_along and not self.is_rotary):
            raise InputError(
                f"temperatures count for a length, and {self.axis} is not read along a linear axis; take axis_at and "
                f"sensor_at out"
            )
        if self.cycles < 1:
            raise InputError(f"cycles is {self.cycles}; a test has one cycle at least, ISO 230-2 asks for five")

    @property
    def is_rotary(self) -> bool:
        """Whether the axis turns."""
        return self.axis in ROTARY

    @property
    def is_angular(self) -> bool:
        """Whether a rotation is read."""
        return self.about is not None or (self.is_rotary and self.direction is None)

    @property
    def reads_angles(self) -> bool:
        """Whether a rotation is read."""
        return self.is_angular

    @property
    def is_along(self) -> bool:
        """Whether the positioning of the axis itself is read, as far as the set-up says without its machine."""
        return self.motion in self._letters() and len(self._letters()) == 1

    @property
    def motion(self) -> str:
        """The component of a twist that the axis makes: X for X and U, C for C."""
        return COMPONENTS[3 + ROTARY[self.axis] if self.is_rotary else LINEAR[self.axis]]

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have; `position` may stand for `deviation`."""
        return ("target", "deviation")

    @property
    def file_units(self) -> Mapping[str, str]:
        """Units of the columns in a run file."""
        angular = "deg" if self.is_rotary else "mm"
        read = {"position": "deg", "deviation": "arcsec"} if self.is_angular else {"position": "mm", "deviation": "um"}
        return {"target": angular, **read, "direction": "", "cycle": ""}

    @property
    def pose_quantity(self) -> str:
        """The target."""
        return "target"

    @property
    def own_to_run(self) -> tuple[str, ...]:
        """The zero of the sensor; across the axis also the slope of the line that straightness is measured against."""
        across = not (self.is_along or self.is_angular or self.is_rotary)
        return ("E_R0", f"E_R{self.axis}1") if across else ("E_R0",)

    def default_parameters(self, runs: Sequence[Run]) -> tuple[str, ...]:
        """The error motion that the sensor sees, to the third degree or as harmonics, and what it loses on reversal."""
        target = np.concatenate([self._columns(run)["target"] for run in runs])
        both = any(len(set(self._senses(run))) > 1 for run in runs)
        seen = self._letters()
        letters = seen if len(seen) == 1 else f"[{seen}]"
        if self.is_rotary and np.ptp(target) > FULL_TURN * 2 * np.pi:
            motion = f"E_{letters}{self.axis}[cs][12]"
        else:
            least = 2 if len(self.own_to_run) > 1 else 1
            most = max(min(3, len(np.unique(distinct(target))) - 1), least)
            motion = f"E_{letters}{self.axis}[{least}-{most}]"
        return (motion, f"B_{letters}{self.axis}") if both else (motion,)

    def facts(self) -> tuple[SetupFact, ...]:
        """The axis, where the others stand, how the sensor reads."""
        named = {"direction of the sensor": self.direction, "sensor about": self.about}
        read = [SetupFact(name, (given,)) for name, given in named.items() if given is not None]
        return (SetupFact("axis", self.axis), *read, SetupFact("pose", self.pose, MM_OR_RAD))

    def observe_all(self, machine: Machine, runs: Sequence[Run]) -> tuple[Observations, ...]:
        """The observations of every cycle of every run; polynomials count from the middle of all targets."""
        found = [(run, self._columns(run)) for run in runs]
        target = np.concatenate([columns["target"] for _, columns in found])
        centre = float(target.min() + target.max()) / 2
        return tuple(cycle for run in runs for cycle in _by_cycle(run, self._observed(machine, run, centre)))

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to, all cycles in one.

        Raises
        ------
        InputError
            If the run states a force, lacks a column, leaves the travel of the axis, or has a value that only a wrong unit
            or a wrong sign gives.
        """
        target = self._columns(run)["target"]
        return self._observed(machine, run, float(target.min() + target.max()) / 2)

    def _observed(self, machine: Machine, run: Run, middle: float) -> Observations:
        if run.force or run.pressure:
            raise InputError(f"run {run.name!r} states a force, and a positioning test applies none; remove it")
        columns = self._columns(run)
        target, moving = columns["target"], machine.index(self.axis)
        self._check_targets(machine, run, target)
        tool = np.array(machine.tool if self.tool is None else self.tool)
        centre = np.array([self.pose.get(axis, 0.0) for axis in machine.axes])
        commands = np.tile(centre, (len(target), 1))
        commands[:, moving] = target
        centre[moving] = self.pose.get(self.axis, middle)
        frames = loop_frames(machine, commands, tool)
        direction = self._direction(machine, frames, len(target))
        along = self._cosine(machine, frames, direction)
        counted = along if np.abs(along).min() >= ALONG else None
        reading = deviations(run, columns, counted)
        check_readings(run, target, reading, angular=self.is_angular)
        way = np.zeros(len(target)) if counted is None else counted * (target - centre[moving])
        correction = self._stretch() * way
        sense = np.zeros_like(commands)
        sense[:, moving] = approaches(run, target).sense
        at_tool = frames.workpiece.components(frames.point - frames.workpiece.origin)
        observations = Observations(
            run=run.name,
            force=0.0,
            pose=target,
            commands=np.asfortranarray(commands),
            velocity=np.zeros_like(commands),
            acceleration=np.zeros_like(commands),
            centre=centre,
            direction=direction,
            wrench=np.zeros((len(target), 6)),
            reading=reading - correction,
            correction=correction,
            tool=tool,
            workpiece=np.array(np.broadcast_to(at_tool, (len(target), 3))),
            influences=tuple(self._warmth(way)),
            sense=sense,
            nominal=None if counted is None else way,
        )
        return check_observations(observations)

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the readings that the sensor would give at its targets, or at those of the set-up."""
        columns = {name: values for name, values in self._columns(run).items() if name not in ("position", "deviation")}
        target = columns["target"]
        blank = self.observe(machine, replace(run, columns={**columns, "deviation": np.zeros(len(target))}))
        true = respond(blank) - blank.reading  # what the correction will take off, the raw reading has on top
        read = (imperfection.angular if self.is_angular else imperfection.noisy)(true, random)
        if blank.nominal is None:
            return replace(run, columns={**columns, "deviation": read})
        return replace(run, columns={**columns, "position": self._cosine_of(machine, blank) * target + read})

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:
        """The axis to every target from the side of its reading, with a dwell there."""
        machine.index(self.axis)
        cycles = [(run, self._columns(run)["target"], self._senses(run)) for run in ordered(runs, procedure.order)]
        return target_blocks(machine, self.axis, self.pose, cycles, procedure)

    def _columns(self, run: Run) -> dict[str, Array]:
        """The columns of a run; those of the plan, where it has only places to be simulated at."""
        known = ("target", "direction", "cycle", "position", "deviation")
        columns = {name: np.asarray(run.columns[name]) for name in known if name in run.columns}
        if "target" not in columns and set(run.columns) <= {"angle", "radial"}:
            columns = self._planned(run)
        if "target" not in columns:
            there = ", ".join(run.columns) or "none"
            raise InputError(f"run {run.name!r} lacks the column target; its columns are: {there}")
        lengths = {name: len(values) for name, values in columns.items()}
        if len(set(lengths.values())) > 1 or not lengths["target"]:
            said = ", ".join(f"{count} of {name}" for name, count in lengths.items())
            raise InputError(f"run {run.name!r} has {said}; every reading needs one value of each")
        return columns

    def _stretch(self) -> float:
        """By how much the readings are too great, relative to the way: a warm axis goes far, a warm sensor reads little."""
        return (self.axis_at.stretch if self.axis_at else 0.0) - (self.sensor_at.stretch if self.sensor_at else 0.0)

    def _warmth(self, way: Array) -> Iterator[ObservedInfluence]:
        """What is uncertain in the correction to 20 °C."""
        if self.axis_at:
            yield from self.axis_at.influences("axis", way)
        if self.sensor_at:
            yield from self.sensor_at.influences("sensor", -way)

    def _planned(self, run: Run) -> dict[str, Array]:
        if not self.targets:
            raise InputError(
                f"run {run.name!r} has no readings, and the set-up no targets; say targets_mm (targets_deg) in [setup]"
            )
        one = np.concatenate([np.sort(self.targets), np.sort(self.targets)[::-1]])
        side = np.repeat([1.0, -1.0], len(self.targets))
        cycle = np.repeat(np.arange(1.0, self.cycles + 1), len(one))
        target = np.tile(one, self.cycles)
        return {
            "cycle": cycle,
            "direction": np.tile(side, self.cycles),
            "target": target,
            "deviation": np.zeros(len(target)),
        }

    def _senses(self, run: Run) -> Array:
        columns = self._columns(run)
        return approaches(replace(run, columns=columns), columns["target"]).sense

    def _letters(self) -> str:
        """Components of a twist that the sensor sees, as far as the set-up says without its machine."""
        given = self.about if self.is_angular else self.direction
        if given is None:
            return self.motion
        parts = np.abs(unit_vector(given, "the sensitive direction")) > SKEW
        return "".join(letter for letter, part in zip("ABC" if self.is_angular else "XYZ", parts, strict=True) if part)

    def _direction(self, machine: Machine, frames: LoopFrames, count: int) -> Array:
        """Sensitive direction at every reading, shape (m, 6)."""
        given = self.about if self.is_angular else self.direction
        if given is None:
            vector = self._motion(machine, frames)
        else:
            vector = unit_vector(given, "the sensitive direction")[np.newaxis]
            vector = frames.workpiece.vector(vector) if self.in_workpiece else vector
        direction = np.zeros((count, 6), order="F")
        direction[:, 3 * self.is_angular : 3 * self.is_angular + 3] = vector
        return direction

    def _motion(self, machine: Machine, frames: LoopFrames) -> Array:
        """Direction along or about which the command moves the tool relative to the workpiece, shape (m or 1, 3)."""
        joint = machine.joints[machine.index(self.axis)]
        return frames.joints[self.axis].location.rotation[:, :, joint.direction]

    def _cosine(self, machine: Machine, frames: LoopFrames, direction: Array) -> Array:
        """How much of the command the sensor reads, shape (m,): 1 along the axis, 0 across it."""
        if self.is_angular != self.is_rotary:
            return np.zeros(len(direction))
        part = direction[:, 3 * self.is_angular : 3 * self.is_angular + 3]
        return np.asarray(np.einsum("mi,mi->m", part, np.broadcast_to(self._motion(machine, frames), part.shape)))

    def _cosine_of(self, machine: Machine, observed: Observations) -> Array:
        return self._cosine(machine, loop_frames(machine, observed.commands, observed.tool), observed.direction)

    def _check_targets(self, machine: Machine, run: Run, target: Array) -> None:
        low, high = machine.joints[machine.index(self.axis)].travel
        unit = "rad" if self.is_rotary else "mm"
        if self.is_rotary and np.ptp(target) > MOST_TURNS * 2 * np.pi:
            raise InputError(
                f"run {run.name!r}: the targets of {self.axis} span {np.ptp(target) / (2 * np.pi):.3g} turns; are they "
                f"degrees given as radians?"
            )
        if target.min() < low or target.max() > high:
            raise InputError(
                f"run {run.name!r}: the targets of {self.axis} go from {target.min():g} to {target.max():g} {unit}, its "
                f"travel from {low:g} to {high:g} {unit}; correct the targets, their unit, or the machine file"
            )


def _by_cycle(run: Run, observed: Observations) -> list[Observations]:
    """The observations of each cycle of a run."""
    cycle = approaches(run, observed.pose).cycle if "target" in run.columns else np.ones(len(observed), dtype=int)
    numbers = np.unique(cycle)
    if len(numbers) == 1:
        return [observed]
    return [replace(observed.at(np.flatnonzero(cycle == k)), run=f"{run.name}, cycle {k}") for k in numbers]
