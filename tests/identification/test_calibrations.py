"""Calibrations of the bar's force and of the set-up: golden values, the GUM's straight line, the rates of their checks."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.calibrations import calibrate_force, calibrate_setup
from elastogeo.observe import force_from_pressure

THESIS_BAR = np.array([0.4, 1, 2, 3, 4, 5, 6])
THESIS_N = np.array([36.0, 112, 238, 364, 490, 616, 742])
"""Thesis 4.6 and 5.6.1: the pressures and the forces that they correspond to."""


def test_the_thesis_pairs_give_126_newtons_per_bar_less_14() -> None:
    """Six pairs are exact; 36 N at 0.4 bar is 36.4 cut off."""
    exact = calibrate_force(THESIS_BAR[1:], THESIS_N[1:])
    assert exact.slope.value == pytest.approx(126.0, rel=1e-12)
    assert exact.offset.value == pytest.approx(-14.0, rel=1e-10)
    assert exact.verdict[0].passed is True
    found = calibrate_force(THESIS_BAR, THESIS_N)
    assert found.slope.value == pytest.approx(126.0, abs=0.1)
    assert found.offset.value == pytest.approx(-14.0, abs=0.3)
    for pressure, force in zip(THESIS_BAR, THESIS_N, strict=True):
        assert force_from_pressure(pressure, found.calibration) == pytest.approx(force, abs=0.4)


def test_the_straight_line_of_the_gum() -> None:
    """JCGM 100, H.3: a thermometer's correction against temperature less 20 degrees; y1, y2, s, r and the printed digits."""
    reading = np.array([21.521, 22.012, 22.512, 23.003, 23.507, 23.999, 24.513, 25.002, 25.503, 26.010, 26.511])
    correction = np.array([171, 169, 166, 159, 164, 165, 156, 157, 159, 161, 160]) * -1e-3
    found = calibrate_force(reading - 20.0, correction)
    assert found.offset.value == pytest.approx(-0.1712, abs=5e-5)
    assert found.offset.standard_uncertainty == pytest.approx(0.0029, abs=5e-5)
    assert found.slope.value == pytest.approx(0.00218, abs=5e-6)
    assert found.slope.standard_uncertainty == pytest.approx(0.00067, abs=5e-6)
    assert found.correlation == pytest.approx(-0.930, abs=5e-4)
    assert found.residual_std == pytest.approx(0.0035, abs=5e-5)
    assert found.slope.degrees_of_freedom == pytest.approx(9)


def ramps(random: np.random.Generator, noise: float, bend: float = 0.0, friction: float = 0.0) -> tuple[np.ndarray, ...]:
    """Two ramps up and down, 0.5 to 6 bar: 126 N/bar - 14 N, a bend [N] in the middle, a friction [N] against the way."""
    up = np.linspace(0.5, 6.0, 8)
    pressure = np.concatenate([up, up[::-1], up, up[::-1]])
    way = np.repeat([1.0, -1.0, 1.0, -1.0], 8)
    middle = 1 - ((pressure - 3.25) / 2.75) ** 2
    force = 126 * pressure - 14 + bend * middle - friction * way + noise * random.standard_normal(len(pressure))
    return pressure, force


def covered(count: int, trials: int) -> tuple[float, float]:
    """99.9 % interval of how many of so many trials cover at 95 %."""
    low, high = stats.binom.interval(0.999, trials, 0.95)
    assert low < count < high, count
    return low, high


def test_the_intervals_cover_slope_offset_and_force_at_any_pressure() -> None:
    random, trials = np.random.default_rng(11), 400
    hits = np.zeros(3)
    for _ in range(trials):
        found = calibrate_force(*ramps(random, 2.0))
        at = found.calibration.influences(2.0)
        u = np.sqrt(sum((part.standard_uncertainty * part.force) ** 2 for part in at))
        error = force_from_pressure(2.0, found.calibration) - 238.0
        k = stats.t.ppf(0.975, at[0].degrees_of_freedom)
        hits += [
            found.slope.interval()[0] < 126 < found.slope.interval()[1],
            found.offset.interval()[0] < -14 < found.offset.interval()[1],
            abs(error) < k * u,
        ]
    for hit in hits:
        covered(int(hit), trials)


def test_the_load_cell_stretches_slope_and_offset() -> None:
    found = calibrate_force(*ramps(np.random.default_rng(1), 0.0), relative=0.005, relative_degrees_of_freedom=20)
    assert found.slope.standard_uncertainty == pytest.approx(0.005 * 126)
    assert found.offset.standard_uncertainty == pytest.approx(0.005 * 14)
    assert found.slope.degrees_of_freedom == pytest.approx(20)
    (*_, cell) = found.calibration.influences(3.0)
    assert (cell.label, cell.standard_uncertainty, cell.degrees_of_freedom) == ("load cell", 0.005, 20)
    assert cell.force == pytest.approx(126 * 3 - 14)


def test_the_checks_alarm_at_their_rate_and_see_their_fault() -> None:
    """One in a hundred without a fault; a bend, or a friction, of twice the noise in nineteen of twenty."""
    random, trials = np.random.default_rng(3), 250
    alarms, missed = np.zeros(2), np.zeros(2)
    for _ in range(trials):
        line, way = calibrate_force(*ramps(random, 1.0)).verdict
        alarms += [line.passed is False, way.passed is False]
        bent = calibrate_force(*ramps(random, 1.0, bend=4.0)).verdict[0]
        rubbing = calibrate_force(*ramps(random, 1.0, friction=1.0)).verdict[1]
        missed += [bent.passed is not False, rubbing.passed is not False]
    print(alarms / trials, missed / trials)
    assert (alarms <= stats.binom.ppf(0.9995, trials, 0.01)).all()
    assert (missed <= stats.binom.ppf(0.9995, trials, 0.05)).all()


def test_readings_that_bend_become_a_table_of_their_levels() -> None:
    found = calibrate_force(*ramps(np.random.default_rng(5), 1.0, bend=30.0))
    assert found.verdict[0].passed is False
    assert not found.is_line
    assert len(found.calibration.pressure) == 8
    middle = found.calibration.pressure[3]
    true = 126 * middle - 14 + 30 * (1 - ((middle - 3.25) / 2.75) ** 2)
    u = found.calibration.standard_uncertainty[3]
    assert u == pytest.approx(0.5, rel=0.5)
    assert abs(force_from_pressure(middle, found.calibration) - true) < 4 * u
    with pytest.raises(InputError, match=r"7 bar lies outside the force calibration, 0\.5 to 6 bar"):
        force_from_pressure(7.0, found.calibration)


def test_rising_pressure_alone_does_not_test_the_friction() -> None:
    check = calibrate_force(THESIS_BAR, THESIS_N).verdict[1]
    assert check.passed is None
    assert check.facts["why"] == "one way"


def test_the_set_up_of_the_thesis_gives_way_by_233_um_per_bar() -> None:
    """Eq. 5.38 as readings: at the horizontal, and with the bar raised by 30 degrees."""
    pressure = np.tile(THESIS_BAR, 2)
    elevation = np.repeat(np.deg2rad([0.0, 30.0]), len(THESIS_BAR))
    deflection = 2.33e-3 * pressure * np.cos(elevation) ** 2 + 0.05
    found = calibrate_setup(pressure, deflection, elevation)
    assert found.per_pressure.value == pytest.approx(2.33e-3, rel=1e-9)
    assert found.zero.value == pytest.approx(0.05, rel=1e-9)
    noisy = deflection + 2e-4 * np.random.default_rng(4).standard_normal(len(pressure))
    low, high = calibrate_setup(pressure, noisy, elevation).per_pressure.interval()
    assert low < 2.33e-3 < high
    assert high - low < 2e-4
    level = calibrate_setup(pressure, noisy)
    assert level.per_pressure.value < 0.95 * 2.33e-3  # what forgetting the elevation costs


@pytest.mark.parametrize(
    ("pressure", "force", "error", "message"),
    [
        ([1, 2, 3], [1, 2], InputError, "every pressure needs one force"),
        ([1, 2, 3], [1, 2, 3], UnsupportedError, "3 readings are too few for this calibration; take 4"),
        ([2, 2, 2, 2], [1, 2, 3, 4], UnsupportedError, "the pressure is 2 bar at every reading"),
        ([1, 2, 3, 4], [1, 2, np.nan, 4], InputError, "the force of reading 3 is nan; remove the reading"),
    ],
)
def test_what_is_no_calibration_is_refused(
    pressure: list[float], force: list[float], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        calibrate_force(np.array(pressure, dtype=float), np.array(force, dtype=float))


def test_a_bar_that_stands_upright_bends_no_post() -> None:
    with pytest.raises(InputError, match="stands upright at every reading"):
        calibrate_setup(THESIS_BAR, THESIS_N, np.pi / 2)
