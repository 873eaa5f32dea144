"""The rule tried out: how many false alarms it makes on machines that do not change, and how soon it finds a change.

Machines are simulated that scatter as one's own does, as far as its baseline tells, or as is expected of any; the tests that
were recorded are judged beside them. **What nobody simulates here is a machine whose scatter is of another kind**: seasons
that no thermometer saw, say.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from math import inf

import numpy as np

from elastogeo.changes.drifts import DRIFT, STEP
from elastogeo.changes.kinds import KINDS, Kind
from elastogeo.changes.priors import Prior
from elastogeo.changes.references import Reference, reference_of
from elastogeo.changes.replay import replay
from elastogeo.changes.rules import Rule
from elastogeo.changes.series import Baseline, Series
from elastogeo.changes.trials.result import FaultFound, RuleTest
from elastogeo.changes.trials.simulated import Scatter, Truth, as_recorded, expected, first_alarms
from elastogeo.errors import InputError, UnsupportedError
from elastogeo.machine import Array

USUAL = {
    "stiffness X": KINDS["stiffness"],
    "stiffness Y": KINDS["stiffness"],
    "squareness XY": KINDS["squareness"],
    "scale difference XY": KINDS["scale"],
    "backlash X": KINDS["backlash"],
    "backlash Y": KINDS["backlash"],
}
"""Indicators of a machine that nobody has measured yet."""
STEPS = (1.0, 2.0, 4.0)
"""Steps that are tried, in the least change that matters."""
A_YEAR = 4.0
"""Drift that is tried, in the least change that matters a year."""
SOON = 5
"""Tests."""
_YEAR = 365.25
_MONTH = 30.0
_FAULTED = 4
"""One in so many machines is simulated again with each fault."""


def try_rule(
    series: Series | None = None,
    baseline: Baseline | None = None,
    prior: Prior | None = None,
    rule: Rule | None = None,
    *,
    relevance: Mapping[str, float] | None = None,
    indicators: Mapping[str, Kind] | None = None,
    baseline_tests: int = 10,
    interval: float | None = None,
    tests: int = 36,
    machines: int = 2000,
    blunders: float = 0.0,
    correlation: float = 0.0,
    seed: int = 0,
) -> RuleTest:
    """Try the rule on machines that do not change, and on machines that do.

    Parameters
    ----------
    series : Series, optional
        Whose baseline says how tests scatter; without it, machines are as expected, each with a baseline of its own.
    baseline : Baseline, optional
        Of the series.
    prior : Prior, optional
        As `judge` takes it.
    rule : Rule, optional
    relevance : mapping of str to float, optional
        As `reference_of` takes it.
    indicators : mapping of str to Kind, optional
        Without a series: what is watched, `USUAL` by default.
    baseline_tests : int
        Without a series.
    interval : float [d], optional
        Between tests; by default that of the series, else 30 days.
    tests : int
        After the baseline.
    machines : int
        Simulated; a quarter of them again for each fault.
    blunders : float
        Share of tests, after the baseline, in which one indicator is off by six standard deviations.
    correlation : float
        Of one test with the next.
    seed : int

    Raises
    ------
    InputError
        If a number is out of its range, or there is a series without a baseline.
    UnsupportedError
        If the baseline has fewer tests than the rule asks for: nothing would ever alarm.
    """
    rule, random, scatter = rule or Rule(), np.random.default_rng(seed), Scatter(blunders, correlation)
    _check(machines, tests, interval, scatter)
    name, made, judged, over = "", "the reproducibility that is expected of any machine", 0, tuple[str, ...]()
    kinds = dict(USUAL if indicators is None else indicators)
    reference = None
    if series is not None:
        if baseline is None:
            raise InputError(f"{series.name} has no baseline; set one first, the rule judges by it")
        reference = reference_of(series, baseline, prior, relevance)
        found = replay(series, baseline, reference, rule, inf)
        name, made = series.name, "the scatter between the tests of the baseline"
        judged, over = len(found.steps), tuple(one.test for one in found.steps if one.over)
        kinds, reference = _determined(series, reference)
        interval = interval or _interval(series)
    interval = interval or _MONTH
    fewest = baseline_tests if reference is None else int(np.min(reference.count, initial=len(kinds) and inf))
    if fewest < rule.least_baseline:
        raise UnsupportedError(
            f"the baseline has {fewest} tests; below {rule.least_baseline} nothing is ever suspect: make it longer first"
        )

    def draw(n: int) -> Truth:
        return expected(kinds, baseline_tests, n, random) if reference is None else as_recorded(reference, n, random)

    truth = draw(machines)
    at, repeats = first_alarms(truth, rule, np.zeros((tests, len(kinds))), scatter, random)
    fewer, least = draw(max(machines // _FAULTED, 1)), np.broadcast_to(truth.reference.relevance, truth.mean.shape)[0]
    courses = _courses(least, tests, interval)
    relative = [kind.relative for kind in kinds.values()]
    scale = np.where(relative, 1.0 if reference is None else np.abs(reference.mean), 1.0)
    return RuleTest(
        name=name,
        simulated=made,
        rule=rule,
        indicators=tuple(kinds),
        kinds=tuple(kinds.values()),
        relevance=least / scale,
        baseline=fewest,
        interval=interval,
        tests=tests,
        machines=machines,
        blunders=blunders,
        correlation=correlation,
        alarmed=int(np.sum(np.any(at <= tests, axis=1))),
        repeats=repeats,
        faults=tuple(
            _found(name, shape, float(size[k] / scale[k]), float(size[k] / typical), at[:, k], tests)
            for shape, size, at in [
                (shape, size, first_alarms(fewer, rule, course, scatter, random)[0]) for shape, size, course in courses
            ]
            for k, (name, typical) in enumerate(zip(kinds, np.median(fewer.reference.deviation, axis=0), strict=True))
        ),
        judged=judged,
        over=over,
    )


def _check(machines: int, tests: int, interval: float | None, scatter: Scatter) -> None:
    if machines < 1 or tests < 1:
        raise InputError(f"{machines} machines with {tests} tests each; give 1 or more of both")
    if interval is not None and not (0 < interval < inf):
        raise InputError(f"the interval between tests is {interval} days; give a number above 0")
    if not 0 <= scatter.blunders < 1:
        raise InputError(f"the share of tests with a blunder is {scatter.blunders}; give 0 to 1")
    if not 0 <= scatter.correlation < 1:
        raise InputError(f"the correlation of one test with the next is {scatter.correlation}; give 0 to 1")


def _determined(series: Series, reference: Reference) -> tuple[dict[str, Kind], Reference]:
    """The indicators that the baseline determines."""
    shown = np.isfinite(reference.mean)
    names = zip(series.indicators, series.kinds, shown, strict=True)
    parts = {part.name: getattr(reference, part.name)[shown] for part in fields(reference)}
    return {name: kind for name, kind, there in names if there}, Reference(**parts)


def _interval(series: Series) -> float | None:
    """The usual one between tests that repeat none."""
    gaps = np.diff(series.date[~series.aside & (series.repeats < 0)])
    found = float(np.median(gaps)) if len(gaps) else 0.0
    return found if found > 0 else None


def _courses(least: Array, tests: int, interval: float) -> list[tuple[str, Array, Array]]:
    """The faults: their shape, size, and what they add to each test, (tests, q). All indicators have theirs at once."""
    year = np.arange(1, tests + 1)[:, np.newaxis] * interval / _YEAR
    steps = [(STEP, times * least, np.broadcast_to(times * least, (tests, len(least)))) for times in STEPS]
    return [*steps, (DRIFT, A_YEAR * least, A_YEAR * least * year)]


def _found(indicator: str, shape: str, size: float, deviations: float, at: Array, tests: int) -> FaultFound:
    median, most = np.quantile(at, (0.5, 0.9), method="inverted_cdf")
    share, soon = float(np.mean(at <= tests)), float(np.mean(at <= SOON))
    return FaultFound(indicator, shape, size, deviations, soon, share, float(median), float(most))
