"""Where two documents differ."""

import pytest

from elastogeo.history.analyses.differences import differences


def paths(old: object, new: object) -> list[str]:
    return [entry.path for entry in differences(old, new)]


@pytest.mark.parametrize(("apart", "found"), [(9e-13, []), (1.1e-12, ["value"])])
def test_a_number_counts_beyond_1e_12_of_itself(apart: float, found: list[str]) -> None:
    assert paths({"value": 5.0}, {"value": 5.0 * (1 + apart)}) == found
    assert paths({"value": -5e9}, {"value": -5e9 * (1 + apart)}) == found


def test_a_number_of_a_list_counts_against_the_largest_of_its_list() -> None:
    assert paths([1.0, 1e-20], [1.0, 3e-20]) == []
    assert paths([1.0, 1e-20], [1.0, 3e-12]) == ["[1]"]


def test_who_computed_it_is_not_compared_but_what_a_test_says_of_software_is() -> None:
    assert paths({"software": {"version": "1"}, "a": 1}, {"software": {"version": "2"}, "a": 1}) == []
    assert paths({"test": {"software": "a"}}, {"test": {"software": "b"}}) == ["test.software"]


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        ({"a": 1}, {"b": 1}, ["a", "b"]),
        ({"a": None}, {"a": 0.0}, ["a"]),
        ({"a": True}, {"a": 1}, ["a"]),
        ({"a": [1, 2]}, {"a": [1, 2, 3]}, ["a"]),
        ({"a": "x"}, {"a": ["x"]}, ["a"]),
        ({"a": {"b": [{"c": 1.0}]}}, {"a": {"b": [{"c": 2.0}]}}, ["a.b[0].c"]),
        ({"a": 0.0}, {"a": -0.0}, []),
    ],
)
def test_what_is_there_and_of_which_type(old: object, new: object, found: list[str]) -> None:
    assert paths(old, new) == found


def test_long_values_are_cut_in_what_is_said() -> None:
    (entry,) = differences({"a": "x" * 500}, {"a": 1.5})
    assert (len(entry.old), entry.new, entry.relative) == (60, "1.5", float("inf"))
