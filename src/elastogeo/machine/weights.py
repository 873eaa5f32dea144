"""Weights that load a machine: its carriages, and the workpiece on its table.

A weight on a body of one branch is carried by the joints and places between that body and the foundation, and by no other.
It acts in the direction of gravity at the body's centre of gravity, which moves and turns with the axes that carry it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite

import numpy as np

from elastogeo.errors import MachineError
from elastogeo.estimate import Array
from elastogeo.machine.frames import Frame, LoopFrames
from elastogeo.machine.jacobian import carried_to
from elastogeo.machine.machine import Machine
from elastogeo.machine.places import WORKPIECE
from elastogeo.machine.quantity import Mass, Point

STANDARD_GRAVITY = 9806.65
"""Acceleration of free fall [mm/s^2] (ISO 80000-3)."""


@dataclass(frozen=True, slots=True)
class Workpiece:
    """A workpiece, or any weight on the table.

    Attributes
    ----------
    mass : float or None [kg in files; N s^2/mm inside]
        None if it is not known: then it loads nothing here, and what gives way under it is asked for as `CW_AAY(w)`.
    centre : tuple of 3 float [mm]
        Its centre of gravity in the frame of the last workpiece-branch carriage, the table.
    """

    mass: Mass | None = None
    centre: Point = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        """Refuse what is no mass."""
        mass = self.mass or 0.0
        if not (isfinite(mass) and mass >= 0 and all(map(isfinite, self.centre))):
            raise MachineError(
                f"a workpiece has a mass of {mass * 1e3:g} kg and its centre of gravity at {self.centre} mm; both "
                f"must be finite, and the mass not negative"
            )


def weight_loads(machine: Machine, frames: LoopFrames, workpiece: Workpiece | None = None) -> dict[str, Array]:
    """What known weights load each joint with, along and about its motion frame, and each place.

    Parameters
    ----------
    machine : Machine
        With the masses of its carriages, and the direction of gravity.
    frames : LoopFrames
        At m poses.
    workpiece : Workpiece, optional

    Returns
    -------
    dict of str to array, shape (m, 6) or (1, 6) [N, N mm]
        By axis or name of a place; what carries no known weight is not in it.
    """
    loads: dict[str, Array] = {}
    for force, body, centre, carriers in _weights(machine, frames, workpiece):
        at = body.point(np.asarray(centre))
        for name in carriers:
            frame, _ = frames.carried_at(name)
            acting = np.broadcast_to(force, (max(len(at), len(frame.origin), len(frame.rotation)), 6))
            load = carried_to(frame, at, acting)
            loads[name] = loads[name] + load if name in loads else load
    return loads


def _weights(
    machine: Machine, frames: LoopFrames, workpiece: Workpiece | None
) -> Iterator[tuple[Array, Frame, Point, tuple[str, ...]]]:
    """Each weight: its force, the body it is fixed to, its centre of gravity there, and what carries it."""
    masses = {joint.name: (joint.mass, joint.centre_of_gravity) for joint in machine.joints if joint.mass}
    for branch in (tuple(reversed(machine.topology.workpiece)), machine.topology.tool):
        for k, axis in enumerate(branch):
            if axis in masses:
                mass, centre = masses[axis]
                below = tuple(place.name for place in machine.places if place.on in branch[:k])
                yield _force(machine, mass), frames.joints[axis].motion, centre, (*branch[: k + 1], *below)
    if workpiece is not None and workpiece.mass:
        axes = machine.topology.workpiece
        below = tuple(p.name for p in machine.places if p.carries_workpiece and p.on in (*axes, WORKPIECE))
        yield _force(machine, workpiece.mass), frames.workpiece, workpiece.centre, (*axes, *below)


def _force(machine: Machine, mass: float) -> Array:
    return np.array([*(np.asarray(machine.gravity) * mass * STANDARD_GRAVITY), 0.0, 0.0, 0.0])
