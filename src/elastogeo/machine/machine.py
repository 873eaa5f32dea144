"""What a machine is: its topology, the frames of its joints, and the points where tool and workpiece sit."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, isfinite

from elastogeo.errors import MachineError
from elastogeo.machine.places import Place, check_places
from elastogeo.machine.quantity import Mass, Pitch, Point, RotationVector, Travel
from elastogeo.machine.topology import AXIS_ORDER, LINEAR, ROTARY, SPINDLE, Topology

_ZERO = (0.0, 0.0, 0.0)
DOWN = (0.0, 0.0, -1.0)
_UNIT = 1e-6


@dataclass(frozen=True, slots=True)
class Joint:
    """One joint of the structural loop.

    Attributes
    ----------
    name : str
        Axis letter of ISO 841, or S for the spindle.
    offset : tuple of 3 float [mm]
        Origin of the location frame in the frame of the link before it (the one nearer the foundation).
    tilt : tuple of 3 float [rad]
        Rotation vector of the location frame in the frame of the link before it: zero unless the axis is inclined.
    travel : tuple of 2 float [mm or rad]
        Least and greatest command.
    pitch : float or None [mm or rad]
        Command per turn of its screw, or per period of its scale, if cyclic errors are to be modelled.
    compliant : bool
        Whether the joint's compliance is modelled. False by default for the spindle alone: what lies behind the last
        axis then counts as rigid.
    mass : float [kg in files; N s^2/mm inside]
        Of its carriage, if its own weight is to load the joints that carry it.
    centre_of_gravity : tuple of 3 float [mm]
        Of the carriage, in its motion frame.
    """

    name: str
    offset: Point = _ZERO
    tilt: RotationVector = _ZERO
    travel: Travel = (-inf, inf)
    pitch: Pitch | None = None
    compliant: bool = True
    mass: Mass = 0.0
    centre_of_gravity: Point = _ZERO

    @property
    def is_rotary(self) -> bool:
        """Whether the joint turns."""
        return self.name in ROTARY

    @property
    def direction(self) -> int:
        """Coordinate axis of the location frame along or about which the joint moves: 0, 1, 2 for x, y, z."""
        return (ROTARY if self.is_rotary else LINEAR)[self.name]


@dataclass(frozen=True, slots=True)
class Machine:
    """A serial machine tool.

    Attributes
    ----------
    name : str
        What the machine is called in reports.
    topology : Topology
        Order of the axes.
    joints : tuple of Joint
        One per axis, in the order of `topology.axes`.
    tool : tuple of 3 float [mm]
        Functional point (tool tip, tool ball) in the frame of the last carriage of the tool branch.
    gravity : tuple of 3 float
        Direction of gravity in the foundation, a unit vector.
    assumed : tuple of str
        What of this description is assumed rather than measured or published, in words.
    places : tuple of Place
        What gives way beside the joints; by default nothing does.
    """

    name: str
    topology: Topology
    joints: tuple[Joint, ...] = field(default=())
    tool: Point = _ZERO
    assumed: tuple[str, ...] = ()
    gravity: tuple[float, float, float] = DOWN
    places: tuple[Place, ...] = ()

    def __post_init__(self) -> None:
        """Fill in the default joints and refuse a description that contradicts itself."""
        if not self.joints:
            joints = tuple(Joint(axis, compliant=axis != SPINDLE) for axis in self.topology.axes)
            object.__setattr__(self, "joints", joints)
        check_machine(self)

    @property
    def axes(self) -> tuple[str, ...]:
        """Axis letters, from the workpiece to the tool: the order of every command array."""
        return self.topology.axes

    @property
    def compliant(self) -> tuple[Joint, ...]:
        """The joints whose compliance is modelled, X Y Z U V W A B C S."""
        return tuple(sorted((j for j in self.joints if j.compliant), key=lambda j: AXIS_ORDER.index(j.name)))

    def index(self, axis: str) -> int:
        """Position of an axis in `axes`.

        Raises
        ------
        MachineError
            If the machine has no such axis.
        """
        if axis not in self.axes:
            raise MachineError(f"machine {self.name!r} ({self.topology.compact}) has no axis {axis!r}")
        return self.axes.index(axis)

    def in_tool_branch(self, axis: str) -> bool:
        """Whether the axis carries the tool (rather than the workpiece)."""
        return axis in self.topology.tool


def check_machine(machine: Machine) -> None:
    """Refuse a machine whose joints are not those of its topology or whose dimensions are no numbers.

    Raises
    ------
    MachineError
        With the joint and the value.
    """
    named = tuple(joint.name for joint in machine.joints)
    if named != machine.topology.axes:
        raise MachineError(
            f"machine {machine.name!r}: the joints are {named}, the topology {machine.topology.compact} wants "
            f"{machine.topology.axes} in this order"
        )
    for joint in machine.joints:
        if not all(map(isfinite, (*joint.offset, *joint.tilt))):
            raise MachineError(f"machine {machine.name!r}, axis {joint.name}: offset and tilt must be finite numbers")
        if joint.pitch is not None and not joint.pitch > 0:
            raise MachineError(
                f"machine {machine.name!r}, axis {joint.name}: the pitch is {joint.pitch:g}, it must be positive"
            )
        low, high = joint.travel
        if not low < high:
            raise MachineError(f"machine {machine.name!r}, axis {joint.name}: travel {low:g} to {high:g} is empty")
        if not (isfinite(joint.mass) and joint.mass >= 0):
            raise MachineError(f"machine {machine.name!r}, axis {joint.name}: the mass must be a number, not negative")
    if not abs(sum(part**2 for part in machine.gravity) - 1.0) < _UNIT:
        raise MachineError(
            f"machine {machine.name!r}: gravity is {machine.gravity}, it must be a direction of length 1, such as (0, 0, -1)"
        )
    if not all(map(isfinite, machine.tool)):
        raise MachineError(f"machine {machine.name!r}: the tool point must be three finite numbers")
    check_places(machine.places, machine.topology, machine.name)
