"""How often the interval of a predicted deviation along a path holds the true one: `python -m studies.paths [TRIALS]`.

Random machines of several topologies; of each a campaign of loaded circles in XY, YZ and ZX at six places, three forces,
two runs each, with a noise of its own for each test, a centre of its own for each run, and one gauge that is off by one
draw of 1 %. All compliances of the joints and the geometry that circles show are asked for, the joints as reciprocal, which
they are. The readings, and where the tool really goes along a path, are made by exact products of transforms from the same
truth; the prediction is linear. The path is a tilted ellipse in the tested volume, on a workpiece that the machine has
probed, under a force that goes with it and is known to 3 %, with a tool known to 10 %: the real ones are off by a draw.
What is counted: x, y, z and the normal of the path at eight points of it, where the tests support them; where they do not,
that no interval was given.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from elastogeo.estimate import solve_as_runs_show
from elastogeo.identification import confounding_of, effects_of, systems_of, uncertainty_budget
from elastogeo.machine import About, Array, ConstantForce, Cut, Machine, ToolPath, measured_tool, path_of_commands
from elastogeo.observe import (
    Campaign,
    Circle,
    Imperfection,
    KnownInfluence,
    LoadedBallBar,
    MachineTest,
    Question,
    Run,
)
from elastogeo.prediction import Knowledge, PathPrediction, known_deviation, parameter_scales, simulated_points
from elastogeo.sources import simulate
from studies.campaigns import machine_of

TOPOLOGIES = ("wFYXZt", "wXYFZt", "wCAFYXZt")
FORCES = (120.0, 400.0, 700.0)
READINGS = 24
SCALE = 0.01
FORCE = 0.03
POINTS = 80
COUNTED = 8
PLANES = {"XY": 1e-4, "YZ": 2e-4, "ZX": 1.5e-4}
"""Standard deviation [mm] of the noise in each plane."""

PLACES = (
    {"X": -90.0, "Y": -60.0, "Z": -50.0},
    {"X": 80.0, "Y": 70.0, "Z": -60.0},
    {"X": 60.0, "Y": -80.0, "Z": 70.0},
    {"X": -70.0, "Y": 50.0, "Z": 90.0},
    {"X": 10.0, "Y": 100.0, "Z": 20.0},
    {"X": -20.0, "Y": -10.0, "Z": -100.0},
)
ASKED = (
    *("C_???", "E_XX1", "E_YY1", "E_ZZ1"),
    *("E_A(0[XYZ])[YZ]|E_A(0)Y", "E_B(0[XYZ])[ZX]|E_B(0)Z", "E_C(0[XYZ])[XY]|E_C(0)X"),
)
"""No straightness: a simulated circle counts its command from its own centre, a campaign from the middle of all."""

SIZES = {"mm/N": 2e-5, "rad/N": 1e-8, "mm/(N mm)": 1e-8, "rad/(N mm)": 3e-11, "mm/mm": 3e-5, "rad": 3e-5}
"""What parameters are on ordinary machines: the standard deviation of their draws, by unit."""


@dataclass(frozen=True)
class Counted:
    """How often an interval held the truth, where there was one."""

    held: int = 0
    supported: int = 0
    unsupported: int = 0
    given_all_the_same: int = 0

    def __add__(self, other: Counted) -> Counted:
        return Counted(
            self.held + other.held,
            self.supported + other.supported,
            self.unsupported + other.unsupported,
            self.given_all_the_same + other.given_all_the_same,
        )


def blank(machine: Machine, planes: tuple[str, ...]) -> Campaign:
    """The campaign without readings."""
    angle = 2 * np.pi * np.arange(READINGS) / READINGS
    gauge = (KnownInfluence("force-scale", "force gauge", relative=SCALE),)
    tests = {}
    for plane in planes:
        for k, place in enumerate(PLACES):
            runs = tuple(
                Run(f"{force:g} N, {n}", {"angle": angle, "radial": np.zeros(READINGS)}, force=force, repeat=n)
                for force in FORCES
                for n in (1, 2)
            )
            setup = LoadedBallBar(Circle(150.0, plane=plane, centre=place), 2000 / 60)
            tests[f"{plane.lower()}-{k}"] = MachineTest(
                f"{plane} {k}",
                machine,
                setup,
                runs,
                Question(ASKED, reciprocal=True),
                influences=gauge,
                about=About(instrument_serial="7"),
            )
    return Campaign(machine.name, tests)


def known(campaign: Campaign) -> Knowledge:
    """What the tests say of the machine, without the models and checks of an identification."""
    systems = systems_of(campaign)
    found = confounding_of(campaign, systems)
    systems = systems.holding(found.retained)
    solution, _ = solve_as_runs_show([run.factor for run in systems.runs], found.retained)
    return Knowledge(
        machine=campaign.machine,
        sources=systems.sources,
        solution=solution,
        budget=uncertainty_budget(systems, solution, effects_of(campaign, systems)),
        confounding=found,
        by_run=True,
        scales=parameter_scales(systems.sources),
        centre=systems.runs[0].observations.centre,
        rigid=(),
        simulated="yes",
    )


def ellipse(machine: Machine, random: np.random.Generator) -> ToolPath:
    """A tilted ellipse within the tested volume."""
    turn = np.linspace(0, 2 * np.pi, POINTS)
    axes = random.normal(size=(2, 3))
    way = np.cos(turn)[:, np.newaxis] * axes[0] + np.sin(turn)[:, np.newaxis] * axes[1]
    way *= 120.0 / np.abs(way).max()
    commands = np.zeros((POINTS, len(machine.axes)))
    for letter, column in zip("XYZ", way.T, strict=True):
        commands[:, machine.index(letter)] = column
    return path_of_commands(machine, commands, feed=30.0)


def trial(topology: str, seed: int, planes: tuple[str, ...] = tuple(PLANES)) -> Counted:
    """One machine, its tests, and one path."""
    random = np.random.default_rng([seed, 7])
    machine = machine_of(topology, random)
    empty = blank(machine, planes)
    sources = [source for source in systems_of(empty).sources if not source.of_test]
    truth = {s.name: SIZES[s.unit] * float(random.normal()) for s in sources}
    truth |= {mirror.name: truth[s.name] for s in sources if (mirror := getattr(s, "mirror", None)) is not None}
    off = 1.0 + SCALE * float(random.normal())
    acted = {name: value * (off if name.startswith("C_") else 1.0) for name, value in truth.items()}
    tests = {
        name: simulate(test, acted, Imperfection(noise=PLANES[test.name[:2]], eccentricity=0.002), seed * 17 + k)
        for k, (name, test) in enumerate(empty.tests.items())
    }
    knowledge = known(Campaign(empty.name, tests))
    path = ellipse(machine, random)
    force = np.array([random.normal(scale=100.0), random.normal(scale=300.0), random.normal(scale=100.0)])
    cut = Cut(
        ConstantForce((force[0], force[1], force[2]), "path", relative_uncertainty=FORCE), measured_tool(2e-5, 0.0, 0.1)
    )
    real = force * (1.0 + FORCE * float(random.normal()))
    held_tool = measured_tool(2e-5 * (1 + 0.1 * float(random.normal())))
    cut_really = Cut(ConstantForce((real[0], real[1], real[2]), "path"), held_tool)
    went = simulated_points(truth, path, cut_really, knowledge.centre) - path.points
    went -= probed(simulated_points(truth, path, Cut(), knowledge.centre) - path.points, path)
    went = np.column_stack([went, np.einsum("mi,mi->m", path.left, went)])
    return counted(known_deviation(knowledge, path, cut, datum="probed"), went)


def probed(off: Array, path: ToolPath) -> Array:
    """The rigid motion, by singular values rather than small angles, that fits what the unloaded machine is off."""
    centre = path.points.mean(axis=0)
    from_, to = path.points - centre, path.points + off - centre - off.mean(axis=0)
    left, _, right = np.linalg.svd(from_.T @ to)
    turn = right.T @ np.diag([1.0, 1.0, np.sign(np.linalg.det(right.T @ left.T))]) @ left.T
    return np.asarray(from_ @ turn.T - from_ + off.mean(axis=0))


def counted(found: PathPrediction, went: Array) -> Counted:
    """What the intervals hold at a few points, evenly chosen."""
    at = np.linspace(3, POINTS - 3, COUNTED).round().astype(int)
    value, expanded, supported = found.value[at], found.expanded[at], found.supported[at]
    there = np.isfinite(expanded)
    held = np.abs(went[at] - value) <= expanded
    return Counted(
        int(held[there].sum()), int((there & supported).sum()), int((~supported).sum()), int((there & ~supported).sum())
    )


def main() -> None:
    """One line for each topology and set of planes."""
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    print("| machine | planes | machines | supported | held | not supported | of these with an interval |")
    print("|---|---|---:|---:|---:|---:|---:|")
    for planes in (tuple(PLANES), ("XY",)):
        for topology in TOPOLOGIES:
            total = Counted()
            for seed in range(trials):
                total = total + trial(topology, seed, planes)
            rate = f"{100 * total.held / total.supported:.1f} %" if total.supported else ""
            print(
                f"| {topology} | {', '.join(planes)} | {trials} | {total.supported} | {rate} | {total.unsupported} | "
                f"{total.given_all_the_same} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
