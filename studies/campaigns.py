"""How often the intervals of a campaign hold the truth: `python -m studies.campaigns [TRIALS]`.

Random machines of several topologies, a campaign each: loaded circles in XY, YZ and ZX at three forces, two runs each, with
a noise of its own for each test and a centre of its own for each run. One gauge measures the force of all tests and is off
by one draw of 3 %. Values are random, in sizes that machines have. An interval counts for every parameter, for what it
stands for.
"""

from __future__ import annotations

import sys

import numpy as np

from elastogeo.estimate import solve_as_runs_show
from elastogeo.identification import confounding_of, effects_of, systems_of, uncertainty_budget
from elastogeo.machine import About, Joint, Machine, parse_topology
from elastogeo.observe import Campaign, Circle, Imperfection, KnownInfluence, LoadedBallBar, MachineTest, Run
from elastogeo.sources import simulate

TOPOLOGIES = ("wFYXZt", "wXYFZt", "wCAFYXZt")
FORCES = (120.0, 400.0, 700.0)
READINGS = 24
SCALE = 0.03
NOISES = {"XY": 1e-4, "YZ": 3e-4, "ZX": 2e-4}


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
    for plane in NOISES:
        runs = tuple(
            Run(f"{force:g} N, {k}", {"angle": angle, "radial": np.zeros(READINGS)}, force=force, repeat=k)
            for force in FORCES
            for k in (1, 2)
        )
        setup, about = LoadedBallBar(Circle(150.0, plane=plane), 2000 / 60), About(instrument_serial="7")
        tests[plane.lower()] = MachineTest(plane, machine, setup, runs, influences=gauge, about=about)
    return Campaign(topology, tests)


def trial(campaign: Campaign, seed: int) -> tuple[int, int]:
    """How many intervals hold the truth, and how many there are."""
    random = np.random.default_rng([seed, 1])
    sources = systems_of(campaign).sources
    truth = {s.name: _size(s.unit) * float(random.normal()) for s in sources}
    off = 1.0 + SCALE * float(random.normal())
    acted = {s.name: truth[s.name] * (off if s.elastic else 1.0) for s in sources}
    tests = {
        name: simulate(test, acted, Imperfection(noise=NOISES[test.name], eccentricity=0.002), seed * 7 + k, exact=False)
        for k, (name, test) in enumerate(campaign.tests.items())
    }
    read = Campaign(campaign.name, tests)
    systems = systems_of(read)
    found = confounding_of(read, systems)
    solution, unshown = solve_as_runs_show([run.factor for run in systems.runs], found.retained)
    budget = uncertainty_budget(systems, solution, effects_of(read, systems))
    true = [sum(c * truth[n] for n, c in found.stands_for(name).items()) for name in found.retained]
    held = [low <= value <= high for value, (low, high) in zip(true, budget.interval, strict=True)]
    shown = [name not in unshown for name in found.retained]
    return sum(h for h, s in zip(held, shown, strict=True) if s), sum(shown)


def _size(unit: str) -> float:
    """What a parameter of this unit is on ordinary machines."""
    return {"mm/N": 5e-5, "rad/N": 2e-8, "mm/(N mm)": 2e-8, "rad/(N mm)": 5e-11}.get(unit, 2e-5 if unit == "mm/mm" else 1e-7)


def main() -> None:
    """One line for each topology."""
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    for topology in TOPOLOGIES:
        counts = np.array([trial(blank(topology, seed % 5), seed) for seed in range(trials)]).sum(axis=0)
        print(f"{topology}: {100 * counts[0] / counts[1]:.1f} % of {counts[1]} intervals hold the truth", flush=True)


if __name__ == "__main__":
    main()
