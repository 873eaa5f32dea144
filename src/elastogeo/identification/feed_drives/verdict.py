"""The verdict on an identified feed drive: named checks, each with a sentence a person can act on."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.drive import DriveRecord, RunScore, Structure
from elastogeo.identification.check import Check
from elastogeo.identification.verdict import conditioned
from elastogeo.machine import Array

if TYPE_CHECKING:
    from elastogeo.identification.feed_drives.axis_drives import AxisDrive

HELD_OUT = 1.25
"""How much greater than that of the identified runs the error of held-out ones may be."""

SEEN = 0.8
"""Share of the change of the velocity, from sample to sample, that the acceleration must explain."""

FLIPS = 0.01
"""Share of samples whose sign noise may decide."""

BIAS = 0.1
"""Share of the RMS residual that the mean residual of one direction may have."""

NEVER_NEGATIVE = ("inertia", "viscous", "viscous forward", "viscous backward", "coulomb", "stribeck")
"""Parameters that are negative in no drive. A negative Stribeck excess is the smooth sign in another dress."""

UNEVEN = 1.5
"""By how much the residuals of slow and fast samples may differ."""

_MOST_DIGITS = 6


def drive_verdict(found: AxisDrive, records: Sequence[DriveRecord]) -> tuple[Check, ...]:
    """All checks of one axis; only the first if it cannot be identified."""
    if found.fit is None:
        return (Check("identifiable", False, {"said": sentence_case(found.refusal)}, decisive=True),)
    fit, kind = found.fit, found.effort_unit
    if not fit.separated:
        return (Check("identifiable", False, {"said": sentence_case(fit.sentence)}, decisive=True),)
    count = len(fit.solution.labels)
    checks = [
        Check("identifiable", True, {"said": f"All {count} parameters are determined by the records."}, decisive=True),
        _possible(found),
        conditioned(fit.confounding, "motion"),
        _counted(fit.counted, sum(count > 0 for count in fit.samples.values())),
    ]
    if found.held_out:
        checks.append(_predicted(found.identified, found.held_out, kind))
    if found.models:
        checks += [_adequate(found), *_shift(found)]
    if found.structure is not None:
        checks += [_unstructured(found.structure, kind), _signs(found.structure)]
        checks += [_sampled(records), _resolved(records, found.structure.rms)]
    return tuple(checks)


def sentence_case(text: str) -> str:
    """A sentence from the words of an error."""
    return f"{text[:1].upper()}{text[1:]}." if text else text


def digits(values: Array, most: int = _MOST_DIGITS) -> int | None:
    """The fewest significant digits that all values can be written with; None if they need more than `most`."""
    there = values[values != 0]
    if not len(there):
        return None
    size = 10.0 ** np.floor(np.log10(np.abs(there)))
    for count in range(1, most + 1):
        step = size * 10.0 ** (1 - count)
        if np.allclose(np.round(there / step) * step, there, rtol=1e-9, atol=0):
            return count
    return None


def acceleration_seen(records: Sequence[DriveRecord]) -> float:
    """Share of the change of the velocity between neighbouring samples that the recorded acceleration explains."""
    left, whole = 0.0, 0.0
    for record in records:
        step = np.diff(record.time)
        near = step <= 1.5 * record.step
        change = np.diff(record.velocity)[near]
        mean = (record.acceleration[1:] + record.acceleration[:-1])[near] / 2
        left += float(np.sum((change - mean * step[near]) ** 2))
        whole += float(np.sum(change**2))
    return 1.0 - left / whole if whole > 0 else 1.0


def _possible(found: AxisDrive) -> Check:
    below = [p.name for p in found.parameters if p.name in NEVER_NEGATIVE and p.interval[1] < 0]
    if not below:
        return Check("physically possible", True, {"said": "No inertia and no friction is negative beyond its uncertainty."})
    return Check(
        "physically possible",
        False,
        {
            "said": f"{', '.join(below)} is negative, and its interval excludes zero. No drive moves by its own friction or inertia: "
            f"check the sign of the effort, or the terms of the model."
        },
    )


def _counted(counted: str, runs: int) -> Check:
    if counted == "runs":
        return Check("uncertainty by run", True, {"said": f"The uncertainties count on the scatter of {runs} runs."})
    if counted == "pieces":
        return Check(
            "uncertainty by run",
            False,
            {
                "said": f"{runs} runs are too few, so the uncertainties count on the scatter of pieces of them: what is the same "
                f"through a run, such as temperature, is not in them. Repeat the runs."
            },
        )
    return Check(
        "uncertainty by run",
        False,
        {
            "said": "The uncertainties take every sample as independent, which neighbours in a log are not: they are too small. "
            "Record more runs, or longer ones."
        },
    )


def _predicted(identified: Sequence[RunScore], unseen: Sequence[RunScore], unit: str) -> Check:
    inside, outside = _rmse(identified), _rmse(unseen)
    if not any(score.samples for score in unseen):
        sentence = "No sample of the held-out runs can be used: they are too slow. Hold out runs that move."
        return Check("held-out runs predicted", False, {"said": sentence})
    good = outside <= HELD_OUT * inside
    return Check(
        "held-out runs predicted",
        good,
        {
            "said": f"{len(unseen)} held-out runs are predicted to {outside:.3g} {unit} (RMSE), those identified from to "
            f"{inside:.3g} {unit}{'' if good else ': the drive or its load was another'}."
        },
    )


def _adequate(found: AxisDrive) -> Check:
    models = {model.name: model for model in found.models}
    plain, best = found.models[0], models[found.supported]
    if best is plain:
        least = min(found.models, key=lambda model: model.left_out.rmse)
        return Check(
            "model adequate",
            True,
            {
                "said": f"The plain model predicts left-out runs to {plain.left_out.rmse:.4g} {found.effort_unit}; no richer one does "
                f"so surely better and by a gain worth having (the best, {least.name}, to {least.left_out.rmse:.4g})."
            },
        )
    return Check(
        "model adequate",
        False,
        {
            "said": f"The runs support {best.name}: it predicts left-out runs to {best.left_out.rmse:.4g} {found.effort_unit}, the "
            f"plain model to {plain.left_out.rmse:.4g} ({100 * best.gain:.1f} % less)."
        },
    )


def _shift(found: AxisDrive) -> list[Check]:
    """Whether a time shift does more than average neighbouring samples of the motion; nothing if it does not help."""
    models = {model.name: model for model in found.models}
    if not {"time shift", "averaged motion"} <= set(models) or not models["time shift"].better:
        return []
    shift, averaged = models["time shift"], models["averaged motion"]
    late = 1000 * next(value.value for value in shift.fit.searched if value.name == "delay")
    good = shift.left_out.rmse < averaged.left_out.rmse
    verdict = "so the shift is real" if good else "so no delay between the channels is shown"
    return [
        Check(
            "time shift told from averaging",
            good,
            {
                "said": f"A shift of {late:.3g} ms predicts left-out runs to {shift.left_out.rmse:.4g} {found.effort_unit}, an average "
                f"of neighbouring samples without a shift to {averaged.left_out.rmse:.4g}: {verdict}."
            },
        )
    ]


def _unstructured(left: Structure, unit: str) -> Check:
    parts = []
    if abs(left.autocorrelation) > left.limit:
        apart = f"{left.apart * 1000:.3g} ms apart"
        parts.append(f"residuals {apart} correlate by {left.autocorrelation:.2f} (noise: below {left.limit:.2f})")
    if max(abs(left.forward or 0.0), abs(left.backward or 0.0)) > BIAS * left.rms:
        parts.append(
            f"their mean is {left.forward or 0.0:.2g} {unit} forward and {left.backward or 0.0:.2g} {unit} backward"
        )
    if max(left.slow, left.fast) > UNEVEN * min(left.slow, left.fast):
        parts.append("they are far greater at one speed than at another")
    if not parts:
        return Check(
            "residuals without structure", True, {"said": f"The residuals look like noise; RMS {left.rms:.3g} {unit}."}
        )
    return Check(
        "residuals without structure",
        False,
        {
            "said": f"{sentence_case(', and '.join(parts))[:-1]}; RMS {left.rms:.3g} {unit}, {left.slow:.3g} in the slower half and "
            f"{left.fast:.3g} in the faster. The model leaves out something: a load, a position, a law of friction, a shift."
        },
    )


def _signs(left: Structure) -> Check:
    good = left.flips <= FLIPS
    advice = "" if good else " Raise least_speed, lower the cut-off, or take a smooth sign."
    return Check(
        "direction known",
        good,
        {"said": f"{100 * left.flips:.2g} % of the samples have another direction than both their neighbours.{advice}"},
    )


def _sampled(records: Sequence[DriveRecord]) -> Check:
    seen, step = acceleration_seen(records), max(record.step for record in records)
    good = seen >= SEEN
    advice = (
        ""
        if good
        else (
            ": accelerations begin and end between two samples, so inertia and time shift rest on few chance samples. "
            "Record faster"
        )
    )
    return Check(
        "sampled fast enough",
        good,
        {
            "said": f"At {step * 1000:.3g} ms a sample, the acceleration explains {max(100 * seen, 0.0):.0f} % of the change of the "
            f"velocity from sample to sample{advice}."
        },
    )


def _resolved(records: Sequence[DriveRecord], rms: float) -> Check:
    effort = np.concatenate([record.effort for record in records])
    count = digits(effort)
    if count is None:
        return Check("resolved", True, {"said": "The effort is written with enough digits."})
    largest = float(np.quantile(np.abs(effort), 0.95))
    half = 0.5 * 10.0 ** (np.floor(np.log10(largest)) + 1 - count) if largest > 0 else 0.0
    unit = records[0].effort_unit
    good = half <= rms / 2
    return Check(
        "resolved",
        bool(good),
        {
            "said": f"The effort is written with {count} significant digits, which rounds it by up to {half:.2g} {unit}: "
            f"{'little' if good else 'much'} against the RMS residual of {rms:.3g} {unit}."
        },
    )


def _rmse(scores: Sequence[RunScore]) -> float:
    samples = sum(score.samples for score in scores)
    return float(np.sqrt(sum(score.samples * score.rmse**2 for score in scores) / samples)) if samples else float("nan")
