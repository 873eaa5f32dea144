"""What runs scatter by, against variances that are known: order by order, and with the force that each run sets anew."""

from __future__ import annotations

import numpy as np
import pytest

from elastogeo.identification.model_choice.scatter import Scatter, scatter_of

ORDER = np.array([0, 1, 1, 2, 2])
FORCES = np.linspace(50.0, 750.0, 30)
RUN = np.repeat(np.arange(len(FORCES)), len(ORDER))
SHAPE = np.array([0.6, 0.0, 0.0, 0.8, 0.0])
KNOWN = 0.002


def scattered(
    sigma: tuple[float, float, float], force: float, seed: int, influence: float = 0.0
) -> tuple[Scatter, np.ndarray, np.ndarray, np.ndarray]:
    """Readings of a trace at no force and one that goes with the force, 30 runs, and forces that scatter by a part."""
    random = np.random.default_rng(seed)
    order = np.tile(ORDER, len(FORCES))
    base = np.zeros((len(order), 10))
    moved = np.zeros((len(order), len(FORCES)))
    for k, applied in enumerate(FORCES):
        base[k == RUN] = np.hstack([np.eye(5), applied / 750 * np.eye(5)])
        moved[k == RUN, k] = KNOWN * 40.0 * applied / 750 * SHAPE
    drift = np.outer(np.linspace(-1, 1, len(FORCES)), np.array([1.0, 0, 0, 0, 0])).reshape(-1, 1) ** 2 * influence
    off = moved @ (force / KNOWN * random.standard_normal(len(FORCES)))
    reading = base @ random.standard_normal(10) + np.array(sigma)[order] * random.standard_normal(len(order)) + off
    reading = reading + drift[:, 0] * random.standard_normal()
    return scatter_of(reading, base, order, RUN, moved, drift), order, moved, drift


def test_without_force_or_influence_it_is_the_variance_of_the_residuals() -> None:
    """One order, one number a run: sum of squares over its degrees of freedom, which are known exactly."""
    random = np.random.default_rng(1)
    base, reading, order = np.ones((9, 1)), random.standard_normal(9), np.zeros(9, dtype=int)
    none = np.zeros((9, 0))
    found = scatter_of(reading, base, order, np.arange(9), np.zeros((9, 9)), none)
    assert found.variances[0] == pytest.approx(np.var(reading, ddof=1), rel=1e-12)
    covariance, freedom = found.of(np.eye(9)[:1], order, np.zeros((9, 9)), none)
    assert covariance[0, 0] == pytest.approx(np.var(reading, ddof=1), rel=1e-12)
    assert freedom == pytest.approx(8.0, rel=1e-9)


def test_cosine_and_sine_of_a_run_count_once() -> None:
    """An amplitude that is drawn once a run is one number, though it is read as two."""
    random = np.random.default_rng(1)
    order, run = np.ones(18, dtype=int), np.repeat(np.arange(9), 2)
    base, none = np.tile(np.eye(2), (9, 1)), np.zeros((18, 0))
    found = scatter_of(random.standard_normal(18), base, order, run, np.zeros((18, 9)), none)
    assert found.of(np.eye(18)[:1], order, np.zeros((18, 9)), none)[1] == pytest.approx(8.0, rel=1e-9)


@pytest.mark.parametrize("sigma", [(0.02, 0.05, 0.02), (0.1, 0.02, 0.1)])
def test_the_variances_that_were_drawn_come_out(sigma: tuple[float, float, float]) -> None:
    """Mean of 40 draws, 28 degrees of freedom each, or twice that: 4 standard deviations of it are 17 %."""
    found = np.array([scattered(sigma, 0.0, seed)[0].variances for seed in range(40)])
    assert found.mean(axis=0) == pytest.approx(np.square(sigma), rel=0.2)


def test_forces_that_scatter_by_more_than_is_known_are_seen_and_others_are_not() -> None:
    more = [scattered((0.02, 0.02, 0.02), 3 * KNOWN, seed)[0].force for seed in range(20)]
    none = [scattered((0.02, 0.02, 0.02), KNOWN, seed)[0].force for seed in range(20)]
    assert np.median(more) == pytest.approx(9.0, rel=0.25)
    assert min(more) > 3
    assert sum(force > 1 for force in none) <= 8
    assert np.median(none) == 1.0


def test_what_an_influence_moves_counts_where_it_moves() -> None:
    scatter, order, moved, drift = scattered((0.02, 0.02, 0.02), KNOWN, 0, influence=0.05)
    first = np.flatnonzero((RUN == 0) & (order == 0))
    covariance, _ = scatter.of(np.eye(len(order))[first], order, moved, drift)
    known = 0.05**2 + scatter.variances[0] + scatter.force * float(np.sum(moved[first] ** 2))
    assert covariance[0, 0] == pytest.approx(known, rel=1e-9)
