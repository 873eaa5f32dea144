"""The ball bar, loaded or not: it reads the change of the distance of two balls, and pushes them apart along it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import ClassVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.machine import Array, Feed, LengthPerPressure, Machine, Point, follow
from elastogeo.observe.circle import Circle, circle_facts, circle_parameters
from elastogeo.observe.expansion import Expansion
from elastogeo.observe.force import Calibration, force_influences, force_of_run
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations, ObservedInfluence, check_observations
from elastogeo.observe.on_circle import OnCircle
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, SetupFact
from elastogeo.observe.template import BAR, CIRCLE, FORCE, Template

MOST_TURNS = 10.0
"""Turns that a run may have."""

MOST_DEVIATION = 0.1
"""Share of the radius that a reading may deviate."""


_SETUP = """\
[setup]
feed_mm_min = 2000
# calibration = "gauge.toml"             # of elastogeo calibrate: the runs may then say pressure_bar in place of force_N
# setup_deflection_um_per_bar = 2.33     # Eq. 5.38; needs pressure_bar in every run
# machine_at = { temperature_degC = 22.5, expansion_um_per_m = 11.5, temperature_uncertainty_degC = 0.3 }   # to 20 degC
# tool_mm = [0, 0, -160]                 # tool ball in the last tool-side carriage, if not the machine's own tool point

"""

_SIMULATION = """\
readings = 1000                  # of a full turn

[imperfection]
noise_um = 0.07
resolution_um = 0.24
eccentricity_um = 0.2            # of the centre, from run to run
force_scatter = 0.002            # relative, from run to run

[values]                         # true parameters, in mm, N, rad
C_XXX = 6e-5
C_YYY = 5e-5
C_CCY = 1e-9
E_XX1 = -1e-4
"""


@instrument("loaded-ball-bar")
@dataclass(frozen=True, slots=True)
class LoadedBallBar(OnCircle):
    """Set-up of a loaded ball bar.

    Attributes
    ----------
    circle : Circle
        Path and centre.
    feed : float [mm/s]
        Speed of the tool ball along the circle.
    tool : tuple of 3 float or None [mm]
        Tool ball in the frame of the last tool-branch carriage; None for the machine's own tool point.
    calibration : Calibration or None
        Force against pressure; None if every run gives its force.
    setup_deflection : float [mm/bar]
        Deflection of the workpiece ball's post per pressure (2.33 um/bar in the thesis); zero switches the correction off.
    setup_deflection_uncertainty : float [mm/bar]
        Its standard uncertainty.
    setup_deflection_degrees_of_freedom : float
        Of that uncertainty.
    machine_at, bar_at : Expansion or None
        Temperature of the machine's scales and of the bar, with their expansions: lengths are then referred to 20 °C (ISO
        1). A run may have temperatures of its own. None for what is at 20 °C, or was corrected.
    pulls : bool
        Whether the bar can pull its balls together: only then may a force be negative.
    """

    circle: Circle
    feed: Feed
    tool: Point | None = None
    calibration: Calibration | None = None
    setup_deflection: LengthPerPressure = 0.0
    setup_deflection_uncertainty: LengthPerPressure = 0.0
    setup_deflection_degrees_of_freedom: float = inf
    machine_at: Expansion | None = None
    bar_at: Expansion | None = None
    pulls: bool = False

    extra: ClassVar = "circularity"
    limits: ClassVar = ("bar length", "bar calibration", "force calibration", "form of the balls")
    of_instrument: ClassVar = ("E_R0",)
    knowledge: ClassVar = (
        "calibration", "setup_deflection", "setup_deflection_uncertainty", "setup_deflection_degrees_of_freedom",
        "machine_at", "bar_at",
    )  # fmt: skip
    corrections: ClassVar = ("setup_deflection", "machine_at", "bar_at")
    warm: ClassVar = "machine_at"
    template: ClassVar = Template(
        title="Loaded ball bar test",
        setup=_SETUP + CIRCLE,
        columns="angle_deg, radial_um",
        simulation=_SIMULATION,
        resolution_um=0.24,
        levels=(36.0, 238.0, 490.0, 742.0),
        repeats=2,
        influences=FORCE + BAR,
    )

    def default_parameters(self, runs: Sequence[Run]) -> tuple[str, ...]:
        """Compliance, geometry and location of a loaded bar; the faults that a bar without load shows."""
        return circle_parameters(self.circle, any(run.force or run.pressure for run in runs))

    def facts(self) -> tuple[SetupFact, ...]:
        """Circle and feed, and the correction of the set-up's deflection if it is on."""
        post = [SetupFact("set-up deflection", self.setup_deflection, "mm_per_bar")] if self.setup_deflection else []
        return (*circle_facts(self.circle, self.feed), *post)

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations that a run amounts to.

        The sensitive direction is the bar's axis, from the workpiece ball to the tool ball (Eqs. 4.11, 4.17); the bar
        pushes the tool along it with the run's force (4.22, no moment: the balls' friction counts as none).

        Raises
        ------
        InputError
            If the run lacks a column, a force or readings, or has a value that is no finite number.
        """
        angle = self._angle(run)
        tool = None if self.tool is None else np.array(self.tool)
        rate = run.sense * (run.feed or self.feed) / self.circle.radius
        commands = follow(machine, self.circle.centre, self.circle.motion(angle, rate), tool)
        force = self.force(run)
        direction = np.zeros((len(angle), 6), order="F")
        np.divide(commands.displacement, self.circle.radius, out=direction[:, :3])
        warmth = self._warmth(run)
        longer = self.circle.radius * sum(sign * one.stretch for _, one, sign in warmth)
        correction = self.deflection(run, direction) + longer
        observations = Observations(
            run=run.name,
            force=force,
            pose=angle,
            commands=commands.position,
            velocity=commands.velocity,
            acceleration=commands.acceleration,
            centre=np.array([self.circle.centre.get(axis, 0.0) for axis in machine.axes]),
            direction=direction,
            wrench=force * direction,
            reading=run.columns["radial"] - correction,
            correction=correction,
            tool=np.array(machine.tool) if tool is None else tool,
            workpiece=commands.ball,
            length=self.circle.radius,
            influences=(*self._influences(run, direction), *self._warm_influences(warmth, len(angle))),
        )
        check_observations(observations)
        _check_units(run, self.circle.radius)
        return observations

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run with the readings that the bar would give at its angles."""
        angle = self._angle(replace(run, columns={**run.columns, "radial": run.columns["angle"]}))
        blank = self.observe(machine, replace(run, columns={"angle": angle, "radial": np.zeros(len(angle))}))
        true = respond(replace(blank, wrench=blank.wrench * imperfection.force_factor(random)))
        # What the set-up's correction will take off is what the raw reading has on top.
        radial = imperfection.added_to(true - blank.reading, angle, blank.force, random)
        return replace(run, columns={"angle": angle, "radial": radial})

    def force(self, run: Run) -> float:
        """Force [N] with which the bar pushed in a run.

        Raises
        ------
        InputError
            If the run has neither, a pressure without a calibration, a force and a pressure that do not agree, or a negative
            force although the bar cannot pull.
        """
        force = force_of_run(run.name, run.force, run.pressure, self.calibration)
        if force < 0 and not self.pulls:
            raise InputError(
                f"run {run.name!r} has a force of {force:g} N, and a bar pushes its balls apart; give the size of the "
                f"force, or say pulls = true in [setup] if this bar can pull"
            )
        return force

    def deflection(self, run: Run, direction: Array) -> Array:
        """Deflection [mm] of the workpiece ball's post in a run, which the reading holds and the machine does not.

        Eq. 5.38: `delta = P 2.33 cos^2(elevation)`, with the elevation of the bar over the horizontal plane.

        Raises
        ------
        InputError
            If the correction is on and the run has no pressure.
        """
        if not self.setup_deflection:
            return np.zeros(len(direction))
        if run.pressure is None:
            raise InputError(f"run {run.name!r} has no pressure, which the set-up deflection correction (Eq. 5.38) needs")
        return np.asarray(self.setup_deflection * run.pressure * (1.0 - direction[:, 2] ** 2))

    def _warmth(self, run: Run) -> list[tuple[str, Expansion, float]]:
        """Each body that is not at 20 °C: a warm machine goes too far, a warm bar reads too little."""
        found = []
        if self.machine_at:
            found.append(("machine", self.machine_at.at(run.machine_temperature), 1.0))
        if self.bar_at:
            found.append(("bar", self.bar_at.at(run.instrument_temperature), -1.0))
        stated = {"machine": run.machine_temperature, "instrument": run.instrument_temperature}
        without = [name for name, body in (("machine", self.machine_at), ("instrument", self.bar_at)) if not body]
        wrong = next((name for name in without if stated[name] is not None), None)
        if wrong:
            table = "machine_at" if wrong == "machine" else "bar_at"
            raise InputError(
                f"run {run.name!r} states the {wrong}'s temperature, and the set-up no expansion; add {table} to [setup]"
            )
        return found

    def _warm_influences(self, warmth: list[tuple[str, Expansion, float]], readings: int) -> Iterator[ObservedInfluence]:
        """What is uncertain in referring lengths to 20 °C."""
        for body, one, sign in warmth:
            yield from one.influences(body, np.full(readings, sign * self.circle.radius))

    def _influences(self, run: Run, direction: Array) -> tuple[ObservedInfluence, ...]:
        """What is uncertain in the force and in the set-up's deflection, alike in all runs."""
        found = force_influences(self.calibration, run.force, run.pressure, len(direction))
        if not self.setup_deflection or not self.setup_deflection_uncertainty:
            return found
        per_unit = -self.deflection(run, direction) / self.setup_deflection
        u, freedom = self.setup_deflection_uncertainty, self.setup_deflection_degrees_of_freedom
        return (*found, ObservedInfluence("set-up deflection", u, freedom, np.zeros_like(direction), per_unit))

    def _angle(self, run: Run) -> Array:
        missing = [name for name in self.quantities if name not in run.columns]
        if missing:
            raise InputError(
                f"run {run.name!r} lacks the column {', '.join(missing)}; a ball bar needs angle_deg, radial_um"
            )
        angles, readings = (len(run.columns[name]) for name in self.quantities)
        if angles != readings:
            raise InputError(f"run {run.name!r} has {angles} angles and {readings} readings; every reading needs its angle")
        if not readings:
            raise InputError(f"run {run.name!r} has no reading")
        return np.asarray(run.columns["angle"])


def _check_units(run: Run, radius: float) -> None:
    """Refuse angles and deviations of a size that only a wrong unit gives.

    Raises
    ------
    InputError
        If the angles span more than `MOST_TURNS`, or a deviation is more than `MOST_DEVIATION` of the radius.
    """
    turns = float(np.ptp(run.columns["angle"])) / (2 * np.pi)
    if turns > MOST_TURNS:
        raise InputError(f"run {run.name!r}: the angles span {turns:.3g} turns; are they degrees given as radians?")
    most = float(np.abs(run.columns["radial"]).max())
    if most > MOST_DEVIATION * radius:
        raise InputError(
            f"run {run.name!r}: a reading of {most:.3g} mm on a radius of {radius:g} mm; look at the units of both: "
            f"are they micrometres given as millimetres, or radii instead of deviations?"
        )
