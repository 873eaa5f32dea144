"""Two tests of one series: how often an unchanged machine is called changed, and what a temperature explains."""

import numpy as np
import pytest

from elastogeo.changes import KINDS, Baseline, Prior, Series, indicator_differences, reference_of, within_scatter

NAMES = ("stiffness X", "squareness XY", "backlash X")
SCATTER = np.array([150.0, 2e-6, 0.5e-3])
MEAN = np.array([20_000.0, 5e-6, 2e-3])


def series(rng: np.random.Generator, tests: int = 12, warm: float = 0.0, slope: float = 0.0) -> Series:
    """A simulated series that scatters by `SCATTER`, whose temperatures move by `warm` and its values with them."""
    temperature = 20 + warm * np.linspace(-1, 1, tests)
    value = MEAN + SCATTER * (rng.standard_normal((tests, 3)) + slope * (temperature - 20)[:, np.newaxis])
    return Series(
        name="simulated",
        indicators=NAMES,
        kinds=tuple(KINDS[name] for name in ("stiffness", "squareness", "backlash")),
        tests=tuple(map(str, range(tests))),
        date=np.arange(tests, dtype=float),
        value=value,
        standard_uncertainty=np.broadcast_to(SCATTER / 20, value.shape),
        temperature=temperature,
        repeats=np.full(tests, -1),
        aside=np.zeros(tests, dtype=bool),
        instruments=("",) * tests,
    )


def baseline(count: int = 10) -> Baseline:
    return Baseline(tuple(map(str, range(count))), 0.0)


def test_two_tests_of_an_unchanged_machine_are_called_changed_in_one_of_twenty() -> None:
    rng = np.random.default_rng(12)
    vague = Prior(np.full(3, 1e-3), SCATTER)
    called = 0
    trials = 500
    for _ in range(trials):
        one = series(rng)
        found = indicator_differences(one, "10", "11", reference_of(one, baseline(), vague))
        check = within_scatter(found)
        assert check is not None
        called += check.passed is False
    # Bonferroni keeps it at or below 0.05; three standard deviations of 500 draws are 0.029
    assert 0.01 < called / trials < 0.08


def test_a_change_beyond_the_scatter_is_named_with_its_size_and_comes_first() -> None:
    one = series(np.random.default_rng(3))
    value = one.value.copy()
    value[10], value[11] = MEAN, MEAN
    value[11, 2] += 6e-3
    moved = Series(**{name: getattr(one, name) for name in one.__dataclass_fields__} | {"value": value})
    found = indicator_differences(moved, "10", "11", reference_of(moved, baseline()))
    assert (found[0].name, found[0].within) == ("backlash X", False)
    assert [row.within for row in found[1:]] == [True, True]
    assert found[0].change.value == pytest.approx(6e-3)
    assert found[0].change.standard_uncertainty == pytest.approx(np.sqrt(2) * SCATTER[2] / 20)
    check = within_scatter(found)
    assert check is not None
    assert check.facts["beyond"] == [("backlash X", pytest.approx(6e-3), None)]


def test_what_the_temperatures_explain_is_expected() -> None:
    one = series(np.random.default_rng(4), tests=40, warm=8.0, slope=1.0)
    found = indicator_differences(one, "0", "39", reference_of(one, baseline(40)))
    for row in found:
        scatter = SCATTER[NAMES.index(row.name)]
        assert row.expected is not None
        middle = sum(row.expected) / 2
        # 16 K apart at one standard deviation a kelvin, drawn to 0 by what is known beforehand and told by 40 tests
        assert middle == pytest.approx(16 * scatter, rel=0.2)
        assert row.within


def test_without_a_baseline_nothing_is_expected_and_nothing_judged() -> None:
    one = series(np.random.default_rng(5))
    found = indicator_differences(one, "10", "11")
    assert {row.within for row in found} == {None}
    assert within_scatter(found) is None


def test_an_indicator_that_one_test_does_not_determine_is_left_out() -> None:
    one = series(np.random.default_rng(6))
    value = one.value.copy()
    value[11, 0] = np.nan
    less = Series(**{name: getattr(one, name) for name in one.__dataclass_fields__} | {"value": value})
    assert {row.name for row in indicator_differences(less, "10", "11")} == {"squareness XY", "backlash X"}
