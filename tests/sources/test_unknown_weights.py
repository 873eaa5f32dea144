"""Weights of unknown mass: their columns are those of a known mass per newton, and what they make give way is found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import SelectionError
from elastogeo.identification import confounding_of, identify, systems_of
from elastogeo.machine import Joint, Machine, Workpiece, parse_topology
from elastogeo.observe import BallBar, Circle, Imperfection, MachineTest, Observations, Question, Run
from elastogeo.sources import Source, design_rows, exact_response, linear_response, select_sources, simulate

KG = 1e-3
G = 9806.65
ANGLE = np.linspace(0.05, 6.3, 120)
FRONT, BACK = (0.0, 250.0, 60.0), (0.0, -250.0, 60.0)
TILTING = Circle(150.0, "XY", {"Z": 40.0}, in_workpiece=True, rotary_turn={"A": 0.3, "C": 0.6})


def machine(masses: dict[str, float] | None = None) -> Machine:
    random, parsed = np.random.default_rng(5), parse_topology("wCAFYXZSt")
    joints = tuple(
        Joint(
            axis,
            tuple(map(float, random.uniform(-150, 150, 3))),
            compliant=axis != "S",
            mass=(masses or {}).get(axis, 0.0),
            centre_of_gravity=(20.0, -30.0, 40.0),
        )
        for axis in parsed.axes
    )
    return Machine("five axes", parsed, joints, tool=(0.0, 0.0, -120.0))


def bars(one: Machine, workpiece: Workpiece | None, *asked: str) -> MachineTest:
    """Six runs of an ordinary ball bar, in both directions, on a tilting table."""
    runs = tuple(
        Run(f"{k}", {"angle": ANGLE[::sense], "radial": np.zeros(len(ANGLE))}, sense=sense)
        for k, sense in enumerate([1, -1] * 3)
    )
    return MachineTest("bars", one, BallBar(TILTING, 1000 / 60), runs, Question(asked), workpiece=workpiece)


def column(one: Machine, name: str, workpiece: Workpiece | None = None) -> tuple[Source, Observations, np.ndarray]:
    observed = bars(one, workpiece, name).observations()[0]
    (source,) = select_sources(one, [name])
    return source, observed, design_rows([source], one, observed)[:, 0]


@pytest.mark.parametrize("name", ["AAA", "YAC", "ZCC", "BYA", "XZA"])
def test_under_the_workpiece_the_column_is_that_of_the_compliance_per_newton(name: str) -> None:
    one = machine()
    _, _, known = column(one, f"C_{name}", Workpiece(400 * KG, FRONT))
    _, _, unknown = column(one, f"CW_{name}(w)", Workpiece(centre=FRONT))
    assert np.abs(known).max() > 0
    assert_allclose(known, 400 * KG * G * unknown, rtol=1e-12, atol=1e-12 * np.abs(known).max())


@pytest.mark.parametrize(("name", "body"), [("AAY", "Z"), ("BBX", "Z"), ("CAY", "X"), ("YBX", "X"), ("CYC", "C")])
def test_under_a_carriage_too(name: str, body: str) -> None:
    _, _, known = column(machine({body: 300 * KG}), f"C_{name}")
    _, _, unknown = column(machine(), f"CW_{name}({body})")
    assert_allclose(known, 300 * KG * G * unknown, rtol=1e-12, atol=1e-12 * max(np.abs(known).max(), 1e-9))


def test_a_mass_that_is_known_leaves_nothing_to_the_unknown() -> None:
    assert not column(machine({"Z": 1.0}), "CW_AAY(Z)")[2].any()
    assert column(machine(), "CW_AAY(Z)")[2].any()
    for workpiece in (None, Workpiece(400 * KG, FRONT)):
        assert not column(machine(), "CW_AAA(w)", workpiece)[2].any()


def test_only_what_a_joint_carries_weighs_on_it() -> None:
    one = machine()
    assert [source.name for source in select_sources(one, ["CW_AA*"])] == ["CW_AAA(w)", "CW_AAC(w)"]
    assert len(select_sources(one, [f"CW_AA{axis}" for axis in ("A(C)", "A(A)", "Y(S)", "Y(Y)", "X(Z)")])) == 5
    for name in ("CW_AAX(w)", "CW_AAX(Y)", "CW_AAC(A)", "CW_AAY(C)", "CW_AAS(S)", "CW_AAB(B)"):
        with pytest.raises(SelectionError, match="selects no error source"):
            select_sources(one, [name])


def test_their_units_are_those_of_a_compliance_times_a_force() -> None:
    sources = select_sources(machine(), ["CW_XXA(w)", "CW_XAA(w)", "CW_AXA(w)", "CW_AAA(w)"])
    assert [source.unit for source in sources] == ["mm", "mm/mm", "rad", "rad/mm"]
    assert not any(source.elastic for source in sources)


def test_the_exact_model_agrees() -> None:
    one = machine()
    for name in ("CW_AAA(w)", "CW_CCC(w)", "CW_AAY(Z)", "CW_BBX(X)"):
        source, observed, found = column(one, name, Workpiece(centre=FRONT))
        size = 1e-4 / max(np.abs(found).max(), 1e-9)
        linear, exact = (r({source: size}, one, observed) for r in (linear_response, exact_response))
        assert_allclose(linear, exact, rtol=0, atol=2e-3 * np.abs(linear).max() + 1e-12)


def test_a_weight_that_nobody_knows_is_moved_and_its_sag_is_found_and_with_a_known_one_its_mass() -> None:
    """The truth is 400 kg, which the tests with it do not say; a test with 150 kg that are known gives the compliance."""
    one, truth = machine(), {"C_AAA": 3e-10, "E_C(0Y)X": 2e-5, "E_XX1": 1e-5, "E_YY1": -2e-5}
    asked = ("C_AAA", "CW_AAA(w)", "E_C(0Y)X", "E_XX1", "E_YY1")

    def made(true: Workpiece | None, said: Workpiece | None, seed: int) -> MachineTest:
        read = simulate(bars(one, true, *asked), truth, Imperfection(noise=1e-4), seed=seed)
        return replace(read, workpiece=said)

    unknown = {
        "empty": made(None, None, 1),
        "front": made(Workpiece(400 * KG, FRONT), Workpiece(centre=FRONT), 2),
        "back": made(Workpiece(400 * KG, BACK), Workpiece(centre=BACK), 3),
    }
    sag = 400 * KG * G * truth["C_AAA"]
    found = identify(unknown)
    assert found.confounding.null == ("C_AAA",)
    low, high = found["CW_AAA(w)"].interval
    assert low < sag < high
    assert high - low < 0.3 * sag

    both = identify({**unknown, "known": made(Workpiece(150 * KG, FRONT), Workpiece(150 * KG, FRONT), 4)})
    assert both.confounding.null == ()
    mass = both["CW_AAA(w)"].value / both["C_AAA"].value / G
    assert mass == pytest.approx(400 * KG, rel=0.2)


def test_where_neither_the_weight_nor_its_lever_changes_it_is_an_offset_of_the_ball() -> None:
    test = bars(machine(), None, "E_Zt0", "CW_ZZY(Y)", "CW_ZAY(Y)")
    assert confounding_of(test, systems_of(test)).groups == (("E_Zt0", "CW_ZZY(Y)", "CW_ZAY(Y)"),)
