"""Whether every test says how warm the machine was."""

from studies.histories import Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "temperature known"
LAYOUT = "8 indicators, baseline of 10, 12 tests"

STUDY = Study(
    CHECK,
    "It counts tests without one. What a season does without a temperature is counted with the charts.",
    (
        Cell(
            "in every test",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=12), covariate=True),
            Named(CHECK),
            most=0.0,
            short=4,
        ),
        Cell(
            "in half of the tests",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=12), covariate=True, unread=0.5),
            Named(CHECK),
            least=1.0,
            short=4,
        ),
    ),
    order=3,
)
