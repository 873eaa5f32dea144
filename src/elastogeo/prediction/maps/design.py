"""What was measured against design or finite elements: as parameters, and, since these stay confounded, at the tool."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtr

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.estimate import Estimate, coverage_factor
from elastogeo.formats import Design
from elastogeo.identification import SIGNIFICANT
from elastogeo.machine import Array
from elastogeo.prediction.knowledge import Knowledge, Predicted

AGREES, UNKNOWN, DIFFERS = 1, 0, -1

_NORMAL = float(coverage_factor(np.array(np.inf)))
_ALIKE = 0.01
"""Share by which C_df and C_fd of one joint may differ in a design and still be one."""


@dataclass(frozen=True, slots=True)
class DesignParameter:
    """A parameter, or the sum that it stands for, as measured and by design.

    Attributes
    ----------
    name, unit : str
    stands_for : dict of str to float
    measured : Estimate
        Without known uncertainty where the runs are too few.
    design : float
        What the sum amounts to by design.
    design_uncertainty : float
        Its standard uncertainty.
    agrees : bool or None
        Whether both agree within U; None where there is none.
    """

    name: str
    unit: str
    stands_for: dict[str, float]
    measured: Estimate
    design: float
    design_uncertainty: float
    agrees: bool | None


@dataclass(frozen=True, slots=True, eq=False)
class AgainstDesign(ByValue):
    """What was measured against design.

    Attributes
    ----------
    name : str
        Where the design comes from.
    parameters : tuple of DesignParameter
        Every compliance, or sum of compliances, that the tests determine.
    compliance : array [mm/N]
        At the tool by design, along the direction of the map at each place, of the shape of its grid.
    agrees : array of int
        Of each place: 1 agrees within U, -1 does not, 0 where the tests do not tell.
    p_value : float
        Probability of such a difference, or a greater one, at any place, if the machine is as designed (Bonferroni, over the
        independent functionals of the map); NaN where the tests tell nowhere.
    missing : tuple of str
        Compliances that were asked for and are not in the design: rigid there.
    unused : tuple of str
        Those of the design that were not asked for: rigid in what was measured.
    """

    name: str
    parameters: tuple[DesignParameter, ...]
    compliance: Array
    agrees: NDArray[np.int8]
    p_value: float
    missing: tuple[str, ...]
    unused: tuple[str, ...]

    @property
    def passed(self) -> bool | None:
        """Whether they agree, all places together; None where the tests tell nowhere."""
        return None if not isfinite(self.p_value) else self.p_value >= SIGNIFICANT

    @property
    def share(self) -> float:
        """Share of the places that the tests tell at which they agree."""
        return float(np.mean(self.agrees[self.agrees != 0] > 0)) if self.agrees.any() else float("nan")


def design_vector(knowledge: Knowledge, design: Design) -> Array:
    """The design's values of the parameters that were asked for, shape (p,); zero for what it does not have.

    Raises
    ------
    InputError
        If it names no compliance that was asked for, or two for C_df and C_fd of a joint that was taken as symmetric.
    """
    names = _names(knowledge)
    if not any(name in design.values for several in names for name in several):
        raise InputError(
            f"the design {design.name!r} has none of the compliances that were asked for; it has "
            f"{', '.join(list(design.values)[:4])}"
        )
    return np.array([_value(several, design.values) for several in names])


def against_design(
    knowledge: Knowledge, design: Design, compliance: Array, measured: Predicted, uncertainty: Array, independent: int
) -> AgainstDesign:
    """The comparison.

    Parameters
    ----------
    knowledge : Knowledge
    design : Design
    compliance : array, shape (m,) [mm/N]
        At the tool by design.
    measured : Predicted
        As measured, at m places; what the tests do not support does not count.
    uncertainty : array, shape (m,) [mm/N]
        Standard uncertainty of the design at the tool.
    independent : int
        How many functionals of the parameters all places are made of.
    """
    difference = np.where(measured.supported, measured.value, np.nan) - compliance
    known = {name for several in _names(knowledge) for name in several}
    missing = tuple(several[0] for several in _names(knowledge) if several and not any(n in design.values for n in several))
    return AgainstDesign(
        name=design.name,
        parameters=tuple(_parameters(knowledge, design)),
        compliance=compliance,
        agrees=_agreement(difference, measured.expanded, uncertainty),
        p_value=_probability(difference, measured, uncertainty, independent),
        missing=missing,
        unused=tuple(name for name, value in design.values.items() if value and name not in known),
    )


def _parameters(knowledge: Knowledge, design: Design) -> list[DesignParameter]:
    sources = {source.name: source for source in knowledge.sources}
    values, combinations = design_vector(knowledge, design), knowledge.combinations
    elastic = np.array([source.elastic for source in knowledge.sources])
    found = knowledge.predict(combinations)
    by_design = combinations @ values
    uncertainty = design.relative_uncertainty * np.linalg.norm(combinations * values, axis=1)
    agrees = _agreement(found.value - by_design, found.expanded, uncertainty)
    return [
        DesignParameter(
            name=label,
            unit=sources[label].unit,
            stands_for=knowledge.confounding.stands_for(label),
            measured=found.estimate(k),
            design=float(by_design[k]),
            design_uncertainty=float(uncertainty[k]),
            agrees={AGREES: True, DIFFERS: False}.get(int(agrees[k])),
        )
        for k, label in enumerate(knowledge.solution.labels)
        if not combinations[k, ~elastic].any()
    ]


def _agreement(difference: Array, expanded: Array, uncertainty: Array) -> NDArray[np.int8]:
    within = np.abs(difference) <= np.hypot(expanded, _NORMAL * uncertainty)
    return np.where(np.isfinite(difference + expanded), np.where(within, AGREES, DIFFERS), UNKNOWN).astype(np.int8)


def _probability(difference: Array, measured: Predicted, uncertainty: Array, independent: int) -> float:
    """That of the surest difference, allowing for how many there are."""
    told = np.isfinite(difference) & np.isfinite(measured.standard_uncertainty)
    if not told.any():
        return float("nan")
    sure = np.abs(difference[told]) / np.hypot(measured.standard_uncertainty, uncertainty)[told]
    each = 2 * stdtr(measured.degrees_of_freedom[told], -sure)
    return float(min(1.0, min(independent, int(told.sum())) * each.min()))


def _names(knowledge: Knowledge) -> list[tuple[str, ...]]:
    """For each parameter the names that a design may give it: both of a pair that is one; none where it is no compliance."""
    mirrors = [getattr(source, "mirror", None) for source in knowledge.sources]
    pairs = zip(knowledge.sources, mirrors, strict=True)
    return [
        () if not source.elastic else (source.name,) if mirror is None else (source.name, mirror.name)
        for source, mirror in pairs
    ]


def _value(names: tuple[str, ...], values: Mapping[str, float]) -> float:
    given = [values[name] for name in names if name in values]
    if not given:
        return 0.0
    if max(given) - min(given) > _ALIKE * max(map(abs, given)):
        raise InputError(
            f"the design has {names[0]} = {given[0]:.4g} and {names[1]} = {given[1]:.4g}, and the joint was taken as "
            f"symmetric; give one value, or ask without reciprocity"
        )
    return float(np.mean(given))
