"""From records of feed drives to the torque balance of each axis, held against runs it has not seen, with a verdict.

The model that is asked for is identified; richer ones are compared with it by predicting each run from all others. What
decides between them is that prediction, on the same samples for all, of the effort as it was recorded.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.special import stdtrit

from elastogeo.drive import (
    PLAIN,
    BalanceFit,
    DriveRecord,
    DriveTest,
    FeedDrive,
    LeftOut,
    Mask,
    RunScore,
    Structure,
    TorqueModel,
    free_labels,
    leave_one_run_out,
    make_search,
    predict,
    ranges_of,
    search_balance,
    shared_masks,
    structure,
)
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.identification.check import Check
from elastogeo.identification.feed_drives.verdict import NEVER_NEGATIVE, drive_verdict
from elastogeo.result import Result

WORTH_HAVING = 0.01
"""A model that lowers the error at left-out runs by less than this share is not worth its parameters."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A model that is compared with the others.

    Attributes
    ----------
    name : str
    terms : tuple of str
    searched : tuple of str
    """

    name: str
    terms: tuple[str, ...] = PLAIN
    searched: tuple[str, ...] = ()


_ASYMMETRIC = ("inertia", "viscous asymmetric", "coulomb", "constant")
_STRIBECK = (*PLAIN, "stribeck")
CANDIDATES = (
    Candidate("plain"),
    Candidate("asymmetric friction", _ASYMMETRIC),
    Candidate("smooth sign", PLAIN, ("smooth_speed",)),
    Candidate("Stribeck", _STRIBECK, ("stribeck_speed",)),
    Candidate("time shift", PLAIN, ("delay",)),
    Candidate("averaged motion", PLAIN, ("neighbours",)),
    Candidate("averaged motion, time shift", PLAIN, ("neighbours", "delay")),
    Candidate("smooth sign, time shift", PLAIN, ("smooth_speed", "delay")),
    Candidate("smooth sign, averaged motion", PLAIN, ("smooth_speed", "neighbours")),
    Candidate("Stribeck, time shift", _STRIBECK, ("stribeck_speed", "delay")),
    Candidate("Stribeck, averaged motion", _STRIBECK, ("stribeck_speed", "neighbours")),
    Candidate("asymmetric friction, smooth sign, averaged motion", _ASYMMETRIC, ("smooth_speed", "neighbours")),
    Candidate("smooth sign, averaged motion, time shift", PLAIN, ("smooth_speed", "neighbours", "delay")),
)
"""Each with the sign of Eq. 6.6 where it is not smooth. Coulomb friction of its own in either direction is not among them:
with a sharp sign it is that of Eq. 6.6 with a constant."""


@dataclass(frozen=True, slots=True)
class DriveParameter:
    """One identified parameter of a balance.

    Attributes
    ----------
    name, unit, meaning : str
    value, standard_uncertainty : float
    interval : tuple of 2 float
        95 %.
    stands_for : mapping of str to float
        The combination that it is: itself alone if it is told from all others.
    at_motor : tuple of (float, float, str), or None
        Value, standard uncertainty and unit at the motor's shaft, where the transmission is known and it differs there.
    """

    name: str
    unit: str
    meaning: str
    value: float
    standard_uncertainty: float
    interval: tuple[float, float]
    stands_for: Mapping[str, float]
    at_motor: tuple[float, float, str] | None = None


@dataclass(frozen=True, slots=True, eq=False)
class ModelScore:
    """A model in the comparison.

    Attributes
    ----------
    name : str
    fit : BalanceFit
        From all runs.
    left_out : LeftOut
        Each run from all others.
    gain : float
        Share by which the error at left-out runs is below that of the first model.
    better : bool
        Whether it predicts left-out runs better than the first model, surely (95 % over the runs).
    """

    name: str
    fit: BalanceFit
    left_out: LeftOut
    gain: float
    better: bool

    @property
    def impossible(self) -> tuple[str, ...]:
        """Parameters whose value no drive can have: it would move by its own friction or inertia."""
        values = zip(self.fit.solution.labels, self.fit.solution.values, strict=True)
        return tuple(label for label, value in values if label in NEVER_NEGATIVE and value < 0)


@dataclass(frozen=True, slots=True, eq=False)
class AxisDrive:
    """What is known of one axis.

    Attributes
    ----------
    axis, effort_unit : str
    fit : BalanceFit or None
        None if the axis cannot be identified at all.
    refusal : str
        Why it cannot.
    parameters : tuple of DriveParameter
        Of the fit; a combination where terms are not told apart.
    identified : tuple of RunScore
        How well the runs are fitted that it was identified from.
    held_out : tuple of RunScore
        How well the runs are predicted that it was not identified from.
    left_out : LeftOut or None
        Each run of the identified ones from the others.
    models : tuple of ModelScore
        Compared models on the samples that all of them can use; empty if none were.
    supported : str
        Name of the model that the runs support.
    not_compared : mapping of str to str
        Why a model is not in the comparison, by its name.
    structure : Structure or None
    verdict : tuple of Check
    """

    axis: str
    effort_unit: str
    fit: BalanceFit | None
    refusal: str = ""
    parameters: tuple[DriveParameter, ...] = ()
    identified: tuple[RunScore, ...] = ()
    held_out: tuple[RunScore, ...] = ()
    left_out: LeftOut | None = None
    models: tuple[ModelScore, ...] = ()
    supported: str = ""
    not_compared: Mapping[str, str] = field(default_factory=dict)
    structure: Structure | None = None
    verdict: tuple[Check, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DriveIdentification(Result):
    """The drives of a test.

    Attributes
    ----------
    test : DriveTest
    axes : tuple of AxisDrive
    """

    test: DriveTest
    axes: tuple[AxisDrive, ...]

    @property
    def verdict(self) -> tuple[Check, ...]:
        """Checks of all axes; their names begin with the axis."""
        return tuple(replace(check, name=f"{axis.axis}: {check.name}") for axis in self.axes for check in axis.verdict)


def identify_drives(test: DriveTest) -> DriveIdentification:
    """Identify the torque balance of every axis of a test.

    An axis that cannot be identified is a result as well: its verdict says why, and it has no number.
    """
    return DriveIdentification(test, tuple(_axis(test, axis) for axis in test.axes))


def _axis(test: DriveTest, axis: str) -> AxisDrive:
    records = test.of(axis)
    used = [record for record in records if record.run not in test.held_out]
    unseen = [record for record in records if record.run in test.held_out]
    known = test.known.get(axis, {})
    if not used:
        return _judged(AxisDrive(axis, records[0].effort_unit, None, f"axis {axis} is recorded in held-out runs only"), used)
    try:
        fit = search_balance(used, test.model, test.searched, known)
    except UnsupportedError as error:
        return _judged(AxisDrive(axis, used[0].effort_unit, None, str(error)), used)
    found = AxisDrive(axis, fit.effort_unit, fit, parameters=_parameters(fit, test.drives.get(axis)))
    if not fit.separated:
        return _judged(found, used)
    found = replace(
        found,
        identified=predict(fit, used),
        held_out=predict(fit, unseen) if unseen else (),
        structure=structure(fit, used),
    )
    if len(used) > 1:
        try:
            found = replace(found, left_out=leave_one_run_out(used, test.model, test.searched, known))
        except UnsupportedError as error:
            found = replace(found, not_compared={"left-out runs": str(error)})
    if found.left_out is not None and test.compare:
        found = _compared(found, used, test.model, known)
    return _judged(found, used)


def _judged(found: AxisDrive, records: Sequence[DriveRecord]) -> AxisDrive:
    return replace(found, verdict=drive_verdict(found, records))


def _parameters(fit: BalanceFit, drive: FeedDrive | None) -> tuple[DriveParameter, ...]:
    meaning = {label: term.meaning for term in fit.model.chosen for label in term.units}
    ratio = drive.transmission_ratio if drive else None
    values = fit.solution
    return tuple(
        DriveParameter(
            name=name,
            unit=fit.units[name],
            meaning=meaning.get(name, "load, per unit of its direction pattern"),
            value=float(value),
            standard_uncertainty=float(uncertainty),
            interval=(float(low), float(high)),
            stands_for=fit.confounding.stands_for(name),
            at_motor=_at_motor(name, fit, float(value), float(uncertainty), ratio),
        )
        for name, value, uncertainty, (low, high) in zip(
            values.labels, values.values, values.standard_uncertainty, values.interval(), strict=True
        )
    )


def _at_motor(
    name: str, fit: BalanceFit, value: float, uncertainty: float, ratio: float | None
) -> tuple[float, float, str] | None:
    """J_T and B_T of Eq. 6.6 at the shaft: per angle of the motor, not per travel of the axis."""
    if ratio is None or fit.effort_unit != "N mm" or "/" not in fit.units[name] or name in fit.mixed:
        return None
    factor, unit = (ratio / 1000, "kg m^2") if "s^2" in fit.units[name] else (ratio / 1000, "N m s/rad")
    return value * factor, uncertainty * factor, unit


def _compared(found: AxisDrive, records: Sequence[DriveRecord], asked: TorqueModel, known: Mapping[str, float]) -> AxisDrive:
    """With the candidates, all on the samples that every one of them can use."""
    base = TorqueModel(least_speed=asked.least_speed)
    masks = shared_masks(records, base, ranges_of(records, base, ("delay",)))
    models: list[ModelScore] = []
    skipped: dict[str, str] = {}
    for candidate in CANDIDATES:
        try:
            score = _scored(candidate, records, base, known, masks, models[0] if models else None)
        except (UnsupportedError, InputError) as error:
            skipped[candidate.name] = str(error)
            if candidate.name == "plain":
                break
            continue
        models.append(score)
    return replace(found, models=tuple(models), supported=_supported(models) if models else "", not_compared=skipped)


def _scored(
    candidate: Candidate,
    records: Sequence[DriveRecord],
    base: TorqueModel,
    known: Mapping[str, float],
    masks: Sequence[Mask],
    first: ModelScore | None,
) -> ModelScore:
    model = replace(base, terms=candidate.terms, stribeck_speed=1.0 if "stribeck" in candidate.terms else None)
    if set(known) - set(free_labels(records, model, {})):
        raise InputError(f"it has none of the known parameters {', '.join(known)}")
    made = make_search(records, model, candidate.searched, known, masks) if candidate.searched else None
    left = leave_one_run_out(records, model, candidate.searched, known, masks, made)
    fit = search_balance(records, model, candidate.searched, known, masks, made)
    if not fit.separated:
        raise UnsupportedError(fit.sentence)
    if first is None:
        return ModelScore(candidate.name, fit, left, 0.0, better=False)
    gain = 1.0 - left.rmse / first.left_out.rmse
    return ModelScore(candidate.name, fit, left, gain, better=_surely(first.left_out, left))


def _supported(models: Sequence[ModelScore]) -> str:
    """The simplest model that no richer one beats at left-out runs, by a gain that is sure (95 %) and worth having.

    A model with a value that no drive can have may predict well; it is never supported.
    """
    best = models[0]
    for model in sorted((model for model in models[1:] if not model.impossible), key=_size):
        if _surely(best.left_out, model.left_out) and model.left_out.rmse < (1 - WORTH_HAVING) * best.left_out.rmse:
            best = model
    return best.name


def _size(model: ModelScore) -> tuple[int, float]:
    """How many parameters a model has; the better of two alike first."""
    return len(model.fit.solution.labels) + len(model.fit.searched), model.left_out.rmse


def _surely(one: LeftOut, other: LeftOut) -> bool:
    """Whether the other predicts better by a mean ratio of the errors over the runs that is sure at 95 % (one-sided t).

    Ratios and not differences: a run of large errors counts as one run.
    """
    errors = np.array([(a.rmse, b.rmse) for a, b in zip(one.scores, other.scores, strict=True) if a.samples])
    if len(errors) < 3 or not errors.all():
        return False
    gain = np.log(errors[:, 0] / errors[:, 1])
    least = gain.mean() - stdtrit(len(gain) - 1, 0.95) * gain.std(ddof=1) / np.sqrt(len(gain))
    return bool(least > 0)
