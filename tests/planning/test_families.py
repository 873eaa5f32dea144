"""What families of tests tell at most: the table of `reference/planning.md`, derived there by another program."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from elastogeo.errors import InputError
from elastogeo.formats import read_machine
from elastogeo.machine import Machine, Point, Workpiece, jacobian, parse_topology
from elastogeo.observe import BAR, PROBES, SIX, JointProbe, MachineTest, Run, Sensor, SensorFrame, family_of
from elastogeo.planning import ceiling, family_ceiling

ONE: tuple[Point, ...] = ((0.0, 0.0, -150.0),)
TWO: tuple[Point, ...] = ((0.0, 0.0, -100.0), (0.0, 0.0, -200.0))
THREE: tuple[Point, ...] = (*TWO, (0.0, 0.0, -150.0))
ANYWHERE: tuple[Point, ...] = tuple(map(tuple, np.random.default_rng(3).uniform(-150, 150, (10, 3))))
HELD = {"A": 0.0, "C": 0.0}


@cache
def machine(name: str) -> Machine:
    return read_machine("hermle_c50") if name == "hermle_c50" else Machine(name, parse_topology(name))


@pytest.mark.parametrize(
    ("family", "tools", "five_axes", "three_axes"),
    [
        (BAR, ONE, (56, 56), (30, 30)),
        (BAR, TWO, (61, 61), (35, 35)),
        (BAR, THREE, (64, 64), (38, 38)),
        (BAR, ANYWHERE, (72, 72), (44, 44)),
        (PROBES, ONE, (91, 56), (47, 30)),
        (PROBES, THREE, (103, 64), (59, 38)),
        (PROBES, ANYWHERE, (122, 72), (74, 44)),
        (SIX, ONE, (123, 73), (75, 45)),
    ],
)
def test_the_table_of_the_reference(
    family: str, tools: tuple[Point, ...], five_axes: tuple[int, int], three_axes: tuple[int, int]
) -> None:
    for name, columns, ranks in (("hermle_c50", 180, five_axes), ("wYXFZt", 108, three_axes)):
        general, reciprocal = (family_ceiling(machine(name), family, tools, symmetric) for symmetric in (False, True))
        assert (general.columns, reciprocal.columns) == (columns, columns * 21 // 36)
        assert (general.rank, reciprocal.rank) == ranks
        assert min(general.gap, reciprocal.gap) > 1e10


@pytest.mark.parametrize(("held", "rank"), [(HELD, 34), ({"A": 0.0}, 48), ({"C": 0.0}, 42)])
def test_rotary_axes_that_stand_tell_less_to_a_bar(held: dict[str, float], rank: int) -> None:
    for reciprocal in (False, True):
        assert family_ceiling(machine("hermle_c50"), BAR, ONE, reciprocal, held).rank == rank


@pytest.mark.parametrize("topology", ["wCAFYXZSt", "wBXFZAYt", "wFXYZCBt", "wAFXYZt"])
def test_six_loads_and_readings_see_what_the_closed_form_leaves(topology: str, make_machine: Callable[..., Machine]) -> None:
    skew = make_machine(topology, (10.0, -20.0, -150.0), seed=3)
    for reciprocal in (False, True):
        found, closed = family_ceiling(skew, SIX, (), reciprocal), ceiling(skew, reciprocal)
        assert (found.labels, found.rank) == (closed.labels, closed.rank)
        kernel = closed.kernel / closed.scales
        kernel /= np.linalg.norm(kernel, axis=1, keepdims=True)
        assert np.abs(kernel @ found.seen).max() < 1e-9


def test_a_test_sees_nothing_beyond_its_family() -> None:
    """A bar at one pose, by the Jacobian: its row lies in what all bars see, and that of probes does not."""
    hermle = machine("hermle_c50")
    seen = family_ceiling(hermle, BAR, [hermle.tool]).seen
    scales = ceiling(hermle).scales
    J = jacobian(hermle, np.array([[0.3, -0.4, 50.0, -70.0, 20.0, 0.0]]))[0]
    joints = [6 * hermle.index(joint.name) + np.arange(6) for joint in hermle.compliant]

    def left(reading: np.ndarray, load: np.ndarray) -> float:
        row = np.concatenate([np.outer(reading @ J[:, k], load @ J[:, k]).ravel() for k in joints]) * scales
        return float(np.linalg.norm(row - seen @ (seen.T @ row)) / np.linalg.norm(row))

    bar = np.array([0.6, 0.0, 0.8, 0.0, 0.0, 0.0])
    assert left(bar, bar) < 1e-10
    assert left(bar, np.eye(6)[1]) > 0.1


def static(run: dict[str, list[float]], setup: SensorFrame | JointProbe) -> MachineTest:
    columns = {name: np.array(values) for name, values in run.items()}
    return MachineTest("static", machine("hermle_c50"), setup, (Run("one", columns),))


def test_the_family_of_a_test_is_that_of_its_loads_and_readings(make_test: Callable[..., MachineTest]) -> None:
    hermle = machine("hermle_c50")
    bar = make_test(hermle, [100.0, 500.0]).observations()
    assert family_of(hermle, bar) == BAR
    forces = {"force_x": [100.0, 0.0], "force_y": [0.0, 100.0], "force_z": [0.0, 0.0]}
    frame = SensorFrame(tuple(Sensor((0.0, 0.0, 0.0), row) for row in ((1, 0, 0), (0, 1, 0), (0, 0, 1))))
    zeros = {f"displacement_{k}": [0.0, 0.0] for k in (1, 2, 3)}
    (probes,) = static({**forces, **zeros}, frame).observations()
    assert family_of(hermle, [*bar, probes]) == PROBES
    assert family_of(hermle, [replace(probes, wrench=np.eye(6)[[3]].repeat(len(probes), 0))]) == SIX
    probe = static({**forces, "displacement": [0.0, 0.0]}, JointProbe(("X",), (1, 0, 0)))
    assert family_of(hermle, probe.observations()) is None
    assert family_of(hermle, [replace(probes, weight=Workpiece(100.0))]) is None
    heavy = replace(hermle, joints=(replace(hermle.joints[0], mass=50.0), *hermle.joints[1:]))
    assert family_of(heavy, bar) is None


def test_a_family_that_does_not_exist_is_refused() -> None:
    with pytest.raises(InputError, match="no family 'laser' of tests; the families are bar, probes and six"):
        family_ceiling(machine("wYXFZt"), "laser")
