"""What a campaign's result says of a machine, for any linear function of its parameters: value, uncertainty, or nothing.

A functional c is supported if it lies in the row space of the tests: then `c = combinations^T c_retained`, and the data say
its value and its uncertainty, by the scatter of the runs and by every influence. Where it does not, no interval of the data
exists: nothing is stated, or, if a prior is asked for, a value by it, with the share of the variance that is the prior's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from math import inf, isfinite

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.estimate import (
    Confounding,
    Estimate,
    RunScatter,
    ScatterAlong,
    Solution,
    coverage_factor,
    effective_degrees_of_freedom,
)
from elastogeo.identification import Budget, Identification, plain, sources_of
from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations
from elastogeo.prediction.scales import parameter_scales
from elastogeo.prediction.support import SUPPORTED
from elastogeo.prediction.virtual import functionals
from elastogeo.sources import Source, select_sources

Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]

_FEW = 12
"""Functionals up to which the forms of their degrees of freedom take less than the runs themselves."""

_ROWS = 20_000
"""Functionals that are predicted at once: what bounds the memory."""

_INDEPENDENT = 1e-10
"""Singular value, relative to the greatest, of retained combinations in scaled parameters that counts as one."""


@dataclass(frozen=True, slots=True, eq=False)
class Predicted(ByValue):
    """Values of m functionals.

    Attributes
    ----------
    value : array, shape (m,)
        NaN where it is not supported, unless a prior was asked for.
    standard_uncertainty : array, shape (m,)
        NaN where there is none: not supported, or the runs are too few to show it.
    degrees_of_freedom : array, shape (m,)
        Effective (JCGM 100, G.4); NaN where there is no uncertainty.
    supported : array of bool, shape (m,)
        Whether the tests determine it.
    unsupported : array, shape (m,)
        The share of each functional that no test sees, 0 to 1, in parameters scaled by their expected size.
    prior_share : array, shape (m,)
        Share of the variance that is the stated prior's; 0 where supported.
    """

    value: Array
    standard_uncertainty: Array
    degrees_of_freedom: Array
    supported: Flags
    unsupported: Array
    prior_share: Array

    @property
    def expanded(self) -> Array:
        """Expanded uncertainty U, shape (m,): half the width of the 95 % coverage interval; NaN where there is none."""
        known = np.isfinite(self.standard_uncertainty)
        factor = coverage_factor(np.where(known, self.degrees_of_freedom, np.inf))
        return np.asarray(np.where(known, factor * self.standard_uncertainty, np.nan))

    @property
    def interval(self) -> Array:
        """95 % coverage interval, shape (m, 2)."""
        return np.column_stack([self.value - self.expanded, self.value + self.expanded])

    def estimate(self, k: int) -> Estimate:
        """The value of one functional as an estimate; its uncertainty is infinite where nothing shows it."""
        value, u, freedom = (float(one[k]) for one in (self.value, self.standard_uncertainty, self.degrees_of_freedom))
        return Estimate(value, u, freedom) if isfinite(u) else Estimate(value, inf)

    @staticmethod
    def joined(parts: Sequence[Predicted]) -> Predicted:
        """The functionals of all parts, one after the other."""
        every = {field.name: np.concatenate([getattr(one, field.name) for one in parts]) for field in fields(Predicted)}
        return Predicted(**every)

    def __len__(self) -> int:
        return len(self.value)


@dataclass(frozen=True, slots=True)
class Span:
    """What is known of b functionals, and so of all their combinations.

    Attributes
    ----------
    value : array, shape (b,)
    over : array, shape (b, r)
        In the space in which the runs scatter.
    systematic : array, shape (b, q)
        By how much one standard uncertainty of each influence moves them.
    freedoms : array, shape (q,)
        Degrees of freedom of each influence.
    seen, unseen : array, shape (b, k), (b, l)
        What the tests see of them, and what they do not, in scaled parameters.
    scatter : RunScatter or None
        None where the runs are too few for an uncertainty.
    along : ScatterAlong or None
        Its forms, where the functionals are few.
    """

    value: Array
    over: Array
    systematic: Array
    freedoms: Array
    seen: Array
    unseen: Array
    scatter: RunScatter | None
    along: ScatterAlong | None = None

    def of(self, functionals: Array) -> Span:
        """What is known of a few combinations, shape (c, b), as a span of its own."""
        over = functionals @ self.over
        few = self.scatter is not None and len(functionals) <= _FEW
        return Span(
            value=functionals @ self.value,
            over=over,
            systematic=functionals @ self.systematic,
            freedoms=self.freedoms,
            seen=narrow(functionals @ self.seen),
            unseen=narrow(functionals @ self.unseen),
            scatter=self.scatter,
            along=self.scatter.along(over) if self.scatter is not None and few else None,
        )

    def predict(self, coefficients: Array, prior: bool = False) -> Predicted:
        """The values of combinations, of coefficients of shape (m, b); see `Knowledge.predict`."""
        blocks = range(0, len(coefficients), _ROWS) if len(coefficients) else (0,)
        found = [self._predicted(coefficients[first : first + _ROWS], prior) for first in blocks]
        return Predicted.joined(found)

    def unsupported(self, coefficients: Array) -> Array:
        """The share of each combination that no test sees, shape (m,), 0 to 1."""
        return _share(*(np.sum((coefficients @ part) ** 2, axis=1) for part in (self.seen, self.unseen)))

    def _predicted(self, coefficients: Array, prior: bool) -> Predicted:
        seen, unseen = (np.sum((coefficients @ part) ** 2, axis=1) for part in (self.seen, self.unseen))
        unsupported = _share(seen, unseen)
        supported = unsupported < SUPPORTED
        held = coefficients * (seen > SUPPORTED**2 * unseen)[:, np.newaxis]
        variance, freedom = self._variance(held)
        unseen = unseen * ~supported
        total = variance + unseen
        known = np.isfinite(variance) & (supported | prior)
        degrees = effective_degrees_of_freedom(
            np.sqrt(np.column_stack([variance, unseen])), np.column_stack([freedom, np.full(len(freedom), np.inf)])
        )
        return Predicted(
            value=np.where(supported | prior, held @ self.value, np.nan),
            standard_uncertainty=np.where(known, np.sqrt(total), np.nan),
            degrees_of_freedom=np.where(known, degrees, np.nan),
            supported=supported,
            unsupported=unsupported,
            prior_share=np.divide(unseen, total, out=np.zeros(len(total)), where=known & (total > 0)),
        )

    def moved(self, coefficients: Array) -> Array | None:
        """What each run, then each influence, moves combinations by, shape (..., q): their squares add up to the variance.

        None where the runs show no uncertainty. Products of two combinations add up to their covariance.
        """
        if self.scatter is None:
            return None
        flat = coefficients.reshape(-1, coefficients.shape[-1])
        both = np.hstack([flat @ self.scatter.moved(self.over), flat @ self.systematic])
        return np.asarray(both.reshape(*coefficients.shape[:-1], -1))

    def _variance(self, held: Array) -> tuple[Array, Array]:
        """Variance of combinations and its degrees of freedom; NaN where the runs show none."""
        if self.scatter is None:
            none = np.full(len(held), np.nan)
            return none, none
        own = np.sum((held @ self.scatter.moved(self.over)) ** 2, axis=1)
        degrees = self.along.freedom(held) if self.along else self.scatter.freedom(held @ self.over)
        shown = (degrees > 1) | ~held.any(axis=1)
        moved = held @ self.systematic
        parts = np.column_stack([np.sqrt(own), np.abs(moved)])
        freedoms = np.tile(self.freedoms, (len(held), 1))
        effective = effective_degrees_of_freedom(parts, np.column_stack([np.maximum(degrees, 1.0), freedoms]))
        return np.where(shown, own + np.sum(moved**2, axis=1), np.nan), effective


def _share(seen: Array, unseen: Array) -> Array:
    """The length of what is not seen over that of all, of the squares of both parts."""
    whole = seen + unseen
    return np.asarray(np.sqrt(np.divide(unseen, whole, out=np.zeros_like(whole), where=whole > 0)))


def narrow(rows: Array) -> Array:
    """Rows of the same lengths and angles, with no more columns than there are rows."""
    return rows if rows.shape[1] <= len(rows) else np.asarray(np.linalg.qr(rows.T)[1]).T


@dataclass(frozen=True, eq=False)
class Knowledge(ByValue):
    """What a result says of p parameters, of which r combinations are determined.

    **Parameters that were not asked for are taken as zero**; `rigid` names the compliances of joints among them.

    Attributes
    ----------
    machine : Machine
    sources : tuple of Source, length p
        All that were asked for, set-up included.
    solution : Solution
        Of the r retained parameters.
    budget : Budget
        Their uncertainty with all influences.
    confounding : Confounding
        What they stand for.
    by_run : bool
        Whether the runs are enough for an uncertainty.
    scales : array, shape (p,)
        Expected size of each parameter, in its unit: the metric of support, and the prior.
    centre : array, shape (n,) [mm, rad]
        From which laws of travel count.
    rigid : tuple of str
        Compliances of joints and places that were not asked for.
    simulated : str
        From what readings are simulated, in words; empty if all were measured.
    """

    machine: Machine
    sources: tuple[Source, ...]
    solution: Solution
    budget: Budget
    confounding: Confounding
    by_run: bool
    scales: Array
    centre: Array
    rigid: tuple[str, ...]
    simulated: str

    @property
    def values(self) -> Array:
        """Of the retained parameters, shape (r,)."""
        return self.solution.values

    @property
    def covariance(self) -> Array:
        """Of the retained parameters, shape (r, r), with all influences."""
        return self.budget.covariance

    @property
    def degrees_of_freedom(self) -> Array:
        """Of each retained parameter, shape (r,). **Those of a sum do not follow from them**: `predict` finds them."""
        return self.budget.degrees_of_freedom

    @property
    def combinations(self) -> Array:
        """What the retained parameters stand for, shape (r, p)."""
        return self.confounding.combinations

    @cached_property
    def seen(self) -> Array:
        """Orthonormal basis of what the tests see, in scaled parameters, shape (p, r)."""
        scaled = self.combinations * self.scales
        scaled = scaled / np.linalg.norm(scaled, axis=1, keepdims=True)
        _, singular_values, right = np.linalg.svd(scaled, full_matrices=False)
        return np.asarray(right[singular_values > _INDEPENDENT * singular_values[0]].T)

    def rows(self, observations: Observations) -> Array:
        """What readings that no instrument takes ask of the parameters, shape (m, p): nothing of any test's set-up.

        Of a parameter by date, the last date counts.
        """
        last = {plain(source.name): k for k, source in enumerate(self.sources) if not source.of_test}
        found = np.zeros((len(observations), len(self.sources)))
        chosen = sorted(last.values())
        placed = replace(observations, centre=self.centre)
        found[:, chosen] = functionals([self.sources[k] for k in chosen], self.machine, placed)
        return found

    @cached_property
    def span(self) -> Span:
        """What is known of each parameter by itself, and so of any functional of all."""
        seen, scales = self.seen, self.scales[:, np.newaxis]
        chosen = [self.confounding.labels.index(label) for label in self.solution.labels]
        onto = scales * (seen @ (seen / scales).T[:, chosen])
        scatter = self.solution.scatter if self.by_run else None
        return Span(
            value=onto @ self.values,
            over=onto if scatter is None else scatter.over(onto),
            systematic=onto @ self.budget.systematic.T,
            freedoms=self.budget.freedoms,
            seen=scales * seen,
            unseen=scales * (np.eye(len(seen)) - seen @ seen.T),
            scatter=scatter,
        )

    def predict(self, functional: Array, prior: bool = False) -> Predicted:
        """The values of functionals, with their uncertainty where the tests support them.

        Parameters
        ----------
        functional : array, shape (m, p)
            What is asked of the parameters, in their units.
        prior : bool
            Whether what is not supported is given by the stated prior: each parameter zero, with a standard deviation of
            its scale, where no test sees it.
        """
        return self.span.predict(np.atleast_2d(functional), prior)


def knowledge_of(result: Identification) -> Knowledge:
    """What the result of a test, or of several tests of one machine, says of the machine."""
    campaign, sources = result.campaign, sources_of(result.campaign)
    return Knowledge(
        machine=campaign.machine,
        sources=sources,
        solution=result.solution,
        budget=result.budget,
        confounding=result.confounding,
        by_run=result.by_run,
        scales=parameter_scales(sources),
        centre=next(iter(campaign.observations().values()))[0].centre,
        rigid=_rigid(campaign.machine, sources),
        simulated=campaign.simulated,
    )


def _rigid(machine: Machine, sources: Sequence[Source]) -> tuple[str, ...]:
    """Compliances of joints and places that were not asked for: those that reciprocity makes one count as one."""
    asked = {(source.site, component) for source in sources for component in _pairs(source)}
    patterns = ["C_???"] + (["CL_*"] if machine.places else [])
    every = select_sources(machine, patterns)
    return tuple(s.name for s in every if not {(s.site, pair) for pair in _pairs(s)[:1]} & asked)


def _pairs(source: Source) -> tuple[tuple[int, int | None], ...]:
    """Displacement and load component, and those of the mirror where reciprocity makes both one."""
    own = source.component, source.load
    mirror = getattr(source, "mirror", None)
    return (own,) if mirror is None else (own, (mirror.component, mirror.load))
