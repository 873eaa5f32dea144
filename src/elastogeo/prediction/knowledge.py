"""What a campaign's result says of a machine, for any linear function of its parameters: value, uncertainty, or nothing.

A functional c is supported if it lies in the row space of the tests: then `c = combinations^T c_retained`, and the data say
its value and its uncertainty, by the scatter of the runs and by every influence. Where it does not, no interval of the data
exists: nothing is stated, or, if a prior is asked for, a value by it, with the share of the variance that is the prior's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.estimate import Confounding, Solution, coverage_factor, effective_degrees_of_freedom
from elastogeo.identification import Budget, Identification, plain, sources_of
from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations
from elastogeo.prediction.scales import parameter_scales
from elastogeo.prediction.support import SUPPORTED, unsupported_share
from elastogeo.prediction.virtual import functionals
from elastogeo.sources import Source, select_sources

Flags = np.ndarray[tuple[int], np.dtype[np.bool_]]

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

    def __len__(self) -> int:
        return len(self.value)


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
        functional = np.atleast_2d(functional)
        unsupported = unsupported_share(functional, self.seen, self.scales)
        supported = unsupported < SUPPORTED
        scaled = functional * self.scales
        along = scaled @ self.seen
        along[np.linalg.norm(along, axis=1) < SUPPORTED * np.linalg.norm(scaled, axis=1)] = 0.0
        chosen = [self.confounding.labels.index(label) for label in self.solution.labels]
        weights = along @ (self.seen / self.scales[:, np.newaxis]).T[:, chosen]
        variance, freedom = self._variance(weights)
        unseen = np.sum((scaled - along @ self.seen.T) ** 2, axis=1) * ~supported
        total = variance + unseen
        known = np.isfinite(variance) & (supported | prior)
        parts = np.sqrt(np.column_stack([variance, unseen]))
        degrees = effective_degrees_of_freedom(parts, np.column_stack([freedom, np.full(len(freedom), np.inf)]))
        share = np.divide(unseen, total, out=np.zeros(len(total)), where=known & (total > 0))
        return Predicted(
            value=np.where(supported | prior, weights @ self.values, np.nan),
            standard_uncertainty=np.where(known, np.sqrt(total), np.nan),
            degrees_of_freedom=np.where(known, degrees, np.nan),
            supported=supported,
            unsupported=unsupported,
            prior_share=share,
        )

    def _variance(self, weights: Array) -> tuple[Array, Array]:
        """Variance of combinations of the retained parameters, and its degrees of freedom; NaN where the runs show none."""
        none = np.full(len(weights), np.nan)
        scatter = self.solution.scatter
        if scatter is None or not self.by_run:
            return none, none
        own, degrees = scatter.variance(weights), scatter.degrees_of_freedom(weights)
        shown = (degrees > 1) | ~weights.any(axis=1)
        moved = weights @ self.budget.systematic.T
        parts = np.column_stack([np.sqrt(own), np.abs(moved)])
        freedoms = np.tile(self.budget.freedoms, (len(weights), 1))
        effective = effective_degrees_of_freedom(parts, np.column_stack([np.maximum(degrees, 1.0), freedoms]))
        return np.where(shown, own + np.sum(moved**2, axis=1), np.nan), effective


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
