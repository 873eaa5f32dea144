"""The sentence beside a signed value: the same for the same fault, on either branch."""

from __future__ import annotations

import pytest

from elastogeo.machine import Machine, parse_topology
from elastogeo.report.signs import sign_sentence
from elastogeo.sources import catalogue

SAID = {
    ("B_XX", 8e-3): "X falls 8.0 µm short when it reverses",
    ("B_XX", -8e-3): "X overshoots by 8.0 µm when it reverses",
    ("B_YX", 2e-3): "X shifts by 2.0 µm towards +y when it turns back from + to -",
    ("B_YX", -2e-3): "X shifts by 2.0 µm towards -y when it turns back from + to -",
    ("B_CX", 3e-5): "X turns by 30 µrad about +Z when it turns back from + to -",
    ("S_YY", 6e-3): "Y is late by up to 6.0 µm right after it reverses",
    ("T_X1", 4e-4): "X lags its command by 0.40 ms",
    ("T_X1", -4e-4): "X leads its command by 0.40 ms",
}


@pytest.mark.parametrize("topology", ["wFYXt", "wXFYt", "wXYFt"])
@pytest.mark.parametrize(("name", "value"), SAID)
def test_what_counts_along_the_command_has_one_sentence(topology: str, name: str, value: float) -> None:
    source = catalogue(Machine(topology, parse_topology(topology)))[name]
    assert source.sign is not None
    assert sign_sentence(source.sign, value, source.unit) == SAID[name, value]


@pytest.mark.parametrize(
    ("topology", "name", "value", "said"),
    [
        ("wFYXt", "E_XX1", 15e-6, "X travels 15 µm/m too far"),
        ("wXFYt", "E_XX1", -15e-6, "X travels 15 µm/m too far"),
        ("wXFYt", "E_XX1", 15e-6, "X travels 15 µm/m too short"),
        ("wCAFYXZt", "E_CC1", -2e-6, "C travels 2.0 µrad/rad too far"),
        ("wFYXt", "E_YX2", 8e-8, "the path of X bends towards +y at both ends"),
        ("wXFYt", "E_YX2", 8e-8, "the path of X bends towards -y at both ends"),
        ("wFYXt", "E_C(0Y)X", 26e-6, "the angle between +X and +Y is 26 µrad less than 90°"),
        ("wXFYt", "E_C(0)X", 26e-6, "the angle between +X and +Y is 26 µrad less than 90°"),
        ("wYXFZt", "E_C(0X)Y", 26e-6, "the angle between +Y and +X is 26 µrad more than 90°"),
    ],
)
def test_an_error_motion_says_the_same_of_the_same_fault(topology: str, name: str, value: float, said: str) -> None:
    source = catalogue(Machine(topology, parse_topology(topology)))[name]
    assert source.sign is not None
    assert sign_sentence(source.sign, value, source.unit) == said


def test_what_has_no_side_has_no_sentence() -> None:
    known = catalogue(Machine("wFYXt", parse_topology("wFYXt")))
    assert all(known[name].sign is None for name in ("C_XXX", "E_Xt0", "E_R0", "E_XX3", "E_A(0Y)X"))
    sign = known["B_XX"].sign
    assert sign is not None
    assert sign_sentence(sign, 0.0, "mm") == ""
