"""The catalogue: what a name means, what no name means, and in which unit a parameter is stated."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable

import numpy as np
import pytest

from elastogeo.errors import SelectionError
from elastogeo.machine import Joint, Machine, parse_topology
from elastogeo.sources import PRESETS, Source, catalogue, families, family, select_sources
from elastogeo.sources.families import _REGISTER

MakeMachine = Callable[..., Machine]

UNITS = {
    "C_XXX": "mm/N",
    "C_AXX": "rad/N",
    "C_XCY": "mm/(N mm)",
    "C_CCY": "rad/(N mm)",
    "CF1_XXX": "mm/N/N",
    "CF2_CCY": "rad/(N mm)/N^2",
    "H_XXX": "mm/N^0.6667",
    "H0.8_XXX": "mm/N^0.8",
    "H0.8_CCY": "rad/(N mm)^0.8",
    "E_XX1": "mm/mm",
    "E_YX2": "mm/mm^2",
    "E_AX3": "rad/mm^3",
    "E_XX7": "mm/mm^7",
    "E_XC1": "mm/rad",
    "E_CC2": "rad/rad^2",
    "E_XCc1": "mm",
    "E_ACs2": "rad",
    "E_C(0Y)X": "rad",
    "E_X(0A)C": "mm",
    "E_Xt0": "mm",
    "E_Zw0": "mm",
    "E_R0": "mm",
    "B_XX": "mm",
    "B_CX": "rad",
    "B_CC": "rad",
    "S_XX": "mm",
    "S_CC": "rad",
    "P_XXc1": "mm",
    "P_CCs2": "rad",
    "T_X1": "s",
    "T_X2": "s^2",
    "T_C1": "s",
}


@pytest.fixture(scope="module")
def machine() -> Machine:
    """Five axes, each with a pitch."""
    topology = parse_topology("wCAFYXZSt")
    pitch = {**dict.fromkeys("XYZ", 10.0), **dict.fromkeys("AC", np.deg2rad(3.0))}
    joints = tuple(Joint(axis, pitch=pitch.get(axis), compliant=axis != "S") for axis in topology.axes)
    return Machine("pitched", topology, joints)


@pytest.mark.parametrize("name", UNITS)
def test_the_unit_of_a_parameter(name: str, machine: Machine) -> None:
    (source,) = select_sources(machine, [name])
    assert source.name == name
    assert source.unit == UNITS[name]
    assert source.meaning


@pytest.mark.parametrize(
    ("name", "site", "component"),
    [
        ("E_XX7", ("motion", "X"), 0),
        ("E_BY12", ("motion", "Y"), 4),
        ("E_ZCs9", ("motion", "C"), 2),
        ("H0.8_XXX", ("motion", "X"), 0),
        ("H1.25_CCY", ("motion", "Y"), 5),
    ],
)
def test_names_beyond_the_listing_parse(name: str, site: tuple[str, str], component: int, machine: Machine) -> None:
    assert name not in catalogue(machine)
    (source,) = select_sources(machine, [name])
    assert (source.name, source.site, source.component) == (name, site, component)


@pytest.mark.parametrize(
    "name",
    [
        "E_XQ1",
        "E_XX0",
        "E_XX-1",
        "E_XXc1",  # harmonics are of rotary axes
        "E_XCc0",
        "E_XX1.5",
        "E_XS1",  # the spindle has no error motion here
        "H0_XXX",
        "H2.5_XXX",
        "H-1_XXX",
        "H0.8_XXQ",
        "H0.8_XXS",  # the spindle is rigid
        "CF3_XXX",
        "P_XXc3",
        "P_YXc1",  # a screw's error is along its axis
        "T_C2",
        "T_S1",
        "B_XS",
        "E_C(0X)Y",
        "c_XXX",
        "nonsense",
    ],
)
def test_a_name_that_means_nothing_is_refused(name: str, machine: Machine) -> None:
    with pytest.raises(SelectionError, match=re.escape(f"{name!r} selects no error source of wCAFYXZSt")):
        select_sources(machine, [name])


def test_a_refusal_names_what_is_close(machine: Machine) -> None:
    with pytest.raises(SelectionError, match=r"close to it: .*E_XX1"):
        select_sources(machine, ["EXX1"])


def test_nothing_asked_is_refused(machine: Machine) -> None:
    with pytest.raises(SelectionError, match="no parameter was asked for"):
        select_sources(machine, [])


def test_axes_without_a_pitch_have_no_cyclic_error(make_machine: MakeMachine) -> None:
    bare = make_machine("wFYXt")
    assert not any(name.startswith("P_") for name in catalogue(bare))
    with pytest.raises(SelectionError, match="'P_XXc1' selects no error source of wFYXt"):
        select_sources(bare, ["P_XXc1"])
    assert not any(source.name.startswith("P_") for source in select_sources(bare, ["ball-bar-xy"]))


def test_every_name_is_its_own_and_selects_itself(machine: Machine) -> None:
    known = catalogue(machine)
    listed = [source.name for sources in families().values() for source in sources(machine)]
    assert sorted(listed) == sorted(known)
    for name, source in known.items():
        assert select_sources(machine, [name]) == (source,)


def test_a_source_selected_twice_comes_once(machine: Machine) -> None:
    names = [source.name for source in select_sources(machine, ["C_XXX", "planar-xy", "C_XX*", "C_XXX"])]
    assert len(names) == len(set(names))
    assert names[0] == "C_XXX"


def test_elastic_is_what_a_load_drives(machine: Machine) -> None:
    for name, source in catalogue(machine).items():
        assert source.elastic == name.startswith(("C_", "CF", "H"))
        assert (source.force_degree > 0) == source.elastic
    degrees = {name: select_sources(machine, [name])[0].force_degree for name in ("C_XXX", "CF2_XXX", "H0.8_XXX", "E_XX1")}
    assert degrees == {"C_XXX": 1.0, "CF2_XXX": 3.0, "H0.8_XXX": 0.8, "E_XX1": 0.0}


SIZES = {
    "compliance": 180,
    "planar-xy": 18,
    "planar-yz": 18,
    "planar-zx": 18,
    "elasto-geometric-xy": 13,
    "ball-bar-xy": 19,
    "ball-bar-yz": 19,
    "ball-bar-zx": 20,
    "geometry-3-axis": 45,
    "geometry-5-axis": 90,
}
"""36 a joint; 2 x 9; the 13 of Table 5.1; of three axes 36 polynomials and 9 orientations; of rotary ones harmonics too."""


def test_presets_select_what_they_say(machine: Machine) -> None:
    assert {preset: len(select_sources(machine, [preset])) for preset in PRESETS} == SIZES


@pytest.mark.parametrize("preset", ["planar-yz", "ball-bar-zx", "geometry-5-axis"])
def test_a_preset_for_axes_that_the_machine_lacks_is_refused(preset: str, make_machine: MakeMachine) -> None:
    with pytest.raises(SelectionError, match="selects no error source of wFYXt"):
        select_sources(make_machine("wFYXt"), [preset])


def test_the_squareness_is_found_wherever_the_axes_hang(make_machine: MakeMachine) -> None:
    """Of X to Y if one carries the other, else of the axis that stands on the foundation."""
    squareness = {"wFYXt": "E_C(0Y)X", "wFXYt": "E_C(0X)Y", "wYXFZt": "E_C(0X)Y", "wXFYt": "E_C(0)X"}
    for topology, name in squareness.items():
        chosen = [source.name for source in select_sources(make_machine(topology), ["ball-bar-xy"])]
        assert [n for n in chosen if n.startswith("E_C(")] == [name]


def test_a_family_of_ones_own_is_selected_at_once(make_machine: MakeMachine, monkeypatch: pytest.MonkeyPatch) -> None:
    """The recipe of `families`, followed."""
    families()
    monkeypatch.setattr(sys.modules[family.__module__], "_REGISTER", dict(_REGISTER))
    catalogue.cache_clear()

    @family
    def thermal_growth(machine: Machine):
        for joint in machine.joints:
            yield Source(f"G_T{joint.name}", "mm/K", ("motion", joint.name), joint.direction, lambda _: 1.0, "growth")

    chosen = select_sources(make_machine("wFYXt"), ["G_T*"])
    catalogue.cache_clear()
    assert [source.name for source in chosen] == ["G_TY", "G_TX"]
    assert thermal_growth.__name__ in families()
