"""Campaigns of all instruments on every machine of the contract: the truth comes back, each set-up to its own test."""

from __future__ import annotations

import numpy as np

from elastogeo.estimate import solve
from elastogeo.identification import confounding_of, merged, systems_of
from elastogeo.observe import Campaign, MachineTest
from elastogeo.sources import simulate

TYPICAL = {"mm": 1e-2, "rad": 1e-4, "mm/mm": 3e-5, "mm/N": 5e-5, "rad/N": 1e-7, "mm/(N mm)": 1e-7, "rad/(N mm)": 1e-10}


def test_the_truth_comes_back_from_all_instruments_together(every_instrument: Campaign) -> None:
    random = np.random.default_rng(len(every_instrument.name))
    systems = systems_of(every_instrument)
    truth = {s.name: TYPICAL.get(s.unit, 1e-8) * float(random.normal()) for s in systems.sources}
    tests = {}
    for name, test in every_instrument.tests.items():
        own = {
            key.removesuffix(f"@{name}"): value for key, value in truth.items() if "@" not in key or key.endswith(f"@{name}")
        }
        tests[name] = simulate(test, own, exact=False)
    read = Campaign(every_instrument.name, tests)
    systems = systems_of(read)
    found = confounding_of(read, systems)
    assert found.rank > max(confounding_of(test, systems_of(test)).rank for test in tests.values())
    solution = solve(merged(systems.runs), found.retained)
    true = np.array([sum(c * truth[n] for n, c in found.stands_for(name).items()) for name in found.retained])
    size = np.linalg.norm(merged(systems.runs).triangle[:, -1])
    norms = np.linalg.norm(merged(systems.runs).R[:, [found.labels.index(name) for name in found.retained]], axis=0)
    assert np.abs((solution.values - true) * norms).max() < 1e-11 * found.condition_scaled * size


def test_a_ball_roller_beside_the_others_tells_the_same_machine(pressed: tuple[Campaign, MachineTest]) -> None:
    """Its force is measured through the drives, so that the truth comes back to what that leaves, not to rounding.

    The others know the compliances in the plane; with the roller the answer is theirs, and the roller's rows agree with it.
    """
    others, roller = pressed
    random = np.random.default_rng(11)
    sources = [s for s in systems_of(others).sources if s.elastic]
    truth = {s.name: TYPICAL.get(s.unit, 1e-8) * float(abs(random.normal())) / 5 for s in sources}
    tests = {name: simulate(test, truth, exact=False) for name, test in others.tests.items()}
    whole = {**tests, "roller": simulate(roller, truth, exact=False)}
    alone, together = (systems_of(Campaign("c", dict(chosen))) for chosen in (tests, whole))
    assert together.tests == (*others.tests, "roller")
    found = confounding_of(Campaign("c", whole), together)
    assert found.rank >= confounding_of(Campaign("c", tests), alone).rank
    solution = solve(merged(together.runs), found.retained)
    for run in together.of("roller").runs:
        predicted = run.design_of(found.retained) @ solution.values
        assert np.linalg.norm(run.reading - predicted) < 0.05 * np.linalg.norm(run.reading)
    for name, value in zip(found.retained, solution.values, strict=True):
        true = sum(c * truth.get(n, 0.0) for n, c in found.stands_for(name).items())
        moves = float(np.abs(np.concatenate([run.design_of([name])[:, 0] for run in together.runs])).max())
        assert abs(value - true) * moves < 0.05 * max(float(np.abs(run.reading).max()) for run in together.runs)
