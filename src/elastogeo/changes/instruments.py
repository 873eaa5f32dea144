"""Machines that move alike with one instrument: then it is the instrument that changed, most likely, not they.

Independent machines seldom change at the same time to the same side by the same amount; those that one bar or one gauge
measures do, if it is off. A machine that the same instrument shows unchanged since then speaks against it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf, sqrt

import numpy as np
from scipy.special import chdtrc, stdtr

from elastogeo.changes.result import ALARM, SUSPECT, ChangeVerdict, IndicatorState
from elastogeo.machine import Array
from elastogeo.result import Part

LEAST_MACHINES = 3
"""Machines that move alike before it is the instrument."""

MOVED = 0.001
"""Probability, without a change, of a departure to one side by which a machine counts as moved beside one in alarm."""

ALIKE = 0.01
"""Probability, if all moved by one change, of such differences between machines below which they did not."""

PROPORTION = 0.15
"""Share by which one error of an instrument may show differently on two machines: they load and reach differently."""

CONTRADICTED = 0.5
"""Machines that did not move, per machine that did, from which it is not the instrument."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class InstrumentMove(Part):
    """Machines that moved to the same side, by the same amount within their scatter, with one instrument.

    Attributes
    ----------
    instrument : str
        Serial number.
    since : float [d]
        Of its last calibration or repair; the first test with it where none is known.
    machines : tuple of str
        Those that moved alike, at least three: their alarms are held back under this one.
    series : tuple of str
        Of these machines, all that moved: one machine may have several.
    indicators : tuple of str
        That moved.
    shifts : tuple of float
        Of each of these indicators the common change: in the unit of its kind, or as a share where the kind is relative.
    intervals : tuple of (float, float)
        Of each shift, 95 %.
    others : tuple of str
        Machines that were tested with it since then and did not move so.
    p_value : float
        Of the differences between the machines' changes, or greater ones, if all moved by the common change.
    """

    instrument: str
    since: float
    machines: tuple[str, ...]
    series: tuple[str, ...]
    indicators: tuple[str, ...]
    shifts: tuple[float, ...]
    intervals: tuple[tuple[float, float], ...]
    others: tuple[str, ...]
    p_value: float


@dataclass(frozen=True, slots=True)
class _Moved:
    """How far one indicator of one machine is off since a date, with one instrument."""

    machine: str
    series: str
    indicator: str
    change: float
    deviation: float
    freedom: float
    alarming: bool

    @property
    def probability(self) -> float:
        """Of such a departure, or a greater one to its side, without a change."""
        return float(stdtr(self.freedom, -abs(self.change) / self.deviation))


@dataclass(frozen=True, slots=True)
class _Common:
    """A change that several machines have in common in one indicator."""

    indicator: str
    moved: tuple[_Moved, ...]
    others: tuple[str, ...]
    shift: float
    deviation: float
    p_value: float


def instrument_moves(
    verdicts: Iterable[ChangeVerdict], since: Mapping[str, float] | None = None
) -> tuple[InstrumentMove, ...]:
    """Instruments with which three machines or more moved alike since the last calibration.

    Parameters
    ----------
    verdicts : iterable of ChangeVerdict
        Of all series in which the instruments were used.
    since : mapping of str to float [d], optional
        By serial number, when each was last calibrated or repaired; where none is known, the first test with it counts.

    Returns
    -------
    tuple of InstrumentMove
        By serial number, one an instrument.
    """
    known, dates = tuple(verdicts), dict(since or {})
    serials = sorted({serial for verdict in known for serial in verdict.series.instruments if serial})
    found = (_move_of(known, serial, dates.get(serial)) for serial in serials)
    return tuple(one for one in found if one is not None)


def _move_of(verdicts: Sequence[ChangeVerdict], serial: str, calibrated: float | None) -> InstrumentMove | None:
    since = _first(verdicts, serial) if calibrated is None else calibrated
    every = [moved for verdict in verdicts for moved in _moved(verdict, serial, since)]
    names = dict.fromkeys(moved.indicator for moved in every)
    common = [_common([moved for moved in every if moved.indicator == name]) for name in names]
    found = [one for one in common if one is not None]
    if not found:
        return None
    machines = dict.fromkeys(moved.machine for one in found for moved in one.moved)
    return InstrumentMove(
        instrument=serial,
        since=since,
        machines=tuple(machines),
        series=tuple(dict.fromkeys(moved.series for one in found for moved in one.moved)),
        indicators=tuple(one.indicator for one in found),
        shifts=tuple(one.shift for one in found),
        intervals=tuple((one.shift - 1.96 * one.deviation, one.shift + 1.96 * one.deviation) for one in found),
        others=tuple(name for name in dict.fromkeys(name for one in found for name in one.others) if name not in machines),
        p_value=min(one.p_value for one in found),
    )


def _first(verdicts: Sequence[ChangeVerdict], serial: str) -> float:
    dates = (
        float(date)
        for verdict in verdicts
        for date, used in zip(verdict.series.date, verdict.series.instruments, strict=True)
        if used == serial
    )
    return min(dates, default=inf)


def _moved(verdict: ChangeVerdict, serial: str, since: float) -> Iterator[_Moved]:
    """Each indicator of a series by its tests with the instrument since a date; nothing without such tests or a baseline."""
    series, baseline = verdict.series, verdict.baseline
    if baseline is None or not verdict.steps:
        return
    replaced = {step.test for step in verdict.steps if step.replaced}
    judged = {step.test for step in verdict.steps} - replaced
    every = zip(series.tests, series.date, series.instruments, strict=True)
    with_it = np.array([test in judged and date >= since and used == serial for test, date, used in every], dtype=bool)
    own = set(baseline.tests)
    of_baseline = np.array([test in own for test in series.tests], dtype=bool) & ~series.aside
    for k, one in enumerate(verdict.indicators):
        departure = series.value[:, k] - one.expected.mean(axis=1)
        after, before = (np.flatnonzero(rows & np.isfinite(departure)) for rows in (with_it, of_baseline))
        if len(after) and len(before) and one.deviation > 0:
            yield _of_indicator(verdict, one, departure[after], len(before), one.expected[after])


def _of_indicator(verdict: ChangeVerdict, one: IndicatorState, departure: Array, tests: int, expected: Array) -> _Moved:
    width = np.ptp(expected, axis=1) / (2 * one.limit * one.deviation)
    warm = float(np.sqrt(np.maximum(width**2 - 1 - 1 / tests, 0.0)).mean())  # what the temperature slope adds, at most
    scale = abs(one.mean) if one.kind.relative else 1.0
    return _Moved(
        machine=verdict.series.machine or verdict.series.name,
        series=verdict.series.name,
        indicator=one.name,
        change=float(departure.mean()) / scale,
        deviation=one.deviation / scale * sqrt(1 / len(departure) + 1 / tests + warm**2),
        freedom=one.degrees_of_freedom,
        alarming=one.state in (ALARM, SUSPECT),
    )


def _common(every: Sequence[_Moved]) -> _Common | None:
    """The change that three machines or more have in common, one of them in alarm at least."""
    for side in (1.0, -1.0):
        moved = [one for one in every if one.change * side > 0 and (one.alarming or one.probability < MOVED)]
        while len({one.machine for one in moved}) >= LEAST_MACHINES and any(one.alarming for one in moved):
            shift, spread, left = _agreement(moved)
            p_value = float(chdtrc(len(moved) - 1, float(np.sum(left**2))))
            if p_value >= ALIKE:
                found = _Common(every[0].indicator, tuple(moved), _others(every, moved, shift), shift, spread, p_value)
                return found if _not_contradicted(found) else None
            moved.pop(int(np.abs(left).argmax()))
    return None


def _not_contradicted(found: _Common) -> bool:
    return len(found.others) < CONTRADICTED * len({one.machine for one in found.moved})


def _agreement(moved: Sequence[_Moved]) -> tuple[float, float, Array]:
    """The weighted mean of changes, its standard deviation, and how far each is off it in its own."""
    change = np.array([one.change for one in moved])
    own = np.array([one.deviation for one in moved]) * np.sqrt([one.freedom / max(one.freedom - 2, 1.0) for one in moved])
    own = np.hypot(own, PROPORTION * np.abs(np.median(change)))
    weight = 1 / own**2
    shift = float(weight @ change / weight.sum())
    return shift, float(1 / np.sqrt(weight.sum())), (change - shift) / own


def _others(every: Sequence[_Moved], moved: Sequence[_Moved], shift: float) -> tuple[str, ...]:
    """Machines that the instrument shows elsewhere than the common change would have put them."""
    names = {one.machine for one in moved}
    off = (one for one in every if one.machine not in names)
    return tuple(dict.fromkeys(one.machine for one in off if _apart(one, shift)))


def _apart(one: _Moved, shift: float) -> bool:
    own = sqrt(one.deviation**2 + (PROPORTION * shift) ** 2)
    return float(stdtr(one.freedom, -abs(one.change - shift) / own)) < MOVED * 10
