"""How often the intervals of a prediction hold the truth: `python -m studies.predictions [TRIALS] [FIRST] [five]`.

Random machines of three axes with links and springs of their own; eight loaded circles each, two forces, two runs, some sets
of which tell everything and some do not. With `five`, machines of five axes and sixteen circles with the rotary axes turned.
Every run has noise of its own that runs along the trace (harmonics of random size and phase), a centre and a force of its
own; one gauge, 1 % uncertain, measures the force of all. Joints are asked with reciprocity, and without. Asked for at
random places: elements of the compliance at the tool, along random directions, the softest direction, K_t, the difference of
two places. Counted is what is supported; what is not must have no number, and by the prior it must hold as often, where the
truth is drawn from the prior.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from elastogeo.estimate import coverage_factor, solve_as_runs_show
from elastogeo.identification import confounding_of, effects_of, sources_of, systems_of, uncertainty_budget
from elastogeo.machine import About, Array, Joint, Machine, jacobian, parse_topology
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
from elastogeo.prediction import Knowledge, Predicted, entry_rows, parameter_scales, tool_compliance
from elastogeo.sources import select_sources, simulate

READINGS, FORCES, REPEATS = 16, (120.0, 700.0), 2
PLANES = ("XY", "YZ", "ZX", "XY", "YZ", "ZX", "XY", "YZ")
TELLING = np.array(
    [[1, 1, 0], [1, -1, 1], [-1, 1, 0], [0, -1, 0], [-1, 0, 1], [-1, -1, 1], [-1, -1, -1], [0, 0, 0]], dtype=float
)
"""Places of the circles that tell everything; others are drawn."""
TOPOLOGIES = ("wYXFZt", "wFYXZt", "wXFYZt")
FIVE = ("wCAFYXZt", "wCAYFXZt", "wCFXYZBt")
CIRCLES, TURNED = 16, 0.6
"""Of machines of five axes: how many circles, and how far [rad] the rotary axes are turned."""
SCALE, ALONG_TRACE = 0.01, 2e-4
DRAWN = 0.2
"""Share of the campaigns whose circles are where they happen to be."""
NOISE = Imperfection(noise=1e-4, eccentricity=2e-3, force_scatter=0.002)


def machine_of(random: np.random.Generator, five: bool = False) -> Machine:
    """A machine with links of random lengths."""
    named = FIVE if five else TOPOLOGIES
    topology = parse_topology(named[int(random.integers(len(named)))])
    joints = tuple(Joint(axis, offset=tuple(random.uniform(-200.0, 200.0, 3))) for axis in topology.axes)
    return Machine("random", topology, joints, tool=(0.0, 0.0, float(random.uniform(-300.0, -100.0))))


def springs_of(machine: Machine, random: np.random.Generator) -> dict[str, float]:
    """True compliances of springs as machines have them: symmetric, positive definite."""
    found: dict[str, float] = {}
    for joint in machine.compliant:
        sources = select_sources(machine, [f"C_??{joint.name}"])
        root = random.normal(size=(6, 6)) / 2 + np.eye(6)
        spring, scales = root @ root.T, parameter_scales(sources)
        found |= {s.name: float(spring[s.component, s.load or 0] * scales[k]) for k, s in enumerate(sources)}
    return found


def drawn_by_prior(machine: Machine, reciprocal: bool, random: np.random.Generator) -> dict[str, float]:
    """True compliances by the prior: each of its scale; those of a reciprocal joint in equal pairs."""
    found: dict[str, float] = {}
    for source in select_sources(machine, ["C_???"]):
        mirror = f"C_{source.name[3]}{source.name[2]}{source.name[4:]}"
        drawn = float(random.normal()) * float(parameter_scales([source])[0])
        found[source.name] = found[mirror] if reciprocal and mirror in found else drawn
    return found


def campaign_of(
    machine: Machine, reciprocal: bool, truth: dict[str, float], random: np.random.Generator, drawn: float = DRAWN
) -> Campaign:
    """Eight circles of that machine, read by a gauge that is off; with a probability `drawn` where they happen to be."""
    angle = 2 * np.pi * np.arange(READINGS) / READINGS
    gauge = (KnownInfluence("force-scale", "gauge", relative=SCALE),)
    off = 1.0 + SCALE * float(random.normal())
    acted = {name: value * off for name, value in truth.items()}
    tests, places = {}, TELLING * random.choice([-1.0, 1.0], 3)
    rotary, planes = [joint.name for joint in machine.joints if joint.is_rotary], PLANES
    if rotary:
        places, planes = random.uniform(-1.0, 1.0, (CIRCLES, 3)), (PLANES * 2)[:CIRCLES]
    elif random.random() < drawn:
        places = random.choice([-1.0, 0.0, 1.0], places.shape)
    for k, (plane, place) in enumerate(zip(planes, 250.0 * places, strict=True)):
        centre = dict(zip("XYZ", map(float, place), strict=True))
        centre |= {axis: float(random.uniform(-TURNED, TURNED)) for axis in rotary}
        runs = tuple(
            Run(f"{force:g} N, {n}", {"angle": angle, "radial": np.zeros(READINGS)}, force=force, repeat=n)
            for force in FORCES
            for n in range(1, REPEATS + 1)
        )
        question = Question(("C_???",), reciprocal=reciprocal)
        setup, about = LoadedBallBar(Circle(150.0, plane=plane, centre=centre), 30.0), About(instrument_serial="7")
        test = MachineTest(plane, machine, setup, runs, influences=gauge, question=question, about=about)
        test = simulate(test, acted, NOISE, int(random.integers(2**31)), exact=False)
        tests[f"t{k}"] = replace(test, runs=tuple(_along_trace(run, random) for run in test.runs))
    return Campaign("circles", tests)


def _along_trace(run: Run, random: np.random.Generator) -> Run:
    """The run with harmonics of its own on its readings."""
    angle, sizes = run.columns["angle"], ALONG_TRACE * random.normal(size=(4, 2)) / np.arange(1, 5)[:, np.newaxis]
    waves = sum(a * np.cos(n * angle) + b * np.sin(n * angle) for n, (a, b) in enumerate(sizes, 2))
    return replace(run, columns={**run.columns, "radial": run.columns["radial"] + waves})


def known_of(campaign: Campaign) -> Knowledge:
    """What the campaign says, without what an identification judges besides."""
    systems, sources = systems_of(campaign), sources_of(campaign)
    found = confounding_of(campaign, systems)
    solution, _ = solve_as_runs_show([run.factor for run in systems.runs], found.retained)
    budget = uncertainty_budget(systems, solution, effects_of(campaign, systems))
    scales, centre = parameter_scales(sources), np.zeros(len(campaign.machine.axes))
    return Knowledge(campaign.machine, sources, solution, budget, found, True, scales, centre, (), "")


def compliance_of(machine: Machine, truth: dict[str, float], commands: Array) -> Array:
    """The true compliance at the tool, shape (6, 6): by the Jacobian, not by the columns of the design."""
    springs = np.zeros((6 * len(machine.axes),) * 2)
    for name, value in truth.items():
        k = 6 * machine.axes.index(name[-1])
        springs[k + "XYZABC".index(name[2]), k + "XYZABC".index(name[3])] = value
    J = jacobian(machine, commands[np.newaxis])[0]
    C = J @ springs @ J.T
    return np.asarray((C + C.T) / 2)


def trial(seed: int, five: bool = False) -> Counter[str]:
    """What holds, what there is: `held X`, `asked X` for every kind X; `numbers` where there must be none."""
    random = np.random.default_rng([seed, 5])
    machine, reciprocal = machine_of(random, five), bool(random.integers(2))
    as_springs = bool(random.integers(2))
    truth = springs_of(machine, random) if as_springs else drawn_by_prior(machine, reciprocal, random)
    known = known_of(campaign_of(machine, reciprocal, truth, random))
    counts: Counter[str] = Counter()
    most = np.array([TURNED if joint.is_rotary else 250.0 for joint in machine.joints])
    places = most * random.uniform(-1.0, 1.0, (3, len(machine.axes)))
    true = [compliance_of(machine, truth, place) for place in places]
    names = "reciprocal" if reciprocal else "free"
    for kind, functional, value in _asked(known, places, true, random):
        found, by_prior = known.predict(functional), known.predict(functional, prior=True)
        if found.supported[0]:
            _count(counts, f"{kind}, {names}", found, value)
        else:
            counts["unsupported"] += 1
            counts["numbers"] += int(np.isfinite([found.value[0], found.expanded[0]]).any())
            if not as_springs:
                _count(counts, f"by the prior, {names}", by_prior, value)
    if as_springs:
        _principal(counts, known, places[0], true[0])
    return counts


def _asked(
    known: Knowledge, places: Array, true: list[Array], random: np.random.Generator
) -> Iterator[tuple[str, Array, float]]:
    rows = entry_rows(known, places)
    pairs = [(i, j) for i in range(6) for j in range(i, 6)]
    for k, C in enumerate(true):
        for e, (i, j) in enumerate(pairs):
            if j < 3 or e % 4 == 0:
                yield ("diagonal" if i == j else "across"), rows[k, e], float(C[i, j])
    for _ in range(3):
        v = random.normal(size=3)
        v /= np.linalg.norm(v)
        weights = np.array([v[i] * v[j] * (1 if i == j else 2) if j < 3 else 0.0 for i, j in pairs])
        along = [float(v @ C[:3, :3] @ v) for C in true]
        yield "along", weights @ rows[0], along[0]
        yield "difference", weights @ (rows[1] - rows[2]), along[1] - along[2]


def _principal(counts: Counter[str], known: Knowledge, place: Array, true: Array) -> None:
    """The softest direction, and the diagonal of K_t for forces alone."""
    found = tool_compliance(known, place)
    if found.softest is not None and np.isfinite(found.stiffness[:3, :3]).all():
        low, high = found.softest.compliance.interval()
        counts["asked softest direction"] += 1
        counts["held softest direction"] += int(low <= np.linalg.eigvalsh(true[:3, :3])[-1] <= high)
        off = np.abs(found.stiffness[:3, :3] - np.linalg.inv(true[:3, :3])).diagonal()
        counts["asked stiffness K_t"] += 3
        counts["held stiffness K_t"] += int(np.sum(off <= found.stiffness_expanded.diagonal()[:3]))


def _count(counts: Counter[str], kind: str, found: Predicted, value: float) -> None:
    if np.isfinite(found.standard_uncertainty[0]):
        half = coverage_factor(found.degrees_of_freedom)[0] * found.standard_uncertainty[0]
        counts[f"asked {kind}"] += 1
        counts[f"held {kind}"] += int(abs(found.value[0] - value) <= half)
    else:
        counts["without uncertainty"] += 1


def main() -> None:
    """A line for each kind of question."""
    trials = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    counts: Counter[str] = Counter()
    for seed in range(first, first + trials):
        counts += trial(seed, "five" in sys.argv)
    kinds = sorted(key.removeprefix("asked ") for key in counts if key.startswith("asked "))
    for kind in kinds:
        asked, held = counts[f"asked {kind}"], counts[f"held {kind}"]
        print(f"{kind}: {100 * held / asked:.1f} % of {asked} intervals hold the truth")
    data = [kind for kind in kinds if not kind.startswith("by the prior")]
    asked, held = (sum(counts[f"{what} {kind}"] for kind in data) for what in ("asked", "held"))
    print(f"all that is supported: {100 * held / asked:.1f} % of {asked}")
    print(f"{counts['unsupported']} functionals not supported, {counts['numbers']} of them with a number")


if __name__ == "__main__":
    main()
