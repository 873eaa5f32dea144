"""Current-based force against a dynamometer (section 6.6.1): delay, gain, offset, and whether they agree.

The dynamometer is the reference. Each record keeps its own clock: the delay between them is where their correlation is
greatest, found within bounds and refined between the samples. Then `F_current = offset + gain F_dynamometer` by ordinary
least squares. Ordinary, because the noise of a dynamometer is small against the range of its forces and all friction left
in the current is on the other side; noise s of the reference would shrink the gain by the part `s^2 / var(F)`, and where s
is known that is put right (errors in both variables, by moments). The residuals are friction, cogging and ripple, which
hold on from reading to reading: the uncertainty counts runs, or long blocks of one run, not readings. What all runs share
(a motor constant, friction that was identified once) no scatter shows; it is stated, and moves gain and offset together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.errors import DegreesOfFreedomError, InputError, UnsupportedError
from elastogeo.estimate import (
    Factor,
    coverage_factor,
    effective_degrees_of_freedom,
    factor_blocks,
    first_order,
    solve_by_run,
)
from elastogeo.machine import Array

LEAST_CORRELATION = 0.5
"""Records that correlate less are not of the same event, or one is mostly noise."""

DISTINCT = 1.2
"""By so much must what is unexplained (1 - r^2) be greater elsewhere than at the best delay."""

_ROUNDING = 1e-9
"""Share of the variance that is rounding error: less unexplained than that is none."""

_MOST = 400_000
"""Samples of the grid at most on which the correlation is sought."""

_CORRELATION_TIMES = 5.0
"""A block is at least so many correlation times of the residuals long, so that blocks are practically independent."""

_WINDOW = 2.0
"""Lags over correlation times up to which a correlation is summed."""

_BLOCKS = (4, 20)
"""Blocks of all runs together: fewer give no uncertainty worth its name, more gain little."""


@dataclass(frozen=True, slots=True)
class ForceRecord:
    """A force over time.

    Attributes
    ----------
    time : array, shape (m,) [s]
        Rising, on the record's own clock.
    force : array, shape (m,) [N]
    """

    time: Array
    force: Array

    def __post_init__(self) -> None:
        """Refuse what is no record."""
        time, force = np.asarray(self.time, float), np.asarray(self.force, float)
        if time.ndim != 1 or time.shape != force.shape or len(time) < 8:
            raise InputError(
                f"a force record has times of shape {time.shape} and forces of shape {force.shape}; "
                f"it needs one force per time, and 8 at least"
            )
        if not (np.isfinite(time).all() and np.isfinite(force).all()):
            wrong = int((~np.isfinite(time) | ~np.isfinite(force)).sum())
            raise InputError(f"{wrong} samples of a force record are NaN or infinite; leave them out or repair them")
        if not (np.diff(time) > 0).all():
            first = int(np.flatnonzero(np.diff(time) <= 0)[0]) + 1
            raise InputError(
                f"the time of a force record does not rise at sample {first} ({time[first]:g} s); sort it, leave doubles out"
            )
        if np.ptp(force) == 0:
            raise UnsupportedError(
                f"a force record is {force[0]:g} N throughout; a force that never changes aligns with none"
            )


@dataclass(frozen=True, slots=True)
class Delay:
    """How much later the clock of the current's record runs: its event at `t + seconds` is the dynamometer's at `t`.

    Attributes
    ----------
    seconds : float [s]
    correlation : float
        Of the two records at this delay.
    rival : float
        Greatest correlation away from this peak, within the search; -1 if nothing was sought.
    """

    seconds: float
    correlation: float
    rival: float


@dataclass(frozen=True, slots=True)
class SharedError:
    """What the current-based force of all runs may be off by together.

    Attributes
    ----------
    label : str
        Errors of one label come from one estimate, and have its degrees of freedom together.
    standard_uncertainty : float
        Of the quantity.
    degrees_of_freedom : float
    force : tuple of array, shape (m,) [N]
        Change of the force per unit of the quantity, at the samples of the current's record: one per run.
    """

    label: str
    standard_uncertainty: float
    degrees_of_freedom: float
    force: tuple[Array, ...]


@dataclass(frozen=True, slots=True)
class ForceAgreement:
    """How a current-based force compares with a dynamometer's.

    Attributes
    ----------
    delays : tuple of Delay
        One per run.
    readings : int
        Compared, of all runs.
    gain, offset : float [N/N, N]
        `F_current = offset + gain F_dynamometer`.
    gain_uncertainty, offset_uncertainty : float
        Standard uncertainties, with what is stated of the scale and of errors that all runs share.
    gain_interval, offset_interval : tuple of 2 float
        Each by itself.
    gain_is_one, offset_is_zero : bool
        Whether a gain of 1 and an offset of 0 lie within the uncertainty; of both together, so that sound forces agree at
        the stated coverage.
    rms_difference, maximum_difference : float [N]
        Of current less dynamometer as they are, gain and offset not subtracted; the maximum is of the size.
    residual_std : float [N]
        What the straight line leaves.
    attenuation : float
        Part by which the reference's stated noise had shrunk the gain, put right.
    units : int
        Runs or blocks that the uncertainty counts.
    by_run : bool
    coverage : float
    """

    delays: tuple[Delay, ...]
    readings: int
    gain: float
    offset: float
    gain_uncertainty: float
    offset_uncertainty: float
    gain_interval: tuple[float, float]
    offset_interval: tuple[float, float]
    rms_difference: float
    maximum_difference: float
    residual_std: float
    attenuation: float
    units: int
    gain_is_one: bool
    offset_is_zero: bool
    by_run: bool
    coverage: float

    @property
    def agrees(self) -> bool:
        """Whether both do. **The difference at a single reading may still be what `rms_difference` says.**"""
        return self.gain_is_one and self.offset_is_zero

    @property
    def sentence(self) -> str:
        """The verdict in words."""
        gain = f"the gain is {self.gain:.4g} ({self.gain_interval[0]:.4g} to {self.gain_interval[1]:.4g})"
        offset = f"the offset {self.offset:.3g} N ({self.offset_interval[0]:.3g} to {self.offset_interval[1]:.3g} N)"
        off = [name for name, good in (("gain 1", self.gain_is_one), ("offset 0", self.offset_is_zero)) if not good]
        judged = (
            "both 1 and 0 lie within" if not off else f"{' and '.join(off)} {'lies' if len(off) == 1 else 'lie'} outside"
        )
        return (
            f"Current-based force against the dynamometer: {gain}, {offset}; {judged} the uncertainty, which counts "
            f"{self.units} {'runs' if self.by_run else 'blocks'}. The two differ by {self.rms_difference:.3g} N RMS, "
            f"{self.maximum_difference:.3g} N at most."
        )


def find_delay(current: ForceRecord, dynamometer: ForceRecord, most: float) -> Delay:
    """Delay of greatest correlation, between `-most` and `most` [s].

    The correlation at each delay is Pearson's over the part where the records overlap, on a common grid as fine as the finer
    record; the peak is refined by the parabola through its three highest points.

    Raises
    ------
    InputError
        If the bound is no number, or more than half of the shorter record.
    UnsupportedError
        If the records are not alike, are of opposite signs, or have no distinct delay within the bound: the peak is flat,
        at the bound, or has a rival (a periodic force repeats itself each period: search less than half of one).
    """
    shorter = min(float(np.ptp(record.time)) for record in (current, dynamometer))
    if not (np.isfinite(most) and 0 <= most <= shorter / 2):
        raise InputError(
            f"a delay of up to {most:g} s is to be sought in records of {shorter:g} s; it lies between 0 and half of that"
        )
    delays, r = _correlations(current, dynamometer, most)
    best = int(r.argmax())
    peak = float(r[best])
    if peak < LEAST_CORRELATION:
        opposite = -float(r.min()) > max(peak, LEAST_CORRELATION)
        advice = (
            f"they are alike with opposite signs ({float(r.min()):.2f}): a dynamometer under the workpiece measures the "
            f"reaction; turn one sign"
            if opposite
            else "widen the bound on the delay, or check that they are of one axis and one run"
        )
        raise UnsupportedError(f"the force records correlate by {peak:.2f} at most, under {LEAST_CORRELATION:g}; {advice}")
    if len(r) == 1:
        return Delay(0.0, peak, -1.0)
    rival = _rival(r, best)
    # At a bound the peak is its own rival.
    if 1 - rival**2 + _ROUNDING < DISTINCT * (1 - peak**2 + _ROUNDING):
        raise UnsupportedError(
            f"the force records have no distinct delay within {most:g} s: they correlate by {peak:.4f} at "
            f"{delays[best]:+.4g} s and by {rival:.4f} away from it; change the bound (under half a period of a periodic "
            f"force), or log an event that both see, such as the first contact"
        )
    left, right = r[best - 1], r[best + 1]
    shift = 0.5 * (left - right) / (left - 2 * peak + right)
    return Delay(float(delays[best] + shift * (delays[1] - delays[0])), peak, rival)


def compare_forces(
    runs: Sequence[tuple[ForceRecord, ForceRecord]],
    most_delay: float,
    *,
    dynamometer_noise: float = 0.0,
    scale_uncertainty: float = 0.0,
    shared: Sequence[SharedError] = (),
    names: Sequence[str] = (),
    coverage: float = 0.95,
) -> ForceAgreement:
    """Compare current-based force records with those of a dynamometer.

    Parameters
    ----------
    runs : sequence of (ForceRecord, ForceRecord)
        Current-based and dynamometer, along one direction. The finer record is read, along straight lines, at the samples
        of the coarser, so that no reading counts twice.
    most_delay : float [s]
        Bound of the search for the delay of each run; 0 if both are on one clock.
    dynamometer_noise : float [N]
        Standard deviation of independent errors of its samples, if known.
    scale_uncertainty : float
        Relative standard uncertainty of the scales of both forces that holds in all runs (motor constant, efficiency,
        calibration of the dynamometer): it widens the uncertainty of the gain.
    shared : sequence of SharedError
        What else holds in all runs.
    names : sequence of str
        Of the run that each pair is of, where several are of one: they count as one. By default each is of its own.
    coverage : float

    Raises
    ------
    InputError
        If there is no run, or a number makes no sense.
    UnsupportedError
        As `find_delay`, or if the force varies hardly more than the stated noise.
    DegreesOfFreedomError
        If there are neither four runs nor four blocks that are long against what the residuals hold on.
    """
    if not runs:
        raise InputError("there is no run to compare forces in; give at least one pair of records")
    if not all(np.isfinite(value) and value >= 0 for value in (dynamometer_noise, scale_uncertainty)):
        raise InputError("the dynamometer's noise and the uncertainty of the scale must be finite and not negative")
    delays = [find_delay(current, dynamometer, most_delay) for current, dynamometer in runs]
    pairs = [_paired(*run, delay.seconds) for run, delay in zip(runs, delays, strict=True)]
    known, seen = (np.concatenate([pair[k] for pair in pairs]) for k in (0, 1))
    attenuation = dynamometer_noise**2 / float(np.var(known))
    if attenuation > 0.5:
        raise UnsupportedError(
            f"the dynamometer's force varies by {float(np.std(known)):.3g} N against a noise of {dynamometer_noise:.3g} N; "
            f"that gives no gain, measure at a greater range of forces"
        )
    units, by_run = _independent(_by_name(pairs, names))
    solution = solve_by_run([_line(*unit) for unit in units], ("gain", "offset"))
    # Moments: var(F) is too great by the noise; the line still goes through the means.
    put_right = np.array([[1.0, 0.0], [-attenuation * known.mean(), 1.0 - attenuation]]) / (1 - attenuation)
    gain, offset = map(float, put_right @ solution.values)
    scatter = np.sqrt(np.diag(first_order(put_right, solution.covariance)))
    changes = [_changed(runs, delays, known, error) * error.standard_uncertainty for error in shared]
    parts = np.column_stack([scatter, [abs(gain) * scale_uncertainty, 0.0], *(put_right @ change for change in changes)])
    freedoms = [
        [degrees, np.inf, *(error.degrees_of_freedom for error in shared)] for degrees in solution.degrees_of_freedom
    ]
    labels = ["scatter", "scale", *(error.label for error in shared)]
    freedom = effective_degrees_of_freedom(parts, np.array(freedoms), labels)
    u = np.linalg.norm(parts, axis=1)
    half = coverage_factor(freedom, coverage) * u
    within = np.abs([gain - 1.0, offset]) <= coverage_factor(freedom, (1.0 + coverage) / 2) * u + _ROUNDING
    difference = seen - known
    residual = seen - offset - gain * known
    return ForceAgreement(
        delays=tuple(delays),
        readings=len(seen),
        gain=gain,
        offset=offset,
        gain_uncertainty=float(u[0]),
        offset_uncertainty=float(u[1]),
        gain_interval=(gain - float(half[0]), gain + float(half[0])),
        offset_interval=(offset - float(half[1]), offset + float(half[1])),
        gain_is_one=bool(within[0]),
        offset_is_zero=bool(within[1]),
        rms_difference=float(np.sqrt(np.mean(difference**2))),
        maximum_difference=float(np.abs(difference).max()),
        residual_std=float(np.sqrt(np.sum(residual**2) / max(len(residual) - 2, 1))),
        attenuation=attenuation,
        units=len(units),
        by_run=by_run,
        coverage=coverage,
    )


def _correlations(current: ForceRecord, dynamometer: ForceRecord, most: float) -> tuple[Array, Array]:
    """Delays on a grid within the bound, and Pearson's correlation of the overlapping parts at each."""
    from scipy.signal import correlate  # here, where it is used: it takes half a second to import

    if most == 0:
        return np.zeros(1), np.array([_pearson(*_paired(current, dynamometer, 0.0))])
    records = (current, dynamometer)
    start = min(record.time[0] for record in records)
    span = max(record.time[-1] for record in records) - start
    step = max(min(float(np.median(np.diff(record.time))) for record in records), span / _MOST)
    a, b = (_gridded(record, step) for record in records)
    # The grids start at the records' own first samples; their difference goes into the delay, which is sought about zero.
    apart = float(current.time[0] - dynamometer.time[0])
    lags = np.arange(-(len(b) - 1), len(a))
    delays = apart + lags * step
    inside = np.abs(delays) <= most + 1e-9 * step
    one, other = np.ones(len(a)), np.ones(len(b))
    a, b = a - a.mean(), b - b.mean()
    count = np.rint(correlate(one, other))
    sums = correlate(a, other), correlate(one, b)
    squares = correlate(a**2, other), correlate(one, b**2)
    product = correlate(a, b)
    inside &= count >= min(len(a), len(b)) / 4
    if inside.sum() < 3:
        raise UnsupportedError(
            f"within a delay of {most:g} s the force records (samples every {step:.3g} s) have fewer than three delays at "
            f"which a quarter of them overlaps; bring their clocks together, or widen the bound (0 for one clock)"
        )
    n = count[inside]
    mean_a, mean_b = sums[0][inside] / n, sums[1][inside] / n
    spread = (squares[0][inside] / n - mean_a**2) * (squares[1][inside] / n - mean_b**2)
    shared = product[inside] / n - mean_a * mean_b
    flat = spread <= (1e-9 * a.var() * b.var())
    return delays[inside], np.where(flat, 0.0, shared / np.sqrt(np.where(flat, 1.0, spread)))


def _gridded(record: ForceRecord, step: float) -> Array:
    count = int(np.floor(np.ptp(record.time) / step + 1e-9)) + 1
    return np.asarray(np.interp(record.time[0] + step * np.arange(count), record.time, record.force))


def _rival(r: Array, best: int) -> float:
    """Greatest correlation outside the peak: beyond the valleys on its two sides, or at the bounds."""
    falls = np.diff(r)
    left = best
    while left > 0 and falls[left - 1] >= 0:
        left -= 1
    right = best
    while right < len(r) - 1 and falls[right] <= 0:
        right += 1
    return float(max(r[: left + 1].max(), r[right:].max()))


def _pearson(one: Array, other: Array) -> float:
    if np.ptp(one) == 0 or np.ptp(other) == 0:
        raise UnsupportedError("a force does not change where the records overlap; it aligns with none")
    return float(np.corrcoef(one, other)[0, 1])


def _paired(current: ForceRecord, dynamometer: ForceRecord, delay: float) -> tuple[Array, Array]:
    """Forces of the dynamometer and of the current at the samples of the coarser record, where both are known."""
    moved, at = current.time - delay, _common(current, dynamometer, delay)
    return np.interp(at, dynamometer.time, dynamometer.force), np.interp(at, moved, current.force)


def _common(current: ForceRecord, dynamometer: ForceRecord, delay: float) -> Array:
    """Samples of the coarser record, on the clock of the dynamometer, at which both forces are known."""
    moved = current.time - delay
    first, last = max(moved[0], dynamometer.time[0]), min(moved[-1], dynamometer.time[-1])
    at = max((moved, dynamometer.time), key=lambda time: float(np.median(np.diff(time))))
    at = at[(at >= first) & (at <= last)]
    if len(at) < 8:
        raise UnsupportedError(
            f"the force records share {len(at)} samples; they need 8 at least, bring their clocks together"
        )
    return np.asarray(at)


def _changed(
    runs: Sequence[tuple[ForceRecord, ForceRecord]], delays: Sequence[Delay], known: Array, error: SharedError
) -> Array:
    """By how much a unit of a shared error changes gain and offset, shape (2,)."""
    moved = [
        np.interp(_common(*run, delay.seconds), run[0].time - delay.seconds, force)
        for run, delay, force in zip(runs, delays, error.force, strict=True)
    ]
    return np.asarray(np.polyfit(known, np.concatenate(moved), 1))


def _by_name(pairs: Sequence[tuple[Array, Array]], names: Sequence[str]) -> list[tuple[Array, Array]]:
    """The pairs, those of one run as one."""
    if not names:
        return list(pairs)
    found: dict[str, list[tuple[Array, Array]]] = {}
    for name, pair in zip(names, pairs, strict=True):
        found.setdefault(name, []).append(pair)
    return [(np.concatenate([k for k, _ in own]), np.concatenate([s for _, s in own])) for own in found.values()]


def _independent(pairs: Sequence[tuple[Array, Array]]) -> tuple[list[tuple[Array, Array]], bool]:
    """Runs if there are four, else blocks of them that are long against what the residuals hold on."""
    least, most = _BLOCKS
    if len(pairs) >= least:
        return list(pairs), True
    known, seen = (np.concatenate([pair[k] for pair in pairs]) for k in (0, 1))
    slope, offset = np.polyfit(known, seen, 1)
    length = max(_correlation_length(y - offset - slope * x, float(np.ptp(seen))) for x, y in pairs)
    size = max(_CORRELATION_TIMES * length, len(known) / most, 3.0)
    blocks = [part for pair in pairs for part in _cut(pair, int(len(pair[0]) / size))]
    if len(blocks) < least:
        raise DegreesOfFreedomError(
            f"what the straight line leaves of the {len(pairs)} force records holds on over {length:.0f} readings; they "
            f"give {len(blocks)} independent blocks, and {least} are needed: record longer, or {least} runs"
        )
    return blocks, False


def _cut(pair: tuple[Array, Array], parts: int) -> list[tuple[Array, Array]]:
    return list(zip(np.array_split(pair[0], parts), np.array_split(pair[1], parts), strict=True)) if parts else []


def _correlation_length(residual: Array, span: float) -> float:
    """Integrated correlation length of the residuals, in readings.

    Summed up to the first lag that is twice the sum so far: further on there is only the noise of the correlation itself. Of
    a residual that swings this is a fifth of its period.
    """
    from scipy.signal import correlate

    residual = residual - residual.mean()
    power = float(residual @ residual)
    if power <= len(residual) * (_ROUNDING * span) ** 2:
        return 1.0
    correlation = correlate(residual, residual)[len(residual) - 1 :] / power
    length = 2 * np.cumsum(correlation) - 1
    enough = np.flatnonzero(np.arange(len(length)) >= _WINDOW * length)
    return max(1.0, float(length[enough[0] if len(enough) else -1]))


def _line(known: Array, seen: Array) -> Factor:
    return factor_blocks(("gain", "offset"), [np.asfortranarray(np.column_stack([known, np.ones(len(known)), seen]))])
