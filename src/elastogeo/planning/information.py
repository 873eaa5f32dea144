"""What a planned test tells of the parameters: its rows, whitened and compressed, nuisance eliminated.

The rows are those that an identification would use: the instrument's own `observe`, the sources' own columns. What does not
go with the force (geometry, set-up, zero of a sensor) may be anything at each pose: only differences between force levels at
the same pose count, so that **a test at one level tells nothing**. What wanders from run to run (centre, length, force) is
in the covariance of the rows, which is the same as eliminating its columns with a prior. Set-up is of each test: nothing of
it is shared. What is left has few directions: it is compressed to as many rows.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.linalg import block_diag, solve_triangular

from elastogeo.errors import UnsupportedError
from elastogeo.identification import reciprocal_sources
from elastogeo.machine import Array, Machine
from elastogeo.observe import MachineTest, Observations
from elastogeo.planning.made import at_the_same_poses
from elastogeo.planning.noise import ReadingNoise
from elastogeo.prediction import parameter_scales
from elastogeo.sources import Source, design_rows, select_sources

SAME_POSE = 1e-6
"""Commands [mm, rad] and sensitive directions that differ by less are the same."""

TOLD = 1e-7
"""Directions that a test tells this much less of than of its best one are rounding error."""

SET_UP = ("E_[XYZ]t0", "E_R0")
"""What wanders from run to run: where one ball or probe sits relative to the other, and the length of a bar or a zero."""


@dataclass(frozen=True, slots=True, eq=False)
class Unknowns:
    """The parameters that are planned for, with the size that each is expected to have.

    Attributes
    ----------
    machine : Machine
    sources : tuple of Source, length p
    scales : array, shape (p,)
        In their units: standard deviation of the stated prior, and the metric in which rank and support are decided.
    """

    machine: Machine
    sources: tuple[Source, ...]
    scales: Array

    @property
    def names(self) -> tuple[str, ...]:
        """Of the parameters."""
        return tuple(source.name for source in self.sources)

    @property
    def nominal(self) -> Array:
        """A plain machine in scaled parameters, shape (p,): each joint gives way by its scale along and about each axis.

        It sets the size of the deflections that an uncertain force scales; nothing else depends on it.
        """
        return np.array([float(source.component == source.load) for source in self.sources])


def unknowns(machine: Machine, reciprocal: bool = False, scales: Mapping[str, float] | None = None) -> Unknowns:
    """All compliances of a machine: of its joints and of the places that it declares.

    Parameters
    ----------
    machine : Machine
    reciprocal : bool
        Whether each joint is taken as symmetric: C_dfj and C_fdj are one parameter.
    scales : mapping of str to float, optional
        The size expected of some of them, where it is not the typical one.
    """
    sources = select_sources(machine, ("C_*", "CL_*") if machine.places else ("C_*",))
    sources = reciprocal_sources(sources) if reciprocal else sources
    sizes = parameter_scales(sources)
    for k, source in enumerate(sources):
        sizes[k] = (scales or {}).get(source.name, sizes[k])
    return Unknowns(machine, sources, sizes)


def whitened(tests: Sequence[MachineTest], asked: Unknowns, noise: ReadingNoise) -> list[Array]:
    """What each test tells, as rows in scaled parameters whose errors are independent with unit standard deviation.

    Parameters
    ----------
    tests : sequence of MachineTest
    asked : Unknowns
        p parameters.
    noise : ReadingNoise

    Returns
    -------
    list of array, shape (q, p)
    """
    return rows_of([at_the_same_poses(test) for test in tests], asked, noise)


def rows_of(observed: Sequence[Sequence[Observations]], asked: Unknowns, noise: ReadingNoise) -> list[Array]:
    """As `whitened`, of tests by the observations of their runs."""
    set_up = select_sources(asked.machine, SET_UP)
    sizes = np.concatenate([asked.scales, np.full(len(set_up), noise.set_up)])
    designs = _designs((*asked.sources, *set_up), sizes, asked.machine, [run for runs in observed for run in runs])
    return [_compressed(_test_rows(runs, [next(designs) for _ in runs], asked.nominal, noise)) for runs in observed]


def _designs(sources: Sequence[Source], sizes: Array, machine: Machine, runs: Sequence[Observations]) -> Iterator[Array]:
    """The design of each run, shape (m, p), per size of each source: runs that can be are made together.

    A compliance looks at poses, directions and loads alone, so runs of one tool are one table of observations.
    """
    together: dict[object, list[int]] = {}
    for k, run in enumerate(runs):
        together.setdefault((tuple(run.tool), run.span, None if run.weight is None else id(run.weight)), []).append(k)
    made: dict[int, Array] = {}
    for members in together.values():
        rows = design_rows(sources, machine, _one_table([runs[k] for k in members]))[:, :-1] * sizes
        ends = np.cumsum([len(runs[k]) for k in members])
        made |= dict(zip(members, np.split(rows, ends[:-1]), strict=True))
    return (made[k] for k in range(len(runs)))


def _one_table(runs: Sequence[Observations]) -> Observations:
    def stacked(name: str) -> Array:
        return np.asfortranarray(np.concatenate([getattr(run, name) for run in runs]))

    return replace(
        runs[0],
        pose=stacked("pose"),
        commands=stacked("commands"),
        velocity=stacked("velocity"),
        direction=stacked("direction"),
        wrench=stacked("wrench"),
        reading=stacked("reading"),
        correction=stacked("correction"),
        acceleration=None,
        influences=(),
        sense=None,
        nominal=None,
        workpiece=np.zeros(3),
        length=np.inf,
    )


def _test_rows(runs: Sequence[Observations], designs: Sequence[Array], nominal: Array, noise: ReadingNoise) -> Array:
    """Rows of one test, whitened: differences between readings at one pose, less what wanders from run to run."""
    sigma = np.concatenate([_sigma(run, noise) for run in runs])[:, np.newaxis]
    p = len(nominal)
    rows = np.concatenate([design[:, :p] for design in designs])
    both = _differences(runs, np.hstack([rows, _wander(designs, nominal, noise)]) / sigma)
    rows, wander = both[:, :p], both[:, p:]
    if not len(rows):
        return rows
    root = np.linalg.cholesky(np.eye(len(rows)) + wander @ wander.T)
    return np.asarray(solve_triangular(root, rows, lower=True, check_finite=False))


def _sigma(run: Observations, noise: ReadingNoise) -> Array:
    """Standard deviation of each reading, shape (m,) [mm or rad]."""
    return np.where(run.direction[:, :3].any(axis=1), noise.reading, noise.angle)


def _wander(designs: Sequence[Array], nominal: Array, noise: ReadingNoise) -> Array:
    """What a standard deviation of each thing that wanders does to the readings, shape (m, k): of each run for itself."""
    p = len(nominal)
    own = [np.column_stack([design[:, p:], noise.force * (design[:, :p] @ nominal)]) for design in designs]
    columns = block_diag(*own)
    return np.asarray(columns[:, columns.any(axis=0)])


def _differences(runs: Sequence[Observations], rows: Array) -> Array:
    """Rows with what may be anything at each pose and direction eliminated: contrasts between the readings of each."""
    at = np.vstack([np.hstack([run.commands, run.direction]) for run in runs])
    _, group = np.unique(np.round(at / SAME_POSE), axis=0, return_inverse=True)
    sizes = np.bincount(group.ravel())
    order = np.argsort(group.ravel(), kind="stable")
    first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    parts = []
    for size in np.unique(sizes[sizes > 1]):
        members = order[first[sizes == size][:, np.newaxis] + np.arange(size)]
        parts.append(np.einsum("kr,grp->gkp", _contrasts(int(size)), rows[members]).reshape(-1, rows.shape[1]))
    return np.vstack(parts) if parts else np.zeros((0, rows.shape[1]))


@lru_cache(maxsize=32)
def _contrasts(count: int) -> Array:
    """Orthonormal contrasts of so many readings, shape (count - 1, count): each row sums to zero."""
    contrasts = np.tril(np.ones((count - 1, count)))
    contrasts[np.arange(count - 1), np.arange(1, count)] = -np.arange(1.0, count)
    return np.asarray(contrasts / np.linalg.norm(contrasts, axis=1)[:, np.newaxis])


def _compressed(rows: Array) -> Array:
    """The same information in as few rows as it has directions: a circle without turning axes has up to nine."""
    if not len(rows):
        return rows
    if not np.isfinite(rows).all():
        raise UnsupportedError("a planned test has rows that are no finite numbers; look at the machine's dimensions")
    strength, turns = np.linalg.eigh(rows @ rows.T)
    strength, turns = strength[::-1], turns[:, ::-1]
    told = int(np.sum(strength > TOLD**2 * strength[0]))
    return np.asarray(turns[:, :told].T @ rows)
