"""Displacement probes about a loaded tool ball while the table turns: the Cartesian stiffness test of thesis 6.2, ref. 4.

A bar pushes the tool ball with a known force; three displacement sensors read how the ball moves relative to the table. As
the table turns, X and Y keep the ball at its place on it, and the force turns in the foundation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import MM_OR_RAD, Array, AxisCommands, Block, Machine, Motion, Point, follow, loop_frames
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector, unit_vectors
from elastogeo.observe.displacements import check_displacements, read_by, recorded
from elastogeo.observe.force import Calibration, force_influences, force_of_run
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations, check_observations
from elastogeo.observe.procedure import Procedure, change_of_level, ordered
from elastogeo.observe.programs import Followed, FollowedRun, following_blocks
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup, SetupFact
from elastogeo.observe.static_loads.load import (
    COMPONENTS,
    force_level,
    force_sizes,
    force_vectors,
    with_lever,
)
from elastogeo.observe.template import FORCE, Template

MOST_TURNS = 10.0
"""Turns that a run may have."""


_SETUP = """\
[setup]
bar = [1, 0, 1]                  # direction of the force on the tool; it turns with the table, as the probes do
probes = [[1, 0.2, 0], [0, 1, 0.3], [0.4, 0, 1]]   # in which each probe counts as positive
centre = { @CENTRE@ }
rotary_turn = { C = 1 }          # C turns along with the readings' angle
# calibration = "gauge.toml"     # of elastogeo calibrate: the runs may then say pressure_bar in place of force_N
"""

_SIMULATION = """\
readings = 72                    # of a full turn of the table

[imperfection]
noise_um = 0.05
resolution_um = 0.1

[values]                         # true parameters, in mm, N, rad
C_XXX = 6e-5
C_YYY = 4e-5
C_ZZZ = 3e-5
E_Xw0 = 0.003
"""


@instrument("displacement-probes")
@dataclass(frozen=True, slots=True)
class DisplacementProbes(Setup):
    """Set-up of a loaded bar and displacement probes.

    A run has a column `angle` and one column per probe, `displacement_1`, `displacement_2`, ...; each of its rows is one
    observation of every probe, probe after probe. The force is that of the run, or a column `force`, or the columns
    `force_x`, `force_y`, `force_z` if the bar has no known direction. The probes' zeros are parameters like others: ask for
    `E_Xw0`, `E_Yw0`, `E_Zw0` with the compliances (`E_Xt0`, ... for probes that do not turn), or zero the probes without
    load. Motion counts as quasi-static: no velocity.

    Attributes
    ----------
    probes : tuple of 3-vector
        Directions in which a displacement of the tool ball counts as positive; they need not be orthogonal.
    bar : 3-vector or None
        Direction of the force on the tool: from the workpiece ball to the tool ball, for a bar that pushes.
    centre : mapping of str to float [mm, rad]
        Axis commands where the rotary axes are not turned; they set the place of the ball on the table.
    rotary_turn : mapping of str to float
        How far each rotary axis turns per angle of the readings: `{ C = 1 }` for the table.
    bar_in_workpiece, probes_in_workpiece : bool
        Whether the bar (or the components of the force), and the probes, are fixed to the turning workpiece rather than to
        the foundation.
    tool : tuple of 3 float or None [mm]
        Tool ball in the frame of the last tool-branch carriage; None for the machine's own tool point.
    calibration : Calibration or None
        Force against pressure, for runs that give a pressure.
    """

    probes: tuple[Direction, ...]
    bar: Direction | None = None
    centre: AxisCommands = field(default_factory=dict)
    rotary_turn: Mapping[str, float] = field(default_factory=dict)
    bar_in_workpiece: bool = True
    probes_in_workpiece: bool = True
    tool: Point | None = None
    calibration: Calibration | None = None

    extra: ClassVar = "cartesian-stiffness"
    limits: ClassVar = ("force", "sensor")
    knowledge: ClassVar = ("calibration",)
    template: ClassVar = Template(
        title="Loaded bar and displacement probes",
        setup=_SETUP,
        columns="angle_deg (of the table), displacement_1_um, displacement_2_um, displacement_3_um",
        simulation=_SIMULATION,
        machine="huron_kx8",
        levels=(200.0, 400.0, 600.0),
        repeats=3,
        influences=FORCE,
    )

    def __post_init__(self) -> None:
        """Refuse directions that are none."""
        unit_vectors(self.probes, "probe")
        if self.bar is not None:
            unit_vector(self.bar, "the direction of the bar")

    @property
    def readings(self) -> tuple[str, ...]:
        """Columns of the probes."""
        return tuple(f"displacement_{k}" for k in range(1, len(self.probes) + 1))

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have."""
        return ("angle", *self.readings)

    @property
    def pose_quantity(self) -> str:
        """The angle by which the rotary axes turn: not that of a circle, as every probe has its own trace over it."""
        return "turn"

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """The compliances in translation, the probes' zeros, and what the ball is off as it goes around.

        X and Y follow the turn, so that error motions to the second degree are its harmonics to the second order.
        """
        place = "w" if self.probes_in_workpiece else "t"
        turning = (f"E_[XYZ]{axis}[cs][12]" for axis in self.rotary_turn)
        return ("C_[XYZ][XYZ]?", *(f"E_{axis}{place}0" for axis in "XYZ"), *turning)

    def facts(self) -> tuple[SetupFact, ...]:
        """Directions of probes and bar, the centre, what turns."""
        bar = [] if self.bar is None else [SetupFact("direction of the force", (self.bar,))]
        turn = [SetupFact("rotary turn", self.rotary_turn)] if self.rotary_turn else []
        return (SetupFact("probes", self.probes), *bar, SetupFact("centre", self.centre, MM_OR_RAD), *turn)

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to: every probe's readings, one probe after the other.

        Raises
        ------
        InputError
            If the run lacks a column or a force, or has a value that is no finite number.
        """
        columns = recorded(run, self.quantities)
        angle = columns["angle"]
        _check_turns(run, angle)
        tool = np.array(machine.tool if self.tool is None else self.tool)
        commands = follow(machine, self.centre, self._motion(angle), tool)
        frame = loop_frames(machine, commands.position, tool).workpiece
        level = self._level(run)
        force = force_vectors(run, self.bar, len(angle), level)
        sizes = force_sizes(force, self.bar)
        force = np.broadcast_to(frame.vector(force) if self.bar_in_workpiece else force, (len(angle), 3))
        directions = [
            np.broadcast_to(frame.vector(probe) if self.probes_in_workpiece else probe, (len(angle), 3))
            for probe in unit_vectors(self.probes, "probe")
        ]
        sensors = len(directions)
        translation = np.concatenate(directions)
        observations = Observations(
            run=run.name,
            force=force_level(sizes, level),
            pose=np.tile(angle, sensors),
            commands=_repeated(commands.position, sensors),
            velocity=_repeated(commands.velocity, sensors),
            acceleration=None if commands.acceleration is None else _repeated(commands.acceleration, sensors),
            centre=np.array([self.centre.get(axis, 0.0) for axis in machine.axes]),
            direction=np.asfortranarray(np.hstack([translation, np.zeros_like(translation)])),
            wrench=_repeated(with_lever(force, np.zeros(3)), sensors),
            reading=np.concatenate([columns[name] for name in self.readings]),
            correction=np.zeros(sensors * len(angle)),
            tool=tool,
            workpiece=commands.ball,
            influences=force_influences(self.calibration, run.force, run.pressure, sensors * len(angle)),
            instant=np.tile(np.arange(float(len(angle))), sensors),
        )
        check_observations(observations)
        check_displacements(run, self.readings)
        return observations

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the displacements that the probes would give at its angles."""
        angle = recorded(run, ["angle"])["angle"]
        columns = {name: values for name, values in run.columns.items() if name in ("angle", "force", *COMPONENTS)}
        zeros = dict.fromkeys(self.readings, np.zeros(len(angle)))
        blank = self.observe(machine, replace(run, columns={**columns, **zeros}))
        true = respond(replace(blank, wrench=blank.wrench * imperfection.force_factor(random)))
        read = read_by(imperfection, true - blank.reading, len(self.probes), random)
        return replace(run, columns={**columns, **dict(zip(self.readings, read, strict=True))})

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:
        """The rotary axes turn from pose to pose under load, the linear axes follow the ball on the table."""
        tool = None if self.tool is None else np.array(self.tool)
        test = Followed(machine, self.centre, tool, "Loaded bar and displacement probes", "put bar and probes in")
        made: list[FollowedRun] = []
        last: Run | None = None
        for run in ordered(runs, procedure.order):
            given = run.columns.get("angle", np.array([0.0, 2 * np.pi]))
            low, high = float(np.min(given)), float(np.max(given))
            count = max(round(procedure.poses * (high - low) / (2 * np.pi)), 1) + 1
            angle = np.linspace(low, high, count)[:: run.sense] if self.rotary_turn else np.zeros(1)
            rotary = {axis: np.asarray(values) for axis, values in self._motion(angle).rotary.items()}
            made.append(FollowedRun(run.name, rotary, change_of_level(run, last), procedure.poses > 0))
            last = run
        return following_blocks(test, made, procedure)

    def _motion(self, angle: Array) -> Motion:
        """The tool ball stays where it is on the table, whatever turns."""
        still = np.zeros((len(angle), 3))
        turned = {axis: self.centre.get(axis, 0.0) + turn * angle for axis, turn in self.rotary_turn.items()}
        return Motion(still, still, still, turned, dict.fromkeys(turned, 0.0))

    def _level(self, run: Run) -> float | None:
        if run.pressure is None:
            return run.force
        return force_of_run(run.name, run.force, run.pressure, self.calibration)


def _repeated(rows: Array, times: int) -> Array:
    """Rows one time after the other, Fortran order."""
    return np.asfortranarray(np.tile(rows, (times, 1)))


def _check_turns(run: Run, angle: Array) -> None:
    turns = float(np.ptp(angle)) / (2 * np.pi)
    if turns > MOST_TURNS:
        raise InputError(f"run {run.name!r}: the angles span {turns:.3g} turns; are they degrees given as radians?")
