"""Whether a machine has changed: the whole verdict of a series, repeats and all."""

from studies.histories import Fault, Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "machine unchanged"
LAYOUT = "8 indicators, baseline of 10"
BLUNDERS = Ways(blunders=0.03)

STUDY = Study(
    CHECK,
    "The rule of the charts in the verdict of a series, after 36 tests: suspect tests are repeated the same day, one that "
    "nobody repeats is an alarm after a week. What the charts do test by test is counted below.",
    (
        Cell("nothing wrong", LAYOUT, "scatter of the prior", Judged(), Named(CHECK), most=0.11, short=40),
        Cell("nothing wrong", LAYOUT, "3 % blunders of 6 sigma", Judged(BLUNDERS), Named(CHECK), most=0.12),
        Cell(
            "nothing wrong, nobody repeats", LAYOUT, "3 % blunders of 6 sigma", Judged(BLUNDERS, repeat=False), Named(CHECK)
        ),
        Cell(
            "a step of 4 sigma, 10 tests ago",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=30, fault=Fault(4.0, after=20))),
            Named(CHECK),
            least=0.95,
            short=20,
        ),
        Cell(
            "a ramp of 0.3 sigma a test, 20 tests long",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=30, fault=Fault(0.3, "ramp", after=10))),
            Named(CHECK),
            least=0.95,
        ),
    ),
    order=3,
)
