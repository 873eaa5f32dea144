"""What a name means: each source against its response written out by hand, and selection by name, pattern, preset."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.errors import SelectionError
from elastogeo.machine import Array, Machine
from elastogeo.observe import Circle, MachineTest
from elastogeo.sources import catalogue, linear_response, parameter_values, select_sources

ANGLE = np.linspace(0.1, 6.2, 40)
C, S, R, F = np.cos(ANGLE), np.sin(ANGLE), 150.0, 100.0

BY_HAND: dict[str, Array] = {
    "C_XXX": F * C * C,
    "C_XYY": F * C * S,
    "C_CXY": F * R * C * C * S,
    "C_CCY": F * R**2 * (C * S) ** 2,
    "E_XX1": R * C * C,
    "E_YX2": R**2 * C * C * S,
    "E_XY2": R**2 * S * S * C,
    "E_YY1": R * S * S,
    "E_CX1": 0 * C,  # the tool sits at the origin of X's carriage
    "E_CY1": R**2 * S * C * S,
    "E_C(0Y)X": R * C * S,
    "E_X(0)Y": C,
    "E_Y(0Y)X": S,
    "E_Xt0": C,
    "E_Yt0": S,
    "E_Xw0": -C,
}
"""Radial response per unit of each parameter: wFYXt, a circle in XY about the origin; Y carries X carries the tool."""


@pytest.mark.parametrize("name", BY_HAND)
def test_a_name_means_what_the_conventions_say(name: str, make_test: Callable[..., MachineTest]) -> None:
    test = make_test("wFYXt", [F], angle=ANGLE, circle=Circle(R))
    (observed,) = test.observations()
    response = linear_response(parameter_values(test.machine, {name: 1.0}), test.machine, observed)
    assert_allclose(response, BY_HAND[name], rtol=0, atol=1e-9 * max(1.0, np.abs(BY_HAND[name]).max()))


@pytest.mark.parametrize(
    ("pattern", "count"),
    [
        ("C_*", 180),
        ("C_??X", 36),
        ("C_[XY][XY]Y", 4),
        ("C_XXX", 1),
        ("planar-xy", 18),
        ("planar-zx", 18),
        ("compliance", 180),
    ],
)
def test_patterns_and_presets_select(pattern: str, count: int, make_machine: Callable[..., Machine]) -> None:
    assert len(select_sources(make_machine("wCAFYXZSt"), [pattern])) == count


def test_each_source_is_selected_once_in_the_order_asked_for(make_machine: Callable[..., Machine]) -> None:
    names = [source.name for source in select_sources(make_machine("wFYXt"), ["C_YYY", "C_YY?", "C_YYX", "C_YYY"])]
    assert names == ["C_YYY", "C_YYX"]


def test_units_follow_from_displacement_and_load(make_machine: Callable[..., Machine]) -> None:
    known = catalogue(make_machine("wCFYXt"))
    units = {
        "C_XYX": "mm/N",
        "C_XCX": "mm/(N mm)",
        "C_CXX": "rad/N",
        "C_CCC": "rad/(N mm)",
        "E_XX1": "mm/mm",
        "E_YX2": "mm/mm^2",
    }
    units |= {"E_CC1": "rad/rad", "E_XC1": "mm/rad", "E_C(0Y)X": "rad", "E_Xt0": "mm"}
    assert {name: known[name].unit for name in units} == units


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (["C_XXZ"], "'C_XXZ' selects no error source of wFYXt; close to it: C_"),
        (["C_XXX", "Q_*"], r"'Q_\*' selects no error source"),
        ([], "no parameter was asked for"),
        ([""], "'' among the parameters names none; take it out, or name one"),
        (["C_XXX", " "], "' ' among the parameters names none"),
        (["|", "C_XXX"], r"'\|' among the parameters names none"),
    ],
)
def test_what_selects_nothing_is_refused(asked: list[str], message: str, make_machine: Callable[..., Machine]) -> None:
    with pytest.raises(SelectionError, match=message):
        select_sources(make_machine("wFYXt"), asked)
