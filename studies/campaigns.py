"""How often the intervals of a campaign hold the truth: `python -m studies.campaigns [TRIALS [MIXED]]`.

Random machines of several topologies, a campaign each: loaded circles in XY, YZ and ZX at three forces, two runs each, with
a noise of its own for each test and a centre of its own for each run. One gauge measures the force of all tests and is off
by one draw of 3 %. Values are random, in sizes that machines have. An interval counts for every parameter, for what it
stands for.

Then mixed campaigns, MIXED of them (300), each on a random machine of a random topology: a loaded circle, a static force in
a random direction at a random place, probes on a loaded bar, a positioning test and a bar without load, each with its own
question. One gauge measures the force of the first three; the bar without load is too long by a draw of its own, the sensors
of the static test and the probes are zeroed each with an error of their own.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.estimate import solve_as_runs_show
from elastogeo.identification import confounding_of, effects_of, plain, systems_of, uncertainty_budget
from elastogeo.machine import About, Array, Joint, Machine, parse_topology
from elastogeo.observe import (
    BallBar,
    Campaign,
    Circle,
    DisplacementProbes,
    Imperfection,
    KnownInfluence,
    LoadedBallBar,
    MachineTest,
    Positioning,
    Question,
    Run,
    Setup,
    StaticForce,
)
from elastogeo.sources import simulate

TOPOLOGIES = ("wFYXZt", "wXYFZt", "wCAFYXZt")
FORCES = (120.0, 400.0, 700.0)
READINGS = 24
SCALE = 0.03
PLANES = ("XY", "YZ", "ZX")
BAR = 1e-3
"""Standard uncertainty [mm] of the length of a bar."""

NOISES = {"xy": 1e-4, "yz": 3e-4, "zx": 2e-4, "loaded": 1e-4, "static": 2e-4, "probes": 3e-4, "travel": 5e-4, "bar": 2e-4}
"""By test."""

MIXED_TOPOLOGIES = ("wFYXZt", "wXYFZt", "wCAFYXZt", "wYXFZt", "wAFYXZBt", "wFXYZBCt", "wCYFXZBt")
TARGETS = tuple(map(float, np.linspace(-200.0, 200.0, 9)))
ZEROS = {"static": ("C_*",), "probes": ("C_[XYZ]??",)}
"""What is asked beside an instrument's own question."""


def machine_of(topology: str, random: np.random.Generator) -> Machine:
    """A machine with links of random lengths."""
    parsed = parse_topology(topology)
    joints = tuple(Joint(axis, offset=tuple(random.uniform(-200.0, 200.0, 3))) for axis in parsed.axes)
    return Machine(topology, parsed, joints, tool=tuple(random.uniform(-100.0, 100.0, 3)))


def blank(topology: str, seed: int) -> Campaign:
    """The campaign without readings."""
    machine = machine_of(topology, np.random.default_rng(seed))
    angle = 2 * np.pi * np.arange(READINGS) / READINGS
    gauge = (KnownInfluence("force-scale", "force gauge", relative=SCALE),)
    tests = {}
    for plane in PLANES:
        runs = tuple(
            Run(f"{force:g} N, {k}", {"angle": angle, "radial": np.zeros(READINGS)}, force=force, repeat=k)
            for force in FORCES
            for k in (1, 2)
        )
        setup, about = LoadedBallBar(Circle(150.0, plane=plane), 2000 / 60), About(instrument_serial="7")
        tests[plane.lower()] = MachineTest(plane, machine, setup, runs, influences=gauge, about=about)
    return Campaign(topology, tests)


def mixed(seed: int) -> Campaign:
    """A campaign of five instruments on a random machine, without readings."""
    random = np.random.default_rng([seed, 2])
    topology = str(random.choice(MIXED_TOPOLOGIES))
    machine = machine_of(topology, random)
    angle = 2 * np.pi * np.arange(READINGS) / READINGS
    gauge = (KnownInfluence("force-scale", "force gauge", relative=SCALE),)

    def length(name: str) -> KnownInfluence:
        return KnownInfluence("bar-length", f"length of the {name} bar", length=BAR)

    def loaded(columns: Mapping[str, Array]) -> tuple[Run, ...]:
        return tuple(Run(f"{f:g} N, {k}", columns, force=f, repeat=k) for f in FORCES for k in (1, 2))

    zeros = np.zeros(READINGS)
    place = {axis: float(random.uniform(-150.0, 150.0)) for axis in "XYZ"}
    directions = [tuple(map(float, random.normal(size=3))) for _ in range(5)]
    held = StaticForce(directions[0], directions[1], place)
    probes = DisplacementProbes((directions[2], directions[3], directions[4]), (1.0, 0.3, -0.4), place)
    around = dict.fromkeys(probes.readings, zeros) | {"angle": angle}
    axis = str(random.choice([name for name in machine.axes if name in "XYZ"]))
    travel = Positioning(axis, targets=TARGETS, cycles=5)
    unloaded = tuple(Run(f"run {k}", {"angle": angle, "radial": zeros}, repeat=k) for k in range(1, 5))
    bar = LoadedBallBar(Circle(150.0), 2000 / 60)

    def test(name: str, setup: Setup, runs: Sequence[Run], *known: KnownInfluence, serial: str = "") -> MachineTest:
        asked = Question((*setup.default_parameters(tuple(runs)), *ZEROS.get(name, ())))
        return MachineTest(name, machine, setup, tuple(runs), asked, influences=known, about=About(instrument_serial=serial))

    return Campaign(
        topology,
        {
            "loaded": test("loaded", bar, loaded({"angle": angle, "radial": zeros}), *gauge, serial="7"),
            "static": test("static", held, loaded({"angle": angle, "displacement": zeros}), *gauge, serial="7"),
            "probes": test("probes", probes, loaded(around), *gauge, serial="7"),
            "travel": test("travel", travel, (Run("cycles", {"angle": angle, "radial": zeros}),)),
            "bar": test("bar", BallBar(Circle(150.0), feed=20.0), unloaded, length("long"), serial="8"),
        },
    )


def trial(campaign: Campaign, seed: int) -> tuple[int, int]:
    """How many intervals hold the truth, and how many there are."""
    random = np.random.default_rng([seed, 1])
    sources = {source.name: source for source in systems_of(campaign).sources}
    truth = {name: _size(source.unit) * float(random.normal()) for name, source in sources.items()}
    off = 1.0 + SCALE * float(random.normal())
    middle = campaign.centre()
    centre = {} if middle is None else dict(zip(campaign.machine.axes, map(float, middle), strict=True))
    tests = {}
    for k, (name, test) in enumerate(campaign.tests.items()):
        scale = {source: off if test.setup.loads and sources[source].elastic else 1.0 for source in sources}
        acted = {
            plain(one): value * scale[one] for one, value in truth.items() if one in (plain(one), f"{plain(one)}@{name}")
        }
        noise = Imperfection(noise=NOISES[name], eccentricity=0.002)
        tests[name] = _too_long(
            simulate(test, acted, noise, seed * 7 + k, exact=False, centre=centre), BAR * float(random.normal())
        )
    campaign = Campaign(campaign.name, tests)
    systems = systems_of(campaign)
    found = confounding_of(campaign, systems)
    solution, unshown = solve_as_runs_show([run.factor for run in systems.runs], found.retained)
    budget = uncertainty_budget(systems, solution, effects_of(campaign, systems))
    true = [sum(c * truth[n] for n, c in found.stands_for(name).items()) for name in found.retained]
    held = [low <= value <= high for value, (low, high) in zip(true, budget.interval, strict=True)]
    shown = [name not in unshown for name in found.retained]
    return sum(h for h, s in zip(held, shown, strict=True) if s), sum(shown)


def _too_long(test: MachineTest, length: float) -> MachineTest:
    """The test with a bar that is longer than it says, if the test states that it may be."""
    if not any(known.kind == "bar-length" for known in test.influences):
        return test
    runs = (replace(run, columns={**run.columns, "radial": run.columns["radial"] + length}) for run in test.runs)
    return replace(test, runs=tuple(runs))


def _size(unit: str) -> float:
    """What a parameter of this unit is on ordinary machines."""
    return {"mm/N": 5e-5, "rad/N": 2e-8, "mm/(N mm)": 2e-8, "rad/(N mm)": 5e-11}.get(unit, 2e-5 if unit == "mm/mm" else 1e-7)


def main() -> None:
    """One line for each topology, and one for mixed campaigns."""
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    several = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    for topology in TOPOLOGIES if trials else ():
        counts = np.array([trial(blank(topology, seed % 5), seed) for seed in range(trials)]).sum(axis=0)
        print(f"{topology}: {100 * counts[0] / counts[1]:.1f} % of {counts[1]} intervals hold the truth", flush=True)
    counts = np.zeros(2, dtype=int)
    for seed in range(several):
        counts += trial(mixed(seed), seed)
        if seed % 20 == 19 or seed == several - 1:
            share = 100 * counts[0] / counts[1]
            print(f"{seed + 1} mixed campaigns: {share:.1f} % of {counts[1]} intervals hold the truth", flush=True)


if __name__ == "__main__":
    main()
