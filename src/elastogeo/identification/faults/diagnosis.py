"""The ball bar diagnosis: which fault distorts the trace by how much, ranked, with what stayed untold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Unpack

import numpy as np
from scipy.special import fdtri

from elastogeo.estimate import Estimate
from elastogeo.identification.faults.circularity import Circularity, circularity
from elastogeo.identification.faults.enclosing_circles import Path
from elastogeo.identification.identification import identified
from elastogeo.identification.question import Asked
from elastogeo.identification.result import Identification, Parameter, Trace
from elastogeo.machine import Array
from elastogeo.observe import MachineTest
from elastogeo.result import Result


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault of the ranking.

    Attributes
    ----------
    names : tuple of str
        Its parameters: two for a cyclic error, whose cosine and sine belong together.
    meaning : str
    axis : str
        The axis it sits at; empty for the set-up.
    value : float
        In `unit`; for a pair the amplitude.
    estimate : Estimate or None
        The value with its uncertainty; None where the runs are too few for one.
    unit : str
    distortion : float [mm]
        Range of its part of the trace, with the sign of the value.
    distortion_estimate : Estimate or None [mm]
        It with its uncertainty.
    share : float
        Of its parameters, together, as in the identification, 0 to 1; 0 for the set-up.
    significant : bool
        Whether its 95 % interval excludes zero; False where there is none.
    also : tuple of str
        Parameters that this test cannot tell from it.
    """

    names: tuple[str, ...]
    meaning: str
    axis: str
    value: float
    estimate: Estimate | None
    unit: str
    distortion: float
    distortion_estimate: Estimate | None
    share: float
    significant: bool
    also: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Diagnosis(Result):
    """A ranked diagnosis.

    Attributes
    ----------
    identification : Identification
        That it was made from.
    faults : tuple of Fault
        Greatest distortion first; set-up errors are not faults of the machine and come last.
    untold : tuple of str
        Parameters that change no reading of this test.
    circularity : dict of float to Circularity
        ISO 230-4 parameters of the measured traces by force level [N].
    """

    identification: Identification
    faults: tuple[Fault, ...]
    untold: tuple[str, ...]
    circularity: dict[float, Circularity]


def diagnose(one: MachineTest | Identification, **asked: Unpack[Asked]) -> Diagnosis:
    """Rank the identified faults by how much they distort the trace at the highest force.

    Parameters
    ----------
    one : MachineTest or Identification
        A test, or what it says already.
    **asked
        Of a test, another question than its own, as in `with_question`.
    """
    result = identified(one, **asked)
    pairs = _paired(result)
    drafts = [_fault(result, members) for members in pairs]
    faults = tuple(sorted(drafts, key=lambda fault: (not fault.axis, -abs(fault.distortion))))
    return Diagnosis(result, faults, result.confounding.null, level_circularity(result))


def level_circularity(result: Identification, traces: Sequence[Trace] | None = None) -> dict[float, Circularity]:
    """ISO 230-4 parameters by force level [N], of the first run in each direction; empty for what is no ball bar.

    Parameters
    ----------
    result : Identification
    traces : sequence of Trace, optional
        Other traces than those measured.
    """
    radius = result.test.setup.nominal_radius
    found = {}
    for force, by_sense in first_runs(result, traces).items():
        paths = {sense: Path(trace.pose, trace.measured) for sense, trace in by_sense.items()}
        assert radius is not None
        found[force] = circularity(radius, paths.get(1), paths.get(-1))
    return found


def first_runs(result: Identification, traces: Sequence[Trace] | None = None) -> dict[float, dict[int, Trace]]:
    """The trace of the first run in each direction (1 counter-clockwise, -1 clockwise) by force level [N].

    Empty for what is no ball bar.

    Parameters
    ----------
    result : Identification
    traces : sequence of Trace, optional
        Other traces than those measured.
    """
    if result.test.setup.nominal_radius is None or result.test.setup.extra != "circularity":
        return {}
    senses = {run.name: run.sense for run in result.test.runs}
    found: dict[float, dict[int, Trace]] = {level.force: {} for level in result.levels}
    for trace in traces or result.traces:
        if trace.force in found:
            found[trace.force].setdefault(senses[trace.run], trace)
    return found


def _paired(result: Identification) -> list[tuple[int, ...]]:
    """Indices of the parameters of each fault: cosine and sine of a cyclic error belong together."""
    names = [parameter.name for parameter in result.parameters]
    pairs: list[tuple[int, ...]] = []
    for k, name in enumerate(names):
        partner = _partner(name)
        if partner in names and name < partner:
            pairs.append((k, names.index(partner)))
        elif partner not in names:
            pairs.append((k,))
    return pairs


def _partner(name: str) -> str:
    """`P_XXc1` for `P_XXs1` and the other way round; empty for what has none."""
    if len(name) >= 6 and name[0] in "PE" and name[4] in "cs" and name[1] == "_":
        return f"{name[:4]}{'s' if name[4] == 'c' else 'c'}{name[5:]}"
    return ""


def _fault(result: Identification, members: tuple[int, ...]) -> Fault:
    chosen = [result.parameters[k] for k in members]
    values = np.array([parameter.value for parameter in chosen])
    covariance = result.budget.covariance[np.ix_(members, members)]
    value = float(values[0]) if len(chosen) == 1 else float(np.hypot(*values))
    slope = np.ones(1) if len(chosen) == 1 else values / (value or 1.0)
    uncertainty = float(np.sqrt(slope @ covariance @ slope))
    freedom = float(result.budget.degrees_of_freedom[list(members)].min())
    known = all(parameter.estimate is not None for parameter in chosen)
    estimate = Estimate(value, uncertainty, freedom) if known else None
    per_unit = max(_distortion_per_unit(parameter) for parameter in chosen)
    return Fault(
        names=tuple(parameter.name for parameter in chosen),
        meaning=_meaning(chosen),
        axis=chosen[0].axis,
        value=value,
        estimate=estimate,
        unit=chosen[0].unit,
        distortion=value * per_unit,
        distortion_estimate=None if estimate is None else estimate.scaled(per_unit),
        share=sum(parameter.share for parameter in chosen),
        significant=known and _is_significant(values, covariance, result, members),
        also=tuple(name for parameter in chosen for name in parameter.stands_for if name != parameter.name),
    )


def _is_significant(values: Array, covariance: Array, result: Identification, members: tuple[int, ...]) -> bool:
    """Whether the 95 % region of the parameters excludes zero."""
    freedom = float(result.budget.degrees_of_freedom[list(members)].min())
    scale = np.sqrt(np.diag(covariance))
    scaled = values / scale
    statistic = scaled @ np.linalg.solve(covariance / np.outer(scale, scale), scaled) / len(values)
    return bool(statistic > fdtri(len(values), min(freedom, 1e9), 0.95))


def _distortion_per_unit(parameter: Parameter) -> float:
    return abs(parameter.peak_to_peak / parameter.value) if parameter.value else 0.0


def _meaning(chosen: list[Parameter]) -> str:
    return chosen[0].meaning if len(chosen) == 1 else chosen[0].meaning.replace(", cosine", "").replace(", sine", "")
