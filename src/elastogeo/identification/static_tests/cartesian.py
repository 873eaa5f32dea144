"""The Cartesian compliance and stiffness of a machine at a place: how the tool gives way to a force in any direction.

Thesis 6.2, ref. 4: a loaded bar pushes the tool ball in directions that turn with the table, three displacement probes read
how it moves. Each reading is `n . C f` with the 3x3 compliance C, the force f and the probe's direction n: linear in C,
whether the probes are orthogonal or not. C adds up all joints; `elastogeo.identification.identify` tells them apart, on
the same observations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import inf

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc, stdtrit

from elastogeo.errors import InputError, RankError, UnsupportedError
from elastogeo.estimate import (
    Confounding,
    Estimate,
    Factor,
    Solution,
    confounding,
    effective_degrees_of_freedom,
    factor_blocks,
    merge,
)
from elastogeo.identification.check import Check
from elastogeo.identification.static_tests.by_run import Counted, solved_by_run
from elastogeo.identification.static_tests.principal import Principal, principal_directions
from elastogeo.machine import Array, Machine, loop_frames
from elastogeo.observe import Observations

AXES = "XYZ"

ELEMENTS = tuple(f"C_{i}{j}" for i in AXES for j in AXES)
"""Displacement, then force component; row by row."""

FEWEST = 3.0
"""Degrees of freedom below which the scatter of runs does not tell three differences from nothing."""

SIGNIFICANT = 0.01
"""Probability below which a departure from the physics is more than scatter."""

_ANTISYMMETRIC = np.zeros((3, 9))
for _row, (_i, _j) in enumerate(((0, 1), (0, 2), (1, 2))):
    _ANTISYMMETRIC[_row, 3 * _i + _j], _ANTISYMMETRIC[_row, 3 * _j + _i] = 1.0, -1.0


@dataclass(frozen=True, slots=True)
class Symmetry:
    """Whether C_ij = C_ji, as reciprocity wants.

    Attributes
    ----------
    differences : array, shape (3,) [mm/N]
        C_XY - C_YX, C_XZ - C_ZX, C_YZ - C_ZY.
    chi_squared : float
        Of the three together, by their covariance.
    probability : float
        That a symmetric compliance shows as much: chi-squared over three by the F distribution, as the covariance is
        estimated too.
    """

    differences: Array
    chi_squared: float
    probability: float


@dataclass(frozen=True, slots=True)
class CartesianCompliance:
    """The 3x3 compliance of a machine at a place.

    Attributes
    ----------
    compliance : array, shape (3, 3) [mm/N]
        Row: component of the displacement, column: component of the force. What is not
        determined is NaN.
    scatter : array, shape (9, 9)
        Covariance of the compliance, row by row, by the scatter of the runs; NaN where it is not determined, infinite where
        the runs are too few to show it.
    scatter_freedom : array, shape (9,)
        Degrees of freedom of each element's scatter.
    undetermined : tuple of str
        Elements that the readings do not determine by themselves (`C_XZ`).
    zeros : tuple of Estimate [mm]
        Readings without force of the sensors, where they were asked for and are determined.
    counted : Counted
        What the uncertainty assumes.
    residual_std : float [mm]
        Estimated standard deviation of one reading.
    systematic : array, shape (k, 9)
        By how much one standard uncertainty of each influence moves the elements [mm/N].
    freedoms : tuple of k float
        Degrees of freedom of each influence.
    """

    compliance: Array
    scatter: Array
    scatter_freedom: Array
    undetermined: tuple[str, ...]
    zeros: tuple[Estimate, ...]
    counted: Counted
    residual_std: float
    systematic: Array = field(default_factory=lambda: np.zeros((0, 9)))
    freedoms: tuple[float, ...] = ()

    @property
    def covariance(self) -> Array:
        """Of scatter and influences together, row by row, shape (9, 9)."""
        return np.asarray(self.scatter + self.systematic.T @ self.systematic)

    @property
    def degrees_of_freedom(self) -> Array:
        """Effective ones of each element, shape (9,) (JCGM 100, G.4)."""
        if not self.freedoms:
            return self.scatter_freedom
        parts = np.vstack([np.sqrt(np.diag(self.scatter)), np.abs(self.systematic)]).T
        each = np.tile(np.asarray(self.freedoms, dtype=float), (9, 1))
        return effective_degrees_of_freedom(parts, np.column_stack([self.scatter_freedom, each]))

    @property
    def standard_uncertainty(self) -> Array:
        """Of each element, shape (3, 3) [mm/N]."""
        return np.sqrt(np.diag(self.covariance)).reshape(3, 3)

    def interval(self, coverage: float = 0.95) -> Array:
        """Coverage interval of each element, shape (3, 3, 2) [mm/N]."""
        half = stdtrit(self.degrees_of_freedom, 0.5 + coverage / 2).reshape(3, 3) * self.standard_uncertainty
        return np.stack([self.compliance - half, self.compliance + half], axis=-1)

    def along(self, direction: Sequence[float]) -> Estimate:
        """Compliance [mm/N] along a direction, for a force along it.

        Raises
        ------
        RankError
            If the compliance is not determined.
        """
        self._check_determined("a compliance along a direction")
        u = np.asarray(direction, dtype=float)
        if u.shape != (3,) or not np.isfinite(u).all() or not u.any():
            raise InputError(f"the direction is {direction}; it must be three finite numbers that are not all zero")
        return self._linear(np.outer(u, u) / (u @ u))

    def stiffness(self) -> tuple[Array, Array]:
        """The stiffness matrix [N/mm] and the covariance of its elements, row by row, shape (9, 9), to first order.

        Raises
        ------
        RankError
            If a column of the compliance is not determined.
        UnsupportedError
            If the compliance of some direction may as well be zero: the stiffness is then unbounded.
        """
        self._check_determined("the stiffness")
        for principal in self.principal():
            principal.stiffness()
        K = np.asarray(np.linalg.inv(self.compliance), dtype=float)
        if not self.counted.by_run:
            return K, np.full((9, 9), inf)
        change = -np.kron(K, K.T)
        return K, np.asarray(change @ self.covariance @ change.T)

    def symmetry(self) -> Symmetry:
        """Whether the compliance is symmetric within its uncertainty.

        Raises
        ------
        RankError
            If the compliance is not determined.
        UnsupportedError
            If the runs are too few to tell.
        """
        self._check_determined("the symmetry")
        freedom = float(self.scatter_freedom.min())
        if not self.counted.by_run or freedom < FEWEST:
            raise UnsupportedError("the runs are too few to tell how symmetric the compliance is; repeat them")
        differences = _ANTISYMMETRIC @ self.compliance.ravel()
        covariance = _ANTISYMMETRIC @ self.covariance @ _ANTISYMMETRIC.T
        scale = np.sqrt(np.diag(covariance))
        if not scale.all():
            raise UnsupportedError(
                "the readings fit without any scatter, so that no uncertainty tells how symmetric they are"
            )
        weighted = np.linalg.solve(covariance / np.outer(scale, scale), differences / scale)
        chi_squared = float(differences / scale @ weighted)
        # The whole covariance is estimated, not one variance only (Hotelling).
        ratio = chi_squared / 3 * (freedom - 2) / freedom
        return Symmetry(differences, chi_squared, float(fdtrc(3, freedom - 2, ratio)))

    def principal(self) -> tuple[Principal, ...]:
        """Principal directions of the symmetric part, the softest first.

        Raises
        ------
        RankError
            If the compliance is not determined.
        """
        self._check_determined("principal directions")
        return principal_directions(self.compliance, self._linear)

    def checks(self) -> tuple[Check, ...]:
        """What is to be believed: all determined, symmetric within the uncertainty, and no force gaining energy."""
        if self.undetermined:
            return (Check("compliance determined", False, {"why": self._undetermined()}),)
        stiffest = self.principal()[-1].compliance
        gained = stiffest.interval()[1] < 0 if stiffest.known else None
        return (
            Check("compliance determined", True, {"why": ""}),
            self._reciprocal(),
            Check("no energy gained", None if gained is None else not gained, {"least": stiffest.value}),
        )

    def _reciprocal(self) -> Check:
        try:
            found = self.symmetry()
        except UnsupportedError as error:
            return Check("reciprocity", None, {"why": str(error)})
        differences = {
            "greatest": float(np.abs(found.differences).max()),
            "chi_squared": found.chi_squared,
            "p_value": found.probability,
        }
        return Check("reciprocity", found.probability >= SIGNIFICANT, differences)

    def _linear(self, weights: Array) -> Estimate:
        """A linear function of the elements; weights of shape (3, 3)."""
        w = weights.ravel()
        if not self.counted.by_run:
            return Estimate(float(w @ self.compliance.ravel()), inf)
        parts = np.array([[np.sqrt(w @ self.scatter @ w), *np.abs(self.systematic @ w)]])
        freedom = effective_degrees_of_freedom(parts, np.array([[self.scatter_freedom.min(), *self.freedoms]]))
        return Estimate(float(w @ self.compliance.ravel()), float(np.linalg.norm(parts)), float(freedom[0]))

    def _check_determined(self, what: str) -> None:
        if self.undetermined:
            raise RankError(f"{what} cannot be had. {self._undetermined()}")

    def _undetermined(self) -> str:
        forces = [j for j in AXES if all(f"C_{i}{j}" in self.undetermined for i in AXES)]
        shown = [i for i in AXES if all(f"C_{i}{j}" in self.undetermined for j in AXES)]
        if len(shown) in (1, 2):
            return f"No sensor shows the displacement along {', '.join(shown)} by itself; add one that does."
        said = f"the columns of the forces along {', '.join(forces)}" if forces else ", ".join(self.undetermined)
        return (
            f"The readings do not determine {said}: the forces lie in one plane or along one line; push in a direction "
            f"outside of it as well."
        )


def cartesian_compliance(
    force: Array, direction: Array, reading: Array, sensor: Array | None = None, run: Array | None = None
) -> CartesianCompliance:
    """The compliance that explains readings of displacement best (least squares).

    Parameters
    ----------
    force : array, shape (m, 3) [N]
        On the tool, at every reading.
    direction : array, shape (m, 3)
        Unit vector along which each reading counts.
    reading : array, shape (m,) [mm]
        Displacement of the tool relative to the workpiece.
    sensor : array of int, shape (m,), optional
        Which sensor read: each then has an unknown zero. Without it all readings count from zero force.
    run : array of int, shape (m,), optional
        Which run it was; by default all are of one. The uncertainty assumes independent runs, and is infinite where they
        are too few: readings along a turn are not independent.

    Notes
    -----
    Force and direction count as exact; readings scatter alike. **It is the compliance of one place:** where the machine
    moves between the readings, its mean over the places.

    Raises
    ------
    InputError
        If shapes do not fit, or a value is no finite number.
    RankError
        If the readings determine no element at all: there is no force.
    DegreesOfFreedomError
        If there are not more readings than unknowns.
    """
    force, direction, reading = _checked(force, direction, reading)
    sensors = _numbered(sensor, len(reading), "sensor") if sensor is not None else np.zeros(0, dtype=int)
    runs = _numbered(run, len(reading), "run") if run is not None else np.zeros(len(reading), dtype=int)
    count = int(sensors.max()) + 1 if len(sensors) else 0
    labels = (*ELEMENTS, *(f"zero of sensor {k + 1}" for k in range(count)))
    elastic = np.einsum("mi,mj->mij", direction, force).reshape(len(reading), 9)
    zeros = np.equal.outer(sensors, np.arange(count)).astype(float).reshape(len(reading), count)
    rows = np.hstack([elastic, zeros, reading[:, np.newaxis]])
    factors = [factor_blocks(labels, [np.asfortranarray(rows[runs == k])]) for k in range(int(runs.max()) + 1)]
    found = _determined(merge(*factors), force)
    return _assembled(*solved_by_run(factors, found.retained), found)


def cartesian_from_vectors(force: Array, displacement: Array, run: Array | None = None) -> CartesianCompliance:
    """The compliance from whole displacement vectors, shape (m, 3) [mm], under forces, shape (m, 3) [N].

    Each component of the displacement counts as a reading by itself, from zero force; see `cartesian_compliance`.

    Raises
    ------
    InputError
        If the shapes do not fit, and as `cartesian_compliance`.
    """
    force, displacement = np.asarray(force, dtype=float), np.asarray(displacement, dtype=float)
    if displacement.ndim != 2 or displacement.shape[1] != 3 or force.shape != displacement.shape:
        raise InputError(f"forces and displacements must have the shape (m, 3), got {force.shape} and {displacement.shape}")
    rows = np.repeat(np.arange(len(force)), 3)
    direction = np.tile(np.eye(3), (len(force), 1))
    runs = None if run is None else np.asarray(run)[rows]
    return cartesian_compliance(force[rows], direction, displacement.ravel(), run=runs)


def cartesian_of(
    machine: Machine, observations: Sequence[Observations], *, in_workpiece: bool = False, sensors: int = 0
) -> CartesianCompliance:
    """The compliance from the observations of displacement sensors, of any instrument that reads along fixed directions.

    Parameters
    ----------
    machine : Machine
    observations : sequence of Observations
        One per run.
    in_workpiece : bool
        Whether the compliance is that seen from the turning table (the same at all its angles) rather than that seen from
        the foundation.
    sensors : int
        How many sensors stand one after the other in every run, each with a zero of its own; 0 if all were zeroed without
        load.

    Raises
    ------
    InputError
        If there is no run, a run is not of so many sensors, or its sensors read rotations or a distance.
    """
    if not observations:
        raise InputError("there is no run; give the observations of one at least")
    force, direction, sensor = [], [], []
    for run in observations:
        if np.isfinite(run.length) or run.direction[:, 3:].any():
            raise InputError(f"run {run.run!r} reads a distance or a rotation; a Cartesian compliance takes displacements")
        if sensors and len(run) % sensors:
            raise InputError(
                f"run {run.run!r} has {len(run)} readings, which {sensors} sensors cannot share; count them again"
            )
        vectors = run.wrench[:, :3], run.direction[:, :3]
        if in_workpiece:
            frame = loop_frames(machine, run.commands, run.tool).workpiece
            vectors = frame.components(vectors[0]), frame.components(vectors[1])
        force.append(vectors[0])
        direction.append(vectors[1])
        sensor.append(np.repeat(np.arange(max(sensors, 1)), len(run) // max(sensors, 1)))
    return cartesian_compliance(
        np.concatenate(force),
        np.concatenate(direction),
        np.concatenate([run.reading for run in observations]),
        np.concatenate(sensor) if sensors else None,
        np.repeat(np.arange(len(observations)), [len(run) for run in observations]),
    )


def _checked(force: Array, direction: Array, reading: Array) -> tuple[Array, Array, Array]:
    """All as arrays of one length, finite, with a force at all."""
    force, direction, reading = (np.asarray(values, dtype=float) for values in (force, direction, reading))
    wanted = (len(reading), 3) if reading.ndim == 1 else ()
    if force.shape != wanted or direction.shape != wanted or not len(reading):
        raise InputError(
            f"m readings need m forces and m directions of three components each: got {reading.shape}, {force.shape} and "
            f"{direction.shape}"
        )
    for name, values in (("force", force), ("direction", direction), ("reading", reading[:, np.newaxis])):
        wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
        if len(wrong):
            raise InputError(f"the {name} of reading {wrong[0] + 1} is no finite number; take the reading out")
    if not np.allclose(np.linalg.norm(direction, axis=1), 1.0, atol=1e-6):
        raise InputError("the directions of the sensors must be unit vectors; divide each by its length")
    if not force.any():
        raise RankError("the force is zero at every reading: nothing shows how the machine gives way; load it")
    return force, direction, reading


def _numbered(groups: Array, readings: int, what: str) -> NDArray[np.intp]:
    """Group of every reading, counted from 0 without gaps."""
    groups = np.asarray(groups)
    if groups.shape != (readings,):
        raise InputError(f"{readings} readings need the {what} of each, got the shape {groups.shape}")
    return np.asarray(np.unique(groups, return_inverse=True)[1])


def _determined(factor: Factor, force: Array) -> Confounding:
    """What the readings distinguish; a column of rounding error counts as none."""
    size = float(np.linalg.norm(force, axis=1).max())
    ceilings = np.array([size] * 9 + [1.0] * (len(factor.labels) - 9)) * np.sqrt(factor.rows)
    return confounding(factor, ceilings=ceilings)


def with_influences(
    found: CartesianCompliance, moved: Sequence[CartesianCompliance], freedoms: Sequence[float]
) -> CartesianCompliance:
    """The compliance with what each influence, by one standard uncertainty, moves it by, beside its scatter."""
    if not (moved and found.counted.by_run):
        return found
    shifts = np.array([(one.compliance - found.compliance).ravel() for one in moved])
    return replace(found, systematic=shifts, freedoms=tuple(freedoms))


def _assembled(solution: Solution, counted: Counted, found: Confounding) -> CartesianCompliance:
    """Elements in their places, NaN where the readings give sums only."""
    alone = [label for label in found.retained if len(found.stands_for(label)) == 1]
    values, covariance = np.full(9, np.nan), np.full((9, 9), np.nan)
    freedom = np.full(9, np.nan)
    places = [(k, solution.labels.index(label)) for k, label in enumerate(ELEMENTS) if label in alone]
    for k, at in places:
        values[k], freedom[k] = solution.values[at], solution.degrees_of_freedom[at]
        for other, there in places:
            covariance[k, other] = solution.covariance[at, there]
    zeros = tuple(solution.estimate(label) for label in solution.labels if label in alone and label not in ELEMENTS)
    return CartesianCompliance(
        compliance=values.reshape(3, 3),
        scatter=covariance,
        scatter_freedom=freedom,
        undetermined=tuple(label for label in ELEMENTS if label not in alone),
        zeros=zeros,
        counted=counted,
        residual_std=solution.residual_std,
    )
