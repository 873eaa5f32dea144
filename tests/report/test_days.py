"""What is said of data that nobody measured."""

from __future__ import annotations

import pytest

from elastogeo.report.days import origin_said, simulated_said


@pytest.mark.parametrize(
    ("what", "said"),
    [
        ("Not measured: simulated from simulation.toml.", "Simulated from simulation.toml."),
        ("simulated, a test of a fleet", "Simulated, a test of a fleet"),
        ("elastogeo, seed 1", "Simulated: elastogeo, seed 1"),
        ("simulated", "Simulated"),
        ("Not measured: from tables", "Simulated: from tables"),
        ("", ""),
    ],
)
def test_the_kind_is_said_once(what: str, said: str) -> None:
    assert origin_said("simulated", what) == said


def test_some_of_several_are_said_with_the_kind() -> None:
    assert (
        origin_said("simulated (2 of 6 runs)", "Not measured: simulated from a table")
        == "Simulated (2 of 6 runs) from a table"
    )


def test_many_simulations_are_the_first_and_their_number() -> None:
    assert simulated_said("Not measured: simulated from a.toml.\nb\nc") == "Simulated from a.toml and 2 more"
    assert simulated_said("") == ""
