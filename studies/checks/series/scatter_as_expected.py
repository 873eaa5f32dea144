"""Whether the tests of the baseline repeat as well as such tests do."""

from studies.histories import Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "scatter as expected"
LAYOUT = "8 indicators, baseline of 10"
ALIKE = float("inf")

STUDY = Study(
    CHECK,
    "Chi-squared of each indicator against what is expected of its kind, or of the fleet, at 1 % for all together. It "
    "changes no limit: those come from the scatter itself.",
    (
        Cell(
            "as expected",
            LAYOUT,
            "white",
            Judged(Ways(tests=2, degrees_of_freedom=ALIKE)),
            Named(CHECK),
            most=0.01,
            short=40,
        ),
        Cell(
            "three times as much",
            LAYOUT,
            "white",
            Judged(Ways(tests=2, degrees_of_freedom=ALIKE, size=3.0)),
            Named(CHECK),
            least=0.95,
            short=10,
        ),
        Cell("twice as much", LAYOUT, "white", Judged(Ways(tests=2, degrees_of_freedom=ALIKE, size=2.0)), Named(CHECK)),
        Cell(
            "drawn from the prior of six degrees of freedom",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=2)),
            Named(CHECK),
        ),
    ),
    order=3,
)
