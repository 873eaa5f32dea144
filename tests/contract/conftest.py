"""What the contract of instruments is tested on: every registered instrument, on many machines, planes and poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
import pytest

from elastogeo.drive import FeedDrive, KnownBalance, SetupCompliance
from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import (
    BallBar,
    BallMotion,
    BallRoller,
    Campaign,
    Circle,
    LoadedBallBar,
    MachineTest,
    Positioning,
    Question,
    Run,
    Setup,
    SphereNest,
    instrument_named,
    instruments,
)
from elastogeo.observe.static_loads.joint_probe import JointProbe
from elastogeo.observe.static_loads.probes import DisplacementProbes
from elastogeo.observe.static_loads.sensor_frame import Sensor, SensorFrame
from elastogeo.observe.static_loads.static_force import StaticForce
from elastogeo.sources import simulate

TILTED = ((1.0, 1.0, 0.0), (1.0, -1.0, 3.0))


@dataclass(frozen=True)
class Arrangement:
    """A machine and where on it the instrument works: a plane about a centre, rotary axes held or moving."""

    topology: str
    plane: str | tuple = "XY"
    centre: dict[str, float] = field(default_factory=dict)
    rotary_turn: dict[str, float] = field(default_factory=dict)
    bar_turn: float = 1.0
    in_workpiece: bool = False
    offsets: int | None = None
    """Seed of random link offsets and tool point; None for a machine whose frames all coincide at zero."""
    inclined: bool = False

    def __str__(self) -> str:
        plane = self.plane if isinstance(self.plane, str) else "tilted"
        moving = f"-{''.join(self.rotary_turn)} moves" if self.rotary_turn else ""
        return f"{self.topology}-{plane}{moving}{'-offset' if self.offsets is not None else ''}"

    @property
    def machine(self) -> Machine:
        topology = parse_topology(self.topology)
        if self.offsets is None:
            return Machine(self.topology, topology)
        random = np.random.default_rng(self.offsets)
        joints = tuple(
            Joint(
                axis,
                offset=tuple(random.uniform(-250, 250, 3)),
                tilt=tuple(random.uniform(-0.8, 0.8, 3) if self.inclined else np.zeros(3)),
                compliant=axis != "S",
            )
            for axis in topology.axes
        )
        return Machine(self.topology, topology, joints, tool=tuple(random.uniform(-120, 120, 3)))

    @property
    def circle(self) -> Circle:
        return Circle(
            150.0, self.plane, self.centre, self.in_workpiece, self.bar_turn, bar_start=0.2, rotary_turn=self.rotary_turn
        )


ARRANGEMENTS = (
    Arrangement("wFYXt"),
    Arrangement("wXFYt", offsets=1),
    Arrangement("wXYFt", centre={"X": 40.0, "Y": -60.0}),
    Arrangement("wYXFZt", "ZX", offsets=2),
    Arrangement("wXYFZt", "YZ", offsets=3),
    Arrangement("wCAFYXZSt", centre={"X": 100.0, "Z": -300.0}),
    Arrangement("wCAFYXZSt", centre={"A": -0.45, "C": 1.1, "Z": -80.0}, offsets=4),
    Arrangement("wCAFYXZSt", centre={"X": 50.0, "Y": 80.0}, rotary_turn={"C": 1.0}, bar_turn=0.0, offsets=5),
    Arrangement("[w C' A' b Y X Z (C1) t]", TILTED, {"A": 0.7, "C": -2.0}, in_workpiece=True, offsets=6),
    Arrangement("wCAYfXZt", "YZ", {"A": 0.35, "C": 0.9}, offsets=7),
    Arrangement("wCAYfXZt", TILTED, {"Z": 40.0}, {"C": 0.5, "A": 0.1}, in_workpiece=True),
    Arrangement("wFXYZBCt", "XY", {"B": 0.6, "C": -0.8}, offsets=8),
    Arrangement("wXFYZBCt", TILTED, {"B": -0.4}, {"C": 1.0}, offsets=9),
    Arrangement("wBXFZYt", "ZX", {"B": 0.5}, offsets=10),
    Arrangement("wCBXFYZt", "YZ", {"C": 1.0, "B": -0.3}, {"B": -0.5}, offsets=11, inclined=True),
    Arrangement("wAFXYZBt", TILTED, {"A": 0.2, "B": 0.1}, offsets=12, inclined=True),
    Arrangement("wZFXYCt", "XY", {"C": 2.0}, offsets=13),
    Arrangement("wCYFXZBt", "YZ", {"C": 0.4, "B": 0.7}, offsets=14, inclined=True),
)


def loaded_ball_bar(arrangement: Arrangement) -> Setup:
    return LoadedBallBar(arrangement.circle, feed=2000 / 60)


def ball_bar(arrangement: Arrangement) -> Setup:
    return BallBar(arrangement.circle, feed=2000 / 60)


def dial_gauge(arrangement: Arrangement) -> Setup:
    """The recipe of `observe.instruments`, as it stands there."""
    return instrument_named("dial-gauge")((0.3, -0.2, -1.0), arrangement.centre)


def positioning(arrangement: Arrangement) -> Setup:
    """A linear axis read in a skew direction, as no sensor is set up: so that every component counts."""
    axis = next(axis for axis in parse_topology(arrangement.topology).axes if axis in "XYZ")
    tool = (40.0, -30.0, 20.0) if arrangement.offsets is None else None
    return Positioning(axis, arrangement.centre, (1.0, -0.6, 0.3), in_workpiece=arrangement.in_workpiece, tool=tool)


def ball_roller(arrangement: Arrangement) -> Setup:
    """With true balances of its drives, so that it can be simulated and each run observed by itself."""
    plane = str(arrangement.plane)
    drives = tuple(FeedDrive(axis, torque_constant=1600.0, pitch=10.0, efficiency=0.9) for axis in sorted(plane))
    balances = tuple(KnownBalance(axis, inertia=5.0, viscous=80.0, coulomb=1500.0, constant=0.0) for axis in sorted(plane))
    circle = Circle(56.4, plane, arrangement.centre)
    return BallRoller(circle, 1000 / 60, drives, SetupCompliance(constant=1 / 15e3), balances)


def static_force(arrangement: Arrangement) -> Setup:
    return StaticForce(None, (1.0, 1.0, -2.0), arrangement.centre, (30.0, -20.0, 10.0), in_workpiece=True)


def displacement_probes(arrangement: Arrangement) -> Setup:
    return DisplacementProbes(
        ((1.0, 0.2, 0.0), (0.0, 1.0, 0.3), (0.4, 0.0, 1.0)), (1.0, 1.0, 1.0), arrangement.centre, arrangement.rotary_turn
    )


def sensor_frame(arrangement: Arrangement) -> Setup:
    points = np.random.default_rng(12).uniform(-80, 80, (12, 3))
    directions = np.random.default_rng(13).standard_normal((12, 3))
    sensors = tuple(Sensor(tuple(p), tuple(n)) for p, n in zip(points, directions, strict=True))
    return SensorFrame(sensors, (1.0, -2.0, 1.0), arrangement.centre, (15.0, -10.0, -40.0), in_workpiece=True)


def joint_probe(arrangement: Arrangement) -> Setup:
    """Across two joints where there are two to one side or the other, off the origin of the first one's carriage."""
    axes = parse_topology(arrangement.topology).axes
    across = axes[:2][::-1] if "S" not in axes[:2] else axes[:1]
    return JointProbe(across, (1.0, -0.4, 0.3), (30.0, -20.0, 55.0), None, arrangement.centre, (10.0, 0.0, -20.0))


def sphere_nest(arrangement: Arrangement) -> Setup:
    """Preloaded; the rotary axes that turn in an arrangement turn here too, all the way."""
    start = {axis: arrangement.centre.get(axis, 0.0) for axis in arrangement.rotary_turn}
    end = {axis: start[axis] + 2 * np.pi * turn for axis, turn in arrangement.rotary_turn.items()}
    sensors = ((1.0, 0.0, 1.0), (-0.5, 0.9, 1.0), (-0.4, -0.8, 1.2))
    return SphereNest(sensors, arrangement.centre, "tool", (), (BallMotion(start, end),), preload=(0.3, -0.2, 1.0))


SETUPS: dict[str, Callable[[Arrangement], Setup]] = {
    "ball-bar": ball_bar,
    "ball-roller": ball_roller,
    "dial-gauge": dial_gauge,
    "joint-probe": joint_probe,
    "loaded-ball-bar": loaded_ball_bar,
    "positioning": positioning,
    "displacement-probes": displacement_probes,
    "sensor-frame": sensor_frame,
    "sphere-nest": sphere_nest,
    "static-force": static_force,
}
"""How each instrument is set up in an arrangement. A new instrument adds its line here and is held to the contract."""

IN_SOME = tuple(arrangement for arrangement in ARRANGEMENTS[::5] if not arrangement.rotary_turn)
IN_ALL = ("displacement-probes", "loaded-ball-bar", "sensor-frame", "static-force")
"""Some arrangements are enough for the others: what they do, one of these does in all of them."""

GEOMETRY = ("E_[XYZABC][XYZ][12]", "E_[ABC](0*)[XYZ]", "E_[XYZ]t0")
"""What an instrument without a load is asked, in place of compliances; the set-up is one for all runs."""


@dataclass(frozen=True)
class Case:
    """One instrument in one arrangement."""

    instrument: str
    arrangement: Arrangement

    def __str__(self) -> str:
        return f"{self.instrument}-{self.arrangement}"

    @property
    def is_typical(self) -> bool:
        """Whether it is one of a few, for what takes many draws."""
        return self.arrangement in ARRANGEMENTS[::5]

    @property
    def loads(self) -> bool:
        return instrument_named(self.instrument).loads

    def test(
        self,
        forces: Sequence[float] = (112.0, 490.0),
        readings: int = 36,
        parameters: Sequence[str] = ("C_*",),
        reference: float | None = None,
        repeats: int = 1,
    ) -> MachineTest:
        """A blank test: one run per force and repeat; without a load one per repeat and force, and geometry is asked for."""
        setup = SETUPS[self.instrument](self.arrangement)
        if not setup.loads:
            parameters, reference = GEOMETRY, None
        if self.instrument == "ball-roller":
            return self._rolled(setup, forces)
        angle = np.arange(readings) * 2 * np.pi / readings
        runs = tuple(
            Run(f"{force:g} N, {k}", blank(setup, angle, force), force=force if setup.loads else None, repeat=k)
            for force in forces
            for k in range(1, repeats + 1)
        )
        return MachineTest(str(self), self.arrangement.machine, setup, runs, Question(tuple(parameters), reference))

    def _rolled(self, setup: Setup, forces: Sequence[float]) -> MachineTest:
        """What a ball-roller records on a rigid machine: its force is measured, so there is no blank run of it."""
        return simulate(unrecorded(self.arrangement, setup, forces), {"C_XXX": 0.0})


def unrecorded(arrangement: Arrangement, setup: Setup, forces: Sequence[float]) -> MachineTest:
    """A ball-roller test that is yet to be simulated."""
    angle = np.linspace(0, 2.06 * np.pi, 700)
    runs = tuple(Run(f"{force:g} N", {"angle": angle}, engagement=force / 15e3) for force in forces)
    return MachineTest(f"ball-roller-{arrangement}", arrangement.machine, setup, runs, Question(("C_*",)))


def blank(setup: Setup, pose: Array, force: float) -> dict[str, Array]:
    """Columns of a run to simulate: zeros, at these poses, under a force that turns if it is recorded by components."""
    if "target" in setup.quantities:
        target, sense = 400 * np.cos(pose), np.where(pose < np.pi, -1.0, 1.0)
        return {"target": target, "direction": sense, "deviation": np.zeros(len(pose)), "angle": pose}
    columns = {quantity: np.zeros(len(pose)) for quantity in setup.quantities if quantity != "force"}
    if "force_x" in columns:
        columns |= {
            "force_x": force * np.cos(pose),
            "force_y": force * np.sin(pose),
            "force_z": force * np.cos(2 * pose) / 2,
        }
    return {**columns, "angle": pose}


PRESSED = tuple(arrangement for arrangement in ARRANGEMENTS[:5] if arrangement.plane in ("XY", "ZX", "YZ"))


def is_held_to(instrument: str, arrangement: Arrangement) -> bool:
    """Whether an instrument is tested in an arrangement; a nest where a rotary axis turns, which is what it is for."""
    if instrument == "sphere-nest":
        return bool(arrangement.rotary_turn)
    return instrument in IN_ALL or arrangement in IN_SOME


CASES = tuple(
    Case(name, arrangement)
    for name, arrangement in product(instruments(), ARRANGEMENTS)
    if name in SETUPS and name != "ball-roller" and is_held_to(name, arrangement)
)
MEASURED = tuple(Case("ball-roller", arrangement) for arrangement in PRESSED)
"""The force of these is measured, so that it has an error of its own: they are held to the parts of the contract that do not
assume exact forces. Their truth comes back to what that leaves, in `tests/observe/test_ball_roller.py`."""


@pytest.fixture(scope="session")
def setups() -> dict[str, Callable[[Arrangement], Setup]]:
    return SETUPS


@pytest.fixture(scope="session", params=CASES, ids=str)
def case(request: pytest.FixtureRequest) -> Case:
    return request.param


@pytest.fixture(scope="session", params=(*CASES, *MEASURED), ids=str)
def any_case(request: pytest.FixtureRequest) -> Case:
    """With the instruments that measure their force."""
    return request.param


@pytest.fixture(scope="session", params=[c for c in CASES if c.is_typical], ids=str)
def typical(request: pytest.FixtureRequest) -> Case:
    """A few cases, for what takes many draws."""
    return request.param


@pytest.fixture(scope="session")
def case_of() -> Callable[[str], Case]:
    """The ball bar's case in an arrangement, by its name."""
    return lambda name: next(c for c in CASES if c.instrument == "loaded-ball-bar" and str(c.arrangement) == name)


@pytest.fixture(scope="session", params=PRESSED[:2], ids=str)
def pressed(request: pytest.FixtureRequest) -> tuple[Campaign, MachineTest]:
    """A static force and a loaded bar in one arrangement, blank; and a ball-roller there."""
    names = ("loaded-ball-bar", "static-force")
    tests = {name: Case(name, request.param).test(readings=24) for name in names}
    return Campaign(str(request.param), tests), unrecorded(request.param, ball_roller(request.param), (112.0, 490.0))


@pytest.fixture(scope="session", params=ARRANGEMENTS, ids=str)
def every_instrument(request: pytest.FixtureRequest) -> Campaign:
    """A blank test of every instrument in one arrangement; without those that measure their force."""
    names = [n for n in SETUPS if n != "ball-roller" and (n != "sphere-nest" or request.param.rotary_turn)]
    return Campaign(str(request.param), {name: Case(name, request.param).test(readings=16) for name in names})
