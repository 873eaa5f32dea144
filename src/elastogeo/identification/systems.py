"""One linear system per run, less a reference force level if one is asked for, and less the run's own set-up.

What every run has for itself (where its circle really lies) is no parameter: it is projected out of the rows of the run, as
if it were estimated in each run anew (Frisch, Waugh and Lovell). What is left of the rows has as many readings less.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Factor, Noise, merge
from elastogeo.identification.levels import ForceLevels, ForceSpread, force_levels
from elastogeo.identification.run_system import Recipe, RunSystem, run_system, without_still
from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations
from elastogeo.sources import Source, column_ceilings, design_rows

SAME_POSE = 1e-6
"""Commands [mm, rad] that differ by less are the same pose."""


@dataclass(frozen=True, slots=True)
class Systems:
    """The systems of the runs of a test, or of several.

    Attributes
    ----------
    sources : tuple of Source
        One per column.
    runs : tuple of RunSystem
        In the order of the test, without the reference runs if they are subtracted.
    references : int
        How many reference runs were averaged and subtracted from each run; 0 if none was.
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
        """The same systems, of whose rows these columns are held, or more."""
        return replace(self, runs=tuple(run.holding(labels) for run in self.runs))

    @property
    def strongest(self) -> tuple[RunSystem, ...]:
        """The runs at the highest force of their test."""
        most = {test: max((run.force for run in self.runs if run.test == test), key=abs) for test in self.tests}
        return tuple(run for run in self.runs if run.force == most[run.test])

    def range_per_unit(self, labels: Sequence[str]) -> Array:
        """Range that a unit of each parameter gives the readings of a run at the highest force, shape (p,).

        With zero in it, so that what shifts all readings alike counts in full. Of several runs the greatest; where some
        read lengths and some angles, that of lengths.
        """
        lengths = [run for run in self.strongest if not run.angular]
        return greatest_range([ranges_of(run, labels) for run in lengths or self.strongest])

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


def ranges_of(run: RunSystem, labels: Sequence[str]) -> Array:
    """Range that a unit of each parameter gives the readings of a run, with zero in it, shape (p,)."""
    columns = run.design_of(labels)
    return np.asarray(np.maximum(columns.max(axis=0), 0.0) - np.minimum(columns.min(axis=0), 0.0))


def greatest_range(ranges: Sequence[Array]) -> Array:
    """The greatest of the ranges of several runs, shape (p,)."""
    return np.asarray(np.max(ranges, axis=0))


def run_systems(
    sources: Sequence[Source],
    machine: Machine,
    observations: Sequence[Observations],
    reference: float | None = None,
    own: Sequence[Source] = (),
    spread: ForceSpread | None = None,
    test: str = "",
    absent: Collection[str] = (),
    observe: Callable[[], Sequence[Observations]] | None = None,
) -> Systems:
    """The linear system of every run of a test.

    Parameters
    ----------
    sources : sequence of Source, length p
    machine : Machine
    observations : sequence of Observations
        One per run.
    reference : float, optional [N]
        Force level whose readings and model are subtracted from all others, at the same poses (Eqs. 4.26, 4.27). What does
        not change with the load then cancels, from the readings and from the model alike.
    own : sequence of Source
        The set-up that every run has for itself.
    spread : ForceSpread, optional
        How well the forces of the runs are known against one another.
    test : str
        Name of the test.
    absent : collection of str
        Names of the sources that are of other tests: they move no reading of this one.
    observe : callable, optional
        Makes the observations again. If it is given, no run holds its rows: they are made again when they are asked for.

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
    made = (_rows(acting, own, machine, run, here, len(sources)) for run in observations)
    rows: Iterable[tuple[Array, Array]] = made if reference is None else list(made)
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
                f"the reference level {reference:g} N cannot be subtracted: the runs are at {there} N; "
                f"it takes a run at the reference and one at another level"
            )
        base = observations[is_reference.index(True)]
        for run in observations:
            _check_same_poses(run, base)
        taken = sum(r for (r, _), is_ref in zip(rows, is_reference, strict=True) if is_ref) / references
        rows = [(r - taken, columns) for r, columns in rows]
        forces = [force - levels.level(base.force) for force in forces]
    names = tuple(source.name for source in own)
    every = (
        run_system(labels, run, force, r, columns, names, test)
        for run, force, (r, columns), is_ref in zip(observations, forces, rows, is_reference, strict=True)
        if not is_ref
    )
    runs = without_still(every, hold=observe is None)
    if observe is not None:
        moving = tuple(source for source in own if source.name in runs[0].set_up_names)
        recipes = (Recipe(partial(_one_of, observe, k), tuple(acting), moving, machine) for k in range(len(runs)))
        runs = tuple(replace(run, recipe=recipe) for run, recipe in zip(runs, recipes, strict=True))
    ceilings = np.zeros(len(sources))
    ceilings[here] = np.linalg.norm([column_ceilings(acting, machine, run) for run in observations], axis=0)
    return Systems(tuple(sources), runs, references, applied, ceilings)


def _one_of(observe: Callable[[], Sequence[Observations]], k: int) -> Observations:
    """One run of a test that is observed anew."""
    return observe()[k]


def _rows(
    acting: Sequence[Source],
    own: Sequence[Source],
    machine: Machine,
    run: Observations,
    here: Sequence[int],
    columns: int,
) -> tuple[Array, Array]:
    """Rows of the sources that act in a test, in the columns of all sources; and the columns of the run's own set-up."""
    made = design_rows([*acting, *own], machine, run)
    every = np.zeros((len(made), columns + 1), order="F")
    every[:, [*here, columns]] = made[:, [*range(len(acting)), -1]]
    return every, made[:, len(acting) : -1].copy(order="F")


def joined(tests: Sequence[Systems]) -> Systems:
    """The systems of several tests as one; of one test, itself.

    Forces of different tests that agree are one level. Of their rows none are held.
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
    readings, count = runs[0].readings, len(runs)
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
