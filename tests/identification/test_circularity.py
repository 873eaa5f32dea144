"""Shapes whose parameters are known in closed form."""

import math
import time
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.faults.circularity import (
    bidirectional_circular_deviation,
    circular_deviation,
    circularity,
    mean_radial_deviation,
    radial_deviation,
)
from elastogeo.identification.faults.enclosing_circles import Centre, Path, arc_of, enclosed

Array = NDArray[np.float64]
RADIUS = 150.0
ECCENTRIC = (0.08, -0.05)
FULL = np.linspace(0.0, math.tau, 721)
CENTRES: tuple[Centre, ...] = ("minimum-zone", "least-squares")
each_centre = pytest.mark.parametrize("centre", CENTRES)


def path(shape: Callable[[Array], Array], at: tuple[float, float] = (0.0, 0.0), turn: Array = FULL) -> Path:
    """A shape about its own centre, as an instrument sees it whose centre is elsewhere."""
    x = at[0] + (RADIUS + shape(turn)) * np.cos(turn)
    y = at[1] + (RADIUS + shape(turn)) * np.sin(turn)
    return Path(np.arctan2(y, x), np.hypot(x, y) - RADIUS)


def lobes(order: int, amplitude: float = 0.01) -> Callable[[Array], Array]:
    return lambda turn: amplitude * np.cos(order * turn)


def constant(value: float) -> Callable[[Array], Array]:
    return lambda turn: np.full_like(turn, value)


def noise(seed: int, turn: Array = FULL) -> Path:
    return path(lambda t: np.random.default_rng(seed).normal(scale=0.002, size=len(t)), ECCENTRIC, turn)


@each_centre
def test_pure_eccentricity_is_no_circular_deviation(centre: Centre) -> None:
    eccentric = path(constant(0.0), (0.3, 0.4))
    assert circular_deviation(eccentric, RADIUS, centre) == pytest.approx(0.0, abs=1e-11)
    assert enclosed([eccentric], RADIUS, centre).centre == pytest.approx((0.3, 0.4), abs=1e-11)
    assert circular_deviation(eccentric, RADIUS, "set-up") == pytest.approx(1.0, rel=1e-4)


@each_centre
@pytest.mark.parametrize("at", [(0.0, 0.0), ECCENTRIC])
@pytest.mark.parametrize("order", [2, 3, 4, 12])
def test_lobes_are_twice_their_amplitude(centre: Centre, at: tuple[float, float], order: int) -> None:
    lobed = enclosed([path(lobes(order), at)], RADIUS, centre)
    assert lobed.separation == pytest.approx(0.02, abs=1e-6)
    assert lobed.centre == pytest.approx(at, abs=1e-6)


def test_the_ends_of_a_full_circle_and_an_overshoot_do_not_count_twice() -> None:
    beyond = np.linspace(-math.pi / 2, 2.5 * math.pi, 1441)
    for turn in (FULL, beyond):
        assert enclosed([path(lobes(2), ECCENTRIC, turn)], RADIUS, "least-squares").centre == pytest.approx(
            ECCENTRIC, abs=1e-8
        )


@each_centre
def test_a_larger_circle_is_radial_deviation_only(centre: Centre) -> None:
    larger, smaller = path(constant(0.012), ECCENTRIC), path(constant(-0.002), ECCENTRIC)
    assert circular_deviation(larger, RADIUS, centre) == pytest.approx(0.0, abs=1e-11)
    assert radial_deviation(larger, RADIUS) == pytest.approx((0.012, 0.012), abs=1e-11)
    assert radial_deviation(smaller, RADIUS) == pytest.approx((-0.002, -0.002), abs=1e-11)
    assert mean_radial_deviation(larger, smaller, RADIUS) == pytest.approx(0.005, abs=1e-11)
    assert bidirectional_circular_deviation(larger, smaller, RADIUS, centre) == pytest.approx(0.014, abs=1e-11)


def test_both_directions_count_the_same_in_the_mean() -> None:
    few = path(constant(0.01), turn=np.linspace(0, math.tau, 90))
    assert mean_radial_deviation(few, path(constant(0.0)), RADIUS) == pytest.approx(0.005, abs=1e-11)


@each_centre
def test_backlash_steps_show_in_both_directions_together(centre: Centre) -> None:
    turn = FULL[:-1] + math.radians(0.25)
    steps = 0.004 * np.sign(np.sin(2 * turn))
    ccw, cw = Path(turn, steps + 0.001), Path(turn[::-1], 0.001 - steps[::-1])
    for one in (ccw, cw):
        assert circular_deviation(one, RADIUS, centre) == pytest.approx(0.008, abs=1e-9)
        assert radial_deviation(one, RADIUS) == pytest.approx((0.005, -0.003), abs=1e-9)
    assert bidirectional_circular_deviation(ccw, cw, RADIUS, centre) == pytest.approx(0.008, abs=1e-9)
    hysteresis = Path(turn, np.full_like(turn, 0.003)), Path(turn, np.full_like(turn, -0.003))
    assert bidirectional_circular_deviation(*hysteresis, RADIUS, centre) == pytest.approx(0.006, abs=1e-11)
    assert mean_radial_deviation(*hysteresis, RADIUS) == pytest.approx(0.0, abs=1e-12)


def test_radial_deviation_with_the_set_up_has_its_eccentricity() -> None:
    eccentric = path(constant(0.0), (0.03, 0.0))
    assert radial_deviation(eccentric, RADIUS, "set-up") == pytest.approx((0.03, -0.03), abs=1e-9)
    assert radial_deviation(eccentric, RADIUS) == pytest.approx((0.0, 0.0), abs=1e-11)


def test_no_other_centre_has_less_separation() -> None:
    ragged = noise(4)
    best = enclosed([ragged], RADIUS, "minimum-zone")
    x, y = (RADIUS + ragged.radial) * np.cos(ragged.angle), (RADIUS + ragged.radial) * np.sin(ragged.angle)
    around = [step * np.array([np.cos(a), np.sin(a)]) for step in (1e-7, 1e-5, 1e-3) for a in np.linspace(0, math.tau, 24)]
    others = [np.ptp(np.hypot(x - best.centre[0] - dx, y - best.centre[1] - dy)) for dx, dy in around]
    assert min(others) > best.separation - 1e-9
    assert best.separation < circular_deviation(ragged, RADIUS, "least-squares")


@settings(derandomize=True, deadline=None, max_examples=30)
@given(st.integers(0, 1000), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(0, math.tau))
def test_the_place_and_the_turn_of_the_set_up_do_not_matter(seed: int, x: float, y: float, turned: float) -> None:
    bumps = np.random.default_rng(seed).normal(scale=0.003, size=4)
    shape = lambda t: sum(b * np.cos((k + 2) * t) for k, b in enumerate(bumps))  # noqa: E731
    here, there = path(shape), path(lambda t: shape(t - turned), (x, y), FULL + turned)
    for centre in CENTRES:
        assert circular_deviation(there, RADIUS, centre) == pytest.approx(circular_deviation(here, RADIUS, centre), abs=1e-7)
    assert circular_deviation(here, RADIUS) <= circular_deviation(here, RADIUS, "least-squares") + 1e-10


def test_partial_arcs() -> None:
    arc = np.linspace(math.radians(-20), math.radians(200), 441)
    assert math.degrees(arc_of(arc)) == pytest.approx(220.0)
    assert arc_of(FULL) == math.tau
    part = path(constant(0.005), ECCENTRIC, arc)
    for centre in CENTRES:
        assert circular_deviation(part, RADIUS, centre) == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(UnsupportedError, match=r"radial deviation F .* needs a full circle; the path covers 22\d\.?\d* deg"):
        radial_deviation(part, RADIUS)
    with pytest.raises(UnsupportedError, match="mean bi-directional radial deviation D needs a full circle"):
        mean_radial_deviation(path(constant(0.0)), part, RADIUS)
    with pytest.raises(UnsupportedError, match=r"CCW path covers 360 deg, the CW path 2.* not the same ones"):
        bidirectional_circular_deviation(path(constant(0.0)), part, RADIUS)
    short = path(constant(0.005), turn=np.linspace(0, 1.0, 50))
    with pytest.raises(
        UnsupportedError, match=r"minimum-zone centre needs an arc of 180 deg or more, the path covers 57.3 deg"
    ):
        circular_deviation(short, RADIUS)
    assert circular_deviation(short, RADIUS, "set-up") == pytest.approx(0.0, abs=1e-12)
    assert radial_deviation(short, RADIUS, "set-up") == pytest.approx((0.005, 0.005), abs=1e-12)


def test_all_parameters_of_a_test() -> None:
    ccw, cw = path(lobes(2), ECCENTRIC), path(lambda t: lobes(2)(t) + 0.002, ECCENTRIC)
    result = circularity(RADIUS, ccw, cw)
    found = (result.g_ccw, result.g_cw, result.g_bidirectional, result.mean_radial)
    assert found == pytest.approx((0.02, 0.02, 0.022, 0.001), abs=1e-6)
    found = (result.f_max_ccw, result.f_min_ccw, result.f_max_cw, result.f_min_cw)
    assert found == pytest.approx((0.01, -0.01, 0.012, -0.008), abs=1e-6)
    assert result.not_determined == ()


def test_what_a_test_does_not_determine_says_why() -> None:
    arc = np.linspace(0, math.radians(220), 441)
    result = circularity(RADIUS, path(lobes(2), turn=arc), path(lobes(2), turn=arc))
    assert result.g_ccw is not None
    assert result.g_bidirectional is not None
    assert (result.f_max_ccw, result.f_min_cw, result.mean_radial) == (None, None, None)
    assert [line.split(":")[0] for line in result.not_determined] == [
        "f_max_ccw",
        "f_min_ccw",
        "f_max_cw",
        "f_min_cw",
        "mean_radial",
    ]
    single = circularity(RADIUS, cw=path(lobes(2)), centre="set-up")
    assert single.g_cw == pytest.approx(0.02)
    assert "g_ccw: there is no CCW run" in single.not_determined
    assert "mean_radial: both directions are needed" in single.not_determined
    short = circularity(RADIUS, path(lobes(2), turn=arc / 3), path(lobes(2), turn=arc / 3))
    assert short.g_ccw is None
    assert short.g_bidirectional is None


BAD: dict[str, Callable[[], object]] = {
    r"shapes \(2,\), \(2,\)": lambda: Path(np.zeros(2), np.zeros(2)),
    r"shapes \(3,\), \(4,\)": lambda: Path(np.zeros(3), np.zeros(4)),
    "no finite number; take the reading out": lambda: Path(np.zeros(3), np.array([0.0, np.nan, 0.0])),
    "nominal radius is 0.0 mm; it must be above zero": lambda: circular_deviation(path(lobes(2)), 0.0),
    "must be deviations from it, in mm": lambda: circular_deviation(Path(FULL, np.full_like(FULL, -200.0)), RADIUS),
    "centre 'middle' is not known; choose one of": lambda: enclosed([path(lobes(2))], RADIUS, "middle"),  # type: ignore[arg-type]
    "needs a path, counter-clockwise or clockwise": lambda: circularity(RADIUS),
}


@pytest.mark.parametrize("message", BAD)
def test_wrong_input_is_told(message: str) -> None:
    with pytest.raises(InputError, match=message):
        BAD[message]()


def test_a_hundred_thousand_readings_take_a_second_at_most() -> None:
    many = noise(5, np.linspace(0.0, math.tau, 100_000))
    start = time.process_time()
    found = enclosed([many], RADIUS, "minimum-zone")
    assert time.process_time() - start < 1
    assert found.centre == pytest.approx(ECCENTRIC, abs=1e-3)
