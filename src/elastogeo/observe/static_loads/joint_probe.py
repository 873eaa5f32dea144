"""A displacement probe across a joint: it sits on one carriage and reads the next, while a force acts at the tool.

Between tool and workpiece, joints in a row give way alike, and no test there tells one from the other. The probe sees the
twists of the joints that it reads across and of no others. At the origin of the carriage's frame it sees the translation
alone; at any other point the rotations too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import COMPONENTS, MM_OR_RAD, Array, AxisCommands, LoopFrames, Machine, Point, loop_frames
from elastogeo.observe.circle import Direction
from elastogeo.observe.directions import unit_vector
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations
from elastogeo.observe.run import Run
from elastogeo.observe.setup import SetupFact
from elastogeo.observe.static_loads.load import commands_row, planned
from elastogeo.observe.static_loads.static_load import StaticLoad
from elastogeo.observe.template import FORCE, Template

_SETUP = """\
[setup]
across = ["X"]                   # the joint between the part that holds the probe and the part that it touches
sensor = [1, 0, 0]               # along which it reads, in the frame of that joint's carriage
point_mm = [0, 0, 0]             # where it touches, in the same frame: at its origin no rotation of the joint is seen
direction = [1, 0, 0]            # of the force on the tool
pose = { @CENTRE@ }            # where the machine stands
places = { Z_mm = [-150, 150] }  # of the simulation, cycle by cycle; measured runs have them as columns (z_mm)
"""

_SIMULATION = """\
readings = 160                   # 40 of each loading cycle, from zero to the run's force and back
end_deg = 1440

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
class JointProbe(StaticLoad):
    """Set-up of a displacement probe across one joint, or several in a row.

    The machine stands still while it is read; the places of a run are columns of axis positions (`z_mm`), and two of them
    tell the compliance for a force from that for its moment, whose lever changes. The probe's zero is a parameter like
    others: ask for `E_R0` with the compliances, or zero the probe without load.

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
        Axis commands where a run has no column of them; an axis not named is at zero.
    lever : tuple of 3 float [mm]
        From the tool point to where the force acts, in the foundation.
    tool : tuple of 3 float or None [mm]
        Tool point in the frame of the last tool-branch carriage; None for the machine's own.
    ramp : bool
        For the simulation alone: whether a run without a column of its force loads to it and unloads (one turn of the
        simulation's angle is one cycle), rather than being read at this force throughout.
    places : mapping of str to tuple of float [mm, rad]
        For the simulation alone: where axes stand in one turn of its angle after the other, over and over.
    """

    across: tuple[str, ...]
    sensor: Direction
    point: Point = (0.0, 0.0, 0.0)
    direction: Direction | None = None
    pose: AxisCommands = field(default_factory=dict)
    lever: Point = (0.0, 0.0, 0.0)
    tool: Point | None = None
    ramp: bool = True
    places: Annotated[Mapping[str, tuple[float, ...]], MM_OR_RAD] = field(default_factory=dict)

    template: ClassVar = Template(
        title="Displacement probe across a joint",
        setup=_SETUP,
        columns="force_N (of every reading), displacement_um, z_mm (and other positions that change)",
        simulation=_SIMULATION,
        machine="huron_kx8",
        levels=(250.0, 500.0, 750.0),
        repeats=2,
        influences=FORCE,
    )

    def __post_init__(self) -> None:
        """Refuse directions that are none, and a probe across nothing."""
        if not self.across:
            raise InputError('the probe reads across no joint; say across = ["X"]')
        unit_vector(self.sensor, "the direction of the sensor")
        if not np.isfinite(self.point).all():
            raise InputError(f"the point of the probe is {self.point} mm; it must be three finite numbers")
        self.check_direction()

    @property
    def file_units(self) -> Mapping[str, str]:
        """Positions of linear axes stand in millimetres."""
        return dict.fromkeys("xyz", "mm")

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """The compliances of the joints in what the probe sees of them, for every load, and the probe's zero."""
        seen = np.hstack([self.sensor, np.cross(self.point, self.sensor)])
        letters = "".join(letter for letter, part in zip(COMPONENTS, seen, strict=True) if part)
        first, *others = self.across
        letters = letters if len(letters) == 1 else f"[{letters}]"
        return (f"C_{letters}?{first}", *(f"C_[XYZABC]?{axis}" for axis in others), "E_R0")

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
            If the run lacks a column or a force, or has a value that is no finite number; if the machine has no such joints
            in a row.
        """
        _check_in_a_row(machine, self.across)
        count, tool = self.instants_of(run), self.tool_point(machine)
        commands = np.asfortranarray(np.repeat(commands_row(machine, self.pose), count, axis=0))
        for axis in machine.axes:
            if axis.lower() in run.columns:
                commands[:, machine.index(axis)] = run.columns[axis.lower()]
        frames = loop_frames(machine, commands, tool)
        opposite = np.broadcast_to(frames.workpiece.components(frames.point - frames.workpiece.origin), (count, 3))
        return self.observed(machine, run, commands, self._line(frames, count), opposite, span=self.across)

    def planned_columns(self, machine: Machine, run: Run) -> dict[str, Array]:
        """Where it stands cycle by cycle, and its forces."""
        columns = planned(machine, run, self.direction, ramp=self.ramp)
        if self.places and "angle" in run.columns:
            turn = np.floor(np.asarray(run.columns["angle"]) / (2 * np.pi)).astype(int)
            for axis, places in self.places.items():
                columns.setdefault(axis.lower(), np.array(places)[turn % len(places)])
        return columns

    def _line(self, frames: LoopFrames, count: int) -> Array:
        """The probe's line as a twist at the tool point, shape (m, 6): its direction, and the moment of it there."""
        carriage = frames.joints[self.across[0]].motion
        along = carriage.vector(unit_vector(self.sensor, "the direction of the sensor"))
        touched = carriage.point(np.array(self.point))
        line = np.empty((count, 6), order="F")
        line[:, :3], line[:, 3:] = along, np.cross(touched - frames.point, along)
        return line


def _check_in_a_row(machine: Machine, across: Sequence[str]) -> None:
    """Refuse joints between which another one lies, which the probe would then read across too."""
    places = sorted(machine.index(axis) for axis in across)
    if len(set(places)) != len(across) or places[-1] - places[0] + 1 != len(places):
        between = " ".join(machine.axes[places[0] : places[-1] + 1])
        raise InputError(
            f"the probe reads across {' '.join(across)}; from the first to the last of them the machine {machine.name!r} "
            f"has {between}: name each of these once, in any order"
        )
