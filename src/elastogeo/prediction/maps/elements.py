"""What a force shows of the machine over the volume, in every direction at once: six elements of C_t at each place.

The compliance along a direction e is e^T C e: with the six elements kept, any direction is six products a place, and the
tests need not be asked again. Where the tests do not tell an element it has no number here. Beside it stands what the tests'
own question says, for which **every compliance that it does not name counts as rigid**: an assumption, kept apart.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.identification import Check, identify
from elastogeo.machine import Array
from elastogeo.observe import Askable, Campaign, campaign_of
from elastogeo.prediction.knowledge import Knowledge, Predicted, knowledge_of
from elastogeo.prediction.maps.field import BLOCK, quadratic
from elastogeo.prediction.maps.places import Grid, grid
from elastogeo.prediction.maps.result import Flags
from elastogeo.prediction.maps.verdict import foundation, uncertainty_known
from elastogeo.prediction.support import SUPPORTED
from elastogeo.prediction.tool_compliances import TRANSLATION
from elastogeo.result import Result

EVERY = "C_???"
"""The compliances of all joints: asked for beside the tests' own question, so that none is taken as rigid."""

_MOST_CENTRES, _NEAR, _ALIKE_MM = 3, 0.5, 6
"""Of an axis, so many different centres of tests are places of the grid; places nearer to them than this share of a step are
not; centres that agree to so many decimals [mm] are one."""

COVARIANCES = tuple((i, j) for i in range(len(TRANSLATION)) for j in range(i, len(TRANSLATION)))
"""Which pairs of elements the 21 covariances of a place are of."""


@dataclass(frozen=True, slots=True, eq=False)
class Elements(ByValue):
    """The six elements of the symmetric compliance, XX XY XZ YY YZ ZZ, at m places.

    Attributes
    ----------
    compliance : array, shape (m, 6) [mm/N]
        NaN where the tests do not tell it.
    covariance : array, shape (m, 21) [(mm/N)^2]
        Of these elements, in the order of `COVARIANCES`; NaN where there is none.
    coverage : array, shape (m, 6)
        Coverage factor (95 %) of each; NaN where there is no uncertainty.
    """

    compliance: Array
    covariance: Array
    coverage: Array

    @property
    def told(self) -> Flags:
        """Whether the tests tell each element, shape (m, 6)."""
        return np.asarray(np.isfinite(self.compliance))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ElementMap(Result):
    """The compliance at the tool over the volume, in every direction: plain numbers, so that it can be kept.

    Attributes
    ----------
    machine : str
    tests : tuple of str
        On which it rests.
    simulated : str
        From what their readings are simulated; empty if all were measured.
    axes : tuple of str
        The linear axes that the grid is over.
    along : tuple of array [mm]
        Commands along each; the places are counted through in this order, the last axis the fastest.
    stands : mapping of str to float [mm, rad]
        Where the other axes stand.
    tool : array, shape (3,) [mm]
        Functional point in the last tool-branch frame.
    told : Elements
        What the tests tell, with no joint taken as rigid.
    assumed : Elements or None
        What they tell if the compliances that they were not asked for are zero; None if they were asked for all.
    rigid : tuple of str
        The compliances that `assumed` takes as zero.
    verdict : tuple of Check
    """

    machine: str
    tests: tuple[str, ...]
    simulated: str
    axes: tuple[str, ...]
    along: tuple[Array, ...]
    stands: Mapping[str, float]
    tool: Array
    told: Elements
    assumed: Elements | None
    rigid: tuple[str, ...]
    verdict: tuple[Check, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Places along each axis."""
        return tuple(len(one) for one in self.along)

    def document(self) -> dict[str, Any]:
        """As plain values, to be kept as JSON; what is not known is None."""
        return {
            "machine": self.machine,
            "tests": list(self.tests),
            "simulated": self.simulated,
            "axes": {axis: one.tolist() for axis, one in zip(self.axes, self.along, strict=True)},
            "stands": dict(self.stands),
            "tool_mm": list(map(float, self.tool)),
            "told": _plain(self.told),
            "assumed": None if self.assumed is None else _plain(self.assumed),
            "rigid": list(self.rigid),
            "checks": [[one.name, one.passed, dict(one.facts), one.decisive] for one in self.verdict],
        }

    @staticmethod
    def of_document(document: Mapping[str, Any]) -> ElementMap:
        """What `document` gave."""
        axes = document["axes"]
        return ElementMap(
            machine=document["machine"],
            tests=tuple(document["tests"]),
            simulated=document["simulated"],
            axes=tuple(axes),
            along=tuple(np.array(one, dtype=float) for one in axes.values()),
            stands=dict(document["stands"]),
            tool=np.array(document["tool_mm"], dtype=float),
            told=_elements(document["told"]),
            assumed=None if document["assumed"] is None else _elements(document["assumed"]),
            rigid=tuple(document["rigid"]),
            verdict=tuple(
                Check(name, passed, _frozen(facts), decisive) for name, passed, facts, decisive in document["checks"]
            ),
        )


def map_elements(
    one: Askable,
    along: Mapping[str, tuple[float, float, int]] | None = None,
    at: Mapping[str, float] | None = None,
    tool: Sequence[float] | None = None,
) -> ElementMap:
    """The compliance at the tool over the volume, in every direction, as far as the tests tell it.

    Parameters
    ----------
    one : MachineTest, Campaign or several tests
    along, at, tool
        As `map_compliance` takes them.

    Returns
    -------
    ElementMap

    Raises
    ------
    InputError
        If the grid or tool is none.
    UnsupportedError
        If no compliance can be asked for, or one changes with force, feed or travel.
    """
    from elastogeo.prediction.maps.compliance_map import functional_point

    campaign = campaign_of(one)
    places, point = grid(campaign.machine, campaign, along, at), functional_point(campaign, tool)
    places = places if along else _with_centres(places, campaign)
    own = identify(campaign)
    narrow = knowledge_of(own)
    enough = not narrow.rigid and campaign.question.reciprocal
    every = own if enough else identify(campaign, parameters=_with_all(campaign), reciprocal=True)
    whole = narrow if enough else knowledge_of(every)
    told = _over(whole, places, point)
    told_all = np.asarray(told.told.all(axis=1))
    stands = {axis: float(places.stands[k]) for k, axis in enumerate(campaign.machine.axes) if axis not in places.axes}
    u = told.covariance[:, [k for k, (i, j) in enumerate(COVARIANCES) if i == j]]
    return ElementMap(
        machine=campaign.machine.name,
        tests=tuple(campaign.tests) if campaign.several else (campaign.name,),
        simulated=campaign.simulated,
        axes=places.axes,
        along=places.along,
        stands=stands,
        tool=point,
        told=told,
        assumed=_over(narrow, places, point) if narrow.rigid else None,
        rigid=narrow.rigid,
        verdict=(
            *((uncertainty_known(every.by_run, u.max(axis=1), told_all),) if told_all.any() else ()),
            foundation(own),
        ),
    )


def _with_centres(places: Grid, campaign: Campaign) -> Grid:
    """The grid with the places where the tests stood: one test tells most there, and often only there."""
    stood = np.array([test.observations()[0].centre for test in campaign.tests.values()])[:, list(places.columns)]
    found = []
    for k, one in enumerate(places.along):
        own = np.unique(stood[:, k].round(_ALIKE_MM))
        own = own[(own > one[0]) & (own < one[-1])] if len(one) > 1 and len(own) <= _MOST_CENTRES else own[:0]
        near = np.abs(one[1:-1, np.newaxis] - own).min(axis=1, initial=np.inf) < _NEAR * (
            one[1] - one[0] if len(one) > 1 else 1
        )
        found.append(np.sort(np.concatenate([one[:1], one[1:-1][~near], own, one[-1:] if len(one) > 1 else one[:0]])))
    return replace(places, along=tuple(found))


def _with_all(campaign: Campaign) -> tuple[str, ...]:
    """What the tests ask, and the compliances of all joints."""
    return (*campaign.asked, EVERY)


def _over(knowledge: Knowledge, places: Grid, tool: Array) -> Elements:
    """The elements over a grid."""
    found, count = quadratic(knowledge, places, tool), len(TRANSLATION)
    span = knowledge.span.of(found.rows.reshape(-1, found.rows.shape[-1]))
    parts = []
    for first in range(0, places.size, BLOCK):
        at = np.arange(first, min(first + BLOCK, places.size))
        terms = found.terms(places.commands(at)[:, list(places.columns)])
        chosen = np.zeros((count, len(at), terms.shape[1], count))
        for k in range(count):
            chosen[k, :, :, k] = terms
        flat = chosen.reshape(count, len(at), -1)
        values = [span.predict(one) for one in flat]
        told = np.array([span.unsupported(one) < SUPPORTED for one in flat]).T
        factor = np.array([_coverage(one) for one in values]).T
        parts.append(
            Elements(
                compliance=np.where(told, np.array([one.value for one in values]).T, np.nan),
                covariance=_covariance(span.moved(flat), told),
                coverage=np.where(told, factor, np.nan),
            )
        )
    return Elements(*(np.concatenate([getattr(one, f.name) for one in parts]) for f in fields(Elements)))


def _coverage(one: Predicted) -> Array:
    """Coverage factors, shape (m,); NaN where there is no uncertainty."""
    u = one.standard_uncertainty
    known = np.isfinite(u) & (u > 0)
    return np.where(known, one.expanded / np.where(known, u, 1.0), np.nan)


def _covariance(moved: Array | None, told: Flags) -> Array:
    """Of the elements at each place, shape (m, 21), from what moves them, shape (6, m, q)."""
    found = np.full((len(told), len(COVARIANCES)), np.nan)
    if moved is not None:
        for k, (i, j) in enumerate(COVARIANCES):
            both = told[:, i] & told[:, j]
            found[both, k] = np.sum(moved[i][both] * moved[j][both], axis=1)
    return found


def _plain(one: Elements) -> dict[str, Any]:
    names = {"compliance": "compliance_mm_per_N", "covariance": "covariance", "coverage": "coverage"}
    return {said: _listed(getattr(one, name)) for name, said in names.items()}


def _listed(values: Array) -> list[list[float | None]]:
    return [[float(value) if np.isfinite(value) else None for value in row] for row in values]


def _elements(document: Mapping[str, Any]) -> Elements:
    names = ("compliance_mm_per_N", "covariance", "coverage")
    return Elements(*(np.array(document[name], dtype=float).reshape(len(document[name]), -1) for name in names))


def _frozen(value: Any) -> Any:
    """Facts as checks have them: what JSON reads back as lists are tuples."""
    if isinstance(value, Mapping):
        return {key: _frozen(one) for key, one in value.items()}
    return tuple(map(_frozen, value)) if isinstance(value, list) else value
