"""The ball bar as most workshops have it: it reads the change of the distance of two balls, and pushes nothing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Feed, Machine, Point
from elastogeo.observe.bars.ball_bar import LoadedBallBar
from elastogeo.observe.circle import Circle, circle_facts, circle_parameters
from elastogeo.observe.expansion import Expansion
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations
from elastogeo.observe.on_circle import OnCircle
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, SetupFact
from elastogeo.observe.template import BAR, CIRCLE, Template

_SIMULATION = """\
readings = 720                   # of a full turn

[imperfection]
noise_um = 0.1
resolution_um = 0.1
eccentricity_um = 0.3            # of the centre, from run to run

[values]                         # true parameters, in mm, rad, s
E_XX1 = 2.5e-5
E_YY1 = -4e-5
B_XX = 0.006
B_YY = 0.004
T_X1 = 0.0003
E_Xt0 = 0.012
"""


@instrument("ball-bar")
@dataclass(frozen=True, slots=True)
class BallBar(OnCircle):
    """Set-up of an ordinary ball bar: its runs have no force.

    Attributes
    ----------
    circle : Circle
        Path and centre.
    feed : float [mm/s]
        Speed of the tool ball along the circle.
    tool : tuple of 3 float or None [mm]
        Tool ball in the frame of the last tool-branch carriage; None for the machine's own tool point.
    machine_at, bar_at : Expansion or None
        As those of a loaded bar: lengths are then referred to 20 °C (ISO 1).
    """

    circle: Circle
    feed: Feed
    tool: Point | None = None
    machine_at: Expansion | None = None
    bar_at: Expansion | None = None

    loads: ClassVar = False
    extra: ClassVar = "circularity"
    limits: ClassVar = ("bar length", "bar calibration", "form of the balls")
    of_instrument: ClassVar = ("E_R0",)
    knowledge: ClassVar = ("machine_at", "bar_at")
    corrections: ClassVar = ("machine_at", "bar_at")
    warm: ClassVar = "machine_at"
    template: ClassVar = Template(
        title="Ball bar test",
        setup="[setup]\nfeed_mm_min = 1000\n\n" + CIRCLE,
        columns="angle_deg, radial_um",
        simulation=_SIMULATION,
        level="",
        both_ways=True,
        repeats=3,
        influences=BAR,
    )

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """The faults that a bar without load shows."""
        return circle_parameters(self.circle, loaded=False)

    def facts(self) -> tuple[SetupFact, ...]:
        """Circle and feed."""
        return circle_facts(self.circle, self.feed)

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to: those of a loaded bar without its load.

        Raises
        ------
        InputError
            If the run states a force or a pressure, lacks a column or readings, or has a value that is no finite number.
        """
        if run.force or run.pressure:
            stated = f"{run.force:g} N" if run.force else f"{run.pressure:g} bar"
            raise InputError(
                f'run {run.name!r} states {stated}, and a ball-bar pushes nothing; write instrument = "loaded-ball-bar" if '
                f"this bar is loaded, or remove the force"
            )
        return self._loaded().observe(machine, replace(run, force=0.0, pressure=None))

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the readings that the bar would give at its angles."""
        seen = self._loaded().simulated(machine, replace(run, force=0.0, pressure=None), respond, imperfection, random)
        return replace(run, columns=seen.columns)

    def _loaded(self) -> LoadedBallBar:
        return LoadedBallBar(self.circle, self.feed, self.tool, machine_at=self.machine_at, bar_at=self.bar_at)
