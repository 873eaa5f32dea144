"""The compliance at the tool, entry by entry, against the exact model and an independent library, on twelve topologies.

The exact model is products of transforms with finite rotations; its difference quotient by the load is C_t. The rigid part
of C_t = J C J^T is pinocchio's. Links have random offsets, axes random inclinations, joints random compliances that need not
be symmetric.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.machine import Array, Machine, loop_frames
from elastogeo.observe import Observations
from elastogeo.prediction import functionals, parameter_scales, virtual_observations
from elastogeo.sources import Source, exact_response, select_sources
from tests.conftest import build_machine
from tests.machine.pinocchio_loop import TOPOLOGIES, pinocchio_jacobian

TWELVE = tuple(dict.fromkeys((*TOPOLOGIES, "wYXFZt")))[:12]
TOOL = (12.0, -30.0, -250.0)
ENTRIES = tuple(product(range(6), range(6)))
POSES = 3
FORCE, LEVER = 100.0, 300.0


def skew_machine(topology: str) -> tuple[Machine, Array, list[Source], Array]:
    """A machine, poses of it, its compliances and random values of these."""
    machine = build_machine(topology, TOOL, seed=len(topology))
    random = np.random.default_rng(2)
    scale = np.array([2.0 if joint.is_rotary else 400.0 for joint in machine.joints])
    commands = random.uniform(-1, 1, (POSES, len(machine.axes))) * scale
    sources = select_sources(machine, ["C_???"])
    return machine, commands, sources, random.normal(size=len(sources)) * parameter_scales(sources)


def entries_observed(machine: Machine, commands: Array, sign: float = 1.0) -> Observations:
    """Every entry at every pose: a unit twist read under a load along a unit wrench, against the table at the tool point."""
    load = sign * np.diag([FORCE] * 3 + [FORCE * LEVER] * 3)
    at = np.repeat(commands, len(ENTRIES), axis=0)
    directions = np.tile(np.eye(6)[[d for d, _ in ENTRIES]], (POSES, 1))
    wrenches = np.tile(load[[f for _, f in ENTRIES]], (POSES, 1))
    frames = loop_frames(machine, at)
    opposite = frames.workpiece.components(frames.point - frames.workpiece.origin)
    observed = virtual_observations(machine, at, directions, wrenches)
    return replace(observed, workpiece=np.broadcast_to(opposite, (len(at), 3)))


def predicted(machine: Machine, commands: Array, sources: list[Source], values: Array) -> Array:
    """C_t times the loads, shape (m, 6, 6), from the rows of predictions."""
    return (functionals(sources, machine, entries_observed(machine, commands)) @ values).reshape(POSES, 6, 6)


def test_there_are_twelve_and_they_differ() -> None:
    assert len(TWELVE) == 12
    assert {"wFYXt", "wCAFYXZSt", "wCBXFYZt", "wFXYZBCt"} <= set(TWELVE)


@pytest.mark.parametrize("topology", TWELVE)
def test_it_is_the_difference_quotient_of_the_exact_model(topology: str) -> None:
    machine, commands, sources, values = skew_machine(topology)
    given = dict(zip(sources, values, strict=True))
    pushed, pulled = (exact_response(given, machine, entries_observed(machine, commands, sign)) for sign in (1.0, -1.0))
    quotient = (pushed - pulled).reshape(POSES, 6, 6) / 2
    expected = predicted(machine, commands, sources, values)
    for rows in (slice(0, 3), slice(3, 6)):  # millimetres and radians
        size = np.abs(expected[:, rows]).max()
        assert_allclose(quotient[:, rows], expected[:, rows], rtol=0, atol=1e-6 * size)


@pytest.mark.parametrize("topology", TWELVE)
def test_its_rigid_part_is_that_of_pinocchio(topology: str) -> None:
    machine, commands, sources, values = skew_machine(topology)
    C = np.zeros((6 * len(machine.axes),) * 2)
    for source, value in zip(sources, values, strict=True):
        k = 6 * machine.index(source.site[1])
        C[k + source.component, k + (source.load or 0)] = value
    load = np.array([FORCE] * 3 + [FORCE * LEVER] * 3)
    found = predicted(machine, commands, sources, values)
    for pose, at_pose in zip(commands, found, strict=True):
        J, _ = pinocchio_jacobian(machine, pose)
        expected = J @ C @ J.T * load
        for rows in (slice(0, 3), slice(3, 6)):
            assert_allclose(at_pose[rows], expected[rows], rtol=0, atol=1e-10 * np.abs(expected[rows]).max())
