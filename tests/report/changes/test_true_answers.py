"""Each sentence of a verdict is true of the tests that it is made of, which are written down here by hand."""

import re
from dataclasses import replace

import numpy as np

from elastogeo.changes import KINDS, STEADY, STEP, SUSPECT, Baseline, Series, Tolerance, judge, machine_row
from elastogeo.changes.drifts import drift_of, line_of
from elastogeo.report import view_of
from elastogeo.report.changes.answers import drift_said
from elastogeo.report.changes.fleets.rows import change_of
from elastogeo.report.changes.rows import resolves_said
from tests.report.changes.cases import guideway

BASE = np.array([0.0, 0.3, -0.3, 0.2, -0.2, 0.1, -0.1, 0.25, -0.25, 0.0])
"""Departures of the tests of a baseline in percent; their mean is zero."""


def series_of(*percent, temperature=None, every=30.0, names=("stiffness X", "stiffness Y"), aside=()):
    """Tests, `every` days apart, whose indicators are off 10 000 N/mm by these percent; shape (n,) each."""
    value = 10_000.0 * (1 + np.column_stack(percent) / 100)
    n = len(value)
    return Series(
        name="Mill 1: loaded ball bar",
        indicators=names[: value.shape[1]],
        kinds=(KINDS["stiffness"],) * value.shape[1],
        tests=tuple(f"test {k + 1}" for k in range(n)),
        date=20_000.0 + every * np.arange(n),
        value=value,
        standard_uncertainty=np.full(value.shape, 5.0),
        temperature=np.full(n, 20.0) if temperature is None else np.asarray(temperature, dtype=float),
        repeats=np.full(n, -1),
        aside=np.isin(np.arange(n), aside),
        instruments=("LDBB 0042",) * n,
        simulated="tests/report/changes/test_true_answers.py",
        machine="Mill 1",
    )


def judged(series, base=10, cleared=(), tolerances=None):
    """As it stands on the day of the last test."""
    baseline = Baseline(series.tests[:base], float(series.date[base - 1]), cleared)
    return judge(series, baseline, now=float(series.date[-1]), tolerances=tolerances)


def test_a_suspect_test_names_the_indicator_that_is_furthest_off():
    found = judged(series_of(np.append(BASE, -12.0), np.append(BASE, -40.0)))
    assert found.state == SUSPECT
    assert found.steps[-1].over == ("stiffness Y", "stiffness X")
    view = view_of(found)
    assert "is 40 % softer in Y. One test is no alarm." in view.sentence
    assert view.values[0].name == "Stiffness Y"


def test_a_machine_and_its_fleet_give_the_same_size_of_a_suspect_change():
    found = judged(series_of(np.concatenate([BASE, [0.0, 0.1, -19.0]])))
    assert found.state == SUSPECT
    assert "is 19 % softer in X" in view_of(found).sentence
    assert change_of(machine_row(found)) == "19 % softer in X"
    low, high = machine_row(found).change_interval
    assert low < -1900 < high
    assert next(one.value for one in view_of(found).values if one.name == "Change").startswith("−19")


def test_a_suspect_test_on_a_warm_day_is_against_what_its_temperature_explains():
    """1 % stiffer for each kelvin: at 30 degC nearly 10 % are expected, so that 1 % is softer by nearly nine."""
    warm = 20.0 + np.array([-10.0, 10.0, -5.0, 5.0, 0.0, -8.0, 8.0, -9.0, 9.0, 0.0])
    found = judged(series_of(np.append(BASE / 10 + warm - 20.0, 1.0), temperature=np.append(warm, 30.0)))
    assert found.state == SUSPECT
    (size,) = re.findall(r"is ([\d.]+) % softer in X", view_of(found).sentence)
    assert 8.7 <= float(size) <= 9.0


def test_the_size_of_a_suspect_change_is_that_of_the_test_whose_date_is_told():
    """X is off on the test that waits; the next one determines Y alone."""
    found = judged(series_of(np.concatenate([BASE, [-19.0, np.nan]]), np.concatenate([BASE, [0.0, 0.1]]), every=3.0))
    assert found.waiting == "test 11"
    assert "is 19 % softer in X" in view_of(found).sentence


def test_an_indicator_that_is_never_judged_is_not_said_to_be_within_its_limits():
    three = np.where(np.arange(10) < 3, BASE, np.nan)
    found = judged(series_of(np.append(BASE, 0.1), np.append(three, -40.0)))
    assert found.state == STEADY
    view = view_of(found)
    assert "1 of 2 indicators is within its limits; stiffness Y is only watched: its baseline has 3 tests" in view.sentence
    check = next(one for one in view.checks if "baseline" in one.sentence and "needed" in one.sentence)
    assert not check.passed
    assert check.sentence.startswith("The baseline has 3 tests of stiffness Y: 6 are needed")


def test_a_step_is_not_told_as_a_drift_the_other_way():
    """16 % lost at once; what has come back since is no drift of the machine away from its baseline."""
    one = guideway()
    worst = replace(one.changed[0], shape=STEP)
    stepped = replace(one, indicators=tuple(worst if i.name == worst.name else i for i in one.indicators))
    assert worst.drift is not None
    view = view_of(stepped)
    assert not any("drifts" in line for line in view.advice)
    assert all(value.name != "Drift" for value in view.values)
    assert any("drifts" in line for line in view_of(one).advice)


def test_a_limit_that_the_line_lies_beyond_is_told_as_passed():
    """A line that loses 1 % a month, 20 % so far, with a tolerance at 95 %: by hand it was passed long ago."""
    one = guideway().changed[0]
    t = 20_000.0 + 30.0 * np.arange(20)
    line = line_of(t, -160.0 * np.arange(20), 100.0, 10.0)
    drift = drift_of(line, 16_000.0, 30.0, 300.0, 15_200.0, np.inf)
    assert "has passed its tolerance" in drift_said(one, drift)
    verdict = guideway()
    told = replace(
        verdict, indicators=tuple(replace(i, drift=drift) if i.name == one.name else i for i in verdict.indicators)
    )
    assert next(value.meaning for value in view_of(told).values if value.name == "Drift") == "limit passed"


def test_only_what_is_known_is_said_to_lie_within_tolerance():
    series = series_of(np.append(BASE, 0.1), np.append(BASE, np.nan))
    tolerance = Tolerance(lower=9_000.0, upper=11_000.0)
    found = judged(series, tolerances={"stiffness X": tolerance, "stiffness Y": tolerance})
    (said,) = [one.sentence for one in view_of(found).checks if "tolerance" in one.sentence]
    assert said == "Stiffness X lies within tolerance. No test since the baseline determines stiffness Y."


def test_tests_of_an_alarm_that_was_closed_as_false_are_not_among_those_that_show_no_change():
    series = series_of(np.concatenate([BASE, [-19.0, -19.0, 0.1, -0.1, 0.0]]))
    found = judged(series, cleared=(float(series.date[12]) - 1.0,))
    assert found.state == STEADY
    view = view_of(found)
    assert "3 tests since show no change" in view.sentence
    assert any(one.sentence == "3 tests since the baseline stay within their limits." for one in view.checks)


def test_tests_that_are_set_aside_are_not_counted_in_a_baseline():
    view = view_of(judged(series_of(np.append(BASE[:7], 0.1), aside=(2, 3)), base=7))
    assert "a baseline of 5 tests says too little" in view.sentence
    assert any("made of 5 tests" in one.sentence for one in view.checks)


def test_one_test_is_not_promised_to_show_what_is_too_small_to_matter():
    found = judged(series_of(np.append(BASE / 10, 0.0)))
    relevant = replace(found["stiffness X"], relevance=900.0)
    assert resolves_said(relevant) == "9.0 %"
