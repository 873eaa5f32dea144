"""What the contract of instruments is tested on: every registered instrument, on many machines, planes and poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import product

import numpy as np
import pytest

from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Question, Run, Setup, instruments
from elastogeo.observe.static_loads.probes import DisplacementProbes
from elastogeo.observe.static_loads.sensor_frame import Sensor, SensorFrame
from elastogeo.observe.static_loads.static_force import StaticForce

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


SETUPS: dict[str, Callable[[Arrangement], Setup]] = {
    "loaded-ball-bar": loaded_ball_bar,
    "displacement-probes": displacement_probes,
    "sensor-frame": sensor_frame,
    "static-force": static_force,
}
"""How each instrument is set up in an arrangement. A new instrument adds its line here and is held to the contract."""


@dataclass(frozen=True)
class Case:
    """One instrument in one arrangement."""

    instrument: str
    arrangement: Arrangement

    def __str__(self) -> str:
        return f"{self.instrument}-{self.arrangement}"

    def test(
        self,
        forces: Sequence[float] = (112.0, 490.0),
        readings: int = 36,
        parameters: Sequence[str] = ("C_*",),
        reference: float | None = None,
        repeats: int = 1,
    ) -> MachineTest:
        """A blank test: one run per force and repeat."""
        setup = SETUPS[self.instrument](self.arrangement)
        angle = np.arange(readings) * 2 * np.pi / readings
        runs = tuple(
            Run(f"{force:g} N, {k}", blank(setup, angle, force), force=force, repeat=k)
            for force in forces
            for k in range(1, repeats + 1)
        )
        return MachineTest(str(self), self.arrangement.machine, setup, runs, Question(tuple(parameters), reference))


def blank(setup: Setup, pose: Array, force: float) -> dict[str, Array]:
    """Columns of a run to simulate: zeros, at these poses, under a force that turns if it is recorded by components."""
    columns = {quantity: np.zeros(len(pose)) for quantity in setup.quantities if quantity != "force"}
    if "force_x" in columns:
        columns |= {
            "force_x": force * np.cos(pose),
            "force_y": force * np.sin(pose),
            "force_z": force * np.cos(2 * pose) / 2,
        }
    return {**columns, "angle": pose}


CASES = tuple(Case(name, arrangement) for name, arrangement in product(instruments(), ARRANGEMENTS) if name in SETUPS)


@pytest.fixture(scope="session")
def setups() -> dict[str, Callable[[Arrangement], Setup]]:
    return SETUPS


@pytest.fixture(scope="session", params=CASES, ids=str)
def case(request: pytest.FixtureRequest) -> Case:
    return request.param


@pytest.fixture(scope="session", params=[c for c in CASES if c.arrangement in ARRANGEMENTS[::5]], ids=str)
def typical(request: pytest.FixtureRequest) -> Case:
    """A few cases, for what takes many draws."""
    return request.param


@pytest.fixture(scope="session")
def case_of() -> Callable[[str], Case]:
    """The ball bar's case in an arrangement, by its name."""
    return lambda name: next(c for c in CASES if c.instrument == "loaded-ball-bar" and str(c.arrangement) == name)
