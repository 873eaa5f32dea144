"""From tests, or what was identified from them, to a map of the compliance at the tool."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Unpack

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Estimate
from elastogeo.formats import Design
from elastogeo.identification import Asked, Identification, identify
from elastogeo.machine import Array
from elastogeo.observe import Askable, Campaign
from elastogeo.prediction.knowledge import Knowledge, knowledge_of
from elastogeo.prediction.maps.acceptance import accepted
from elastogeo.prediction.maps.design import AgainstDesign, against_design, design_vector
from elastogeo.prediction.maps.field import Field, field_over, given_over
from elastogeo.prediction.maps.places import Grid, grid
from elastogeo.prediction.maps.result import ComplianceMap, Place
from elastogeo.prediction.maps.verdict import (
    as_designed,
    foundation,
    judged,
    nothing_left_out,
    stiff_enough,
    supported_everywhere,
    uncertainty_known,
)
from elastogeo.prediction.tool_compliances import TRANSLATION, entry_rows, tool_compliance, unit_direction, weights_of

SOFTEST = "softest"

_NAMED = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


def map_compliance(
    one: Askable | Identification,
    along: Mapping[str, tuple[float, float, int]] | None = None,
    at: Mapping[str, float] | None = None,
    direction: str | Sequence[float] = SOFTEST,
    tool: Sequence[float] | None = None,
    least_stiffness: float | None = None,
    design: Design | None = None,
    prior: bool = False,
    **asked: Unpack[Asked],
) -> ComplianceMap:
    """The compliance at the tool over the volume, with U, where the tests support it.

    Parameters
    ----------
    one : MachineTest, Campaign, several tests, or Identification
    along : mapping of str to (first, last, count), optional [mm]
        Linear axes of the grid: `{"X": (-200, 200, 21)}`; by default all, over their travel, or as far as the tests went.
    at : mapping of str to float, optional [mm, rad]
        Where other axes stand; by default at the centre of the first test.
    direction : "softest", "X", "Y", "Z", or three numbers
        Of the force, and of the displacement that counts, in the foundation.
    tool : sequence of 3 float, optional [mm]
        Functional point in the last tool-branch frame; by default that of the tests, if all have the same.
    least_stiffness : float, optional [N/mm]
        Limit that is decided on at every place (ISO 14253-1).
    design : Design, optional
        Compliances by design or finite elements, to be compared with what was measured.
    prior : bool
        Whether to give what is not supported by the stated prior.
    **asked
        Another question than the tests' own, as in `identify`.

    Returns
    -------
    ComplianceMap

    Raises
    ------
    InputError
        If the grid, direction, tool, limit or design is none, or an identification is asked another question.
    UnsupportedError
        If no compliance was asked for, or one changes with force, feed or travel.
    """
    if isinstance(one, Identification) and asked:
        raise InputError(
            f"{', '.join(asked)} cannot be asked of a result; ask the tests, or identify them with this question"
        )
    result = one if isinstance(one, Identification) else identify(one, **asked)
    known, campaign = knowledge_of(result), result.campaign
    places = grid(campaign.machine, campaign, along, at)
    way, point = _direction(direction), functional_point(campaign, tool)
    found = field_over(known, places, point, way, prior)
    compliance, expanded = found.predicted.value, found.predicted.expanded
    told = np.where(found.predicted.supported, compliance, np.nan)  # a prior accepts no machine
    decision = None if least_stiffness is None else accepted(told, expanded, least_stiffness)
    stiffest, softest = _extremes(known, places, point, found, prior)
    compared = None if design is None else _compared(known, places, point, found, design)
    shape, predicted = places.shape, found.predicted
    return ComplianceMap(
        campaign=campaign,
        grid=places,
        tool=point,
        direction=way,
        compliance=compliance.reshape(shape),
        expanded=expanded.reshape(shape),
        supported=predicted.supported.reshape(shape),
        unsupported=predicted.unsupported.reshape(shape),
        prior_share=predicted.prior_share.reshape(shape),
        directions=found.direction.reshape(*shape, 3),
        prior=prior,
        by_run=result.by_run,
        stiffest=stiffest,
        softest=softest,
        corners=tuple(_place(known, places, point, found, k, prior) for k in places.corners if np.isfinite(compliance[k])),
        difference=_difference(known, point, found, places, stiffest, softest, prior),
        acceptance=decision,
        design=compared,
        rigid=known.rigid,
        verdict=judged(
            supported_everywhere(predicted.supported, prior, (known.confounding.rank, len(known.confounding.labels))),
            uncertainty_known(result.by_run, expanded, predicted.supported) if predicted.supported.any() else None,
            nothing_left_out(known.rigid, sum(source.elastic for source in known.sources)),
            foundation(result),
            None if decision is None else stiff_enough(decision),
            None if compared is None else as_designed(compared),
        ),
    )


def _compared(known: Knowledge, places: Grid, tool: Array, found: Field, design: Design) -> AgainstDesign:
    """What was measured against design; by data alone, also where a prior was asked for."""
    value, spread = given_over(known, places, tool, found.direction, design_vector(known, design))
    unsure = design.relative_uncertainty * spread
    whole = against_design(known, design, value, found.predicted, unsure, found.independent)
    return replace(whole, compliance=value.reshape(places.shape), agrees=whole.agrees.reshape(places.shape))


def _direction(asked: str | Sequence[float]) -> Array | None:
    if isinstance(asked, str):
        if asked.lower() == SOFTEST:
            return None
        if asked.upper() not in _NAMED:
            raise InputError(f"the direction is {asked!r}; give {SOFTEST}, X, Y, Z, or three numbers")
        return np.array(_NAMED[asked.upper()])
    return unit_direction(asked)


def functional_point(campaign: Campaign, asked: Sequence[float] | None) -> Array:
    """The functional point: what is asked for, else that of the tests if they have one, else the machine's."""
    if asked is not None:
        point = np.asarray(asked, dtype=float)
        if point.shape != (3,) or not np.isfinite(point).all():
            raise InputError(f"the tool point is {asked}; it must be three finite numbers, in mm")
        return point
    tools = np.array([runs[0].tool for runs in campaign.observations().values()])
    return tools[0] if not np.ptp(tools, axis=0).any() else np.array(campaign.machine.tool, dtype=float)


def _extremes(
    known: Knowledge, places: Grid, tool: Array, found: Field, prior: bool
) -> tuple[Place, Place] | tuple[None, None]:
    values = found.predicted.value
    if not np.isfinite(values).any():
        return None, None
    stiffest, softest = (
        _place(known, places, tool, found, int(k), prior) for k in (np.nanargmin(values), np.nanargmax(values))
    )
    return stiffest, softest


def _place(known: Knowledge, places: Grid, tool: Array, found: Field, k: int, prior: bool) -> Place:
    commands = places.commands(np.array([k]))[0]
    index = tuple(map(int, np.unravel_index(k, places.shape)))
    return Place(index, commands, found.predicted.estimate(k), tool_compliance(known, commands, tool, prior))


def _difference(
    known: Knowledge, tool: Array, found: Field, places: Grid, stiffest: Place | None, softest: Place | None, prior: bool
) -> Estimate | None:
    """By how much the softest place is softer than the stiffest: what is uncertain of both alike cancels."""
    if stiffest is None or softest is None:
        return None
    way = found.direction.reshape(*places.shape, 3)
    rows = entry_rows(known, np.vstack([softest.commands, stiffest.commands]), tool, TRANSLATION)
    weights = [weights_of(way[place.index], TRANSLATION) for place in (softest, stiffest)]
    return known.predict(weights[0] @ rows[0] - weights[1] @ rows[1], prior).estimate(0)
