"""A displacement probe across a joint: it sits on one carriage and reads the next, while a force acts at the tool.

Between tool and workpiece, joints in a row give way alike, and no test there tells one from the other. The probe sees the
twists of the joints that it reads across and of no others. At the origin of the carriage's frame it sees the translation
alone; at any other point the rotations too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import (
    COMPONENTS,
    MM_OR_RAD,
    Array,
    AxisCommands,
    LoopFrames,
    Machine,
    Point,
    loop_frames,
    workpiece_ball,
)
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.displacements import check_displacements, recorded
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations, check_observations
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, Setup, SetupFact
from elastogeo.observe.static_loads.load import (
    commands_row,
    force_columns,
    force_level,
    force_sizes,
    force_vectors,
    planned,
    static_commands,
    with_lever,
)
from elastogeo.observe.template import FORCE, Template

_SETUP = """\
[setup]
across = ["X"]                   # the joint between the part that holds the probe and the part that it touches
sensor = [1, 0, 0]               # along which it reads, in the frame of that joint's carriage
point_mm = [0, 0, 0]             # where it touches, in the same frame: at its origin no rotation of the joint is seen
direction = [1, 0, 0]            # of the force on the tool
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
C_XBX = 1e-8
C_XXY = 1e-5
E_R0 = 0.002
"""


@instrument("joint-probe")
@dataclass(frozen=True, slots=True)
class JointProbe(Setup):
    """Set-up of a displacement probe across one joint, or several in a row.

    A run stands still, as with a static force; runs at several places name them by columns of axis positions (`z_mm`). The
    probe's zero is a parameter like others: ask for `E_R0` with the compliances, or zero the probe without load.

    Attributes
    ----------
    across : tuple of str
        The joints between the two parts, next to each other in the loop. The first one's carriage gives the frame.
    sensor : 3-vector
        Direction in which a displacement of the part nearer to the tool, relative to the part nearer to the workpiece,
        counts as positive; in that frame.
    point : tuple of 3 float [mm]
        Where the probe touches, in that frame.
    direction : 3-vector or None
        Of the force on the tool, in the foundation; None if the runs record `force_x`, `force_y`, `force_z`.
    pose : mapping of str to float [mm, rad]
        Axis commands; an axis not named is at zero.
    lever : tuple of 3 float [mm]
        From the tool point to where the force acts, in the foundation.
    tool : tuple of 3 float or None [mm]
        Tool point in the frame of the last tool-branch carriage; None for the machine's own.
    ramp : bool
        For the simulation alone: whether a run without a column of its force loads to it and unloads (one turn of the
        simulation's angle is one cycle), rather than being read at this force throughout.
    """

    across: tuple[str, ...]
    sensor: Direction
    point: Point = (0.0, 0.0, 0.0)
    direction: Direction | None = None
    pose: AxisCommands = field(default_factory=dict)
    lever: Point = (0.0, 0.0, 0.0)
    tool: Point | None = None
    ramp: bool = True

    limits: ClassVar = ("force", "sensor")
    template: ClassVar = Template(
        title="Displacement probe across a joint",
        setup=_SETUP,
        columns="force_N (of every reading), displacement_um",
        simulation=_SIMULATION,
        machine="huron_kx8",
        levels=(250.0, 500.0, 750.0),
        influences=FORCE,
    )

    def __post_init__(self) -> None:
        """Refuse directions that are none, and a probe across nothing."""
        if not self.across:
            raise InputError('the probe reads across no joint; say across = ["X"]')
        unit_vector(self.sensor, "the direction of the sensor")
        if not np.isfinite(self.point).all():
            raise InputError(f"the point of the probe is {self.point} mm; it must be three finite numbers")
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
        """The compliances of the joints in what the probe sees of them, for every load, and the probe's zero."""
        seen = np.hstack([self.sensor, np.cross(self.point, self.sensor)])
        letters = "".join(letter for letter, part in zip(COMPONENTS, seen, strict=True) if part)
        first, *others = self.across
        return (f"C_[{letters}]?{first}", *(f"C_[XYZABC]?{axis}" for axis in others), "E_R0")

    def facts(self) -> tuple[SetupFact, ...]:
        """Across what the probe reads and where, the direction of the force, where the machine stands."""
        along = [] if self.direction is None else [SetupFact("direction of the force", (self.direction,))]
        return (
            SetupFact("across", " ".join(self.across)),
            SetupFact("direction of the sensor", (self.sensor,)),
            SetupFact("point of the sensor", (self.point,), "mm"),
            *along,
            SetupFact("pose", self.pose, MM_OR_RAD),
        )

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to: the probe's line as a twist at the tool point, the wrench of the force.

        Raises
        ------
        InputError
            If the run lacks a column or a force, moves, or has a value that is no finite number; if the machine has no such
            joints in a row.
        """
        _check_in_a_row(machine, self.across)
        columns = recorded(run, self.quantities, optional="force")
        count = len(columns["displacement"])
        tool = np.array(machine.tool if self.tool is None else self.tool)
        place = static_commands(machine, run, self.pose)
        commands = np.repeat(commands_row(machine, place), count, axis=0)
        line = self._line(loop_frames(machine, commands[:1], tool))
        force = force_vectors(run, self.direction, count, run.force)
        sizes = force_sizes(force, self.direction)
        observations = Observations(
            run=run.name,
            force=force_level(sizes, run.force),
            pose=sizes,
            commands=commands,
            velocity=np.zeros_like(commands),
            acceleration=np.zeros_like(commands),
            centre=np.array([self.pose.get(axis, 0.0) for axis in machine.axes]),
            direction=np.asfortranarray(np.repeat(line, count, axis=0)),
            wrench=with_lever(force, np.array([self.lever])),
            reading=columns["displacement"],
            correction=np.zeros(count),
            tool=tool,
            workpiece=workpiece_ball(machine, place, tool),
            span=self.across,
        )
        check_observations(observations)
        check_displacements(run, ["displacement"])
        return observations

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the displacements that the probe would give at its forces."""
        columns = planned(machine, run, self.direction, ramp=self.ramp)
        count = max(map(len, (columns or run.columns).values()), default=0)
        blank = self.observe(machine, replace(run, columns={**columns, "displacement": np.zeros(count)}))
        true = respond(replace(blank, wrench=blank.wrench * imperfection.force_factor(random)))
        return replace(run, columns={**columns, "displacement": imperfection.noisy(true - blank.reading, random)})

    def _line(self, frames: LoopFrames) -> Array:
        """The probe's line as a twist at the tool point, shape (1, 6): its direction, and the moment of it there."""
        carriage = frames.joints[self.across[0]].motion
        along = carriage.vector(unit_vector(self.sensor, "the direction of the sensor"))
        touched = carriage.point(np.array(self.point))
        return np.hstack([along, np.cross(touched - frames.point, along)])


def _check_in_a_row(machine: Machine, across: Sequence[str]) -> None:
    """Refuse joints between which another one lies, which the probe would then read across too."""
    places = sorted(machine.index(axis) for axis in across)
    if len(set(places)) != len(across) or places[-1] - places[0] + 1 != len(places):
        between = " ".join(machine.axes[places[0] : places[-1] + 1])
        raise InputError(
            f"the probe reads across {' '.join(across)}; from the first to the last of them the machine {machine.name!r} "
            f"has {between}: name each of these once, in any order"
        )
