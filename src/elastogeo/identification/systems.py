"""One linear system per run, less a reference force level if one is asked for, and less the run's own set-up.

What every run has for itself (where its circle really lies) is no parameter: it is projected out of the rows of the run, as
if it were estimated in each run anew (Frisch, Waugh and Lovell). What is left of the rows has as many readings less.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Factor, Noise, factor_blocks, merge
from elastogeo.identification.levels import ForceLevels, ForceSpread, force_levels
from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations
from elastogeo.sources import Source, column_ceilings, design_rows

SAME_POSE = 1e-6
"""Commands [mm, rad] that differ by less are the same pose."""


OWN_TOLERANCE = 1e-9
"""Relative length below which a combination of a run's set-up columns is none."""


ABSORBED = 1e-12
"""Share of a column that is left by rounding when the run's own set-up explains all of it."""


@dataclass(frozen=True, slots=True, eq=False)
class RunSystem:
    """The linear system of one run.

    Attributes
    ----------
    observations : Observations
        As observed; nothing is taken off.
    force : float [N]
        Of its level, less the reference's if one is subtracted (Eq. 4.27).
    rows : array, shape (m, q + 1)
        `[A | y]` of the columns that are held, less the reference's if one is taken off (Eq. 4.26), less what the run's own
        set-up explains of them.
    factor : Factor
        Of the rows, each with the root of its weight.
    own : array, shape (m, k)
        Columns of the run's own set-up.
    aside : array, shape (k, p + 1)
        How much of these columns the rows held.
    set_up_names : tuple of str, length k
        Of the run's own set-up.
    test : str
        Name of the test.
    weights : array, shape (m,), or None
        Of the readings, where outliers count less; None if all count one.
    precision : float
        What a reading of its test counts against those of other tests: one over its variance, 1 on the average of all.
    held : tuple of str, length q, or None
        The columns that are held; None if all of the factor are. Others are made again when they are asked for: the rows of
        many tests would fill the memory.
    model : tuple of (tuple of Source, Machine) or None
        To make them with, the sources that act in the test.
    """

    observations: Observations
    force: float
    rows: Array
    factor: Factor
    own: Array
    aside: Array
    set_up_names: tuple[str, ...] = ()
    test: str = ""
    weights: Array | None = None
    precision: float = 1.0
    held: tuple[str, ...] | None = None
    model: tuple[tuple[Source, ...], Machine] | None = None

    @property
    def name(self) -> str:
        """Name of the run."""
        return self.observations.run

    def design_of(self, labels: Sequence[str]) -> Array:
        """Columns of the design for these parameters, shape (m, len(labels))."""
        held = self.factor.labels if self.held is None else self.held
        if self.model is not None and any(label not in held for label in labels):
            return self._made(labels)
        return self.rows[:, [held.index(label) for label in labels]]

    def holding(self, labels: Sequence[str]) -> RunSystem:
        """The same run, of whose rows these columns are held and no others."""
        rows = np.column_stack([self.design_of(labels), self.reading])
        return replace(self, rows=np.asfortranarray(rows), held=tuple(labels))

    def _made(self, labels: Sequence[str]) -> Array:
        """Columns of the design as they were made for the factor."""
        assert self.model is not None
        sources, machine = self.model
        acting = [source for source in sources if source.name in labels]
        columns = np.zeros((len(self.observations), len(labels)))
        at = [labels.index(source.name) for source in acting]
        columns[:, at] = design_rows(acting, machine, self.observations)[:, :-1]
        left = columns - self.own @ self.aside[:, [self.factor.labels.index(label) for label in labels]]
        left[:, np.linalg.norm(left, axis=0) <= ABSORBED * np.linalg.norm(columns, axis=0)] = 0.0
        return np.asarray(left)

    @property
    def reading(self) -> Array:
        """The readings that the model is to explain, shape (m,) [mm or rad]."""
        return self.rows[:, -1]

    @property
    def design(self) -> Array:
        """Change of each reading per unit of each parameter, shape (m, p)."""
        return self.design_of(self.factor.labels)

    @property
    def angular(self) -> bool:
        """Whether its readings, or some of them, are angles."""
        return bool(self.observations.direction[:, 3:].any())

    @property
    def counted(self) -> Array | float:
        """What each reading counts, shape (m,), or one number for all: its weight times the precision of its test."""
        return self.precision if self.weights is None else self.precision * self.weights

    def set_up(self, labels: Sequence[str], values: Array) -> Array:
        """The run's own set-up, shape (k,) [mm], if the parameters have these values."""
        chosen = self.aside[:, [self.factor.labels.index(label) for label in labels]]
        return np.asarray(self.aside[:, -1] - chosen @ values)

    def without_own(self, columns: Array) -> Array:
        """Other columns of the run, shape (m, q), less what its own set-up explains of them."""
        return columns - self.own @ own_part(self.own, columns, self.weights)


@dataclass(frozen=True, slots=True)
class Systems:
    """The systems of the runs of a test, or of several.

    Attributes
    ----------
    sources : tuple of Source
        One per column.
    runs : tuple of RunSystem
        In the order of the test, without the reference runs if they are taken off.
    references : int
        How many reference runs were averaged and taken off from each run; 0 if none was.
    applied : ForceLevels
        The force levels that were applied, the reference among them.
    ceilings : array, shape (p,)
        Length that each column would have if nothing cancelled (`column_ceilings`).
    scatter : dict of str to float [mm or rad]
        Of several tests, the standard deviation of a reading of each. Empty for one test.
    """

    sources: tuple[Source, ...]
    runs: tuple[RunSystem, ...]
    references: int
    applied: ForceLevels
    ceilings: Array
    scatter: Mapping[str, float] = field(default_factory=dict)

    @property
    def levels(self) -> tuple[float, ...]:
        """The force levels [N] of the runs, increasing."""
        return tuple(sorted({run.force for run in self.runs}))

    @property
    def tests(self) -> tuple[str, ...]:
        """Names of the tests, in order."""
        return tuple(dict.fromkeys(run.test for run in self.runs))

    def of(self, test: str) -> Systems:
        """The systems of one of the tests."""
        return replace(self, runs=tuple(run for run in self.runs if run.test == test))

    def holding(self, labels: Sequence[str]) -> Systems:
        """The same systems, of whose rows these columns are held and no others."""
        return replace(self, runs=tuple(run.holding(labels) for run in self.runs))

    @property
    def strongest(self) -> tuple[RunSystem, ...]:
        """The runs at the highest force of their test."""
        most = {test: max((run.force for run in self.runs if run.test == test), key=abs) for test in self.tests}
        return tuple(run for run in self.runs if run.force == most[run.test])

    def range_per_unit(self, labels: Sequence[str]) -> Array:
        """Range that a unit of each parameter gives the readings of a run at the highest force, shape (p,).

        With zero in it, so that what shifts all readings alike counts in full. Of several tests the greatest; where some
        read lengths and some angles, that of lengths.
        """
        lengths = [run for run in self.strongest if not run.angular]
        parts = [run.design_of(labels) for run in lengths or self.strongest]
        ranges = [np.maximum(part.max(axis=0), 0.0) - np.minimum(part.min(axis=0), 0.0) for part in parts]
        return np.asarray(np.max(ranges, axis=0))

    def at(self, *levels: float) -> tuple[RunSystem, ...]:
        """The runs at these force levels [N].

        Raises
        ------
        InputError
            If there is none at one of them.
        """
        chosen = set()
        for level in levels:
            nearest = min(self.levels, key=lambda force: abs(force - level))
            if not self.applied.spread.agree(nearest, level):
                there = ", ".join(f"{force:g}" for force in self.levels)
                raise InputError(f"no run has the force {level:g} N; there are {there} N")
            chosen.add(nearest)
        return tuple(run for run in self.runs if run.force in chosen)


def run_systems(
    sources: Sequence[Source],
    machine: Machine,
    observations: Sequence[Observations],
    reference: float | None = None,
    own: Sequence[Source] = (),
    spread: ForceSpread | None = None,
    test: str = "",
    absent: Collection[str] = (),
    hold: bool = True,
) -> Systems:
    """The linear system of every run of a test.

    Parameters
    ----------
    sources : sequence of Source, length p
    machine : Machine
    observations : sequence of Observations
        One per run.
    reference : float, optional [N]
        Force level whose readings and model are taken off from all others, at the same poses (Eqs. 4.26, 4.27). What does
        not change with the load then cancels, from the readings and from the model alike.
    own : sequence of Source
        The set-up that every run has for itself.
    spread : ForceSpread, optional
        How well the forces of the runs are known against one another.
    test : str
        Name of the test.
    absent : collection of str
        Names of the sources that are of other tests: they move no reading of this one.
    hold : bool
        Whether the runs hold their rows; if not, they are made again when they are asked for.

    Raises
    ------
    UnsupportedError
        If no run has the reference level, or no other.
    InputError
        If a run was not read at the poses of the reference.
    """
    labels = [source.name for source in sources]
    here = [k for k, source in enumerate(sources) if source.name not in absent]
    acting = [sources[k] for k in here]
    made = (_spread_out(design_rows(acting, machine, run), here, len(sources)) for run in observations)
    rows: Iterable[Array] = made if reference is None else list(made)
    levels = force_levels((run.force for run in observations), spread)
    forces = [levels.level(run.force) for run in observations]
    applied = force_levels((force for run in observations for force in _applied(run)), spread)
    taken_off = None if reference is None or reference not in levels else levels.level(reference)
    is_reference = [force == taken_off for force in forces]
    references = sum(is_reference)
    if reference is not None:
        if not references or references == len(forces):
            there = ", ".join(f"{level:g}" for level in applied.forces)
            raise UnsupportedError(
                f"the reference level {reference:g} N cannot be taken off: the runs are at {there} N; "
                f"it takes a run at the reference and one at another level"
            )
        base = observations[is_reference.index(True)]
        for run in observations:
            _check_same_poses(run, base)
        taken = sum(r for r, is_ref in zip(rows, is_reference, strict=True) if is_ref) / references
        rows = [r - taken for r in rows]
        forces = [force - levels.level(base.force) for force in forces]
    own_columns = [design_rows(own, machine, run)[:, :-1] for run in observations]
    sizes = np.max([np.linalg.norm(columns, axis=0) / np.sqrt(len(columns)) for columns in own_columns], axis=0)
    moving = [k for k in range(len(own)) if sizes[k] > OWN_TOLERANCE]
    names = tuple(own[k].name for k in moving)
    model = None if hold else (tuple(acting), machine)
    every = (
        _run_system(labels, run, force, r, np.asfortranarray(columns[:, moving]), names, test)
        for run, force, r, columns, is_ref in zip(observations, forces, rows, own_columns, is_reference, strict=True)
        if not is_ref
    )
    runs = tuple(run if model is None else replace(run, model=model).holding(()) for run in every)
    ceilings = np.zeros(len(sources))
    ceilings[here] = np.linalg.norm([column_ceilings(acting, machine, run) for run in observations], axis=0)
    return Systems(tuple(sources), runs, references, applied, ceilings)


def _spread_out(rows: Array, here: Sequence[int], columns: int) -> Array:
    """Rows of the sources that act in a test, in the columns of all sources."""
    if len(here) == columns:
        return rows
    every = np.zeros((len(rows), columns + 1), order="F")
    every[:, [*here, columns]] = rows
    return every


def joined(tests: Sequence[Systems]) -> Systems:
    """The systems of several tests as one; of one test, itself.

    Forces of different tests that agree are one level. Of their rows none are held but the readings.
    """
    if len(tests) == 1:
        return tests[0]
    spread = max((one.applied.spread for one in tests), key=lambda spread: (spread.relative, spread.absolute))
    runs = [run for one in tests for run in one.runs]
    levels = force_levels((run.force for run in runs), spread)
    applied = force_levels((force for one in tests for level in one.applied.members for force in level), spread)
    ceilings = np.linalg.norm([one.ceilings for one in tests], axis=0)
    runs = [replace(run, force=levels.level(run.force)) for run in runs]
    return Systems(tests[0].sources, tuple(runs), 0, applied, ceilings)


def _run_system(
    labels: Sequence[str], run: Observations, force: float, rows: Array, own: Array, names: tuple[str, ...], test: str
) -> RunSystem:
    aside = own_part(own, rows)
    left = rows - own @ aside
    left[:, :-1][:, np.linalg.norm(left[:, :-1], axis=0) <= ABSORBED * np.linalg.norm(rows[:, :-1], axis=0)] = 0.0
    return RunSystem(run, force, left, _factor_of(labels, left, own), own, aside, names, test)


def with_precision(run: RunSystem, precision: float) -> RunSystem:
    """The same run whose readings count so much against those of other tests."""
    factor = replace(run.factor, triangle=run.factor.triangle * np.sqrt(precision / run.precision))
    return replace(run, factor=factor, precision=precision)


def reweighted(run: RunSystem, weights: Array) -> RunSystem:
    """The same run, whose rows are all held, with a weight for each reading, shape (m,); its own set-up is found anew."""
    more = own_part(run.own, run.rows, weights)
    rows, root = run.rows - run.own @ more, np.sqrt(run.precision * weights)[:, np.newaxis]
    factor = _factor_of(run.factor.labels, rows * root, run.own * root)
    return replace(run, rows=rows, aside=run.aside + more, weights=weights, factor=factor)


def own_part(own: Array, columns: Array, weights: Array | None = None) -> Array:
    """How much of a run's own set-up, shape (m, k), is in columns, shape (m, q): least squares, shape (k, q).

    Of set-up columns that the run cannot tell apart the smallest values, of one that moves no reading none.
    """
    if not own.shape[1]:
        return np.zeros((0, columns.shape[1]))
    root = np.ones(len(own)) if weights is None else np.sqrt(weights)
    return np.asarray(np.linalg.lstsq(own * root[:, np.newaxis], columns * root[:, np.newaxis], rcond=OWN_TOLERANCE)[0])


def _factor_of(labels: Sequence[str], rows: Array, own: Array) -> Factor:
    """Factor of rows from which a run's own set-up is projected out: so many readings less."""
    factor = factor_blocks(labels, [rows.copy(order="F")])
    spent = int(np.linalg.matrix_rank(own, tol=OWN_TOLERANCE * np.sqrt(len(own)))) if own.shape[1] else 0
    return replace(factor, rows=factor.rows - spent)


def _applied(run: Observations) -> tuple[float, ...]:
    """The forces [N] of a run: its level; where it stands at one place, the least and the greatest that acted there."""
    if np.ptp(run.commands, axis=0).any():
        return (run.force,)
    sizes = np.linalg.norm(run.wrench[:, :3], axis=1)
    return float(sizes.min()), float(sizes.max())


def merged(runs: Sequence[RunSystem]) -> Factor:
    """One factor of several runs."""
    return merge(*(run.factor for run in runs))


def noise_of(runs: Sequence[RunSystem], references: int) -> Noise | None:
    """How the errors of the rows belong together: differences to one reference share its errors.

    With N runs less the mean of n reference runs, the errors at each pose have the covariance `sigma^2 (I + 1 1^T / n)`.
    """
    if not references:
        return None
    own = merged(runs)
    shared = sum(run.design for run in runs) / np.sqrt(references)
    readings, count = len(runs[0].rows), len(runs)
    return Noise(
        root=np.vstack([own.R, np.linalg.qr(shared, mode="r")]),
        trace=readings * count * (1 + 1 / references),
        square=readings * ((count - 1) + (1 + count / references) ** 2),
    )


def _check_same_poses(run: Observations, reference: Observations) -> None:
    if run.commands.shape != reference.commands.shape:
        raise InputError(
            f"run {run.run!r} has {len(run)} readings, the reference {reference.run!r} has {len(reference)}; "
            f"to take a reference off, both must be read at the same poses"
        )
    apart = np.abs(run.commands - reference.commands).max(axis=1)
    if apart.max() > SAME_POSE:
        row = int(np.argmax(apart > SAME_POSE))
        raise InputError(
            f"run {run.run!r} and the reference {reference.run!r} are at different poses from reading {row + 1} on; "
            f"to take a reference off, both must be read at the same poses, in the same order"
        )
