"""Run lengths of textbook charts: published figures, a Markov chain of our own, and the limits of the charts."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.changes import cusum_run_length, ewma_run_length, shewhart_run_length
from elastogeo.errors import InputError

SHIFTS = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0])
GOLDEN = {
    "EWMA 0.4, 2.9589": (lambda at: ewma_run_length(at, 2.9589), (370.4, 58.46, 12.71, 5.47, 3.35, 1.95, 1.39)),
    "EWMA 0.4, 3.054": (lambda at: ewma_run_length(at, 3.054), (499.9, 71.2, 14.26, 5.87, 3.52, 2.02, 1.44)),
    "CUSUM 0.5, 5": (lambda at: cusum_run_length(at, 5.0, 0.5), (465.4, 38.0, 10.38, 5.75, 4.01, 2.57, 2.01)),
    "CUSUM 1, 2.5168": (lambda at: cusum_run_length(at, 2.5168, 1.0), (370.4, 69.05, 13.55, 5.46, 3.26, 1.86, 1.32)),
    "Shewhart 3": (shewhart_run_length, (370.4, 155.2, 43.89, 14.97, 6.30, 2.00, 1.19)),
}
"""By Markov chain: `reference/monitoring.md`, section 7; they agree with Lucas and Saccucci (1990) and Montgomery."""


@pytest.mark.parametrize("chart", GOLDEN)
def test_run_lengths_are_those_of_the_textbooks(chart: str) -> None:
    found, expected = GOLDEN[chart]
    assert_allclose(found(SHIFTS), expected, rtol=0.01)


def by_chain(shift: float, h: float, smoothing: float, states: int) -> float:
    """Of an EWMA between two limits, as steps between intervals (Brook and Evans, 1972)."""
    edges = np.linspace(-h, h, states + 1)
    middle = (edges[1:] + edges[:-1]) / 2
    reach = stats.norm.cdf((edges - (1 - smoothing) * middle[:, np.newaxis]) / smoothing, shift)
    return float(np.linalg.solve(np.eye(states) - np.diff(reach, axis=1), np.ones(states))[states // 2])


@pytest.mark.parametrize(("shift", "limit", "smoothing"), [(0.0, 2.9589, 0.4), (1.0, 2.7, 0.1), (0.5, 3.2, 0.75)])
def test_the_integral_equation_is_the_limit_of_the_chain(shift: float, limit: float, smoothing: float) -> None:
    h = limit * np.sqrt(smoothing / (2 - smoothing))
    coarse, fine = (by_chain(shift, h, smoothing, states) for states in (201, 603))
    limit_of_both = fine + (fine - coarse) / 8  # its error falls with the square of the width
    assert float(ewma_run_length(shift, limit, smoothing)) == pytest.approx(limit_of_both, rel=1e-5)


def test_the_two_sided_sum_is_that_of_its_simulation() -> None:
    """20 000 runs, 5 standard errors; the sums are reset at zero and know nothing of each other."""
    random = np.random.default_rng(5)
    runs, shift, h, k = 20000, 0.8, 3.0, 0.5
    up, down, length = np.zeros(runs), np.zeros(runs), np.zeros(runs)
    going = np.ones(runs, dtype=bool)
    while going.any():
        x = shift + random.standard_normal(runs)
        up, down = np.maximum(0, up + x - k), np.maximum(0, down - x - k)
        length += going
        going &= (up <= h) & (down <= h)
    assert float(cusum_run_length(shift, h, k)) == pytest.approx(length.mean(), abs=5 * length.std() / np.sqrt(runs))


def test_charts_are_symmetric_and_meet_at_their_limits() -> None:
    for chart in (lambda at: ewma_run_length(at, 2.9), lambda at: cusum_run_length(at, 4.0), shewhart_run_length):
        assert_allclose(chart(SHIFTS), chart(-SHIFTS), rtol=1e-9)
    assert_allclose(ewma_run_length(SHIFTS, 3.0, 0.999), shewhart_run_length(SHIFTS, 3.0), rtol=0.01)
    assert_allclose(cusum_run_length(SHIFTS, 1e-9, 3.0), shewhart_run_length(SHIFTS, 3.0), rtol=1e-6)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: shewhart_run_length(0.0, 0.0), "the limit of a chart is 0.0"),
        (lambda: cusum_run_length(0.0, float("nan")), "the limit of a chart is nan"),
        (lambda: ewma_run_length(0.0, 3.0, 1.0), "the smoothing of a running mean is 1.0"),
    ],
)
def test_a_chart_without_a_limit_is_refused(wrong: object, said: str) -> None:
    with pytest.raises(InputError, match=said):
        wrong()  # type: ignore[operator]
