"""The differentiator: its gain by formula against sines that really pass it, zero phase, segments, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import differentiate, gain, smoothed
from elastogeo.errors import InputError

STEP = 0.002
TIME = np.arange(4000) * STEP


@pytest.mark.parametrize("frequency", [1.0, 5.0, 20.0, 35.0])
@pytest.mark.parametrize("derivative", [0, 1, 2])
def test_a_sine_passes_with_the_stated_gain_and_no_phase(frequency: float, derivative: int) -> None:
    turn = 2 * np.pi * frequency
    position = np.sin(turn * TIME)
    truth = {0: np.sin(turn * TIME), 1: turn * np.cos(turn * TIME), 2: -(turn**2) * np.sin(turn * TIME)}[derivative]
    found = differentiate(TIME, position, 20.0)
    values = (found.position, found.velocity, found.acceleration)[derivative]
    inside = ~found.edge & (TIME > 2) & (TIME < 6)
    expected = gain(20.0, STEP, frequency, derivative) * truth
    assert_allclose(values[inside], expected[inside], atol=1e-6 * np.abs(truth).max())


def test_the_cutoff_is_where_the_amplitude_is_halved() -> None:
    assert gain(20.0, STEP, 20.0, 0) == pytest.approx(0.5, rel=1e-12)
    assert gain(20.0, STEP, 0.0) == 1.0


def test_an_effort_under_the_same_low_pass_keeps_the_inertia() -> None:
    """Effort = 3 times the true acceleration, at the cut-off itself: halved on both sides, the inertia stays."""
    turn = 2 * np.pi * 20.0
    effort = smoothed(TIME, -3.0 * turn**2 * np.sin(turn * TIME), 20.0)
    found = differentiate(TIME, np.sin(turn * TIME), 20.0)
    inside = ~found.edge
    inertia = effort[inside] @ found.acceleration[inside] / (found.acceleration[inside] @ found.acceleration[inside])
    assert inertia == pytest.approx(3.0 * gain(20.0, STEP, 20.0, 0) / gain(20.0, STEP, 20.0, 2), rel=1e-5)
    assert inertia == pytest.approx(3.0, rel=1e-3)


def test_a_parabola_is_differentiated_exactly() -> None:
    found = differentiate(TIME, 3 * TIME**2 + 2 * TIME + 1, 20.0)
    inside = ~found.edge & (TIME > 1) & (TIME < 7)
    assert_allclose(found.velocity[inside], (6 * TIME + 2)[inside], rtol=1e-6)
    assert_allclose(found.acceleration[inside], 6.0, rtol=1e-5)


def test_a_ramp_is_differentiated_exactly_up_to_its_ends() -> None:
    """Constant feed: the filter adds no transient at the ends, which would pass for an acceleration."""
    found = differentiate(TIME, 3.0 + 5.0 * TIME, 20.0)
    assert_allclose(found.velocity, 5.0, rtol=1e-9)
    assert_allclose(found.acceleration, 0.0, atol=1e-6)


def test_a_record_is_cut_where_its_clock_jumps() -> None:
    time = np.concatenate([TIME, TIME + TIME[-1] + 5.0])
    position = np.concatenate([np.sin(TIME), 100 + np.sin(TIME)])
    found = differentiate(time, position, 20.0)
    once = differentiate(TIME, np.sin(TIME), 20.0)
    assert_allclose(found.velocity, np.tile(once.velocity, 2), atol=1e-9)
    assert found.edge[len(TIME) - 1]
    assert found.edge[len(TIME)]
    assert np.abs(found.velocity).max() < 1.2


def test_a_segment_too_short_for_the_filter_has_no_number() -> None:
    time = np.concatenate([TIME, TIME[-1] + 5.0 + STEP * np.arange(5)])
    found = differentiate(time, np.zeros(len(time)), 20.0)
    assert np.isnan(found.velocity[-5:]).all()
    assert found.edge[-5:].all()
    assert not np.isnan(found.velocity[:-5]).any()


def test_what_cannot_be_differentiated_is_refused() -> None:
    position = np.sin(TIME)
    jittered = TIME + 0.2 * STEP * np.random.default_rng(1).uniform(-1, 1, len(TIME))
    with pytest.raises(InputError, match=r"the clock of the record is not uniform: .* resample it on one clock"):
        differentiate(jittered, position, 20.0)
    with pytest.raises(InputError, match=r"the cut-off of 260 Hz is out of range .* below half the sampling rate, 250 Hz"):
        differentiate(TIME, position, 260.0)
    with pytest.raises(InputError, match="two samples or more, at finite times that increase"):
        differentiate(TIME[::-1], position, 20.0)
    with pytest.raises(InputError, match="two samples or more, at finite times that increase"):
        differentiate(TIME[:1], position[:1], 20.0)
    with pytest.raises(InputError, match="no segment of the record has the 16 samples that the filter needs"):
        differentiate(TIME[:15], position[:15], 20.0)
    with pytest.raises(InputError, match=r"4000 times and values of the shape \(3999,\) arrived"):
        differentiate(TIME, position[1:], 20.0)
    broken = position.copy()
    broken[7] = np.nan
    with pytest.raises(InputError, match=r"sample 8 \(at 0.014 s\) is no finite number"):
        smoothed(TIME, broken, 20.0)
    with pytest.raises(InputError, match="says nothing of 300 Hz; ask below 250 Hz"):
        gain(20.0, STEP, 300.0)
