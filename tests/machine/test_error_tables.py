"""An error table: its sign, its name, what lies between its points, and what is refused as one."""

import numpy as np
import pytest

from elastogeo.errors import InputError
from elastogeo.machine import ErrorTable, motion_of


def table(position=(0.0, 100.0, 200.0), value=((0.0, 0.002), (0.01, 0.012), (0.03, 0.03)), axis="X", component="X"):
    value = np.array(value)
    return ErrorTable(axis, component, np.array(position), value, np.full(value.shape, 0.001))


def test_between_the_points_it_is_linear_and_beyond_them_constant():
    at = table().at(np.array([-50.0, 50.0, 150.0, 300.0]))
    assert at == pytest.approx(np.array([[0.0, 0.002], [0.005, 0.007], [0.02, 0.021], [0.03, 0.03]]))


def test_the_direction_chooses_the_column_and_standing_takes_the_mean():
    found = table().deviation(np.array([50.0, 50.0, 50.0]), np.array([1.0, -1.0, 0.0]))
    assert found == pytest.approx([0.005, 0.007, 0.006])


def test_names_are_those_of_iso_230_1():
    assert table(component="Y").name == "E_YX"
    assert [motion_of(axis) for axis in "XUCS"] == ["X", "X", "C", "C"]
    assert table().is_own
    assert not table(component="Y").is_own
    assert table(axis="U").is_own
    assert table(axis="C", component="C").is_rotary
    assert table(component="B").is_angular


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"position": (0.0, 200.0, 100.0)}, "error table E_XX: 100 follows 200; sort the positions, each once"),
        ({"position": (0.0, 0.0, 100.0)}, "error table E_XX: 0 follows 0; sort the positions, each once"),
        ({"value": ((0.0, np.nan), (0.0, 0.0), (0.0, 0.0))}, "error table E_XX: a position or a value is no finite number"),
        ({"value": ((0.0, 0.0), (0.0, 0.0))}, "error table E_XX: 3 positions, values of shape"),
        ({"position": (), "value": np.zeros((0, 2))}, "error table E_XX: 0 positions"),
        ({"axis": "Q"}, "component 'X' of axis 'Q'; axes are X Y Z U V W A B C S"),
    ],
)
def test_what_is_no_table_is_refused(given, message):
    with pytest.raises(InputError, match=message):
        table(**given)
