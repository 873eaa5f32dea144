"""Whether a baseline says how its tests scatter."""

from studies.histories import Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "baseline long enough"

STUDY = Study(
    CHECK,
    "It counts tests. With five the limits are so wide that a change of 5 sigma is found in five tests in four of five.",
    (
        Cell(
            "a baseline of 6",
            "8 indicators",
            "scatter of the prior",
            Judged(Ways(baseline=6, tests=2)),
            Named(CHECK),
            most=0.0,
            short=4,
        ),
        Cell(
            "a baseline of 5",
            "8 indicators",
            "scatter of the prior",
            Judged(Ways(baseline=5, tests=2)),
            Named(CHECK),
            least=1.0,
            short=4,
        ),
    ),
    order=3,
)
