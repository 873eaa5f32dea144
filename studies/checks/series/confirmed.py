"""Whether an alarm is confirmed by a second test."""

from studies.histories import Fault, Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "change confirmed"
LAYOUT = "8 indicators, baseline of 10"
LAST = Ways(tests=12, degrees_of_freedom=float("inf"), fault=Fault(9.0, after=11))

STUDY = Study(
    CHECK,
    "Of an alarm: a repeat on the same side at 0.8 of the limit, or another test over the limit. It cannot tell a blunder "
    "that nobody repeated from a change.",
    (
        Cell(
            "a step of 4 sigma, repeated",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=30, fault=Fault(4.0, after=20))),
            Named(CHECK),
            most=0.05,
            short=20,
        ),
        Cell(
            "the last test is off by 9 sigma, not repeated",
            LAYOUT,
            "white",
            Judged(LAST, repeat=False),
            Named(CHECK),
            least=0.95,
            short=20,
        ),
    ),
    order=3,
)
