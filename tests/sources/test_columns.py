"""The columns of the sources: against formulas written out by hand, and against differences of the exact response.

Both senses of the circle, an axis with a screw of 10 mm, forces up to 742 N.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, MachineTest, Observations, Run
from elastogeo.sources import (
    Situation,
    Source,
    catalogue,
    design_rows,
    exact_response,
    linear_response,
    parameter_values,
    select_sources,
)

RADIUS, FEED, PITCH, FORCE = 150.0, 2000 / 60, 10.0, 742.0
OMEGA = FEED / RADIUS


def pitched(topology: str, seed: int | None = None) -> Machine:
    """A machine whose linear axes have a pitch; with a seed, its frames stand apart and its axes are inclined."""
    parsed = parse_topology(topology)
    random = np.random.default_rng(seed)

    def of(axis: str) -> Joint:
        away = {} if seed is None else {"offset": random.uniform(-250, 250, 3), "tilt": random.uniform(-0.3, 0.3, 3)}
        vectors = {name: tuple(map(float, vector)) for name, vector in away.items()}
        return Joint(axis, pitch=PITCH if axis in "XYZ" else 0.05, compliant=axis != "S", **vectors)

    return Machine(topology, parsed, tuple(map(of, parsed.axes)))


def blank_test(machine: Machine, angle: Array, sense: int = 1, circle: Circle | None = None) -> MachineTest:
    run = Run("run", {"angle": angle, "radial": np.zeros(len(angle))}, force=FORCE, sense=sense)
    return MachineTest("test", machine, LoadedBallBar(circle or Circle(RADIUS), FEED), (run,))


def columns(test: MachineTest, names: list[str]) -> dict[str, Array]:
    (observed,) = test.observations()
    rows = design_rows(select_sources(test.machine, names), test.machine, observed)
    return dict(zip(names, rows.T, strict=False))


ANGLES = np.arange(97) * 2 * np.pi / 97 + 0.01
"""No reading stands on a reversal."""


@pytest.mark.parametrize("sense", [1, -1], ids=["ccw", "cw"])
def test_columns_by_hand_on_the_circle_in_xy(sense: int) -> None:
    c, s = np.cos(ANGLES), np.sin(ANGLES)
    x, y = RADIUS * c, RADIUS * s
    vx, vy = -sense * FEED * s, sense * FEED * c
    expected = {
        "C_XXX": FORCE * c * c,
        "C_CXY": x * s * FORCE * c,
        "CF1_XXX": FORCE**2 * c * c,
        "CF2_CCY": x * s * x * s * FORCE**3,
        "H_XXX": np.abs(FORCE * c) ** (2 / 3) * np.abs(c),
        "H0.8_YYY": np.abs(FORCE * s) ** 0.8 * np.abs(s),
        "H0.8_XYX": np.sign(s) * np.abs(FORCE * s) ** 0.8 * c,
        "E_XX1": x * c,
        "E_YX2": x**2 * s,
        "E_XX7": x**7 * c,
        "E_CY1": y * x * s,
        "E_C(0Y)X": x * s,
        "E_Xt0": c,
        "E_Yw0": -s,
        "E_R0": np.ones(97),
        "B_XX": -0.5 * np.sign(vx) * c,
        "B_YX": -0.5 * np.sign(vx) * s,
        "B_CY": -0.5 * np.sign(vy) * x * s,
        "P_XXc1": np.cos(2 * np.pi * x / PITCH) * c,
        "P_YYs2": np.sin(4 * np.pi * y / PITCH) * s,
        "T_X1": -vx * c,
        "T_Y1": -vy * s,
        "T_X2": OMEGA**2 * x * c,
    }
    found = columns(blank_test(pitched("wFYXt"), ANGLES, sense), list(expected))
    for name, column in expected.items():
        assert np.abs(column).max() > 1e-3, name
        assert_allclose(found[name], column, rtol=0, atol=1e-12 * np.abs(column).max(), err_msg=name)


@pytest.mark.parametrize("sense", [1, -1], ids=["ccw", "cw"])
@pytest.mark.parametrize("angle", [ANGLES, np.deg2rad(np.linspace(-170, 170, 200)), np.deg2rad(np.linspace(1, 60, 50))])
def test_spikes_by_hand(sense: int, angle: Array) -> None:
    """They die with the travel from the turn, which is at +-R wherever the readings happen to stand."""
    c, s = np.cos(angle), np.sin(angle)
    after = sense * s * c < 0, sense * s * c > 0
    sides = {"Y": (s, np.sign(s)), "X": (c, np.sign(c))}
    found = columns(blank_test(pitched("wFYXt"), angle, sense), ["S_XX", "S_YY"])
    for axis, leaving in zip("YX", after, strict=True):
        along, side = sides[axis]
        expected = np.where(leaving, side * np.exp(-RADIUS * (1 - np.abs(along)) / 0.1), 0.0) * along
        assert_allclose(found[f"S_{axis}{axis}"], expected, rtol=0, atol=2e-4)


def test_harmonics_of_a_turning_table_by_hand() -> None:
    """The bar stands along x, the table turns by C: its frame turns the other way, and carries the ball, not the tool."""
    circle = Circle(RADIUS, "XY", bar_turn=0.0, rotary_turn={"C": 1.0})
    c = ANGLES
    expected = {
        "E_XCc1": -np.cos(c) * np.cos(c),
        "E_YCs1": -np.sin(c) * np.sin(c),
        "E_XCs2": -np.cos(c) * np.sin(2 * c),
        "E_XC1": -np.cos(c) * c,
    }
    found = columns(blank_test(pitched("wCAFYXZSt"), ANGLES, circle=circle), list(expected))
    for name, column in expected.items():
        assert_allclose(found[name], column, rtol=0, atol=1e-12, err_msg=name)


def test_an_axis_that_stands_has_no_lag_and_no_backlash() -> None:
    found = columns(blank_test(pitched("wCAFYXZSt"), ANGLES), ["B_ZZ", "B_XZ", "T_Z1", "S_ZZ", "B_CC", "T_C1", "S_CC"])
    for name, column in found.items():
        assert not column.any(), name


def test_at_the_very_reversal_backlash_is_neither_way() -> None:
    angle = np.arange(8) * np.pi / 4
    (column,) = columns(blank_test(pitched("wFYXt"), angle), ["B_XX"]).values()
    assert column[0] == column[4] == 0.0
    assert np.all(column[[1, 3, 5, 7]] != 0.0)


def difference_quotient(source: Source, test: MachineTest, observed: Observations) -> Array:
    """Derivative of the exact response by a parameter: central differences, extrapolated once (Richardson)."""
    unit = float(np.max(np.abs(source.driver(Situation(test.machine, observed)))))
    step = (0.1 if source.component < 3 else 3e-4) / unit if unit else 1.0

    def central(h: float) -> Array:
        up, down = (exact_response({source: x}, test.machine, observed) for x in (h, -h))
        return np.asarray((up - down) / (2 * h))

    return (4 * central(step / 2) - central(step)) / 3


ARRANGEMENTS = {
    "ccw": (Circle(RADIUS, centre={"A": 0.4, "C": -0.7, "Z": -80.0}), 1, (0.0, 2 * np.pi)),
    "cw": (Circle(RADIUS, ((1.0, 1.0, 0.0), (1.0, -1.0, 3.0)), {"A": 0.3, "X": 40.0}), -1, (0.0, -2 * np.pi)),
    "an arc, C turning": (Circle(RADIUS, "YZ", {"A": 0.2}, rotary_turn={"C": 0.8}), 1, (0.5, 4.0)),
}


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_columns_are_the_derivatives_of_the_exact_response(arrangement: str) -> None:
    """Every source but the plain compliances, on a machine whose axes have pitches and are inclined."""
    circle, sense, (start, end) = ARRANGEMENTS[arrangement]
    test = blank_test(pitched("wCAFYXZSt", seed=3), np.linspace(start, end, 14, endpoint=False) + 0.003, sense, circle)
    (observed,) = test.observations()
    turning = observed.acceleration is None
    accelerated = {*(f"T_{axis}2" for axis in "XYZ"), "S_XX", "S_YY", "S_ZZ", "S_AA", "S_CC"}
    chosen = {name: s for name, s in catalogue(test.machine).items() if not name.startswith(("C_", "CF2", "H_"))}
    named = [name for name in chosen if not (turning and name in accelerated)]
    named += ["E_XX7", "E_BCs5", "H0.8_XXX", "H0.8_CCY", "H1.5_ABZ"]
    sources = select_sources(test.machine, named)
    analytic = design_rows(sources, test.machine, observed)[:, :-1]
    numeric = np.column_stack([difference_quotient(source, test, observed) for source in sources])
    largest: dict[str, float] = {}
    for k, source in enumerate(sources):
        largest[source.unit] = max(largest.get(source.unit, 1e-9), float(np.abs(analytic[:, k]).max()))
    apart = {s.name: np.abs(analytic[:, k] - numeric[:, k]).max() / largest[s.unit] for k, s in enumerate(sources)}
    worst = max(apart, key=lambda name: apart[name])
    print(f"{arrangement}: {len(sources)} columns, worst {worst} {apart[worst]:.1e}")
    assert sum(np.abs(analytic[:, k]).max() > 0 for k in range(len(sources))) > len(sources) // 2
    assert apart[worst] < 1e-6, worst


def test_responses_to_first_order_superpose_and_are_the_columns() -> None:
    test = blank_test(pitched("wFYXt"), ANGLES)
    (observed,) = test.observations()
    names = ["B_XX", "P_XXc1", "T_X1", "E_R0", "C_XXX", "H0.8_YYY", "S_YY"]
    values = parameter_values(test.machine, {name: 1e-3 * (k + 1) for k, name in enumerate(names)})
    each = [linear_response({source: value}, test.machine, observed) for source, value in values.items()]
    assert_allclose(linear_response(values, test.machine, observed), np.sum(each, axis=0), rtol=0, atol=1e-15)
    assert_allclose(each[0], 1e-3 * columns(test, names)["B_XX"], rtol=1e-14)


def test_a_longer_bar_is_read_as_it_is_by_the_exact_response_too() -> None:
    test = blank_test(pitched("wFYXt"), ANGLES)
    (observed,) = test.observations()
    values = parameter_values(test.machine, {"E_R0": 0.02})
    assert_allclose(exact_response(values, test.machine, observed), 0.02, atol=1e-13)


def test_polynomials_count_from_the_centre_of_the_test() -> None:
    """A circle elsewhere on the axis has the same column of E_XX2; its command counts from the centre."""
    here, there = (
        columns(blank_test(pitched("wFYXt"), ANGLES, circle=Circle(RADIUS, centre=centre)), ["E_XX2", "E_YX3"])
        for centre in ({}, {"X": 400.0, "Y": -300.0})
    )
    for name, column in here.items():
        assert_allclose(there[name], column, rtol=0, atol=1e-10 * np.abs(column).max())


MakeTest = Callable[..., MachineTest]


@pytest.mark.parametrize("name", ["S_XX", "S_YY"])
def test_an_arc_without_a_reversal_has_no_spike(name: str) -> None:
    inside = np.deg2rad(np.linspace(10, 80, 40))
    machine = pitched("wFYXt")
    assert not columns(blank_test(machine, inside), [name])[name].any()
    around = np.deg2rad(np.linspace(-30, 120, 151))
    column = columns(blank_test(machine, around), [name])[name]
    turn = 0.0 if name == "S_XX" else 90.0
    after = np.rad2deg(around[np.argmax(np.abs(column))]) - turn
    assert 0 < after < 3
    assert np.abs(column).max() > 0.5
    assert not column[np.rad2deg(around) < turn].any()


def test_a_spike_follows_the_reversal_in_the_direction_of_travel() -> None:
    around = np.deg2rad(np.linspace(-30, 30, 121))
    forth = columns(blank_test(pitched("wFYXt"), around), ["S_XX"])["S_XX"]
    back = columns(blank_test(pitched("wFYXt"), around[::-1], sense=-1), ["S_XX"])["S_XX"][::-1]
    assert not forth[around < 0].any()
    assert not back[around > 0].any()
    assert_allclose(back[::-1], forth, atol=1e-9)


def test_a_whole_revolution_read_from_anywhere_has_the_same_columns() -> None:
    names = ["B_XX", "S_XX", "P_YYc1", "T_X1"]
    plain = columns(blank_test(pitched("wFYXt"), ANGLES), names)
    turned = columns(blank_test(pitched("wFYXt"), np.roll(ANGLES, 31)), names)
    for name, column in plain.items():
        assert_allclose(np.roll(turned[name], -31), column, rtol=0, atol=1e-12 * np.abs(column).max())


def test_the_force_changes_nothing_geometric() -> None:
    test = blank_test(pitched("wFYXt"), ANGLES)
    weaker = replace(test, runs=(replace(test.runs[0], force=36.0),))
    names = ["E_XX1", "B_XX", "T_X1", "P_XXc1", "E_R0", "E_C(0Y)X", "S_XX"]
    for name, column in columns(test, names).items():
        assert np.array_equal(columns(weaker, names)[name], column)
    for name, degree in (("C_XXX", 1), ("CF1_XXX", 2), ("H0.8_XXX", 0.8)):
        strong, weak = (columns(t, [name])[name] for t in (test, weaker))
        assert_allclose(strong / weak, (FORCE / 36.0) ** degree, rtol=1e-12)
