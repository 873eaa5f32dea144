"""What every set-up has whose readings go around a circle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from elastogeo.machine import Block, Feed, Machine, Point
from elastogeo.observe.circle import Circle
from elastogeo.observe.procedure import Procedure
from elastogeo.observe.programs import CircleTest, circle_blocks
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Setup


class OnCircle(Setup):
    """A set-up whose readings count along the angle of a circle.

    Attributes
    ----------
    circle : Circle
        Path and centre.
    feed : float [mm/s]
        Along it.
    tool : tuple of 3 float or None [mm]
        Tool ball in the frame of the last tool-branch carriage; None for the machine's own tool point.
    """

    __slots__ = ()

    circle: Circle
    feed: Feed
    tool: Point | None
    put_in: ClassVar[str] = "put the instrument in"
    """What the operator does before the first run, when the machine stands outside of the circle."""

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have: those of a bar."""
        return ("angle", "radial")

    @property
    def pose_quantity(self) -> str:
        """The angle in the plane of the circle."""
        return "angle"

    @property
    def nominal_radius(self) -> float:
        """That of the circle."""
        return self.circle.radius

    def program(self, machine: Machine, runs: Sequence[Run], procedure: Procedure) -> Sequence[Block]:
        """Feed in, overshoot, circle, overshoot, feed out, for every run."""
        tool = None if self.tool is None else np.array(self.tool)
        point = machine.tool if self.tool is None else self.tool
        title = self.template.title if self.template else type(self).__name__
        said = (f"tool ball at {point[0]:.6g}, {point[1]:.6g}, {point[2]:.6g} mm in the last carriage",)
        test = CircleTest(machine, self.circle, self.feed, tool, title, said, self.put_in)
        return circle_blocks(test, runs, procedure)

    @property
    def own_to_run(self) -> tuple[str, ...]:
        """The offsets of the circle's centre."""
        return ("E_[XYZ]t0",)
