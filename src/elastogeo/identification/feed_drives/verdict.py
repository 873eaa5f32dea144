"""The verdict on an identified feed drive: named checks with their facts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.drive import DriveRecord, Structure
from elastogeo.identification.check import Check
from elastogeo.identification.feed_drives.models import averaging_explains, rmse_of
from elastogeo.identification.feed_drives.result import LEFT_OUT, NEVER_NEGATIVE, AxisDrive, Rest
from elastogeo.identification.verdict import conditioned
from elastogeo.machine import Array

HELD_OUT = 1.25
"""How much greater than that of the identified runs the error of held-out ones may be."""

SEEN = 0.8
"""Share of the change of the velocity, from sample to sample, that the acceleration must explain."""

FLIPS = 0.01
"""Share of samples whose sign noise may decide."""

AT_REST = 0.01
"""Share of the samples used that may be at rest."""

BIAS = 0.1
"""Share of the RMS residual that the mean residual of one direction may have."""

UNEVEN = 1.5
"""By how much the residuals of slow and fast samples may differ."""

_MOST_DIGITS = 6


def drive_verdict(found: AxisDrive, records: Sequence[DriveRecord]) -> tuple[Check, ...]:
    """All checks of one axis; only the first if it cannot be identified."""
    terms = _terms(found)
    if found.fit is None or not terms.passed:
        return (terms,)
    checks = [
        terms,
        _possible(found),
        conditioned(found.fit.confounding, "motion"),
        _repeated(found.fit.counted, sum(count > 0 for count in found.fit.samples.values())),
    ]
    if found.rest is not None:
        checks.append(_standstill(found.rest, found.fit.model.least_speed, records))
    if found.held_out:
        checks.append(_predicted(found))
    checks += [*_adequate(found), *_shift(found)]
    if found.structure is not None:
        checks += [_unstructured(found.structure, found.effort_unit), _signs(found.structure)]
        checks += [_sampled(records), _resolved(records, found.structure.rms)]
    return tuple(checks)


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


def _terms(found: AxisDrive) -> Check:
    fit = found.fit
    if fit is None:
        return Check("terms distinguished", False, {"reason": found.refusal}, decisive=True)
    facts = {"terms": len(fit.confounding.labels), "mixed": fit.mixed, "null": fit.confounding.null, "reason": fit.sentence}
    return Check("terms distinguished", fit.separated, facts, decisive=True)


def _possible(found: AxisDrive) -> Check:
    below = tuple(p.name for p in found.parameters if p.name in NEVER_NEGATIVE and p.estimate.interval()[1] < 0)
    return Check("physically possible", not below, {"below": below})


def _repeated(counted: str, runs: int) -> Check:
    return Check("runs repeated", counted == "runs", {"counted": counted, "runs": runs})


def _standstill(rest: Rest, stated: float | None, records: Sequence[DriveRecord]) -> Check:
    """Passed as well where no record shows a rest."""
    facts = {
        "share": rest.share,
        "used": rest.used,
        "speed": rest.speed,
        "stated_speed": stated,
        "left_out": rest.left_out,
        "kept": rest.kept,
        "worse": rest.worse,
        "effort_unit": records[0].effort_unit,
        "length_unit": records[0].length_unit,
    }
    return Check("standstill left out", rest.used <= AT_REST and not rest.worse, facts)


def _predicted(found: AxisDrive) -> Check:
    inside, outside = rmse_of(found.identified), rmse_of(found.held_out)
    facts = {"runs": len(found.held_out), "identified": inside, "held_out": outside, "effort_unit": found.effort_unit}
    good = None if outside is None or inside is None else outside <= HELD_OUT * inside
    return Check("held-out runs predicted", good, facts)


def _adequate(found: AxisDrive) -> list[Check]:
    """Whether the model that is shown is the one that the runs support; nothing where no comparison was asked for."""
    name = "friction model adequate"
    reason = found.not_compared.get(LEFT_OUT)
    if reason is not None or (not found.models and found.not_compared):
        reason = reason or next(iter(found.not_compared.values()))
        return [Check(name, None, {"shown": found.model, "reason": reason, "runs": len(found.identified)})]
    if not found.models:
        return []
    models = {model.name: model for model in found.models}
    first, best = found.models[0], models[found.supported]
    least = min(found.models, key=lambda model: model.left_out.rmse)
    facts = {
        "shown": found.model,
        "supported": best.name,
        "first": first.name,
        "supported_rmse": best.left_out.rmse,
        "first_rmse": first.left_out.rmse,
        "gain": best.gain,
        "least": least.name,
        "least_rmse": least.left_out.rmse,
        "effort_unit": found.effort_unit,
    }
    return [Check(name, found.model == best.name, facts)]


def _shift(found: AxisDrive) -> list[Check]:
    """Whether a time shift does more than average neighbouring samples of the motion; nothing if it does not help."""
    models = {model.name: model for model in found.models}
    shift = models.get("time shift")
    if shift is None or not shift.better or "averaged motion" not in models:
        return []
    facts = {
        "delay_s": next(value.value for value in shift.fit.searched if value.name == "delay"),
        "shift_rmse": shift.left_out.rmse,
        "averaged_rmse": models["averaged motion"].left_out.rmse,
        "effort_unit": found.effort_unit,
    }
    return [Check("time shift distinct from averaging", averaging_explains(shift, found.models) is None, facts)]


def _unstructured(left: Structure, unit: str) -> Check:
    facts = {
        "autocorrelation": left.autocorrelation,
        "correlated": abs(left.autocorrelation) > left.limit,
        "apart_s": left.apart,
        "limit": left.limit,
        "forward": left.forward,
        "backward": left.backward,
        "biased": max(abs(left.forward or 0.0), abs(left.backward or 0.0)) > BIAS * left.rms,
        "slow": left.slow,
        "fast": left.fast,
        "uneven": max(left.slow, left.fast) > UNEVEN * min(left.slow, left.fast),
        "rms": left.rms,
        "effort_unit": unit,
    }
    good = not (facts["correlated"] or facts["biased"] or facts["uneven"])
    return Check("residuals like noise", good, facts)


def _signs(left: Structure) -> Check:
    return Check("direction known", left.flips <= FLIPS, {"share": left.flips})


def _sampled(records: Sequence[DriveRecord]) -> Check:
    seen, step = acceleration_seen(records), max(record.step for record in records)
    return Check("sampled fast enough", seen >= SEEN, {"step_s": step, "share": max(seen, 0.0)})


def _resolved(records: Sequence[DriveRecord], rms: float) -> Check:
    effort = np.concatenate([record.effort for record in records])
    count = digits(effort)
    largest = float(np.quantile(np.abs(effort), 0.95))
    half = 0.5 * 10.0 ** (np.floor(np.log10(largest)) + 1 - count) if count is not None and largest > 0 else 0.0
    facts = {"digits": count, "rounding": float(half), "rms": rms, "effort_unit": records[0].effort_unit}
    return Check("effort resolved", bool(half <= rms / 2), facts)
