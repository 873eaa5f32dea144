"""Campaigns of all instruments on every machine of the contract: the truth comes back, each set-up to its own test."""

from __future__ import annotations

import numpy as np

from elastogeo.estimate import solve
from elastogeo.identification import confounding_of, merged, systems_of
from elastogeo.observe import Campaign
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
