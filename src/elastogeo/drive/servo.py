"""Stiffness of a position servo, static and dynamic, from the parameters of its loops (section 2.7, Figure 2.19).

The standard cascade: a proportional position loop (K_v) commands a speed, a proportional-integral speed loop (K_p, T_i)
commands a torque, the current loop turns it into torque late (a second-order lag, a dead time). A force F on the table
moves it by x; the dynamic stiffness is F(s) / x(s) at s = j omega. All in axis coordinates, `P = K_p / r_g^2`,
`M = J / r_g^2`, `B = b / r_g^2`, motor position x_m (as axis position), table position x, no command:

    controller   D = P (1 + 1 / (T_i s)) exp(-s T) / (1 + 2 zeta s / w + s^2 / w^2)
    motor        (M s^2 + B s) x_m + k (x_m - x) = -D (K_v y + s x_m),    k = transmission stiffness + damping s
    table        m s^2 x + k (x - x_m) = F

where y is x_m if the position loop is closed on the motor encoder and x if it is closed on a scale. Eliminating x_m gives

    on the motor   F / x = m s^2 + k Z / (Z + k),                         Z = M s^2 + B s + D (K_v + s)
    on the scale   F / x = m s^2 + k (Z + D K_v) / (Z + k),               Z = M s^2 + B s + D s
    rigid          F / x = (M + m) s^2 + B s + D (K_v + s)

At s = 0 with an integrator D grows without bound: on the motor the transmission k alone is left, on the scale (and for a
rigid transmission) the static stiffness is infinite. Without one it is `P K_v = K_p K_v / r_g^2`, in series with k if the
loop is closed on the motor. **Friction, backlash, saturation and feed forward are not in it**: Coulomb friction makes an
axis at rest look stiffer than this for small forces, and a force beyond the current limit makes it yield.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, isfinite, pi

import numpy as np
from numpy.polynomial import polynomial as poly
from numpy.typing import ArrayLike, NDArray

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.machine import Array, Damping, Frequency, Inertia, Time

FEEDBACKS = ("motor", "scale")

_PADE = 3
"""Order of the rational stand-in for the dead time, in the judgement of stability alone."""


@dataclass(frozen=True, slots=True)
class ServoLoop:
    """Loop parameters of a position servo.

    Attributes
    ----------
    position_gain : float [1/s]
        K_v; 1 (m/min)/mm is 16.67 1/s.
    velocity_gain : float [N mm s/rad]
        K_p: torque of the motor per error of its speed. A gain in A s/rad is to be multiplied by the torque constant. Of a
        linear motor force per speed [N s/mm], with the transmission ratio 1.
    inertia : float [N mm s^2]
        J, all that turns rigidly with the motor; 1 kg m^2 is 1000 N mm s^2. Of a linear motor mass [N s^2/mm]. For a rigid
        transmission it may hold the table as well.
    transmission_ratio : float [mm/rad]
        r_g, travel per turn of the motor (Eq. 6.11).
    integral_time : float or None [s]
        T_i of the speed loop; None without integrator.
    table_mass : float [N s^2/mm]
        m, what moves behind the transmission; 1000 kg is 1 N s^2/mm.
    transmission_stiffness : float or None [N/mm]
        Of screw, nut, coupling and bearing; None for a rigid one.
    transmission_damping : float [N s/mm]
    viscous : float [N mm s/rad]
        B, viscous friction at the motor.
    electrical_frequency : float or None [Hz]
        w / (2 pi), nominal frequency of the current loop; None if it is fast.
    electrical_damping : float
        zeta, its damping ratio.
    dead_time : float or None [s]
        Of sampling and computation.
    feedback : str
        Where the position loop is closed: one of `FEEDBACKS`.
    """

    position_gain: float
    velocity_gain: Damping
    inertia: Inertia
    transmission_ratio: float = 1.0
    integral_time: Time | None = None
    table_mass: float = 0.0
    transmission_stiffness: float | None = None
    transmission_damping: float = 0.0
    viscous: Damping = 0.0
    electrical_frequency: Frequency | None = None
    electrical_damping: float = 1.0
    dead_time: Time | None = None
    feedback: str = "motor"

    def __post_init__(self) -> None:
        """Refuse what is no servo."""
        if self.feedback not in FEEDBACKS:
            raise InputError(f"a position loop is closed on {self.feedback!r}; say {' or '.join(FEEDBACKS)}")
        positive = {
            name: getattr(self, name) for name in ("position_gain", "velocity_gain", "inertia", "transmission_ratio")
        }
        optional = ("integral_time", "transmission_stiffness", "electrical_frequency", "electrical_damping")
        positive |= {name: getattr(self, name) for name in optional if getattr(self, name) is not None}
        for name, value in positive.items():
            if not (isfinite(value) and value > 0):
                raise InputError(f"the servo's {name} is {value:g}; it must be positive and finite")
        for name in ("table_mass", "transmission_damping", "viscous", "dead_time"):
            value = getattr(self, name)
            if value is not None and not (isfinite(value) and value >= 0):
                raise InputError(f"the servo's {name} is {value:g}; it must be finite and not negative")
        if self.transmission_stiffness is None and self.transmission_damping:
            raise InputError("the servo's transmission has damping but no stiffness; a rigid one damps nothing, give both")
        if self.transmission_stiffness is not None and not self.table_mass:
            raise InputError("the servo's transmission yields but moves no table_mass; give the mass behind it")


@dataclass(frozen=True, slots=True)
class ServoStiffness:
    """Stiffness of a servo against a force on the table.

    Attributes
    ----------
    frequency : array, shape (m,) [Hz]
    stiffness : array, shape (m,) [N/mm]
        Dynamic stiffness |F / x|.
    static : float [N/mm]
        At frequency zero; infinite with an integrator that sees the table.
    minimum : float [N/mm]
        Least dynamic stiffness over these frequencies, refined between them.
    minimum_frequency : float [Hz]
        Where it is.
    minimum_inside : bool
        Whether it lies between the frequencies; if not, it may be less beyond them.
    """

    frequency: Array
    stiffness: Array
    static: float
    minimum: float
    minimum_frequency: float
    minimum_inside: bool


def static_stiffness(loop: ServoLoop) -> float:
    """Static stiffness of a servo [N/mm], the limit of the dynamic one at frequency zero.

    Infinite where an integrator holds the position that the loop sees; `K_p K_v / r_g^2` without one. A transmission outside
    the loop (closed on the motor) is in series with it.
    """
    servo = inf if loop.integral_time is not None else loop.velocity_gain * loop.position_gain / loop.transmission_ratio**2
    outside = loop.transmission_stiffness if loop.feedback == "motor" else None
    if outside is None:
        return servo
    return outside if servo == inf else 1.0 / (1.0 / servo + 1.0 / outside)


def complex_stiffness(loop: ServoLoop, frequency: Array) -> NDArray[np.complex128]:
    """Force per displacement of the table, shape (m,) [N/mm], complex: its phase is that of the force before the motion.

    Parameters
    ----------
    loop : ServoLoop
    frequency : array, shape (m,) [Hz]
        Positive.

    Raises
    ------
    InputError
        If a frequency is not positive: at zero ask for `static_stiffness`.
    UnsupportedError
        If the loop is unstable: it then holds no position.
    """
    frequency = np.atleast_1d(np.asarray(frequency, float))
    if not len(frequency) or not (np.isfinite(frequency) & (frequency > 0)).all():
        raise InputError("the dynamic stiffness needs positive, finite frequencies; at zero ask for the static stiffness")
    fastest = float(poles(loop).real.max())
    if fastest >= 0:
        raise UnsupportedError(
            f"with these parameters the servo is unstable (a pole at {fastest:+.3g} 1/s), so it has no stiffness; "
            f"check the units of the gains, the inertia and the times"
        )
    s = 2j * pi * frequency
    controller = np.full(s.shape, loop.velocity_gain / loop.transmission_ratio**2, dtype=np.complex128)
    if loop.integral_time is not None:
        controller *= 1 + 1 / (loop.integral_time * s)
    if loop.electrical_frequency is not None:
        ratio = s / (2 * pi * loop.electrical_frequency)
        controller /= 1 + 2 * loop.electrical_damping * ratio + ratio**2
    controller *= np.exp(-s * (loop.dead_time or 0.0))
    motor = (loop.inertia * s**2 + loop.viscous * s) / loop.transmission_ratio**2 + controller * s
    position, table = controller * loop.position_gain, loop.table_mass * s**2
    if loop.transmission_stiffness is None:
        return np.asarray(table + motor + position)
    spring = loop.transmission_stiffness + loop.transmission_damping * s
    if loop.feedback == "motor":
        # In series as compliances: with an integrator the motor's stiffness is huge near zero, and products overflow first.
        return np.asarray(table + 1 / (1 / (motor + position) + 1 / spring))
    return np.asarray(table + spring * (motor + position) / (motor + spring))


def servo_stiffness(loop: ServoLoop, frequency: Array) -> ServoStiffness:
    """Static and dynamic stiffness of a servo over frequency, with its minimum.

    Parameters
    ----------
    loop : ServoLoop
    frequency : array, shape (m,) [Hz]
        Positive and rising, close enough to see the valleys.

    Raises
    ------
    InputError
        If the frequencies are not positive and rising.
    UnsupportedError
        If the loop is unstable.
    """
    from scipy.optimize import minimize_scalar

    frequency = np.atleast_1d(np.asarray(frequency, float))
    if not (np.diff(frequency) > 0).all():
        raise InputError("the frequencies of the dynamic stiffness must rise; sort them and leave doubles out")
    stiffness = np.abs(complex_stiffness(loop, frequency))
    least = int(stiffness.argmin())
    inside = 0 < least < len(frequency) - 1
    minimum, at = float(stiffness[least]), float(frequency[least])
    if inside:
        found = minimize_scalar(
            lambda f: float(np.abs(complex_stiffness(loop, np.array([f])))[0]),
            bounds=(frequency[least - 1], frequency[least + 1]),
            method="bounded",
            options={"xatol": 1e-6 * at},
        )
        if found.fun < minimum:
            minimum, at = float(found.fun), float(found.x)
    return ServoStiffness(frequency, stiffness, static_stiffness(loop), minimum, at, inside)


def poles(loop: ServoLoop) -> NDArray[np.complex128]:
    """Poles of the closed loop, shape (n,) [1/s]: the servo is stable if all have a negative real part.

    They are the zeros of the stiffness. A dead time is replaced by its third-order Pade approximant, which stands for it up
    to about `1 / dead_time` in angular frequency.
    """
    ratio = loop.transmission_ratio**2
    above, below = _controller(loop)
    mass = np.array([0.0, 0.0, loop.table_mass])
    motor = poly.polyadd(
        poly.polymul([0.0, loop.viscous / ratio, loop.inertia / ratio], below), poly.polymul([0.0, 1.0], above)
    )
    closed = poly.polyadd(motor, loop.position_gain * above)
    if loop.transmission_stiffness is None:
        characteristic = np.asarray(poly.polyadd(poly.polymul(mass, below), closed))
    else:
        spring = [loop.transmission_stiffness, loop.transmission_damping]
        beside = poly.polyadd(closed if loop.feedback == "motor" else motor, poly.polymul(spring, below))
        characteristic = poly.polyadd(poly.polymul(mass, beside), poly.polymul(spring, closed))
    return _zeros(np.asarray(characteristic))


def _controller(loop: ServoLoop) -> tuple[Array, Array]:
    """Numerator and denominator of D(s), ascending powers."""
    above: Array = np.array([loop.velocity_gain / loop.transmission_ratio**2])
    below: Array = np.ones(1)
    if loop.integral_time is not None:
        above, below = _product(above, [1.0, loop.integral_time]), _product(below, [0.0, loop.integral_time])
    if loop.electrical_frequency is not None:
        w = 2 * pi * loop.electrical_frequency
        below = _product(below, [1.0, 2 * loop.electrical_damping / w, 1 / w**2])
    if loop.dead_time:
        late = np.cumprod([1.0] + [(_PADE - k) / ((2 * _PADE - k) * (k + 1)) for k in range(_PADE)])
        late = late * loop.dead_time ** np.arange(_PADE + 1)
        above, below = _product(above, late * (-1.0) ** np.arange(_PADE + 1)), _product(below, late)
    return above, below


def _product(one: ArrayLike, other: ArrayLike) -> Array:
    return np.asarray(poly.polymul(np.asarray(one, float), np.asarray(other, float)), dtype=np.float64)


def _zeros(polynomial: Array) -> NDArray[np.complex128]:
    """Zeros on a time scale that balances the coefficients: their powers of s spread over many decades."""
    polynomial = np.trim_zeros(polynomial, "b")
    scale = (abs(polynomial[0]) / abs(polynomial[-1])) ** (1 / (len(polynomial) - 1))
    return np.asarray(poly.polyroots(polynomial * scale ** np.arange(len(polynomial))) * scale)
