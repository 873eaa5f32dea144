"""False alarms of a machine in three years, and how soon a change is found: the rule of the charts in closed form."""

from __future__ import annotations

from dataclasses import replace
from math import inf

from studies.histories import Fault, Ways
from studies.rates import Cell, Study
from studies.watched import OTHER, Named, Watched, Within

FOUND = "alarm"
TESTS = 36
SOUND, SHORT = "any alarm in 36 tests, nothing wrong", 1000
PLAIN = "8 indicators, baseline of 10"
REPORTED = 0.25
"""Share of the draws of what is reported only."""
FAULTS = 4.0
"""As many draws with a fault as without."""


def sound(noise: str, sample: Watched, layout: str = PLAIN, most: float = 1.0) -> Cell:
    """False alarms of one machine in 36 tests, all its charts together."""
    bounded = most < 1
    return Cell(
        f"{SOUND}: {noise}", layout, "share", sample, Within(TESTS), most=most, short=SHORT if bounded else 0,
        share=1.0 if bounded else REPORTED,
    )  # fmt: skip


def found(truth: str, sample: Watched, tests: int, least: float = 0.0, layout: str = PLAIN) -> Cell:
    """How often a change is found within so many tests."""
    ways = replace(sample.ways, tests=sample.ways.fault.after + tests)
    within = f"alarm within {tests} tests" if tests > 1 else "alarm at the next test"
    return Cell(
        f"{within}: {truth}", layout, "share", replace(sample, ways=ways), Within(tests), least=least,
        short=SHORT if least else 0, share=FAULTS if least else REPORTED,
    )  # fmt: skip


def other(truth: str, sample: Watched) -> Cell:
    """How often another indicator is named first."""
    return Cell(
        f"another indicator named first: {truth}", PLAIN, "share", sample, Named(), (OTHER,), most=0.05, short=SHORT // 2
    )


def step_of(size: float, after: int = 0, **ways: float) -> Ways:
    """A step of so many standard deviations."""
    return Ways(fault=Fault(size, after=after), **ways)  # type: ignore[arg-type]


def season(**ways: float) -> Ways:
    """Of two standard deviations."""
    return Ways(season=2.0, **ways)  # type: ignore[arg-type]


DIFFER = {"degrees_of_freedom": inf, "spread": 0.5}
FOUR, LATER = "4 indicators, baseline of 10", "after a year"
SIZES = {m: f"8 indicators, baseline of {m}" for m in (4, 6, 20)}

FALSE_ALARMS = (
    sound("scatter drawn from the prior", Watched(), most=0.11),
    sound("3 % blunders of 6 sigma", Watched(Ways(blunders=0.03)), most=0.12),
    sound("season of 2 sigma, temperature known", Watched(season(), covariate=True), most=0.12),
    sound("3 % blunders, suspect tests not repeated", Watched(Ways(blunders=0.03), repeat=False)),
    sound("season of 2 sigma, temperature not known", Watched(season())),
    sound("season and 3 % blunders, temperature known", Watched(season(blunders=0.03), covariate=True)),
    sound("season, thermometer off by 0.5 K", Watched(season(thermometer=0.5), covariate=True)),
    sound("season, every 2 weeks, temperature known", Watched(season(interval=14.0), covariate=True)),
    sound("season, every 2 weeks, temperature not known", Watched(season(interval=14.0))),
    sound("season, every week, temperature known", Watched(season(interval=7.0), covariate=True)),
    sound("season of 5 sigma, temperature known", Watched(Ways(season=5.0), covariate=True)),
    sound("season of 5 sigma, every week, temperature known", Watched(Ways(season=5.0, interval=7.0), covariate=True)),
    sound("no season, temperature known", Watched(covariate=True)),
    sound("autocorrelation 0.6", Watched(Ways(correlation=0.6))),
    sound("autocorrelation 0.6, a change below 2 sigma does not matter", Watched(Ways(correlation=0.6), relevance=2.0)),
    sound("heavy tails (t with 4)", Watched(Ways(tails=4.0))),
    sound("the truth scatters twice as much as expected", Watched(Ways(size=2.0))),
    sound("machines that differ by 50 %, default prior", Watched(Ways(**DIFFER))),
    sound("machines that differ by 50 %, fixed prior of 10", Watched(Ways(**DIFFER), prior=(10.0, 1.0))),
    sound("machines that differ by 50 %, prior of a fleet of 5", Watched(Ways(**DIFFER), fleet=5)),
    sound("machines that differ by 50 %, prior of a fleet of 20", Watched(Ways(**DIFFER), fleet=20)),
    sound("machines alike, prior of a fleet of 20", Watched(Ways(degrees_of_freedom=inf), fleet=20)),
    sound("scatter drawn from the prior", Watched(Ways(indicators=4)), FOUR),
    *(sound("scatter drawn from the prior", Watched(Ways(baseline=m)), layout) for m, layout in SIZES.items()),
)  # fmt: skip

STIFFNESS = Fault(0.2 / 0.015, expected=True)

POWERS = (
    found("a step of 3 sigma", Watched(step_of(3.0)), 5, 0.5),
    found("a step of 4 sigma", Watched(step_of(4.0)), 5, 0.9),
    found("20 % of stiffness, expected to scatter by 1.5 %", Watched(Ways(fault=STIFFNESS)), 1, 0.99),
    other("a step of 3 sigma", Watched(step_of(3.0))),
    other("a step of 4 sigma", Watched(step_of(4.0))),
    found(f"a step of 3 sigma, {LATER}", Watched(step_of(3.0, 12)), 5),
    found(f"a step of 4 sigma, {LATER}", Watched(step_of(4.0, 12)), 5),
    found("a step of 5 sigma", Watched(step_of(5.0)), 2),
    found("0.3 sigma more each test", Watched(Ways(fault=Fault(0.3, "ramp"))), 10),
    found("a step of 3 sigma, temperature known", Watched(step_of(3.0), covariate=True), 5),
    found("a step of 3 sigma, season of 2 sigma, temperature known", Watched(step_of(3.0, season=2.0), covariate=True), 5),
    found("a step of 3 sigma, the same every week", Watched(step_of(3.0, season=2.0, interval=7.0), covariate=True), 5),
    found("a step of 4 sigma, prior of a fleet of 20, alike", Watched(step_of(4.0, degrees_of_freedom=inf), fleet=20), 5),
    found("a step of 3 sigma", Watched(step_of(3.0, indicators=4)), 5, layout=FOUR),
    *(
        found(f"a step of {size:g} sigma", Watched(step_of(size, baseline=m)), 5, layout=layout)
        for size in (3.0, 4.0)
        for m, layout in SIZES.items()
        if m >= 6
    ),
)  # fmt: skip

STUDY = Study(
    "charts of a series",
    "Machines that are tested once a month, unless it says otherwise. The standard deviation between tests, sigma, is drawn "
    "for each machine and indicator: its variance from an inverse chi-square with six degrees of freedom about what is "
    "expected. An alarm is a suspect test that its repeat on the same day confirms at 0.8 of the limit; the repeat shares "
    "the scatter between tests and draws the blunder anew. A blunder is in one indicator, in the baseline as often as after "
    "it. A step begins with the first test after the baseline, or a year later; what alarmed before that is counted apart. "
    "Where nothing is wanted, nothing is promised: where each test resembles the one before, or the scatter has heavy "
    "tails, the charts alarm far more often than designed. With a baseline of fewer than six tests they never do.",
    (*FALSE_ALARMS, *POWERS),
    order=3,
)
