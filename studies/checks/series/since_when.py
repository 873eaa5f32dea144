"""Since when, by how much, how fast, when a limit is reached: how often an interval of 95 % misses the truth."""

from studies.histories import Fault, Ways
from studies.rates import Cell, Study
from studies.series_samples import HELD, MISSED, Judged, Since

LAYOUT = "8 indicators, baseline of 10"
STEP = Judged(Ways(tests=14, fault=Fault(-5.0, after=6, expected=True)))
RAMP = Judged(Ways(tests=20, degrees_of_freedom=float("inf"), fault=Fault(-1.0, "ramp", after=6)), tolerance=40.0)


def missed(truth: str, what: str, sample: Judged, most: float, short: int = 0) -> Cell:
    """How often the interval does not hold it."""
    noise = "white" if sample is RAMP else "scatter of the prior"
    return Cell(f"{truth}: {what}", LAYOUT, noise, sample, Since(what, sample), (MISSED,), most=most, short=short)


def said(truth: str, what: str, sample: Judged) -> Cell:
    """How often it is said at all, and holds the truth."""
    noise = "white" if sample is RAMP else "scatter of the prior"
    return Cell(f"{truth}: {what} said", LAYOUT, noise, sample, Since(what, sample), (HELD,), least=0.85, short=20)


STUDY = Study(
    "since when, how fast",
    "Intervals of 95 %, of those draws in which the change is found; step or drift is chosen by the likelihood, and the "
    "interval does not know of the choice.",
    (
        missed("a step of 5 sigma", "change point", STEP, 0.06, 40),
        missed("a step of 5 sigma", "change", STEP, 0.07),
        missed("a ramp of 1 sigma a test", "change point", RAMP, 0.1, 40),
        missed("a ramp of 1 sigma a test", "change", RAMP, 0.1),
        missed("a ramp of 1 sigma a test", "slope", RAMP, 0.08),
        missed("a ramp of 1 sigma a test", "date of the limit", RAMP, 0.08),
        said("a step of 5 sigma", "change point", STEP),
        said("a ramp of 1 sigma a test", "slope", RAMP),
        said("a ramp of 1 sigma a test", "date of the limit", RAMP),
    ),
    order=3,
)
