"""Compliance that changes with the force in proportion to it (Eq. 5.39): each compliance of the model is `C0 + C1 F`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import DegreesOfFreedomError, RankError
from elastogeo.estimate import Estimate, Factor, Solution, factor_blocks, merge, solve, solve_by_run
from elastogeo.identification.fit import Fit, fit_of
from elastogeo.identification.model_choice.candidates import elastic_among
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array

LEAST_LEVELS = 3
"""Force levels that it takes to see a compliance change beside a geometry that does not."""


@dataclass(frozen=True, slots=True, eq=False)
class VariableCompliance(ByValue):
    """The model in which every compliance changes with the force, each in its own way.

    **More parameters always fit better: whether the data support this model is for the comparison of models to say.**

    Attributes
    ----------
    elastic : tuple of str
        The compliances that may change.
    solution : Solution
        All parameters of the model as asked, the compliances at no force; then what each gains per newton (`CF1_XXX`).
    by_run : bool
        Whether the covariance assumes independent runs; if not, independent readings, and it is no uncertainty.
    rmse : float [mm]
        Over all readings.
    levels : tuple of Fit
        At each force level.
    """

    elastic: tuple[str, ...]
    solution: Solution
    by_run: bool
    rmse: float
    levels: tuple[Fit, ...]

    def at(self, name: str, force: float) -> Estimate:
        """A parameter at a force [N], with its uncertainty from the scatter alone; the lesser degrees of freedom of the two.

        Of a parameter that does not change with the force, what it is at any.
        """
        if name not in self.elastic:
            return self.solution.estimate(name)
        return self._combined(name, 1.0, force)

    def change(self, name: str, distance: float) -> Estimate:
        """What a compliance gains over this many newtons."""
        return self._combined(name, 0.0, distance)

    def _combined(self, name: str, constant: float, force: float) -> Estimate:
        labels, weights = self.solution.labels, np.zeros(len(self.solution.labels))
        at = [labels.index(name), labels.index(gain_of(name))]
        weights[at] = constant, force
        variance = float(weights @ self.solution.covariance @ weights)
        freedom = float(self.solution.degrees_of_freedom[at].min())
        return Estimate(float(weights @ self.solution.values), float(np.sqrt(max(variance, 0.0))), freedom)


def gain_of(name: str) -> str:
    """The name of what a compliance gains per newton."""
    return f"CF1_{name.removeprefix('C_')}"


def variable_compliance(systems: Systems, retained: Sequence[str]) -> VariableCompliance | None:
    """The model in which every retained compliance changes with the force; None where the runs do not determine it.

    Parameters
    ----------
    systems : Systems
        No reference subtracted.
    retained : sequence of str
        Parameters of the model as asked.
    """
    elastic = elastic_among(systems, retained)
    if systems.references or not elastic or len(systems.levels) < LEAST_LEVELS:
        return None
    labels = (*retained, *map(gain_of, elastic))
    columns = {run.name: np.column_stack([run.design_of(retained), _gains(run, elastic)]) for run in systems.runs}
    factors = [_factor(run, labels, columns[run.name]) for run in systems.runs]
    try:
        plain = solve(merge(*factors), labels)
    except (RankError, DegreesOfFreedomError):
        return None
    try:
        solution = solve_by_run(factors, labels)
    except DegreesOfFreedomError:
        solution = plain
    predicted = {run.name: columns[run.name] @ solution.values for run in systems.runs}
    levels = tuple(fit_of([(predicted[run.name], run.reading) for run in systems.at(force)]) for force in systems.levels)
    every = fit_of([(predicted[run.name], run.reading) for run in systems.runs])
    return VariableCompliance(tuple(elastic), solution, solution is not plain, every.rmse, levels)


def _gains(run: RunSystem, elastic: Sequence[str]) -> Array:
    """Columns of what each compliance gains per newton, less what the run's own set-up explains of them."""
    force = np.linalg.norm(run.observations.wrench[:, :3], axis=1)
    if np.ptp(force) <= np.finfo(float).eps * force.max():
        return np.asarray(run.design_of(elastic) * force[0])
    at = [run.factor.labels.index(label) for label in elastic]
    whole = run.design_of(elastic) + run.own @ run.aside[:, at]
    return run.without_own(whole * force[:, np.newaxis])


def _factor(run: RunSystem, labels: Sequence[str], columns: Array) -> Factor:
    root = 1.0 if run.weights is None else np.sqrt(run.weights)[:, np.newaxis]
    rows = np.column_stack([columns, run.reading]) * root
    return replace(factor_blocks(labels, [np.asfortranarray(rows)]), rows=run.factor.rows)
