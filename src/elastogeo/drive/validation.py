"""Does the balance predict runs that it was not identified from? And what structure do its residuals have left?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.drive.balance import (
    COLLINEAR,
    BalanceFit,
    check_records,
    design_rows,
    factors_of,
    free_labels,
    live_masks,
    load_names,
)
from elastogeo.drive.model import Mask, TorqueModel, usable
from elastogeo.drive.nonlinear import Search, lowest, make_search
from elastogeo.drive.records import DriveRecord
from elastogeo.errors import RankError
from elastogeo.estimate import confounding, merge, solve
from elastogeo.machine import Array

NOISE = 2.58
"""Standard deviations that noise exceeds once in a hundred times."""

LEAST_SAMPLES = 10
"""Of a direction, without which its mean residual says nothing."""


@dataclass(frozen=True, slots=True)
class RunScore:
    """How well a balance predicts a run.

    Attributes
    ----------
    run : str
    samples : int
    rmse : float
        In the unit of the effort.
    r2 : float
        Share of the variance of this run's effort that is predicted; negative if its mean would predict better.
    """

    run: str
    samples: int
    rmse: float
    r2: float


@dataclass(frozen=True, slots=True)
class LeftOut:
    """Every run predicted from all others.

    Attributes
    ----------
    scores : tuple of RunScore
    searched : mapping of str to tuple of float
        What the searched parameters were without each run, in the order of the runs.
    """

    scores: tuple[RunScore, ...]
    searched: Mapping[str, tuple[float, ...]]

    @property
    def rmse(self) -> float:
        """Over all samples of all runs [unit of the effort]."""
        samples = sum(score.samples for score in self.scores)
        return float(np.sqrt(sum(score.samples * score.rmse**2 for score in self.scores) / samples))


@dataclass(frozen=True, slots=True)
class Structure:
    """What residuals have left.

    Attributes
    ----------
    autocorrelation : float
        Of samples that are `apart`: neighbours, or, in a record that went through a low-pass, two periods of its cut-off,
        since it makes neighbours alike.
    apart : float [s]
    limit : float
        That white noise exceeds once in a hundred records.
    forward, backward : float or None
        Mean residual by the direction of the motion [unit of the effort].
    slow, fast : float
        RMS of the slower and of the faster half of the samples [unit of the effort].
    rms : float
        Of all [unit of the effort].
    flips : float
        Share of the used samples whose velocity has another sign than both neighbours: signs that noise decides.
    """

    autocorrelation: float
    apart: float
    limit: float
    forward: float | None
    backward: float | None
    slow: float
    fast: float
    rms: float
    flips: float


def predict(fit: BalanceFit, records: Sequence[DriveRecord], masks: Sequence[Mask] | None = None) -> tuple[RunScore, ...]:
    """Score an identified balance on runs, loaded ones with the loads that it knows.

    Raises
    ------
    RankError
        If the balance is not determined, or a run has a load that was not identified.
    """
    balance = fit.balance
    loads = _loads(fit)
    strangers = [name for name in load_names(records) if name not in loads]
    if strangers:
        run = next(record.run for record in records if strangers[0] in record.disturbance)
        raise RankError(
            f"axis {fit.axis}: the load {strangers[0]} of run {run} is in no run that was identified; it cannot be predicted"
        )
    scores = []
    for k, record in enumerate(records):
        mask = usable(record, fit.model) if masks is None else masks[k]
        scores.append(_score(record.run, record.effort[mask], (balance.effort(record) + _load(record, loads))[mask]))
    return tuple(scores)


def leave_one_run_out(
    records: Sequence[DriveRecord],
    model: TorqueModel,
    searched: Sequence[str] = (),
    known: Mapping[str, float] | None = None,
    chosen: Sequence[Mask] | None = None,
    search: Search | None = None,
    judged: Sequence[Mask] | None = None,
) -> LeftOut:
    """Predict every run from all others; what is searched is searched again without it.

    Parameters
    ----------
    records, model, searched, known, chosen, search
        As in `search_balance`.
    judged : sequence of array of bool, shape (m,), optional
        Samples of each record that are predicted; default those that are identified from.

    Raises
    ------
    RankError
        If the runs that remain without one do not tell the parameters apart.
    """
    known = known or {}
    check_records(records, model, known)
    made = (search or make_search(records, model, searched, known, chosen)) if searched else None
    masks = made.masks if made else live_masks(records, model, chosen)
    if len(records) < 2:
        raise RankError(f"axis {records[0].axis}: one run alone cannot be left out; record another")
    labels = free_labels(records, model, known)
    fixed = [] if made else factors_of(design_rows(records, model, known, masks), labels)
    scores, values = [], []
    for k, record in enumerate(records):
        others = [n for n in range(len(records)) if n != k]
        law, factors = model, fixed
        if made:
            point = lowest(made.factors_at, made.ranges, others, made.best)
            law, factors = made.ranges.model(model, point), made.factors_at(point)
            values.append([made.ranges.value(name, at) for name, at in zip(made.ranges.names, point, strict=True)])
        rest = merge(*(factors[n] for n in others))
        if confounding(rest, tolerance=COLLINEAR).rank < len(labels):
            raise RankError(f"axis {record.axis}: without run {record.run} the others do not determine all parameters")
        rows = design_rows(records, law, known, judged or masks)[k]
        effort = record.effort[(judged or masks)[k]]
        # The last column is the effort less its known part.
        scores.append(_score(record.run, effort, rows[:, :-1] @ solve(rest, labels).values + effort - rows[:, -1]))
    names = made.ranges.names if made else ()
    return LeftOut(tuple(scores), {name: tuple(v[n] for v in values) for n, name in enumerate(names)})


def structure(fit: BalanceFit, records: Sequence[DriveRecord], masks: Sequence[Mask] | None = None) -> Structure:
    """What structure the residuals of a determined balance have left."""
    balance = fit.balance
    loads = _loads(fit)
    products, squares, pairs = 0.0, 0.0, 0.0
    residuals, speeds, flips = [], [], 0
    for k, record in enumerate(records):
        mask = usable(record, fit.model) if masks is None else masks[k]
        residual = balance.disturbance(record) - _load(record, loads)
        lag, independent = _lag(record)
        both = mask[lag:] & mask[:-lag]
        products += float(np.sum((residual[lag:] * residual[:-lag])[both]))
        squares += float(np.sum((residual[lag:] ** 2 + residual[:-lag] ** 2)[both])) / 2
        pairs += independent * float(both.sum())
        residuals.append(residual[mask])
        speeds.append(record.velocity[mask])
        flips += _flips(record.velocity, mask)
    left, velocity = np.concatenate(residuals), np.concatenate(speeds)
    slow = np.abs(velocity) <= np.median(np.abs(velocity))
    return Structure(
        autocorrelation=products / squares if squares > 0 else float("nan"),
        apart=_lag(records[0])[0] * records[0].step,
        limit=NOISE / float(np.sqrt(max(pairs, 1.0))),
        forward=_mean(left[velocity > 0]),
        backward=_mean(left[velocity < 0]),
        slow=_rms(left[slow]),
        fast=_rms(left[~slow]),
        rms=_rms(left),
        flips=flips / len(left),
    )


def _loads(fit: BalanceFit) -> dict[str, float]:
    """What was identified or known, by name; the loads are among it."""
    return dict(zip(fit.solution.labels, fit.solution.values.tolist(), strict=True)) | dict(fit.known)


def _load(record: DriveRecord, loads: Mapping[str, float]) -> Array:
    """Effort that the loads of a run take, shape (m,)."""
    return sum((loads[name] * pattern for name, pattern in record.disturbance.items()), np.zeros(len(record.time)))


def _lag(record: DriveRecord) -> tuple[int, float]:
    """Samples between residuals that a low-pass does not tie together, and the share of samples that are independent."""
    if record.cutoff is None:
        return 1, 1.0
    # The pass band, forward and backward, is that of white noise up to about 0.8 of the cut-off.
    per_sample = record.cutoff * record.step
    return min(int(np.ceil(2 / per_sample)), len(record.time) - 1), min(1.0, 1.6 * per_sample)


def _flips(velocity: Array, mask: Mask) -> int:
    sign = np.sign(velocity)
    alone = (sign[1:-1] * sign[:-2] < 0) & (sign[1:-1] * sign[2:] < 0) & mask[1:-1]
    return int(alone.sum())


def _mean(values: Array) -> float | None:
    return float(values.mean()) if len(values) >= LEAST_SAMPLES else None


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else float("nan")


def _score(run: str, effort: Array, predicted: Array) -> RunScore:
    if not len(effort):
        return RunScore(run, 0, 0.0, float("nan"))
    error = effort - predicted
    spread = float(np.sum((effort - effort.mean()) ** 2))
    r2 = 1.0 - float(error @ error) / spread if spread > 0 else float("nan")
    return RunScore(run, len(effort), _rms(error), r2)
