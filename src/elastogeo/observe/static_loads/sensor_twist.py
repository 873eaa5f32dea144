"""From the readings of a frame of sensors to the twist of the tool, with its uncertainty, and to the sensor that lies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc, fdtrc

from elastogeo.errors import InputError, RankError
from elastogeo.machine import COMPONENTS, Array
from elastogeo.observe.static_loads.sensor_frame import Sensor, sensitivities

FALSE_ALARM = 0.01
"""Rate at which a sound frame is said to have a sensor that stands out."""

_BLIND = 1e-8
"""Share of a unit twist component, on scaled columns, that a frame may miss and still count as seeing it."""

_UNCHECKED = 1e-9
"""Redundancy below which no other sensor checks a sensor."""


@dataclass(frozen=True, slots=True)
class SensorTwist:
    """The twist of the tool relative to the workpiece at m instants.

    Attributes
    ----------
    twist : array, shape (m, 6) [mm, rad]
        Translation of the tool point and rotation, along the axes in which the sensors are given.
    covariance : array, shape (6, 6)
        Of the twist of one instant, from the sensors.
    degrees_of_freedom : float
        Of it: infinite if the sensors' standard deviation was given.
    residual : array, shape (m, k) [mm]
        Reading less what the twist explains.
    standard_deviation : float [mm]
        Of one reading: as given, or from the residuals.
    redundancy : array, shape (k,)
        Share of a sensor's error that shows in its own residual; they sum up to k - 6. Where it is zero nothing checks the
        sensor.
    outlying : array, shape (k,)
        Probability that a sound sensor's residuals stand out so far; NaN where nothing checks the sensor.
    suspect : int or None
        Number, from 1, of the sensor whose residuals stand out (`FALSE_ALARM`, over all sensors); None if none does.
    consistent : float or None
        Probability that sound sensors of the given standard deviation have such residuals; None if it was not given.
    """

    twist: Array
    covariance: Array
    degrees_of_freedom: float
    residual: Array
    standard_deviation: float
    redundancy: Array
    outlying: Array
    suspect: int | None
    consistent: float | None

    @property
    def standard_uncertainty(self) -> Array:
        """Standard uncertainty of each component, shape (6,) [mm, rad]."""
        return np.sqrt(np.diag(self.covariance))


def sensor_twist(sensors: Sequence[Sensor], readings: Array, standard_deviation: float | None = None) -> SensorTwist:
    """The twist that explains the readings of a frame best (least squares).

    Parameters
    ----------
    sensors : sequence of Sensor, length k
    readings : array, shape (m, k) or (k,) [mm]
        At m instants, zeroed without load.
    standard_deviation : float, optional [mm]
        Of one reading, if it is known; without it the residuals tell.

    Returns
    -------
    SensorTwist

    Notes
    -----
    To first order in the rotation. A sensor is held against all others: its residual, over the root of its redundancy,
    against the scatter of the rest (an F test; with a known standard deviation chi-squared), at a false alarm of one in a
    hundred over the frame. One bad sensor is found so; **two at once may hide behind each other.**

    Raises
    ------
    InputError
        If the shapes do not fit, a reading is no finite number, or the standard deviation is not positive.
    RankError
        If the frame cannot see every twist component; the message names those that it cannot.
    """
    B = sensitivities(sensors)
    readings = _checked(readings, len(B), standard_deviation)
    check_sees_twist(sensors)
    if len(B) == 6 and standard_deviation is None:
        raise InputError("six sensors leave no residual: give the standard deviation of a reading, or add a sensor")
    scale = np.linalg.norm(B, axis=0)
    U, s, Vt = np.linalg.svd(B / scale, full_matrices=False)
    twist = (readings @ U / s) @ Vt / scale
    residual = readings - twist @ B.T
    redundancy = np.clip(1.0 - np.sum(U**2, axis=1), 0.0, 1.0)
    freedom = len(readings) * (len(B) - 6)
    left = float(np.sum(residual**2))
    deviation = np.sqrt(left / freedom) if standard_deviation is None else standard_deviation
    root = (Vt.T / s) / scale[:, np.newaxis]
    outlying = _outlying(residual, redundancy, standard_deviation)
    return SensorTwist(
        twist=twist,
        covariance=deviation**2 * root @ root.T,
        degrees_of_freedom=float(freedom) if standard_deviation is None else np.inf,
        residual=residual,
        standard_deviation=float(deviation),
        redundancy=redundancy,
        outlying=outlying,
        suspect=_suspect(outlying),
        consistent=None if standard_deviation is None or not freedom else float(chdtrc(freedom, left / deviation**2)),
    )


def check_sees_twist(sensors: Sequence[Sensor]) -> None:
    """Refuse a frame that cannot see every component of a twist.

    Raises
    ------
    RankError
        With the components that it does not see at all, and those that it sees in sums only.
    """
    B = sensitivities(sensors)
    lever = float(np.linalg.norm([sensor.point for sensor in sensors], axis=1).max()) or 1.0
    scaled = B / np.array([1.0, 1.0, 1.0, lever, lever, lever])
    _, s, Vt = np.linalg.svd(scaled)
    unseen = Vt[int(np.sum(s > _BLIND * s[0])) :]
    if not len(unseen):
        return
    missed = np.linalg.norm(unseen, axis=0)
    alone = [COMPONENTS[k] for k in range(6) if not np.linalg.norm(scaled[:, k]) > _BLIND]
    sums = [COMPONENTS[k] for k in range(6) if missed[k] > _BLIND and COMPONENTS[k] not in alone]
    said = [f"does not see {', '.join(alone)}"] if alone else []
    said += [f"sees {', '.join(sums)} in sums only"] if sums else []
    raise RankError(
        f"this frame of {len(sensors)} sensors {' and '.join(said)} (translations X Y Z, rotations A B C at the tool point)"
        f"; place a sensor that reads the missing component, or move one off the line of the others"
    )


def _checked(readings: Array, sensors: int, standard_deviation: float | None) -> Array:
    """Readings as an array of shape (m, k), finite."""
    values = np.atleast_2d(np.asarray(readings, dtype=float))
    if values.ndim != 2 or values.shape[1] != sensors or not len(values):
        raise InputError(f"{sensors} sensors need readings of the shape (m, {sensors}), got {np.shape(readings)}")
    if not np.isfinite(values).all():
        row, column = np.argwhere(~np.isfinite(values))[0]
        raise InputError(
            f"sensor {column + 1}, instant {row + 1}: the reading is {values[row, column]}; take the instant out"
        )
    if standard_deviation is not None and not (np.isfinite(standard_deviation) and standard_deviation > 0):
        raise InputError(f"the standard deviation of a reading is {standard_deviation:g} mm, it must be positive and finite")
    return values


def _outlying(residual: Array, redundancy: Array, standard_deviation: float | None) -> Array:
    """Probability that each sensor's residuals stand out so far by chance, shape (k,); NaN where nothing checks it."""
    instants, sensors = residual.shape
    checked = redundancy > _UNCHECKED
    own = np.divide(np.sum(residual**2, axis=0), redundancy, out=np.zeros(sensors), where=checked)
    if standard_deviation is not None:
        probability = chdtrc(instants, own / standard_deviation**2)
    else:
        rest = np.sum(residual**2) - own
        freedom = instants * (sensors - 7)
        if freedom <= 0:
            return np.full(sensors, np.nan)
        ratio = np.divide(own / instants, rest / freedom, out=np.zeros(sensors), where=(rest > 0) & (own > 0))
        probability = fdtrc(instants, freedom, ratio)
    return np.where(checked, probability, np.nan)


def _suspect(outlying: Array) -> int | None:
    """The sensor that stands out most, if it does."""
    known = np.flatnonzero(~np.isnan(outlying))
    if not len(known):
        return None
    worst = known[np.argmin(outlying[known])]
    return int(worst) + 1 if outlying[worst] < FALSE_ALARM / len(known) else None
