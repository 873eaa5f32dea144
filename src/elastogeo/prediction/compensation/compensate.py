"""From results to the compensation files of a control, and what is expected after they are loaded."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from elastogeo.errors import InputError
from elastogeo.formats import CompensationFormat, compensation_format, compensation_text, read_back
from elastogeo.identification import Identification, PositioningResults
from elastogeo.machine import ErrorTable
from elastogeo.observe import Campaign, campaign_of
from elastogeo.prediction.compensation.by_parameters import found_by_parameters
from elastogeo.prediction.compensation.by_targets import found_by_targets
from elastogeo.prediction.compensation.in_volume import InVolume, in_volume
from elastogeo.prediction.compensation.parts import ErrorPart, FoundError
from elastogeo.prediction.compensation.result import CompensatedError, Compensation, LeftOut
from elastogeo.prediction.compensation.verdict import checks


def compensate(
    *results: PositioningResults | Identification,
    control: str = "linuxcnc",
    settings: Mapping[str, str] | None = None,
    zero_at: Mapping[str, float] | None = None,
) -> Compensation:
    """The compensation files of a control, and what is left of the errors after they are loaded.

    A part of an error (the curve of an axis, what it loses when it turns back) is written if it is greater than its expanded
    uncertainty, and if the tests determine it by itself; what is not is named, with the reason. What is left is what was
    found less what the control makes of its own files, read back.

    Parameters
    ----------
    *results : PositioningResults or Identification
        Of one machine. Of a positioning test the means by target count, of an identification the parameters; where both have
        an error, the targets.
    control : str
        `linuxcnc`, `sinumerik-lec`, `sinumerik-cec`, `heidenhain`, `fanuc`, `isg`, `csv`.
    settings : mapping of str to str, optional
        Of the control, by name.
    zero_at : mapping of str to float, optional [mm or rad]
        By axis, the position whose error counts as zero: where the machine refers to. 0 by default.

    Raises
    ------
    InputError
        If there is no such control or setting, or two results are of one error or of different machines.
    """
    form = compensation_format(control)
    values = form.with_defaults(settings or {})
    found = _each_once([error for one in results for error in _found(one, zero_at or {})])
    campaign = _campaign(results, found)
    left = [out for one in found for out in _left_out(one, form)]
    chosen = {
        one.table.name: certain for one in found if not form.takes(one.table) and (certain := one.certain()) is not None
    }
    files = compensation_text(list(chosen.values()), control, values) if chosen else {}
    applied = {table.name: table for table in read_back(files, control, values)}
    errors = tuple(CompensatedError(one, applied[one.table.name]) for one in found if one.table.name in chosen)
    left += [out for one in errors for out in _one_curve(one)]
    return Compensation(
        campaign=campaign,
        control=form.name,
        title=form.title,
        settings=values,
        errors=errors,
        left_out=tuple(left),
        files=files,
        volume=_volume(results, applied, found),
        verdict=checks(errors, left, form.sign_is_public),
    )


def _found(result: PositioningResults | Identification, zero_at: Mapping[str, float]) -> tuple[FoundError, ...]:
    if isinstance(result, Identification):
        return found_by_parameters(result, zero_at)
    return (found_by_targets(result, zero_at.get(result.axis)),)


def _volume(
    results: Sequence[PositioningResults | Identification], applied: Mapping[str, ErrorTable], found: Sequence[FoundError]
) -> InVolume | None:
    identified = [one for one in results if isinstance(one, Identification)]
    zero = {one.table.axis: one.zero_at for one in found}
    return in_volume(identified[0], applied, zero) if len(identified) == 1 and applied else None


def _each_once(found: Sequence[FoundError]) -> list[FoundError]:
    """Without what parameters say of an error that was read at targets."""
    by_target = {one.table.name for one in found if one.by_target}
    return [one for one in found if one.by_target or one.table.name not in by_target]


def _campaign(results: Sequence[PositioningResults | Identification], found: Sequence[FoundError]) -> Campaign:
    if not results:
        raise InputError("there is nothing to compensate; give one result or more")
    names = [one.table.name for one in found]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(f"two results are of {twice[0]}; give the one that is to be compensated")
    asked = [one.campaign if isinstance(one, Identification) else campaign_of(one.test) for one in results]
    if len(asked) == 1:
        return asked[0]
    return campaign_of([test for campaign in asked for test in campaign.tests.values()])


def _left_out(found: FoundError, form: CompensationFormat) -> Iterator[LeftOut]:
    name = found.table.name
    if found.unknown:
        yield LeftOut(found.unknown, name, "not determined")
    why = form.takes(found.table)
    if why:
        yield LeftOut(tuple(n for part in found.parts for n in part.names), name, "control", why=why)
        return
    for part in found.parts:
        if not part.is_certain:
            yield LeftOut(part.names, name, _reason(part), part.size, part.doubt)


def _one_curve(error: CompensatedError) -> Iterator[LeftOut]:
    """What differs by direction, where the control has one curve for both."""
    certain = error.found.certain()
    if error.written.one_sided and certain is not None and not certain.one_sided:
        parts = [part for part in error.found.parts if part.is_certain and not np.array_equal(*part.value.T)]
        names = tuple(name for part in parts for name in part.names)
        yield LeftOut(names, error.error.name, "control", why="it has one curve for both directions here")


def _reason(part: ErrorPart) -> str:
    return "no interval" if part.doubt != part.doubt else "uncertainty"
