"""The ball-roller device: a roller bearing that circles a ball too closely, read from encoders and motor currents alone.

The distance that the encoders command is smaller than the sum of the radii; machine and set-up give way until the two bodies
fit: `engagement = F (C_machine + C_setup) + what the path is off` (Eqs. 6.1 to 6.4). With the set-up's deflection subtracted
(6.5), a reading is the radial deviation of the tool under a radial force: the same as that of a loaded ball bar.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from elastogeo.drive import (
    DriveRecord,
    FeedDrive,
    KnownBalance,
    SetupCompliance,
    TorqueBalance,
    TorqueModel,
    balance_effort,
    current_from_effort,
    effort_from_force,
    identify_balance,
    joint_forces,
    known_terms,
    known_torque_balance,
    setup_compliance,
)
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.machine import (
    Array,
    Feed,
    Frequency,
    Machine,
    Point,
    follow,
    workpiece_ball,
)
from elastogeo.observe.circle import Circle, circle_facts, circle_parameters
from elastogeo.observe.imperfection import Imperfection
from elastogeo.observe.instruments import instrument
from elastogeo.observe.observations import Observations, check_observations
from elastogeo.observe.on_circle import OnCircle
from elastogeo.observe.rollers.beginning import TEMPLATE
from elastogeo.observe.rollers.force import ContactForce, contact_force, drives_against, observed_influences
from elastogeo.observe.rollers.rig import Rig
from elastogeo.observe.rollers.track import Track, moving, track_of
from elastogeo.observe.run import Run
from elastogeo.observe.setup import Respond, SetupFact

MEASURED_FORCE = 0.02
"""Columns that differ by a smaller share than this differ by the noise of the force, which is measured."""

LOAD_ORDERS = (1, 2)
"""Harmonics of the turn that the load of a run may have where the drives' friction is identified beside it: an eccentric
ball, machines that are stiffer in one direction."""

UNCLAIMED = 0.01
"""Engagement [mm] that the encoders may show of a run that claims none."""

SAME_ENGAGEMENT = 1e-6
"""Commanded engagements [mm] that differ by less are one level."""


@dataclass(frozen=True, slots=True, eq=False)
class Pressed:
    """What the recordings of a test amount to before they are observations.

    Attributes
    ----------
    tracks : mapping of str to Track
        Of every run, by its name.
    balances : mapping of str to TorqueBalance
        Of every drive, by its axis.
    forces : mapping of str to ContactForce
        Of every run with an engagement.
    """

    tracks: Mapping[str, Track]
    balances: Mapping[str, TorqueBalance]
    forces: Mapping[str, ContactForce]


@instrument("ball-roller")
@dataclass(frozen=True, slots=True)
class BallRoller(OnCircle):
    """Set-up of a ball-roller test.

    Attributes
    ----------
    circle : Circle
        Path and centre; its radius is the distance of the centres at which ball and roller just touch: the sum of their
        radii.
    feed : float [mm/s]
        Along the circle; for the simulation alone, as the encoders say what was done.
    drives : tuple of FeedDrive
        Of the linear axes that press: motor constant and transmission.
    setup : SetupCompliance
        Compliance of ball and roller together; zero leaves it in the machine's.
    balances : tuple of KnownBalance
        What is known of what the motors need by themselves, by axis. The rest is identified from the runs.
    rig : tuple of Rig
        Compliant parts that were put in the loop, if any: they are in the compliance that is measured.
    terms : tuple of str
        Of the torque balance that is identified.
    least_speed : float [mm/s]
        A drive that moves slower has no known friction: these samples of its current do not count.
    cutoff : float [Hz]
        Of velocity and acceleration: far above the turns' frequency, so that nothing of the motion is lost. The current is
        not filtered, which would smear its jumps where an axis turns back.
    harmonics : int
        Of the turn, to which the forces of the drives are smoothed over the samples at which they move; 0 takes each sample
        by itself, and those only at which all drives move.
    tool : tuple of 3 float or None [mm]
        Centre of the roller in the frame of the last tool-branch carriage; None for the machine's own tool point.
    """

    circle: Circle
    feed: Feed
    drives: tuple[FeedDrive, ...]
    setup: SetupCompliance = SetupCompliance(constant=0.0)  # noqa: RUF009
    balances: tuple[KnownBalance, ...] = ()
    rig: tuple[Rig, ...] = ()
    terms: tuple[str, ...] = ("inertia", "viscous", "coulomb", "constant")
    least_speed: Feed = 0.5
    cutoff: Frequency = 2.0
    harmonics: int = 12
    tool: Point | None = None

    extra: ClassVar = "stiffness-map"
    limits: ClassVar = ("touching radius", "motor constants", "set-up compliance", "slow motion")
    knowledge: ClassVar = ("drives", "setup", "balances")
    corrections: ClassVar = ("setup", "balances")
    template: ClassVar = TEMPLATE

    def __post_init__(self) -> None:
        """Refuse a set-up without drives, or with two of one axis."""
        axes = [drive.axis for drive in self.drives]
        if not axes or len(set(axes)) < len(axes):
            raise InputError(f"a ball-roller test needs one [[setup.drives]] for each axis that presses, got {axes}")

    @property
    def quantities(self) -> tuple[str, ...]:
        """Columns that a run file must have."""
        axes = [drive.axis.lower() for drive in self.drives]
        return ("time", *(f"position_{axis}" for axis in axes), *(f"current_{axis}" for axis in axes))

    def default_parameters(self, _: Sequence[Run]) -> tuple[str, ...]:
        """Compliance, geometry and location."""
        return circle_parameters(self.circle, loaded=True)

    def facts(self) -> tuple[SetupFact, ...]:
        """Circle and feed, the axes that press, the parts in the loop."""
        rigs = [SetupFact("rig", len(self.rig))] if self.rig else []
        return (
            *circle_facts(self.circle, self.feed),
            SetupFact("axes that press", " ".join(drive.axis for drive in self.drives)),
            *rigs,
        )

    def observe(self, machine: Machine, run: Run) -> Observations:
        """The observations of one run, with balances that are known.

        Raises
        ------
        InputError
            If the balance of a drive is not known: it takes all runs to identify it.
        """
        known = {drive.axis: self._given(drive) for drive in self.drives}
        missing = [axis for axis, balance in known.items() if balance is None]
        if missing:
            raise InputError(
                f"the torque balance of axis {', '.join(missing)} is not known; observe all runs of the test together, or "
                f"give it as [[setup.balances]]"
            )
        track = self._track(machine, run)
        balances = {axis: balance for axis, balance in known.items() if balance is not None}
        contact = contact_force(machine, track, self.drives, balances, self.harmonics, self._tool)
        return self._observations(machine, run, track, contact, float(contact.force.mean()))

    def observe_all(self, machine: Machine, runs: Sequence[Run]) -> tuple[Observations, ...]:
        """The observations of the runs with an engagement; those without show what the drives need by themselves.

        Runs of one commanded engagement are one level, of the mean of their forces.
        """
        return self.observed(machine, runs, self.pressed(machine, runs))

    def observed(self, machine: Machine, runs: Sequence[Run], pressed: Pressed) -> tuple[Observations, ...]:
        """The observations of the runs with an engagement, of what was worked out of them before."""
        loaded = [run for run in runs if run.name in pressed.forces]
        levels = {run.name: _level(run, loaded, pressed.forces) for run in loaded}
        return tuple(
            self._observations(machine, run, pressed.tracks[run.name], pressed.forces[run.name], levels[run.name])
            for run in loaded
        )

    def pressed(self, machine: Machine, runs: Sequence[Run]) -> Pressed:
        """Tracks of all runs, balances of all drives, forces of every run with an engagement.

        Raises
        ------
        UnsupportedError
            If there is none, or the runs do not tell the drives' own torques from the load.
        """
        tracks = {run.name: self._track(machine, run) for run in runs}
        self._check_engagements(runs, tracks)
        loaded = [run.name for run in runs if self._engaged(run)]
        if not loaded:
            raise UnsupportedError("no run has an engagement; give engagement_um to those at which the roller was pressed")
        balances = self.torque_balances(machine, runs, tracks)
        forces = {
            name: contact_force(machine, tracks[name], self.drives, balances, self.harmonics, self._tool) for name in loaded
        }
        return Pressed(tracks, balances, forces)

    def torque_balances(
        self, machine: Machine, runs: Sequence[Run], tracks: dict[str, Track] | None = None
    ) -> dict[str, TorqueBalance]:
        """The torque balance of every drive, by axis: as given, else from the unloaded runs, else from all at once.

        Raises
        ------
        UnsupportedError
            If the runs do not determine it; the message says which parameters fall together, and what would tell them apart.
        """
        tracks = tracks or {run.name: self._track(machine, run) for run in runs}
        return {drive.axis: self._given(drive) or self._identified(machine, drive, runs, tracks) for drive in self.drives}

    def simulated(
        self, machine: Machine, run: Run, respond: Respond, imperfection: Imperfection, random: np.random.Generator
    ) -> Run:
        """The run as encoders and currents would show it at its angles, with the balances given.

        Raises
        ------
        InputError
            If the run has no angles, the balance of a drive is not given, or the contact would open.
        """
        if "angle" not in run.columns:
            raise InputError(f"run {run.name!r} has no angles to simulate it at")
        angle = np.sort(run.columns["angle"])[:: run.sense]
        engagement = run.engagement or 0.0
        path = replace(self.circle, radius=self.circle.radius - engagement)
        rate = run.sense * (run.feed or self.feed) / path.radius
        commands = follow(machine, self.circle.centre, path.motion(angle, rate), self._tool)
        direction = commands.displacement / path.radius
        blank = Observations(
            run=run.name,
            force=0.0,
            pose=angle,
            commands=commands.position,
            velocity=commands.velocity,
            acceleration=commands.acceleration,
            centre=self._centre(machine),
            direction=np.column_stack([direction, np.zeros_like(direction)]),
            wrench=np.zeros((len(angle), 6)),
            reading=np.zeros(len(angle)),
            correction=np.zeros(len(angle)),
            tool=np.array(machine.tool) if self._tool is None else self._tool,
            workpiece=commands.ball,
            length=path.radius,
        )
        force = np.zeros(len(angle))
        if self._engaged(run):
            parts = sum((rig.along(angle) for rig in self.rig), np.zeros(len(angle)))
            force = _balanced_force(blank, respond, engagement, self.setup, parts)
            force *= imperfection.force_factor(random)
        columns = {"time": np.abs((angle - angle[0]) / rate)}
        wrench = force[:, np.newaxis] * blank.direction
        axes = [drive.axis for drive in self.drives]
        held = -joint_forces(machine, commands.position, wrench, axes, self._tool)
        offsets = imperfection.eccentricity * random.standard_normal(len(axes))
        for k, drive in enumerate(self.drives):
            joint = machine.index(drive.axis)
            position = commands.position[:, joint] + offsets[k]
            columns[f"position_{drive.axis.lower()}"] = imperfection.noisy(position, random)
            acceleration = np.zeros(len(angle)) if commands.acceleration is None else commands.acceleration[:, joint]
            effort = balance_effort(self._true(drive), drive, commands.velocity[:, joint], acceleration)
            effort += effort_from_force(drive, held[:, k], held[:, k] * commands.velocity[:, joint] > 0)
            noise = imperfection.current_noise * random.standard_normal(len(angle))
            columns[f"current_{drive.axis.lower()}"] = current_from_effort(drive, effort) + noise
        return replace(run, columns=columns)

    @property
    def _tool(self) -> Array | None:
        return None if self.tool is None else np.array(self.tool)

    def _centre(self, machine: Machine) -> Array:
        return np.array([self.circle.centre.get(axis, 0.0) for axis in machine.axes])

    def _known(self, drive: FeedDrive) -> KnownBalance | None:
        return next((balance for balance in self.balances if balance.axis == drive.axis), None)

    def _given(self, drive: FeedDrive) -> TorqueBalance | None:
        """The balance of a drive, if all its terms are given."""
        known = self._known(drive)
        if known is None or len(known_terms(known, drive)) < len(self.terms):
            return None
        return known_torque_balance(known, drive, self.least_speed)

    def _true(self, drive: FeedDrive) -> KnownBalance:
        known = self._known(drive)
        if known is not None:
            return known
        raise InputError(
            f"to simulate the current of axis {drive.axis}, its true torques must be given: [[setup.balances]] of the "
            f"simulation file"
        )

    def _check_engagements(self, runs: Sequence[Run], tracks: dict[str, Track]) -> None:
        """Refuse a loaded run that passes for an unloaded one."""
        for run in runs:
            shown = float(tracks[run.name].engagement.mean())
            if not self._engaged(run) and shown > UNCLAIMED:
                raise InputError(
                    f"run {run.name!r} claims no engagement, but the encoders show one of {1000 * shown:.0f} um; give its "
                    f"engagement_um, or correct the radius at which ball and roller just touch"
                )

    def _engaged(self, run: Run) -> bool:
        return run.engagement is not None and run.engagement > 0

    def _track(self, machine: Machine, run: Run) -> Track:
        missing = [name for name in self.quantities if name not in run.columns]
        if missing:
            raise InputError(
                f"run {run.name!r} lacks {', '.join(missing)}; a ball-roller test needs time, position and current of every "
                f"axis that presses"
            )
        track = track_of(machine, run, self.circle, self.drives, self.cutoff, self._tool)
        return track if self.harmonics else moving(track, self.least_speed)

    def _identified(
        self, machine: Machine, drive: FeedDrive, runs: Sequence[Run], tracks: dict[str, Track]
    ) -> TorqueBalance:
        """The balance of a drive from the unloaded runs; where there is none, with the loads of the others as unknowns."""
        known = self._known(drive)
        model = TorqueModel(self.terms, self.least_speed, known.smooth_speed if known else None)
        unloaded = [tracks[run.name].records[drive.axis] for run in runs if not self._engaged(run)]
        records = unloaded or [self._loaded_record(machine, drive, run, tracks[run.name]) for run in runs]
        return identify_balance(records, model, known_terms(known, drive) if known else {}).balance

    def _loaded_record(self, machine: Machine, drive: FeedDrive, run: Run, track: Track) -> DriveRecord:
        """The record of a loaded run, with the direction pattern of its load (Eqs. 6.7, 6.8), which may go with the turn.

        What the drive feels of it when driven back is a load of its own where the drive loses power: else the step between
        the two, which rests on the stated losses alone, would tell the load from the inertia.
        """
        held = -joint_forces(machine, track.commands, track.push, [drive.axis], self._tool)[:, 0]
        driving = drives_against(machine, track, drive.axis, self._tool)
        pattern = held * drive.force_per_effort() / drive.force_per_effort(driving)
        level = f"load at {1000 * (run.engagement or 0.0):g} um"
        waves = {
            f"{level}, {name} {order}": pattern * wave(order * track.angle)
            for order in LOAD_ORDERS
            for name, wave in (("cos", np.cos), ("sin", np.sin))
        }
        whole = {level: pattern}
        if drive.efficiency < 1:
            whole = {level: pattern * driving, f"{level}, driven back": pattern * ~driving}
        return replace(track.records[drive.axis], disturbance=whole | waves)

    def _observations(self, machine: Machine, run: Run, track: Track, contact: ContactForce, level: float) -> Observations:
        """The readings that count: at which the contact's force is known."""
        if contact.force.min() <= 0:
            angle = float(np.rad2deg(track.angle[int(contact.force.argmin())])) % 360
            raise UnsupportedError(
                f"run {run.name!r}: the currents say that ball and roller lost contact near {angle:.0f} degrees "
                f"({contact.force.min():.3g} N); engage them further, or look at the drives' constants and their sense"
            )
        setup = setup_compliance(self.setup, run.engagement or 0.0, contact.force)
        correction = setup * contact.force
        observations = Observations(
            run=run.name,
            force=level,
            pose=track.angle,
            commands=track.commands,
            velocity=track.velocity,
            acceleration=track.acceleration,
            centre=self._centre(machine),
            direction=track.push,
            wrench=contact.force[:, np.newaxis] * track.push,
            reading=track.engagement - correction,
            correction=correction,
            tool=np.array(machine.tool) if self._tool is None else self._tool,
            workpiece=workpiece_ball(machine, self.circle.centre, self._tool),
            length=self.circle.radius - float(track.engagement.mean()),
            collinear=MEASURED_FORCE,
            influences=observed_influences(contact, track.push, setup, self.setup.standard_uncertainty),
        )
        return check_observations(observations)


def _level(run: Run, loaded: Sequence[Run], forces: Mapping[str, ContactForce]) -> float:
    """Mean force [N] of all runs of one commanded engagement."""
    alike = [other for other in loaded if abs((other.engagement or 0.0) - (run.engagement or 0.0)) < SAME_ENGAGEMENT]
    return float(np.mean([forces[other.name].force.mean() for other in alike]))


def _balanced_force(blank: Observations, respond: Respond, engagement: float, setup: SetupCompliance, parts: Array) -> Array:
    """The force at which machine and set-up together give way by the engagement, shape (m,) [N]."""
    path = respond(blank)
    force = np.ones(len(path))
    for _ in range(3):  # exact products of transforms are not quite linear in the force
        given = respond(replace(blank, wrench=force[:, np.newaxis] * blank.direction)) - path
        force = (engagement - path) / (given / force + setup_compliance(setup, engagement, force) + parts)
    if not (force > 0).all():
        raise InputError(f"run {blank.run!r}: an engagement of {1000 * engagement:g} um opens where the path is off by more")
    return np.asarray(force)
