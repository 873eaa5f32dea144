"""From records of feed drives to the torque balance of each axis, held against runs it has not seen, with a verdict.

The models of the friction are compared by predicting each run from all others, of the effort as it was recorded, and the
one that the runs support is shown for each axis, unless the test asks for one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from elastogeo.drive import (
    DriveRecord,
    DriveTest,
    TorqueModel,
    leave_one_run_out,
    predict,
    search_balance,
    standstill,
    structure,
    usable,
)
from elastogeo.errors import UnsupportedError
from elastogeo.identification.feed_drives.models import (
    WORTH_HAVING,
    Candidate,
    candidate_named,
    candidate_of,
    compare,
    parameters_of,
    supported,
    surely_better,
)
from elastogeo.identification.feed_drives.result import LEFT_OUT, AxisDrive, DriveIdentification, Rest
from elastogeo.identification.feed_drives.verdict import drive_verdict


def identify_drives(test: DriveTest) -> DriveIdentification:
    """Identify the torque balance of every axis of a test.

    An axis that cannot be identified is a result as well: its verdict says why, and it has no number.

    Raises
    ------
    InputError
        If the test asks for a model that there is not.
    """
    return DriveIdentification(test, tuple(_axis(test, axis) for axis in test.axes))


def _axis(test: DriveTest, axis: str) -> AxisDrive:
    records = test.of(axis)
    used = [record for record in records if record.run not in test.held_out]
    unseen = [record for record in records if record.run in test.held_out]
    asked, given = _asked(test, axis)
    if not used:
        refusal = f"axis {axis} is recorded in held-out runs only"
        return _judged(AxisDrive(axis, records[0].effort_unit, None, refusal=refusal), used)
    known = test.known.get(axis, {})
    try:
        found = _identified(test, asked, used, unseen, known)
    except UnsupportedError as error:
        return _judged(AxisDrive(axis, used[0].effort_unit, None, refusal=str(error)), used)
    if found.fit is None or not found.fit.separated:
        return _judged(found, used)
    found = replace(found, rest=_rest(found, used, known))
    if found.left_out is not None and test.compare:
        models, skipped = compare(asked, used, unseen, test.model.least_speed, known, test.drives.get(axis))
        chosen = supported(models) if models else ""
        if chosen and chosen != asked.name and not given:
            found = replace(_identified(test, candidate_named(chosen), used, unseen, known), rest=found.rest)
        found = replace(found, models=models, supported=chosen, not_compared=skipped)
    return _judged(found, used)


def _asked(test: DriveTest, axis: str) -> tuple[Candidate, bool]:
    """The model that a test asks for of an axis, and whether it does so or takes what comes."""
    name = test.models.get(axis) or test.models.get("")
    if name:
        return candidate_named(name), True
    own = candidate_of(test.model, test.searched)
    return own, own.name != "plain"


def _identified(
    test: DriveTest,
    candidate: Candidate,
    used: Sequence[DriveRecord],
    unseen: Sequence[DriveRecord],
    known: Mapping[str, float],
) -> AxisDrive:
    """An axis by one model, with how well it predicts."""
    axis, model = used[0].axis, candidate.model(test.model.least_speed)
    fit = search_balance(used, model, candidate.searched, known)
    found = AxisDrive(axis, fit.effort_unit, fit, candidate.name, parameters=parameters_of(fit, test.drives.get(axis)))
    if not fit.separated:
        return found
    found = replace(
        found,
        identified=predict(fit, used),
        held_out=predict(fit, unseen) if unseen else (),
        structure=structure(fit, used),
    )
    try:
        return replace(found, left_out=leave_one_run_out(used, model, candidate.searched, known))
    except UnsupportedError as error:
        return replace(found, not_compared={LEFT_OUT: str(error)})


def _rest(found: AxisDrive, used: Sequence[DriveRecord], known: Mapping[str, float]) -> Rest:
    """What the records show of a standstill; a hold-out by runs judges whether leaving it out is right."""
    assert found.fit is not None
    rests = [standstill(record) for record in used]
    near = np.concatenate([rest.near for rest in rests])
    taken = np.concatenate([usable(record, found.fit.model) for record in used])
    shown = Rest(float(near.mean()), float(near[taken].mean()), max(rest.speed for rest in rests))
    if not shown.share or len(used) < 2:
        return shown
    moving = [usable(record, TorqueModel()) for record in used]
    every = [usable(record, TorqueModel(least_speed=0.0)) for record in used]
    try:
        without = leave_one_run_out(used, TorqueModel(), known=known, chosen=moving)
        kept = leave_one_run_out(used, TorqueModel(least_speed=0.0), known=known, chosen=every, judged=moving)
    except UnsupportedError:
        return shown
    worse = surely_better(without, kept) and kept.rmse < (1 - WORTH_HAVING) * without.rmse
    return replace(shown, left_out=without.rmse, kept=kept.rmse, worse=worse)


def _judged(found: AxisDrive, records: Sequence[DriveRecord]) -> AxisDrive:
    return replace(found, verdict=drive_verdict(found, records))
