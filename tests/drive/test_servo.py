"""Servo stiffness: its limits, against a state space of the same loops and their motion in time, what makes it stiffer."""

from __future__ import annotations

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import StateSpace, lsim

from elastogeo.drive.servo import ServoLoop, complex_stiffness, poles, servo_stiffness, static_stiffness
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.machine import Array

RIGID = ServoLoop(
    position_gain=30.0,
    velocity_gain=900.0,  # 0.9 N m s/rad
    inertia=6.0,  # 0.006 kg m^2, Table 6.4
    transmission_ratio=10 / (2 * pi),
    integral_time=0.02,
    viscous=90.0,
)
ELASTIC = replace(RIGID, inertia=4.0, table_mass=0.8, transmission_stiffness=1.5e5, transmission_damping=100.0)
ELECTRIC = replace(ELASTIC, electrical_frequency=400.0, electrical_damping=0.7)
LOOPS = {
    "rigid": RIGID,
    "rigid, no integrator": replace(RIGID, integral_time=None),
    "motor": ELASTIC,
    "motor, no integrator": replace(ELASTIC, integral_time=None),
    "motor, electric": ELECTRIC,
    "scale": replace(ELASTIC, feedback="scale"),
    "scale, no integrator": replace(ELASTIC, feedback="scale", integral_time=None),
    "scale, electric": replace(ELECTRIC, feedback="scale"),
}
FREQUENCY = np.geomspace(0.1, 2000.0, 60)


@pytest.fixture(params=LOOPS)
def loop(request: pytest.FixtureRequest) -> ServoLoop:
    return LOOPS[request.param]


def state_space(loop: ServoLoop) -> tuple[Array, Array, Array]:
    """Motion of motor angle, table, integrator and current loop, in motor coordinates [rad], force in, table out.

    States: angle, its speed, table, its speed, integral of the speed error, motor torque, its rate.
    """
    r, electric = loop.transmission_ratio, loop.electrical_frequency is not None
    elastic = loop.transmission_stiffness is not None
    A, B = np.zeros((7, 7)), np.zeros((7, 1))
    angle, speed, table, rate, integral, torque, jerk = np.eye(7)
    seen = table if loop.feedback == "scale" else r * angle
    error = -loop.position_gain * seen / r - speed
    command = loop.velocity_gain * (error + (integral / loop.integral_time if loop.integral_time else 0))
    w = 2 * pi * (loop.electrical_frequency or 1.0)
    drive = torque if electric else command
    spring = np.zeros(7)
    if elastic:
        spring = loop.transmission_stiffness * (r * angle - table) + loop.transmission_damping * (r * speed - rate)
        A[3], B[3] = spring / loop.table_mass, 1 / loop.table_mass
    A[0], A[2], A[4] = speed, rate, error
    inertia = loop.inertia + (0 if elastic else loop.table_mass * r**2)
    A[1] = (drive - loop.viscous * speed - r * spring) / inertia
    if not elastic:
        B[1] = r / inertia
    if electric:
        A[5], A[6] = jerk, w**2 * (command - torque) - 2 * loop.electrical_damping * w * jerk
    kept = [0, 1] + ([2, 3] if elastic else []) + ([4] if loop.integral_time else []) + ([5, 6] if electric else [])
    return A[np.ix_(kept, kept)], B[kept], (table if elastic else r * angle)[np.newaxis, kept]


def test_the_closed_form_is_that_of_the_state_space(loop: ServoLoop) -> None:
    A, B, C = state_space(loop)
    compliance = np.array([(C @ np.linalg.solve(2j * pi * f * np.eye(len(A)) - A, B))[0, 0] for f in FREQUENCY])
    assert_allclose(complex_stiffness(loop, FREQUENCY) * compliance, 1.0, rtol=0, atol=1e-9)


def test_the_poles_are_the_eigenvalues_of_the_state_space(loop: ServoLoop) -> None:
    A, _, _ = state_space(loop)
    assert_allclose(np.sort_complex(poles(loop)), np.sort_complex(np.linalg.eigvals(A)), rtol=1e-6)


@pytest.mark.parametrize("name", ["rigid", "motor", "scale, no integrator"])
def test_a_force_that_swings_moves_the_table_by_force_over_stiffness_in_time(name: str) -> None:
    frequency, loop = 25.0, LOOPS[name]
    time = np.linspace(0, 4.0, 40_001)
    _, moved, _ = lsim(StateSpace(*state_space(loop), np.zeros((1, 1))), 100 * np.sin(2 * pi * frequency * time), time)
    late = time > 3.0  # the transient has died by then: the slowest pole is faster than -10 1/s
    assert poles(loop).real.max() < -10
    amplitude = 2 * abs(np.mean(moved[late] * np.exp(-2j * pi * frequency * time[late])))
    assert 100 / amplitude == pytest.approx(servo_stiffness(loop, np.array([frequency])).stiffness[0], rel=1e-3)


@pytest.mark.parametrize("name", ["motor", "motor, no integrator", "scale, no integrator", "rigid, no integrator"])
def test_a_steady_force_moves_the_table_by_force_over_static_stiffness_in_time(name: str) -> None:
    loop = LOOPS[name]
    time = np.linspace(0, 3.0, 6001)
    _, moved, _ = lsim(StateSpace(*state_space(loop), np.zeros((1, 1))), np.full(len(time), 100.0), time)
    assert 100 / moved[-1] == pytest.approx(static_stiffness(loop), rel=1e-6)


def test_static_stiffness_of_each_structure() -> None:
    servo = 900.0 * 30.0 / (10 / (2 * pi)) ** 2
    assert static_stiffness(LOOPS["rigid"]) == static_stiffness(LOOPS["scale"]) == inf
    assert static_stiffness(LOOPS["motor"]) == 1.5e5
    for name in ("rigid, no integrator", "scale, no integrator"):
        assert static_stiffness(LOOPS[name]) == pytest.approx(servo, rel=1e-14)
    assert static_stiffness(LOOPS["motor, no integrator"]) == pytest.approx(servo * 1.5e5 / (servo + 1.5e5), rel=1e-14)


def test_slow_forces_meet_the_static_stiffness(loop: ServoLoop) -> None:
    slow = np.abs(complex_stiffness(loop, np.array([1e-5, 1e-4])))
    if static_stiffness(loop) == inf:  # the integrator: the stiffness falls with the frequency
        assert slow[0] == pytest.approx(10 * slow[1], rel=1e-3)
    else:
        assert_allclose(slow, static_stiffness(loop), rtol=1e-4)


def test_fast_forces_meet_the_mass(loop: ServoLoop) -> None:
    mass = loop.table_mass or loop.inertia / loop.transmission_ratio**2
    fast = np.array([1e6, 1e7])
    assert_allclose(complex_stiffness(loop, fast), -mass * (2 * pi * fast) ** 2, rtol=1e-3)


def test_a_stiff_transmission_is_a_rigid_one_and_the_loop_may_then_close_anywhere() -> None:
    rigid = replace(RIGID, inertia=4.0, table_mass=0.8)
    stiff = replace(rigid, transmission_stiffness=1e13)
    for feedback in ("motor", "scale"):
        assert_allclose(
            complex_stiffness(replace(stiff, feedback=feedback), FREQUENCY), complex_stiffness(rigid, FREQUENCY), rtol=1e-4
        )


def test_only_the_torque_over_the_ratio_squared_counts() -> None:
    linear = replace(RIGID, velocity_gain=900 / RIGID.transmission_ratio**2, inertia=6 / RIGID.transmission_ratio**2)
    linear = replace(linear, viscous=90 / RIGID.transmission_ratio**2, transmission_ratio=1.0)
    assert_allclose(complex_stiffness(linear, FREQUENCY), complex_stiffness(RIGID, FREQUENCY), rtol=1e-13)


def test_a_dead_time_is_what_many_short_lags_in_a_row_are() -> None:
    """exp(-s T) as the limit of (1 + s T / n)^-n, with error s^2 T^2 / (2 n)."""
    late = replace(RIGID, dead_time=1e-3)
    s, n, P = 2j * pi * FREQUENCY, 10**7, 900.0 / RIGID.transmission_ratio**2
    D = P * (1 + 1 / (0.02 * s)) * (1 + s * 1e-3 / n) ** -n
    expected = (6.0 * s**2 + 90.0 * s) / RIGID.transmission_ratio**2 + D * (30.0 + s)
    assert_allclose(complex_stiffness(late, FREQUENCY), expected, rtol=2e-5)
    assert poles(late).real.max() < 0


@pytest.mark.parametrize("name", [name for name, loop in LOOPS.items() if loop.integral_time])
def test_the_minimum_lies_between_the_frequencies_and_is_that_of_a_fine_search(name: str) -> None:
    """With an integrator, that is: without, the stiffness of these drives rises from the start."""
    coarse = servo_stiffness(LOOPS[name], np.geomspace(0.5, 500.0, 40))
    fine = np.geomspace(0.5, 500.0, 40_000)
    stiffness = np.abs(complex_stiffness(LOOPS[name], fine))
    assert coarse.minimum_inside
    assert coarse.minimum == pytest.approx(stiffness.min(), rel=1e-6)
    assert coarse.minimum_frequency == pytest.approx(fine[stiffness.argmin()], rel=1e-3)
    assert coarse.minimum <= coarse.stiffness.min()


def test_a_minimum_at_the_edge_is_said_to_be_there() -> None:
    found = servo_stiffness(ELASTIC, np.array([1.0, 2.0, 3.0]))
    assert not found.minimum_inside
    assert found.minimum_frequency == 3.0


@pytest.mark.parametrize(
    ("stiffer", "lowest"),
    [
        ({"position_gain": 36.0}, 1.0),
        ({"velocity_gain": 1100.0}, 1.0),
        ({"transmission_stiffness": 2e5}, 1.0),
        ({"transmission_damping": 200.0}, 65.0),
        ({"electrical_frequency": 600.0}, 1.0),
        ({"table_mass": 0.6}, 1.0),
        ({"dead_time": 0.0}, 1.0),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_what_stiffens_a_drive_dynamically_as_section_2_7_says(stiffer: dict[str, float], lowest: float) -> None:
    """Gain, stiffness and electrical frequency up, or mass and sampling period down: the least dynamic stiffness rises.

    Damping of the transmission raises the valley of the mechanics (73 Hz here), and lowers that of the servo by 0.1 %. The
    damping of the electrical parts, which section 2.7 says to soften the drive, is left out: its loop is another one.
    """
    plain, frequency = replace(ELECTRIC, dead_time=1e-4), np.geomspace(lowest, 500.0, 400)
    before, after = (servo_stiffness(servo, frequency) for servo in (plain, replace(plain, **stiffer)))
    assert after.minimum > before.minimum
    assert before.minimum_inside


def test_an_unstable_servo_has_no_stiffness() -> None:
    """A rigid drive without friction by Routh: `M s^3 + P s^2 + P (K_v + 1/T) s + P K_v/T` is stable if and only if
    `T > (K_v - a) / (a K_v)` with a = P / M."""
    a, K_v = 900.0 / 6.0, 400.0
    border = (K_v - a) / (a * K_v)
    loop = replace(RIGID, viscous=0.0, position_gain=K_v)
    assert poles(replace(loop, integral_time=border * 1.001)).real.max() < 0
    assert poles(replace(loop, integral_time=border * 0.999)).real.max() > 0
    with pytest.raises(UnsupportedError, match=r"the servo is unstable \(a pole at \+.* 1/s\)"):
        complex_stiffness(replace(loop, integral_time=border * 0.9), FREQUENCY)


def test_a_dead_time_makes_it_unstable_where_the_phase_says() -> None:
    """Rigid, no friction, no integrator: `M w^2 = P |K_v + j w|` gives the crossing, `w T = atan(w / K_v)` the longest T."""
    loop = replace(RIGID, integral_time=None, viscous=0.0)
    a, K_v = 900.0 / 6.0, 30.0
    crossing = np.sqrt((a**2 + np.sqrt(a**4 + 4 * a**2 * K_v**2)) / 2)
    longest = np.arctan(crossing / K_v) / crossing
    assert poles(replace(loop, dead_time=0.999 * longest)).real.max() < 0
    assert poles(replace(loop, dead_time=1.001 * longest)).real.max() > 0


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"position_gain": 0.0}, "position_gain is 0; it must be positive"),
        ({"velocity_gain": np.nan}, "velocity_gain is nan"),
        ({"integral_time": 0.0}, "integral_time is 0"),
        ({"table_mass": -1.0}, "table_mass is -1; it must be finite and not negative"),
        ({"dead_time": inf}, "dead_time is inf"),
        ({"feedback": "laser"}, "closed on 'laser'; say motor or scale"),
        ({"transmission_damping": 1.0}, "damping but no stiffness"),
        ({"transmission_stiffness": 1e5}, "moves no table_mass"),
    ],
)
def test_a_contradictory_servo_is_refused(fields: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(RIGID, **fields)  # type: ignore[arg-type]


@pytest.mark.parametrize("frequency", [[0.0, 1.0], [-1.0], [np.nan], []])
def test_frequencies_are_positive(frequency: list[float]) -> None:
    with pytest.raises(InputError, match="positive, finite frequencies"):
        complex_stiffness(RIGID, np.array(frequency))


def test_frequencies_rise() -> None:
    with pytest.raises(InputError, match="must rise"):
        servo_stiffness(RIGID, np.array([2.0, 1.0]))
