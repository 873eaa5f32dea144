"""How the compliance depends on the force: constant, linear, quadratic, stiffening; and which of these the data support.

The models are nested. The exponent of a stiffening contact is the one parameter that is not linear in the readings; it is
searched outside the linear solve (variable projection). What decides is prediction of what was left out: a whole run, a
whole force level. F-test and BIC are given beside it; both count on independent readings.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import fdtrc, stdtrit

from elastogeo.errors import RankError
from elastogeo.estimate import Factor, merge, select, solve
from elastogeo.identification.systems import Systems, run_systems
from elastogeo.machine import Array, Machine
from elastogeo.sources import select_sources

EXPONENTS = (0.3, 0.95)
"""Within which the exponent of a stiffening contact is searched; at 1 it is a constant compliance."""

WORTH_HAVING = 0.01
"""A model that lowers the error at left-out levels by less than this share is not worth its parameters."""


@dataclass(frozen=True, slots=True)
class ModelFit:
    """One model of the compliance.

    Attributes
    ----------
    name : str
    labels : tuple of str
        Its parameters.
    rmse : float [mm]
        Over all readings.
    fitness : dict of float to float [%]
        Eq. 5.41 by force level.
    left_out_run, left_out_level : float or None [mm]
        RMSE of the readings of a run, of a level, predicted from all others; None if the others do not determine the model.
    bic : float
        Bayesian information criterion less that of the constant model.
    p_value : float or None
        F-test against the constant model; None for itself.
    exponent : float or None
        Of a stiffening contact.
    """

    name: str
    labels: tuple[str, ...]
    rmse: float
    fitness: dict[float, float]
    left_out_run: float | None
    left_out_level: float | None
    bic: float
    p_value: float | None
    exponent: float | None


@dataclass(frozen=True, slots=True)
class Comparison:
    """Models of one test, and the one that its data support.

    Attributes
    ----------
    models : tuple of ModelFit
        The constant one first.
    supported : str
        Name of the model that predicts left-out levels best, by a gain that is positive at 95 % over the levels and worth
        having; else the simpler one.
    """

    models: tuple[ModelFit, ...]
    supported: str


def compare_models(machine: Machine, systems: Systems, retained: Sequence[str]) -> Comparison:
    """Compare models of the compliance.

    Parameters
    ----------
    machine : Machine
    systems : Systems
        Of the constant model, no reference taken off.
    retained : sequence of str
        Its retained parameters.
    """
    elastic = [label for label in retained if label.startswith("C_")]
    on_axis = [label for label in elastic if label[2] == label[3] == label[4]] or elastic
    exponent = _exponent(machine, systems, retained, on_axis)
    more: dict[str, list[str]] = {
        "constant": [],
        "linear": [f"CF1_{label[2:]}" for label in elastic],
        "quadratic": [f"CF{power}_{label[2:]}" for power in (1, 2) for label in elastic],
        "stiffening": _stiffening(on_axis, exponent),
    }
    runs = {name: _extended(machine, systems, retained, added) for name, added in more.items()}
    fits: list[ModelFit] = []
    errors: dict[str, Array] = {}
    for name, system in runs.items():
        labels = _independent(system, [*retained, *more[name]])
        if fits and len(labels) <= len(retained):
            continue
        fit, errors[name] = _fit(name, system, labels, fits[0] if fits else None, exponent if name == "stiffening" else None)
        fits.append(fit)
    return Comparison(tuple(fits), _supported(fits, errors))


def _fit(
    name: str, systems: Systems, labels: tuple[str, ...], constant: ModelFit | None, exponent: float | None
) -> tuple[ModelFit, Array]:
    runs = [select(run.factor, labels) for run in systems.runs]
    solution = solve(merge(*runs))
    left = np.array([_left(run, solution.values) for run in runs])
    rows = np.array([run.rows for run in runs])
    by_level = [np.array([run in systems.at(level) for run in systems.runs]) for level in systems.levels]
    level_errors = _left_out(runs, by_level)
    run_errors = _left_out(runs, np.eye(len(runs), dtype=bool))
    readings, rss = int(rows.sum()), float(left.sum())
    count = len(labels) + (exponent is not None)
    bic = readings * np.log(rss / readings) + count * np.log(readings)
    p_value = None
    if constant is not None:
        added = count - len(constant.labels)
        gain = (constant.rmse**2 * readings - rss) / added
        p_value = float(fdtrc(added, readings - count, gain / (rss / (readings - count))))
    fit = ModelFit(
        name=name,
        labels=labels,
        rmse=float(np.sqrt(rss / readings)),
        fitness={
            level: _fitness(systems, level, left[at].sum() / rows[at].sum())
            for level, at in zip(systems.levels, by_level, strict=True)
        },
        left_out_run=None if run_errors is None else float(np.sqrt(run_errors.sum() / readings)),
        left_out_level=None if level_errors is None else float(np.sqrt(level_errors.sum() / readings)),
        bic=float(bic) - (0.0 if constant is None else _bic(constant, readings)),
        p_value=p_value,
        exponent=exponent,
    )
    errors = np.full(len(by_level), np.nan)
    if level_errors is not None:
        errors = level_errors / np.array([rows[at].sum() for at in by_level])
    return (replace(fit, bic=0.0) if constant is None else fit), errors


def _bic(fit: ModelFit, readings: int) -> float:
    return float(readings * np.log(fit.rmse**2) + len(fit.labels) * np.log(readings))


def _left(run: Factor, values: Array) -> float:
    """Residual sum of squares of one run for given values."""
    return float(np.sum((run.z - run.R @ values) ** 2) + run.residual_norm**2)


def _left_out(runs: Sequence[Factor], groups: Iterable[Array]) -> Array | None:
    """Sum of squared errors of each group of runs, predicted from all others; None if they do not determine the model."""
    errors = []
    for group in groups:
        others = [run for run, out in zip(runs, group, strict=True) if not out]
        if not others:
            return None
        try:
            values = solve(merge(*others)).values
        except RankError:
            return None
        errors.append(sum(_left(run, values) for run, out in zip(runs, group, strict=True) if out))
    return np.array(errors)


def _fitness(systems: Systems, level: float, mean_square: float) -> float:
    measured = np.concatenate([run.reading for run in systems.at(level)])
    span = float(np.ptp(measured))
    return 100.0 * (1.0 - float(np.sqrt(mean_square)) / span) if span > 0 else float("nan")


def _supported(fits: Sequence[ModelFit], errors: dict[str, Array]) -> str:
    """The simplest model that no richer one beats at left-out levels, by a gain that is sure (95 %) and worth having."""
    best = fits[0]
    for fit in sorted(fits[1:], key=lambda fit: len(fit.labels)):
        gain = errors[best.name] - errors[fit.name]
        if best.left_out_level is None or fit.left_out_level is None or len(gain) < 3:
            continue
        least = gain.mean() - stdtrit(len(gain) - 1, 0.95) * gain.std(ddof=1) / np.sqrt(len(gain))
        if least > 0 and fit.left_out_level < (1 - WORTH_HAVING) * best.left_out_level:
            best = fit
    return best.name


def _extended(machine: Machine, systems: Systems, retained: Sequence[str], added: Sequence[str]) -> Systems:
    sources = select_sources(machine, [*retained, *added])
    return run_systems(
        sources, machine, [run.observations for run in systems.runs], own=systems.own, spread=systems.applied.spread
    )


def _independent(systems: Systems, labels: Sequence[str]) -> tuple[str, ...]:
    """The labels, or the retained ones alone if the levels are too few for the others."""
    factor = merge(*(run.factor for run in systems.runs))
    for count in range(len(labels), 0, -1):
        try:
            solve(factor, labels[:count])
        except RankError:
            continue
        return tuple(labels[:count])
    return tuple(labels)


def _stiffening(on_axis: Sequence[str], exponent: float) -> list[str]:
    return [f"H{exponent:.6f}_{label[2:]}" for label in on_axis]


def _exponent(machine: Machine, systems: Systems, retained: Sequence[str], on_axis: Sequence[str]) -> float:
    """The exponent with the least residual sum of squares, by a bounded search outside the linear solve."""
    from scipy.optimize import minimize_scalar

    def left(exponent: float) -> float:
        labels = [*retained, *_stiffening(on_axis, exponent)]
        factor = merge(*(run.factor for run in _extended(machine, systems, retained, labels[len(retained) :]).runs))
        return select(factor, labels).residual_norm

    return float(minimize_scalar(left, bounds=EXPONENTS, method="bounded", options={"xatol": 1e-4}).x)
