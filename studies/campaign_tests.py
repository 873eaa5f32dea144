"""A campaign of five loaded circles of one machine, sound or with one test that is wrong in a known way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import cast

import numpy as np

from elastogeo.estimate import solve
from elastogeo.identification import TestsAgreement, confounding_of, effects_of, merged, moments_of, systems_of
from elastogeo.identification.campaigns.agreement import tests_agreement
from elastogeo.observe import LoadedBallBar, MachineTest, campaign_of
from studies.ball_bar import Circles
from studies.bar_tests import machine_test
from studies.chain import Array, Chain
from studies.noise import NOISES, Noise
from studies.truth import Truth

CHAIN = Chain(
    "wCAFYXZSt", (("A", (0.0, 0.0, 200.0)), ("C", (0.0, 0.0, 150.0)), ("Z", (0.0, 0.0, 900.0))), (0.0, 0.0, -250.0)
)
FORCES = (100.0, 300.0, 500.0)
READINGS = 90
RADIUS = 150.0
NOISE = Noise(white=1e-4, eccentricity=2e-4)
TRUTH = Truth(
    (
        ("C_XXX", 6.0e-5),
        ("C_YYY", 4.5e-5),
        ("C_ZZZ", 3.0e-5),
        ("C_AYY", 2.0e-8),
        ("C_CXX", 1.5e-8),
        ("E_XX1", -8.0e-5),
        ("E_YY1", 6.0e-5),
        ("E_ZZ1", 4.0e-5),
        ("E_YX2", 4.0e-7),
        ("E_ZY2", -3.0e-7),
        ("E_C(0Y)X", 3.0e-5),
        ("E_B(0X)Z", -2.0e-5),
        ("E_A(0X)Z", 2.5e-5),
    )
)
"""Compliances of a machining centre and geometry of a worn one, so that a circle stated with a wrong radius shows."""

TILT = (("A", 0.5), ("C", 0.7))
TESTS: dict[str, tuple[str, tuple[tuple[str, float], ...]]] = {
    "xy": ("XY", ()),
    "yz": ("YZ", ()),
    "zx": ("ZX", ()),
    "xy-tilted": ("XY", TILT),
    "xy-repeated": ("XY", ()),
}
FORCE, EXCHANGED, SMALLER, LEVEL = (
    "5 % too much force",
    "X and Y exchanged",
    "a radius of 100 mm stated as 150 mm",
    "a level 20 % too strong",
)
FAULTS = (FORCE, EXCHANGED, SMALLER, LEVEL)
LEVEL_FAULT = FORCES[1]
"""The level [N] that is too strong."""


def campaign(fault: str, wrong: str, seed: tuple[int, ...], noise: str = "wandering centre") -> dict[str, MachineTest]:
    """One draw of all five tests, of which one is wrong."""
    return {name: one_test(name, fault if name == wrong else "", (*seed, k), noise) for k, name in enumerate(TESTS)}


def one_test(name: str, fault: str, seed: tuple[int, ...], noise: str = "wandering centre") -> MachineTest:
    """One test: what was really done, under what is stated of it."""
    plane, held = TESTS[name]
    truth = replace(
        TRUTH,
        force_scale=0.05 if fault == FORCE else 0.0,
        force_scatter=tuple(0.2 * (force == LEVEL_FAULT) for force in FORCES) if fault == LEVEL else (),
    )
    circles = Circles(CHAIN, FORCES, (1,) * len(FORCES), READINGS, 100.0 if fault == SMALLER else RADIUS, plane, held=held)
    added = NOISE if noise == "wandering centre" else NOISES[noise]
    test = machine_test(circles, truth, added, seed, (f"loaded-{plane.lower()}",))
    if fault == SMALLER:
        bar = cast("LoadedBallBar", test.setup)
        test = replace(test, setup=replace(bar, circle=replace(bar.circle, radius=RADIUS)))
    if fault == EXCHANGED:
        test = replace(test, runs=tuple(replace(run, columns=_exchanged(run.columns)) for run in test.runs))
    return test


def _exchanged(columns: Mapping[str, Array]) -> dict[str, Array]:
    """The readings of a circle whose cosine and sine were exchanged."""
    angle = np.asarray(columns["angle"])
    other = (np.pi / 2 - angle) % (2 * np.pi)
    order = np.argsort(other)
    return {"angle": other[order], "radial": np.asarray(columns["radial"])[order]}


def agreement_of(tests: dict[str, MachineTest]) -> TestsAgreement:
    """What an identification finds of the agreement, without the rest of it."""
    asked = campaign_of(tests)
    systems = systems_of(asked)
    found = confounding_of(asked, systems)
    solution = solve(merged(systems.runs), found.retained)
    agreement = tests_agreement(systems, solution, moments_of(systems, solution, effects_of(asked, systems)))
    assert agreement is not None
    return agreement
