"""The torque balance of a feed drive (Eqs. 6.6 to 6.9): least squares by the factor, with its uncertainty and confounding.

    effort = J dv/dt + B v + tau_c sgn(v) + constant + sum of loads times their direction patterns

The columns are measured themselves, so two that differ by their noise only would be "distinguished" by it. Hence the
wide tolerance `COLLINEAR`. What is not distinguished is named with what would separate it, and gets no number of its own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from elastogeo.drive.model import Mask, TorqueModel, motion_columns, usable
from elastogeo.drive.records import DriveRecord
from elastogeo.drive.separation import advice, at_rest, named
from elastogeo.errors import DegreesOfFreedomError, InputError, RankError
from elastogeo.estimate import Confounding, Factor, Solution, confounding, factor_blocks, merge, solve, solve_by_run
from elastogeo.machine import Array

COLLINEAR = 0.02
"""A column whose distance from the span of the others is less than this share of its length is not told from them: the
noise of an encoder, a differentiator or an interpolation makes such differences."""

PIECES = 12
"""Into how many pieces the runs are cut, all together, where they are too few for an uncertainty by run."""

LEAST_PIECE = 20
"""Samples that a piece must have at least."""


@dataclass(frozen=True, slots=True, eq=False)
class TorqueBalance:
    """An identified torque balance: every term told from the others.

    Attributes
    ----------
    axis : str
    model : TorqueModel
    labels : tuple of str
        Of the p terms of the motion; loads are not among them.
    values : array, shape (p,)
        In `units`.
    covariance : array, shape (p, p)
    degrees_of_freedom : array, shape (p,)
    residual_std : float [`effort_unit`]
    units : mapping of str to str
    effort_unit : str
    """

    axis: str
    model: TorqueModel
    labels: tuple[str, ...]
    values: Array
    covariance: Array
    degrees_of_freedom: Array
    residual_std: float
    units: Mapping[str, str]
    effort_unit: str = "A"

    def effort(self, record: DriveRecord) -> Array:
        """Effort that the motion alone takes, shape (m,) [`effort_unit`]; at standstill a sharp sign knows no friction."""
        self._check(record)
        labels, columns = motion_columns(record, self.model)
        return np.asarray(columns @ self.values[[self.labels.index(label) for label in labels]])

    def disturbance(self, record: DriveRecord) -> Array:
        """Effort that the motion does not explain, shape (m,) [`effort_unit`]: that of the load (Eq. 6.6)."""
        return np.asarray(record.effort - self.effort(record))

    def _check(self, record: DriveRecord) -> None:
        if (record.axis, record.effort_unit) != (self.axis, self.effort_unit):
            raise InputError(
                f"run {record.run} is of axis {record.axis} in {record.effort_unit}, the balance of axis {self.axis} in "
                f"{self.effort_unit}; use a record of the same drive in the same unit"
            )


@dataclass(frozen=True, slots=True)
class Searched:
    """A parameter that is not linear in the effort, found outside the linear solve.

    Attributes
    ----------
    name, unit : str
    value : float
    interval : tuple of 2 (float or None)
        95 % from the profile; None where it stays inside to the end of what was searched.
    at_bound : bool
        Whether the best value is an end of what was searched.
    """

    name: str
    unit: str
    value: float
    interval: tuple[float | None, float | None]
    at_bound: bool


@dataclass(frozen=True, slots=True, eq=False)
class BalanceFit:
    """What the records say of the balance of one axis.

    Attributes
    ----------
    axis, effort_unit : str
    model : TorqueModel
    known : mapping of str to float
        Parameters that were given, not identified.
    samples : mapping of str to int
        Samples used, by run.
    left_out : int
        Samples that were too slow or without a motion.
    confounding : Confounding
    solution : Solution
        Of the retained parameters, loads included; each stands for `confounding.stands_for`.
    counted : str
        What the uncertainties take as independent: `runs`; `pieces` of the runs, where the runs are too few; `samples`,
        where the pieces are too few as well: neighbours in a log hardly are, so these uncertainties are too small.
    rmse : float [`effort_unit`]
    r2 : float
        Share of the variance of the effort that is explained, over the used samples of all runs.
    units : mapping of str to str
    searched : tuple of Searched
    """

    axis: str
    effort_unit: str
    model: TorqueModel
    known: Mapping[str, float]
    samples: Mapping[str, int]
    left_out: int
    confounding: Confounding
    solution: Solution
    counted: str
    rmse: float
    r2: float
    units: Mapping[str, str]
    searched: tuple[Searched, ...] = field(default=())

    @property
    def mixed(self) -> dict[str, dict[str, float]]:
        """Retained parameters that stand for more than themselves: the combination of each by its name."""
        stands = {name: self.confounding.stands_for(name) for name in self.confounding.retained}
        return {name: terms for name, terms in stands.items() if len(terms) > 1}

    @property
    def separated(self) -> bool:
        """Whether every parameter is determined by itself."""
        return not self.mixed and not self.confounding.null

    @property
    def sentence(self) -> str:
        """What cannot be distinguished, and what would separate it; empty if all can."""
        return advice(self.axis, self.confounding)

    @property
    def determined(self) -> dict[str, float]:
        """Values of the parameters that are determined by themselves, by name; no other has a number."""
        told = dict(zip(self.solution.labels, self.solution.values.tolist(), strict=True))
        inside = {name for terms in self.mixed.values() for name in terms}
        return {name: value for name, value in told.items() if name not in inside}

    @property
    def balance(self) -> TorqueBalance:
        """The identified balance.

        Raises
        ------
        RankError
            If a term is determined only together with others.
        """
        if not self.separated:
            raise RankError(self.sentence)
        labels = self.model.labels
        free = [label for label in labels if label not in self.known]
        at = [self.solution.labels.index(label) for label in free]
        to = [labels.index(label) for label in free]
        values, covariance = np.zeros(len(labels)), np.zeros((len(labels), len(labels)))
        freedom = np.full(len(labels), np.inf)
        values[:] = [self.known.get(label, 0.0) for label in labels]
        values[to], freedom[to] = self.solution.values[at], self.solution.degrees_of_freedom[at]
        covariance[np.ix_(to, to)] = self.solution.covariance[np.ix_(at, at)]
        return TorqueBalance(
            axis=self.axis,
            model=self.model,
            labels=labels,
            values=values,
            covariance=covariance,
            degrees_of_freedom=freedom,
            residual_std=self.solution.residual_std,
            units={label: self.units[label] for label in labels},
            effort_unit=self.effort_unit,
        )


def identify_balance(
    records: Sequence[DriveRecord],
    model: TorqueModel | None = None,
    known: Mapping[str, float] | None = None,
    chosen: Sequence[Mask] | None = None,
) -> BalanceFit:
    """Identify the torque balance of one axis.

    Parameters
    ----------
    records : sequence of DriveRecord
        Of one axis, one per run. Loads that carry the same name are one load.
    model : TorqueModel, optional
        Default the plain four terms.
    known : mapping of str to float, optional
        Parameters that are given; their part is subtracted from the effort.
    chosen : sequence of array of bool, shape (m,), optional
        Samples to use of each record; default `usable`.

    Returns
    -------
    BalanceFit
        `balance` and `determined` give numbers only for what the records distinguish.

    Raises
    ------
    RankError
        If the axis cannot be identified at all: its effort or its motion is nothing.
    DegreesOfFreedomError
        If there are no more samples than parameters.
    InputError
        If the records are not of one axis in one unit, or a known parameter is none of the model.
    """
    model, known = model or TorqueModel(), known or {}
    check_records(records, model, known)
    masks = live_masks(records, model, chosen)
    rows = design_rows(records, model, known, masks)
    labels = free_labels(records, model, known)
    factor = merge(*factors_of(rows, labels))
    found = confounding(factor, labels, _ceilings(factor, records), COLLINEAR)
    solution, counted = solved(rows, labels, found.retained)
    at = [found.labels.index(label) for label in solution.labels]
    residual = np.concatenate([block[:, -1] - block[:, at] @ solution.values for block in rows])
    effort = np.concatenate([record.effort[mask] for record, mask in zip(records, masks, strict=True)])
    spread = float(np.sum((effort - effort.mean()) ** 2))
    return BalanceFit(
        axis=records[0].axis,
        effort_unit=records[0].effort_unit,
        model=model,
        known=dict(known),
        samples={record.run: int(mask.sum()) for record, mask in zip(records, masks, strict=True)},
        left_out=int(sum((~mask).sum() for mask in masks)),
        confounding=found,
        solution=solution,
        counted=counted,
        rmse=float(np.sqrt(np.mean(residual**2))),
        r2=1.0 - float(residual @ residual) / spread if spread > 0 else float("nan"),
        units=units_of(records, model),
    )


def _ceilings(factor: Factor, records: Sequence[DriveRecord]) -> Array:
    """The length of each column if nothing cancelled: an acceleration is a difference of velocities a sample apart."""
    jump = max(float(np.abs(record.velocity).max()) / record.step for record in records)
    of = {"inertia": jump * np.sqrt(factor.rows)}
    return np.array([of.get(label, norm) for label, norm in zip(factor.labels, factor.column_norms, strict=True)])


def solved(rows: Sequence[Array], labels: Sequence[str], retained: Sequence[str]) -> tuple[Solution, str]:
    """The solution from the rows of each run, and what its uncertainty takes as independent: runs, pieces, or samples."""
    cut = -(-PIECES // len(rows))
    ways = {"runs": rows, "pieces": [piece for run in rows for piece in np.array_split(run, cut)]}
    for counted, parts in ways.items():
        if min(map(len, parts)) < LEAST_PIECE and counted == "pieces":
            continue
        try:
            return solve_by_run(factors_of(parts, labels), retained), counted
        except DegreesOfFreedomError:
            continue
    return solve(merge(*factors_of(rows, labels)), retained), "samples"


def factors_of(rows: Sequence[Array], labels: Sequence[str]) -> list[Factor]:
    """One factor for the rows `[A | y]` of each run."""
    return [factor_blocks(labels, [np.array(run, order="F")]) for run in rows]


def free_labels(records: Sequence[DriveRecord], model: TorqueModel, known: Mapping[str, float]) -> tuple[str, ...]:
    """Names of the parameters to identify: the terms of the motion, then the loads."""
    return tuple(label for label in (*model.labels, *load_names(records)) if label not in known)


def load_names(records: Sequence[DriveRecord]) -> tuple[str, ...]:
    """Names of the loads of all records, each once."""
    return tuple(dict.fromkeys(name for record in records for name in record.disturbance))


def design_rows(
    records: Sequence[DriveRecord], model: TorqueModel, known: Mapping[str, float], masks: Sequence[Mask]
) -> list[Array]:
    """Rows `[A | y]` of every run for `free_labels`, each of shape (samples, parameters + 1)."""
    loads = load_names(records)
    return [_rows(record, model, known, mask, loads) for record, mask in zip(records, masks, strict=True)]


def _rows(record: DriveRecord, model: TorqueModel, known: Mapping[str, float], mask: Mask, loads: Sequence[str]) -> Array:
    labels, columns = motion_columns(record, model)
    nothing = np.zeros(len(record.time))
    patterns = [record.disturbance.get(name, nothing) for name in loads]
    by_label = dict(zip((*labels, *loads), (*columns.T, *patterns), strict=True))
    effort = record.effort - sum((by_label[label] * value for label, value in known.items()), nothing)
    free = [column for label, column in by_label.items() if label not in known]
    return np.column_stack([*free, effort])[mask]


def units_of(records: Sequence[DriveRecord], model: TorqueModel) -> dict[str, str]:
    """Unit of every parameter by its name."""
    effort, length = records[0].effort_unit, records[0].length_unit
    written = {
        label: unit.format(effort=effort, length=length) for term in model.chosen for label, unit in term.units.items()
    }
    return written | dict.fromkeys(load_names(records), effort)


def check_records(records: Sequence[DriveRecord], model: TorqueModel, known: Mapping[str, float]) -> None:
    """Refuse records that are not of one drive, or parameters that are none.

    Raises
    ------
    InputError
    """
    if not records:
        raise InputError("there is no record of the drive; give the log of one run or more")
    for what, values in (
        ("axis", {record.axis for record in records}),
        ("unit of the effort", {record.effort_unit for record in records}),
    ):
        if len(values) > 1:
            raise InputError(f"the records differ in the {what} ({', '.join(sorted(values))}); identify each by itself")
    runs = [record.run for record in records]
    twice = sorted({run for run in runs if runs.count(run) > 1})
    if twice:
        raise InputError(f"two records of axis {records[0].axis} are called {twice[0]}; give every run a name of its own")
    labels = (*model.labels, *load_names(records))
    clash = [name for name in load_names(records) if name in model.labels]
    if clash:
        raise InputError(f"a load is called {clash[0]}, as a term of the balance is; give it another name")
    unknown = [label for label in known if label not in labels]
    if unknown:
        raise InputError(f"the known parameters {', '.join(unknown)} are none of the model: {', '.join(labels)}")
    if any(not np.isfinite(value) for value in known.values()):
        raise InputError("a known parameter is no finite number")
    if not set(labels) - set(known):
        raise InputError("all parameters are known; nothing is left to identify")


def live_masks(records: Sequence[DriveRecord], model: TorqueModel, chosen: Sequence[Mask] | None) -> list[Mask]:
    """Samples to use of each record, as chosen or all that are usable, of a drive that is alive.

    Raises
    ------
    RankError
        If the effort or the motion is nothing.
    """
    masks = list(chosen) if chosen is not None else [usable(record, model) for record in records]
    check_alive(records, masks, model)
    return masks


def check_alive(records: Sequence[DriveRecord], masks: Sequence[Mask], model: TorqueModel) -> None:
    """Refuse a dead axis: an effort or a motion that is nothing.

    Raises
    ------
    RankError
    """
    axis, count = records[0].axis, sum(len(record.time) for record in records)
    reasons = list(_dead(records, count))
    if not reasons and not any(mask.any() for mask in masks):
        reasons = [at_rest(count, model.least_speed, records[0].length_unit)]
    if reasons:
        raise RankError(f"axis {axis} cannot be identified, because {named(reasons)}")


def _dead(records: Sequence[DriveRecord], count: int) -> Iterator[str]:
    efforts = {float(end) + 0.0 for r in records for end in (r.effort.min(), r.effort.max())}
    still = len({float(end) for r in records for end in (r.velocity.min(), r.velocity.max())}) == 1
    if len(efforts) == 1 and (efforts == {0.0} or not still):
        yield f"its effort is {efforts.pop():g} {records[0].effort_unit} in all {count} samples: the channel is dead"
    if not any(record.velocity.any() for record in records):
        yield f"its velocity is zero in all {count} samples: it does not move"
