"""Ball-roller tests: a device that is known from a test, at other places of the volume and table angles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import cast

import numpy as np

from elastogeo.drive import KnownBalance
from elastogeo.errors import ElastogeoError, InputError
from elastogeo.machine import Array, Machine
from elastogeo.observe import BallRoller, Imperfection, MachineTest, Observations, Question, Run
from elastogeo.planning.information import unknowns
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import Means, minutes
from elastogeo.planning.offers.proposal import Draft, proposes
from elastogeo.sources import linear_response

INSTRUMENT = "ball-roller"

READINGS = 400
"""Samples of a planned run: enough for the low-pass of velocity and acceleration."""

SPAN = np.deg2rad(385.0)
"""A little more than a turn: the ends are lost to the low-pass."""


@proposes(INSTRUMENT)
def presses(means: Means, random: np.random.Generator) -> Iterator[Draft]:
    """The device of a ball-roller test at random places, at every engagement.

    Raises
    ------
    InputError
        If no test says what the drives are.
    """
    if INSTRUMENT not in means.devices:
        raise InputError(
            "a ball-roller test is planned with the drives of one that is there; name its folder among those made"
        )
    device = cast(BallRoller, means.devices[INSTRUMENT])
    while True:
        place = means.somewhere(random, device.circle.radius)
        rotary = means.turned(random) if means.rotary and random.random() < 1 / 2 else {}
        circle = replace(device.circle, centre=place | rotary)
        known = tuple(KnownBalance(drive.axis, 0.0, 0.0, 0.0, 0.0) for drive in device.drives)
        tool = means.tool_points[random.integers(len(means.tool_points))]
        yield _draft(means, replace(device, circle=circle, balances=known, tool=tool))


def _draft(means: Means, setup: BallRoller) -> Draft:
    """The candidate of one place; None if it is out of the travel, not clear, or the contact would open there."""
    angle = np.linspace(0.0, SPAN, READINGS)
    blank = [Run(f"{1000 * depth:g} um", {"angle": angle}, engagement=depth) for depth in means.engagements]
    random = np.random.default_rng(0)
    try:
        runs = tuple(setup.simulated(means.machine, run, Nominal(means.machine), Imperfection(), random) for run in blank)
        test = MachineTest("press", means.machine, setup, runs, Question(("compliance",)))
        seen = test.observations()
    except ElastogeoError:
        return None
    if not all(means.clearance.free(means.machine, run).all() for run in seen):
        return None
    return Candidate("press", test, minutes(len(runs), float(SPAN) * setup.circle.radius, setup.feed))


class Nominal:
    """The readings of a plain machine, to first order: each joint gives way by its expected size."""

    def __init__(self, machine: Machine) -> None:
        """Of a machine."""
        asked = unknowns(machine)
        self.machine = machine
        self.values = {
            source: float(size) for source, size in zip(asked.sources, asked.nominal * asked.scales, strict=True) if size
        }

    def __call__(self, observations: Observations) -> Array:
        """Of observations, shape (m,)."""
        return linear_response(self.values, self.machine, observations)
