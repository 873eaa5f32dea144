"""Whether a machine is within the tolerance that a person set."""

from studies.histories import Fault, Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "within tolerance"
LAYOUT = "8 indicators, baseline of 10"

STUDY = Study(
    CHECK,
    "By the running mean, which follows a step in about five tests; without the uncertainty of the baseline.",
    (
        Cell(
            "nothing wrong, tolerance of 3 sigma",
            LAYOUT,
            "scatter of the prior",
            Judged(tolerance=3.0),
            Named(CHECK),
            most=0.05,
            short=40,
        ),
        Cell(
            "a step of 5 sigma six tests ago, tolerance of 3 sigma",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=26, fault=Fault(5.0, after=20, expected=True)), tolerance=3.0),
            Named(CHECK),
            least=0.95,
            short=20,
        ),
    ),
    order=3,
)
