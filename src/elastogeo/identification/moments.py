"""What runs say of the parameters, and what systematic influences change of it: made run by run, in one pass.

The normal equations of every run, on columns scaled to unit length over all runs. The design is well conditioned on scaled
columns (the verdict says when it is not), so that they lose nothing here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.estimate import Solution, select
from elastogeo.identification.influences import Effect
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array


@dataclass(frozen=True, slots=True)
class Loads:
    """What q of all k effects, those on single loads, change in the normal equations of p parameters.

    With the sizes s of all effects and D_i the change of the design, the information gains `sum s_i (D_i^T A + A^T D_i) +
    sum s_i s_j D_i^T D_j`, the moment `sum s_i (D_i^T y - sum s_l D_i^T shift_l)`.
    """

    which: np.ndarray[tuple[int], np.dtype[np.int_]]
    cross: Array
    square: Array
    moment: Array
    shifted: Array

    def information(self, sizes: Array) -> Array:
        """What draws of the sizes, shape (c, k), add to the information, shape (c, p, p)."""
        own = sizes[:, self.which]
        return np.asarray(
            np.einsum("ci,ipq->cpq", own, self.cross) + np.einsum("ci,cj,ijpq->cpq", own, own, self.square, optimize=True)
        )

    def moved(self, sizes: Array) -> Array:
        """What they add to the moment, shape (c, p)."""
        own = sizes[:, self.which]
        return np.asarray(own @ self.moment - np.einsum("ci,cl,ilp->cp", own, sizes, self.shifted, optimize=True))


@dataclass(frozen=True, slots=True)
class Moments:
    """The normal equations of every run about a solution, and what k effects change of them.

    Attributes
    ----------
    effects : tuple of Effect, length k
    norms : array, shape (p,)
        Length of each column over all runs.
    gram : array, shape (runs, p, p)
    moment : array, shape (runs, p)
    powers : array, shape (p,)
        Of the force in each column.
    shifted : array, shape (k, runs, p)
        `A^T s` for the change s of the readings.
    moved : array, shape (k, runs, p)
        By how much the normal equations of each run are off per unit of the influence quantity.
    loads : Loads
    """

    effects: tuple[Effect, ...]
    norms: Array
    gram: Array
    moment: Array
    powers: Array
    shifted: Array
    moved: Array
    loads: Loads


def moments_of(systems: Systems, solution: Solution, effects: Sequence[Effect]) -> Moments:
    """The moments of all runs about a solution."""
    runs = [select(run.factor, solution.labels) for run in systems.runs]
    norms = np.sqrt(sum(np.sum(run.R**2, axis=0) for run in runs))
    by_name = {source.name: source.force_degree for source in systems.sources}
    gram = np.array([(run.R / norms).T @ (run.R / norms) for run in runs])
    moment = np.array([(run.R / norms).T @ run.z for run in runs])
    powers = np.array([by_name[label] for label in solution.labels])
    values = solution.values * norms
    shifted, pulled, loads = _by_readings(systems, solution.labels, effects, norms, values)
    stretch = np.array([effect.stretch for effect in effects]).reshape(len(effects), len(runs), 1)
    stretched = powers * (moment - gram @ values) - gram @ (powers * values)
    return Moments(tuple(effects), norms, gram, moment, powers, shifted, stretch * stretched - shifted + pulled, loads)


def _by_readings(
    systems: Systems, labels: Sequence[str], effects: Sequence[Effect], norms: Array, values: Array
) -> tuple[Array, Array, Loads]:
    """What the effects change reading by reading: `A^T s`, what single loads pull the normal equations, and of all loads."""
    k, p = len(effects), len(norms)
    which = np.array([i for i, effect in enumerate(effects) if effect.columns is not None], dtype=int)
    q, row = len(which), {int(i): n for n, i in enumerate(which)}
    shifted, pulled = np.zeros((k, len(systems.runs), p)), np.zeros((k, len(systems.runs), p))
    loads = Loads(which, np.zeros((q, p, p)), np.zeros((q, q, p, p)), np.zeros((q, p)), np.zeros((q, k, p)))
    for n, run in enumerate(systems.runs):
        acting = [i for i, effect in enumerate(effects) if effect.acts_in(run.test)]
        if not acting:
            continue
        here = run.holding(labels)
        design, counted = here.design_of(labels) / norms, np.reshape(here.counted, (-1, 1))
        shifts = {i: np.asarray(shift(here)) for i in acting if (shift := effects[i].shift) is not None}
        changes = {i: _change(effects[i], here, labels, norms) for i in acting if i in row}
        weighted = {i: counted * change for i, change in changes.items()}
        for i, off in shifts.items():
            shifted[i, n] = (design * counted).T @ off
        for i, change in weighted.items():
            cross, pull = change.T @ design, change.T @ here.reading
            pulled[i, n] = pull - (cross + cross.T) @ values
            loads.cross[row[i]] += cross + cross.T
            loads.moment[row[i]] += pull
            for j, other in changes.items():
                loads.square[row[i], row[j]] += change.T @ other
            for j, off in shifts.items():
                loads.shifted[row[i], j] += change.T @ off
    return shifted, pulled, loads


def _change(effect: Effect, run: RunSystem, labels: Sequence[str], norms: Array) -> Array:
    """Change of the design of a run, scaled like its columns; of parameters that are of other tests, none."""
    assert effect.columns is not None
    columns, chosen = effect.columns(run), [run.factor.labels.index(label) for label in labels]
    absent = set() if run.recipe is None else set(labels) - {source.name for source in run.recipe.sources}
    return np.asarray(columns[:, chosen] * [label not in absent for label in labels] / norms)
