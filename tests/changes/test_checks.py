"""The checks of a series: each fails for its fault and passes without it, and says so in a sentence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.changes import Baseline, ChangeVerdict, Tolerance, judge
from elastogeo.identification import Check
from elastogeo.report.sentences import sentence_of
from tests.changes.simulated_series import MEANS, baseline_of, deviations, judged, series_of

QUIET = np.zeros((24, 4))


def check(verdict: ChangeVerdict, name: str) -> Check:
    found = next(one for one in verdict.verdict if one.name == name)
    assert sentence_of(found).endswith((".", "!"))
    return found


def rate(off: np.ndarray[tuple[int, int], np.dtype[np.float64]], name: str, draws: int = 60) -> float:
    """How often a check fails, of simulated series."""
    return float(np.mean([check(judged(off, seed), name).passed is False for seed in range(draws)]))


@pytest.mark.parametrize("name", ["baseline steady", "scatter as expected", "tests independent"])
def test_checks_of_the_ground_are_quiet_on_independent_tests(name: str) -> None:
    """One in a hundred by design: of 60 draws five or more have a probability of 3e-4."""
    assert rate(QUIET, name) < 5 / 60


def test_a_drift_while_the_baseline_was_made_is_found() -> None:
    off = QUIET.copy()
    off[:10, 1] = np.arange(10)
    assert rate(off, "baseline steady", 20) > 0.9


def test_badly_seated_balls_in_the_baseline_are_found() -> None:
    off = QUIET.copy()
    off[[2, 5, 8], 2] = 8.0, -8.0, 8.0
    assert rate(off, "scatter as expected", 20) > 0.9


def test_tests_that_follow_one_another_are_found() -> None:
    """All indicators together wander by a first-order process with 0.8."""
    random = np.random.default_rng(4)
    walks = np.zeros((40, 4))
    for k in range(1, 40):
        walks[k] = 0.8 * walks[k - 1] + random.standard_normal(4)
    assert rate(walks, "tests independent", 20) > 0.9


def test_temperatures_that_are_missing_are_counted() -> None:
    series = series_of(QUIET, 1)
    warm = np.full(24, 20.0)
    assert check(judge(replace(series, temperature=warm), baseline_of(series)), "temperature known").passed is True
    warm[[3, 20]] = np.nan
    found = check(judge(replace(series, temperature=warm), baseline_of(series)), "temperature known")
    assert found.passed is False
    assert (found.facts["without"], found.facts["tests"]) == (2, 24)


def test_a_short_baseline_is_decisive() -> None:
    series = series_of(QUIET, 1)
    assert check(judge(series, baseline_of(series, 6)), "baseline long enough").passed is True
    short = check(judge(series, baseline_of(series, 5)), "baseline long enough")
    assert (short.passed, short.decisive) == (False, True)
    assert "5 tests" in sentence_of(short)


def test_an_alarm_fails_unchanged_and_says_what_changed_and_whether_it_was_confirmed() -> None:
    off = QUIET.copy()
    off[20:, 1] = -9.0
    verdict = judged(off, 1)
    assert check(verdict, "machine unchanged").facts["changed"] == ("stiffness Y",)
    assert check(verdict, "change confirmed").passed is True
    assert check(verdict, "change explained by one component").passed is None
    quiet = judged(QUIET, 1)
    assert check(quiet, "machine unchanged").passed is True
    assert not any(one.name == "change confirmed" for one in quiet.verdict)


def test_a_single_suspect_test_that_nobody_repeated_is_not_confirmed() -> None:
    off = QUIET.copy()
    off[23, 1] = -9.0
    series = series_of(off, 1)
    verdict = judge(series, baseline_of(series), now=float(series.date[-1]) + 8)
    assert check(verdict, "change confirmed").passed is False
    waiting = judge(series, baseline_of(series), now=float(series.date[-1]) + 1)
    assert check(waiting, "machine unchanged").passed is None


def test_a_tolerance_is_checked_by_the_running_mean() -> None:
    series = series_of(QUIET, 1)
    within = {"stiffness X": Tolerance(lower=0.9 * MEANS[0]), "backlash X": Tolerance(upper=1.0)}
    assert check(judge(series, baseline_of(series), tolerances=within), "within tolerance").passed is True
    beyond = {"stiffness X": Tolerance(lower=1.1 * MEANS[0])}
    found = check(judge(series, baseline_of(series), tolerances=beyond), "within tolerance")
    assert found.passed is False
    assert abs(found.facts["beyond"]["stiffness X"] - MEANS[0]) < 2 * deviations()[0]


def test_nothing_to_judge_is_not_tested() -> None:
    series = series_of(QUIET[:10], 1)
    verdict = judge(series, baseline_of(series))
    assert check(verdict, "machine unchanged").passed is None
    lonely = judge(series_of(QUIET[:3], 1), Baseline(("test 0",), 20000.5))
    assert check(lonely, "baseline steady").passed is None
    assert check(lonely, "scatter as expected").passed is None
    assert check(lonely, "tests independent").passed is None
