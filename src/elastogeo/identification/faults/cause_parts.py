"""What each ranked fault does to the readings: the columns of a diagnosis, so that a what-if needs no model."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from elastogeo.identification.faults.circularity import circularity
from elastogeo.identification.faults.diagnosis import Diagnosis, Fault, diagnose, first_runs
from elastogeo.identification.faults.enclosing_circles import Path
from elastogeo.identification.question import systems_of
from elastogeo.identification.result import Identification
from elastogeo.machine import Array


@dataclass(frozen=True, slots=True, eq=False)
class RunParts:
    """One run, apart into what each cause does to it.

    `measured - (1 - f) @ parts` would be measured if each cause were `f`, shape (c,), times what it is.

    Attributes
    ----------
    run : str
    force : float [N]
    sense : int
        1 counter-clockwise, -1 clockwise.
    angle : array, shape (m,) [rad]
    measured, predicted : array, shape (m,) [mm]
        As in `Trace`.
    parts : array, shape (c, m) [mm]
        The column of each cause times its value.
    """

    run: str
    force: float
    sense: int
    angle: Array
    measured: Array
    predicted: Array
    parts: Array


@dataclass(frozen=True, slots=True, eq=False)
class CauseParts:
    """The causes of a circular test, and what each does to its readings.

    Attributes
    ----------
    diagnosis : Diagnosis
    causes : tuple of Fault, length c
        Those of the machine, greatest distortion first: the set-up causes nothing. One whose parameters the test cannot
        tell from others stands for their sum, and its part is that of the sum.
    runs : tuple of RunParts
        The first of each direction at each force level, as in `Diagnosis.circularity`.
    radius : float or None [mm]
        Nominal radius; None for what is no circle.
    """

    diagnosis: Diagnosis
    causes: tuple[Fault, ...]
    runs: tuple[RunParts, ...]
    radius: float | None


def cause_parts(one: Diagnosis | Identification) -> CauseParts:
    """What each cause does to the readings of a circular test; without runs for what is no ball bar.

    Parameters
    ----------
    one : Diagnosis or Identification
        Of one test.
    """
    diagnosis = one if isinstance(one, Diagnosis) else diagnose(one)
    result = diagnosis.identification
    causes = tuple(fault for fault in diagnosis.faults if fault.axis)
    runs = {run.name: run for run in systems_of(result.test).runs}
    value = {parameter.name: parameter.value for parameter in result.parameters}
    found = []
    for force, by_sense in first_runs(result).items():
        for sense, trace in by_sense.items():
            parts = [
                runs[trace.run].design_of(fault.names) @ np.array([value[name] for name in fault.names]) for fault in causes
            ]
            of_all = np.array(parts).reshape(len(causes), len(trace.pose))
            found.append(RunParts(trace.run, force, sense, trace.pose, trace.measured, trace.predicted, of_all))
    return CauseParts(diagnosis, causes, tuple(found), result.test.setup.nominal_radius if found else None)


def thinned_parts(parts: CauseParts, many: int, within: float) -> CauseParts:
    """The same with fewer readings of the runs that have very many, if their deviations stay what they are.

    Of each of many short pieces the readings are kept that stand out most from the prediction, outward and inward, and of
    the whole trace the greatest and the least as it is, without each cause and with twice of it: on these the deviations
    rest, however great the causes are.

    Parameters
    ----------
    parts : CauseParts
    many : int
        With at most so many readings a run is left as it is.
    within : float [mm]
        By how much circular and radial deviation may change.
    """
    radius = parts.radius
    return parts if radius is None else replace(parts, runs=tuple(_thinned(run, radius, many, within) for run in parts.runs))


def _thinned(run: RunParts, radius: float, many: int, within: float) -> RunParts:
    count, pieces = len(run.angle), many // 2
    if count <= many:
        return run
    extremes = np.unique([pick(left) for left in _without_centre(run) for pick in (np.argmin, np.argmax)])
    whole = _deviations(run, radius)
    while 2 * pieces < count:
        kept = np.union1d(_standing_out(run.measured - run.predicted, pieces), extremes)
        fewer = replace(
            run,
            angle=run.angle[kept],
            measured=run.measured[kept],
            predicted=run.predicted[kept],
            parts=run.parts[:, kept],
        )
        if np.allclose(_deviations(fewer, radius), whole, rtol=0.0, atol=within, equal_nan=True):
            return fewer
        pieces *= 2
    return run


def _standing_out(residual: Array, pieces: int) -> Array:
    """Indices of the first, the last, and the greatest and the least reading of each piece."""
    edges = np.linspace(0, len(residual), pieces + 1).astype(int)
    spans = list(pairwise(edges))
    most = [first + pick(residual[first:last]) for first, last in spans for pick in (np.argmin, np.argmax)]
    return np.unique([0, *most, len(residual) - 1])


def _without_centre(run: RunParts) -> Iterator[Array]:
    """The trace as it is, without each cause and with twice of it, less its mean and eccentricity."""
    first = np.column_stack([np.ones_like(run.angle), np.cos(run.angle), np.sin(run.angle)])
    cases = np.vstack([run.measured, run.measured - run.parts, run.measured + run.parts]).T
    yield from (cases - first @ np.linalg.lstsq(first, cases, rcond=None)[0]).T


def _deviations(run: RunParts, radius: float) -> Array:
    """Circular deviation and greatest and least radial deviation [mm] as measured; NaN where not determined."""
    found = circularity(radius, Path(run.angle, run.measured))
    return np.array([found.g_ccw, found.f_max_ccw, found.f_min_ccw], dtype=np.float64)
