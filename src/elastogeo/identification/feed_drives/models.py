"""Models of a drive compared by predicting every run from all others, on the same samples for all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from elastogeo.drive import (
    PLAIN,
    BalanceFit,
    DriveRecord,
    FeedDrive,
    LeftOut,
    Mask,
    RunScore,
    TorqueModel,
    free_labels,
    leave_one_run_out,
    make_search,
    predict,
    ranges_of,
    search_balance,
    shared_masks,
)
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.identification.feed_drives.result import DriveParameter, ModelScore

WORTH_HAVING = 0.01
"""A model that lowers the error at left-out runs by less than this share is not worth its parameters."""

AS_ASKED = "as asked"
"""Name of a model that a test asks for and that is none of the candidates."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """A model that is compared with the others.

    Attributes
    ----------
    name : str
    terms : tuple of str
    searched : tuple of str
    given : TorqueModel or None
        A model with laws of its own.
    """

    name: str
    terms: tuple[str, ...] = PLAIN
    searched: tuple[str, ...] = ()
    given: TorqueModel | None = None

    def model(self, least_speed: float | None) -> TorqueModel:
        """Its torque model; what is searched has any value."""
        if self.given is not None:
            return self.given
        return TorqueModel(self.terms, least_speed, stribeck_speed=1.0 if "stribeck" in self.terms else None)


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


def candidate_named(name: str) -> Candidate:
    """A candidate by its name.

    Raises
    ------
    InputError
        If there is none.
    """
    for candidate in CANDIDATES:
        if candidate.name == name:
            return candidate
    raise InputError(f"there is no model {name!r:.60}; there are: {'; '.join(c.name for c in CANDIDATES)}")


def candidate_of(model: TorqueModel, searched: Sequence[str]) -> Candidate:
    """The candidate that a torque model is, or one of its own."""
    for candidate in CANDIDATES:
        if candidate.model(model.least_speed) == model and candidate.searched == tuple(searched):
            return candidate
    return Candidate(AS_ASKED, model.terms, tuple(searched), model)


def compare(
    asked: Candidate,
    records: Sequence[DriveRecord],
    unseen: Sequence[DriveRecord],
    least_speed: float | None,
    known: Mapping[str, float],
    drive: FeedDrive | None,
) -> tuple[tuple[ModelScore, ...], dict[str, str]]:
    """The scores of all candidates, the plain one first, and why any has none.

    Parameters
    ----------
    asked : Candidate
        Compared as well if it is none of `CANDIDATES`.
    records, unseen : sequence of DriveRecord
        To identify from, and held out.
    least_speed : float or None
    known : mapping of str to float
    drive : FeedDrive or None
    """
    base = TorqueModel(least_speed=least_speed)
    ranges = ranges_of(records, base, ("delay",))
    masks, unseen_masks = shared_masks(records, base, ranges), shared_masks(unseen, base, ranges)
    models: list[ModelScore] = []
    skipped: dict[str, str] = {}
    for candidate in CANDIDATES if asked in CANDIDATES else (*CANDIDATES, asked):
        try:
            fit, left = _fitted(candidate, records, least_speed, known, masks)
        except (UnsupportedError, InputError) as error:
            skipped[candidate.name] = str(error)
            if candidate.name == "plain":
                break
            continue
        first = models[0].left_out if models else left
        models.append(
            ModelScore(
                name=candidate.name,
                fit=fit,
                parameters=parameters_of(fit, drive),
                left_out=left,
                held_out=_predicted(fit, unseen, unseen_masks),
                gain=1.0 - left.rmse / first.rmse,
                better=bool(models) and surely_better(first, left),
            )
        )
    return tuple(models), skipped


def supported(models: Sequence[ModelScore]) -> str:
    """The simplest model that no richer one beats at left-out runs, by a gain that is sure (95 %) and worth having.

    Never one with a value that no drive can have, one whose delay an average of neighbouring samples explains as well, or
    one that predicts held-out runs worse than the first model does.
    """
    best = models[0]
    eligible = [
        model
        for model in models[1:]
        if not model.impossible and averaging_explains(model, models) is None and not _loses(model, models[0])
    ]
    for model in sorted(eligible, key=_size):
        if _replaces(best, model):
            best = model
    return best.name


def averaging_explains(model: ModelScore, models: Sequence[ModelScore]) -> ModelScore | None:
    """The same model with an average in place of its delay; None if the delay surely does more for left-out runs."""
    searched = [found.name for found in model.fit.searched]
    if "delay" not in searched:
        return None
    instead = {*searched, "neighbours"} - {"delay"}
    for other in models:
        same = other.fit.model.terms == model.fit.model.terms and {f.name for f in other.fit.searched} == instead
        if same and not _replaces(other, model):
            return other
    return None


def surely_better(one: LeftOut, other: LeftOut) -> bool:
    """Whether the other predicts better by a mean ratio of the errors over the runs that is sure at 95 % (one-sided t).

    Ratios and not differences: a run of large errors counts as one run.
    """
    errors = np.array([(a.rmse, b.rmse) for a, b in zip(one.scores, other.scores, strict=True) if a.samples])
    if len(errors) < 3 or not errors.all():
        return False
    gain = np.log(errors[:, 0] / errors[:, 1])
    least = gain.mean() - stdtrit(len(gain) - 1, 0.95) * gain.std(ddof=1) / np.sqrt(len(gain))
    return bool(least > 0)


def _replaces(one: ModelScore, other: ModelScore) -> bool:
    """Whether another model predicts left-out runs surely better, by a gain worth having."""
    gain = other.left_out.rmse < (1 - WORTH_HAVING) * one.left_out.rmse
    return gain and surely_better(one.left_out, other.left_out)


def rmse_of(scores: Sequence[RunScore]) -> float | None:
    """Error over all samples of runs [unit of the effort]; None without any."""
    samples = sum(score.samples for score in scores)
    return float(np.sqrt(sum(score.samples * score.rmse**2 for score in scores) / samples)) if samples else None


def _fitted(
    candidate: Candidate,
    records: Sequence[DriveRecord],
    least_speed: float | None,
    known: Mapping[str, float],
    masks: Sequence[Mask],
) -> tuple[BalanceFit, LeftOut]:
    model = candidate.model(least_speed)
    if set(known) - set(free_labels(records, model, {})):
        raise InputError(f"it has none of the known parameters {', '.join(known)}")
    made = make_search(records, model, candidate.searched, known, masks) if candidate.searched else None
    left = leave_one_run_out(records, model, candidate.searched, known, masks, made)
    fit = search_balance(records, model, candidate.searched, known, masks, made)
    if not fit.separated:
        raise UnsupportedError(fit.sentence)
    return fit, left


def _predicted(fit: BalanceFit, unseen: Sequence[DriveRecord], masks: Sequence[Mask]) -> tuple[RunScore, ...]:
    """The held-out runs; nothing where one has a load that no other has."""
    try:
        return predict(fit, unseen, masks)
    except UnsupportedError:
        return ()


def _loses(model: ModelScore, first: ModelScore) -> bool:
    own, plain = rmse_of(model.held_out), rmse_of(first.held_out)
    return own is not None and plain is not None and own > plain


def _size(model: ModelScore) -> tuple[int, float]:
    """How many parameters a model has; the better of two of one size first."""
    return len(model.fit.solution.labels) + len(model.fit.searched), model.left_out.rmse


def parameters_of(fit: BalanceFit, drive: FeedDrive | None) -> tuple[DriveParameter, ...]:
    """The parameters of a fit, at the motor's shaft as well where the transmission is known."""
    meaning = {label: term.meaning for term in fit.model.chosen for label in term.units}
    ratio = drive.transmission_ratio if drive else None
    return tuple(
        DriveParameter(
            name=name,
            unit=fit.units[name],
            meaning=meaning.get(name, "load, per unit of its direction pattern"),
            estimate=estimate,
            stands_for=fit.confounding.stands_for(name),
            at_motor=_at_motor(name, fit, estimate, ratio),
        )
        for name, estimate in zip(fit.solution.labels, fit.solution.estimates(), strict=True)
    )


def _at_motor(name: str, fit: BalanceFit, estimate: Estimate, ratio: float | None) -> tuple[Estimate, str] | None:
    """J_T and B_T of Eq. 6.6 at the shaft: per angle of the motor, not per travel of the axis."""
    if ratio is None or fit.effort_unit != "N mm" or "/" not in fit.units[name] or name in fit.mixed:
        return None
    factor, unit = (ratio / 1000, "kg m^2") if "s^2" in fit.units[name] else (ratio / 1000, "N m s/rad")
    return estimate.scaled(factor), unit
