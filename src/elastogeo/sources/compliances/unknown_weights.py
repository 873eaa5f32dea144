"""What gives way under a weight that nobody knows: `CW_AAY(Z)` under the carriage of Z, `CW_AAY(w)` under the workpiece.

Where the mass is known, the weight is a load of the joints that carry it, and drives their compliances (`C_AAY`). Where it
is not, only the product of compliance and weight shows: C_AAY times the weight of the carriage of Z, with its centre of
gravity where the machine file says. It is there at every force, as geometry is. On a joint that keeps its direction the
weight itself is constant: what it does is a location error, or a set-up offset. Its moment goes with the travel of the axes
between the joint and the weight: along a straight axis it is the bend of its path, or a change of squareness with another
axis. A weight that lies elsewhere in another test, or a table that turns under it, separates it; a known mass beside it
gives the compliance by itself, and then the weight.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.machine import Array, Machine, Point, carried_to
from elastogeo.sources.compliance import spring
from elastogeo.sources.families import family, named
from elastogeo.sources.situation import Situation
from elastogeo.sources.source import Source

WORKPIECE = "w"
_NAME = re.compile(r"CW_[XYZABC]{2}([A-Z])\(([A-Z])\)")


@dataclass(frozen=True, slots=True)
class UnknownWeight:
    """Driver: what a weight of one newton on a carriage loads a joint of its branch with; zero where the mass is known.

    Attributes
    ----------
    axis : str
        Of the joint.
    component : int
        Of the load there.
    body : str
        The axis whose carriage it is, or `w` for the workpiece.
    """

    axis: str
    component: int
    body: str

    def __call__(self, situation: Situation) -> Array:
        """Load per weight [N/N or N mm/N] at every reading, shape (m,)."""
        frames, count = situation.frames, len(situation.observations)
        centre = self._centre(situation)
        if centre is None:
            return np.zeros(count)
        body = frames.workpiece if self.body == WORKPIECE else frames.joints[self.body].motion
        down = np.broadcast_to([*situation.machine.gravity, 0.0, 0.0, 0.0], (count, 6))
        return np.asarray(
            carried_to(frames.joints[self.axis].motion, body.point(np.asarray(centre)), down)[:, self.component]
        )

    def _centre(self, situation: Situation) -> Point | None:
        """Where the centre of gravity is in the frame of the body; None if there is no weight, or it is known."""
        if self.body == WORKPIECE:
            weight = situation.observations.weight
            return weight.centre if weight is not None and weight.mass is None else None
        carriage = situation.machine.joints[situation.machine.index(self.body)]
        return None if carriage.mass else carriage.centre_of_gravity


@family
def workpiece_of_unknown_weight(machine: Machine) -> Iterator[Source]:
    """For each compliant joint that carries the workpiece the 36 products of its compliances with that weight."""
    for axis in reversed(machine.topology.workpiece):
        yield from _products(machine, axis, WORKPIECE)


@named
def carriage_of_unknown_weight(machine: Machine, name: str) -> Source | None:
    """The product with the weight of a carriage that the joint carries, its own or one beyond it; never listed."""
    match = _NAME.fullmatch(name)
    if not match:
        return None
    axis, body = match.groups()
    branches = (machine.topology.workpiece[::-1], machine.topology.tool)
    carried = next((branch[branch.index(axis) :] for branch in branches if axis in branch), ())
    made = _products(machine, axis, body) if body in carried else iter(())
    return next((source for source in made if source.name == name), None)


def _products(machine: Machine, axis: str, body: str) -> Iterator[Source]:
    if not machine.joints[machine.index(axis)].compliant:
        return
    whose = "the workpiece" if body == WORKPIECE else f"the carriage of {body}"
    for source in spring("CW", ("motion", axis), f"joint {axis}"):
        load = source.load or 0
        yield replace(
            source,
            name=f"{source.name}({body})",
            unit=_times_newton(source.unit),
            driver=UnknownWeight(axis, load, body),
            meaning=f"{source.meaning}, times the weight of {whose}",
            load=None,
            force_degree=0.0,
        )


def _times_newton(unit: str) -> str:
    """The unit of a compliance times a force: `rad/(N mm)` becomes `rad/mm`."""
    return unit.replace("/(N mm)", "/mm").removesuffix("/N")
