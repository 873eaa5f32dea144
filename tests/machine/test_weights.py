"""Known weights load the joints that carry them, and no other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import MachineError
from elastogeo.machine import Joint, Machine, Workpiece, loop_frames, parse_topology, weight_loads

KG = 1e-3
G = 9.80665


def machine(topology: str, masses: dict[str, float] | None = None, **more: object) -> Machine:
    parsed = parse_topology(topology)
    masses = masses or {}
    joints = tuple(
        Joint(axis, mass=masses.get(axis, 0.0) * KG, centre_of_gravity=(10.0, 20.0, 30.0), compliant=axis != "S")
        for axis in parsed.axes
    )
    return Machine("weighed", parsed, joints, **more)


def loads(one: Machine, commands: list[float], workpiece: Workpiece | None = None) -> dict[str, np.ndarray]:
    return weight_loads(one, loop_frames(one, np.array([commands])), workpiece)


def test_a_workpiece_loads_the_joints_of_its_branch_only() -> None:
    found = loads(machine("wXYFZt"), [0.0, 0.0, 0.0], Workpiece(100 * KG, (200.0, -50.0, 0.0)))
    assert set(found) == {"X", "Y"}
    # 980.665 N down at (200, -50): M = r x F = (-50 * -F, -(200 * -F), 0)
    for load in found.values():
        assert_allclose(load, [[0, 0, -100 * G, 50 * 100 * G, 200 * 100 * G, 0]], rtol=1e-12, atol=1e-9)


def test_its_lever_grows_as_the_table_travels() -> None:
    """X of the table at +300 has moved the table by -300 (ISO 841): Y sees the weight there, X itself does not."""
    found = loads(machine("wXYFZt"), [300.0, 0.0, 0.0], Workpiece(100 * KG))
    assert found["X"][0, 4] == pytest.approx(0.0, abs=1e-9)
    assert found["Y"][0, 4] == pytest.approx(-300 * 100 * G, rel=1e-12)


def test_it_turns_with_the_table() -> None:
    """A weight 100 mm along x of a table that has turned a quarter: C of the workpiece side moves by minus its command."""
    found = loads(machine("wCFZt"), [np.pi / 2, 0.0], Workpiece(10 * KG, (100.0, 0.0, 0.0)))
    about_own = found["C"][0]
    assert_allclose(about_own, [0, 0, -10 * G, 0, 100 * 10 * G, 0], rtol=1e-12, atol=1e-9)
    tilted = loads(machine("wAFZt"), [np.pi / 2, 0.0], Workpiece(10 * KG, (0.0, 100.0, 0.0)))["A"][0]
    # A at +90 turns the table by -90: gravity (-z) is +y or -y of the table; the lever along y has no moment about x.
    assert abs(tilted[1]) == pytest.approx(10 * G)
    assert tilted[3] == pytest.approx(0.0, abs=1e-9)


def test_a_carriage_loads_its_own_joint_and_those_nearer_the_foundation() -> None:
    found = loads(machine("wFYXZt", {"X": 50.0}), [0.0, 0.0, 0.0])
    assert set(found) == {"Y", "X"}
    assert_allclose(found["X"], [[0, 0, -50 * G, -20 * 50 * G, 10 * 50 * G, 0]], rtol=1e-12, atol=1e-9)


def test_gravity_may_act_along_another_direction() -> None:
    found = loads(machine("wFZt", {"Z": 1.0}, gravity=(0.0, -1.0, 0.0)), [0.0])
    assert_allclose(found["Z"][0, :3], [0.0, -G, 0.0], rtol=1e-12)


def test_what_is_no_mass_or_direction_is_refused() -> None:
    with pytest.raises(MachineError, match="mass"):
        Workpiece(-1.0)
    with pytest.raises(MachineError, match="mass"):
        machine("wFZt", {"Z": np.nan})
    with pytest.raises(MachineError, match="length 1"):
        machine("wFZt", gravity=(0.0, 0.0, -9.81))
