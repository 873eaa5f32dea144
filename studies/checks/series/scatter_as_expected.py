"""Whether the tests of the baseline repeat as well as such tests do."""

from studies.histories import Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "scatter as expected"
LAYOUT, NOISE = "8 indicators, baseline of 10", "scatter of the prior"

STUDY = Study(
    CHECK,
    "F of each indicator against what is expected of its kind, or of the fleet, with the degrees of freedom that this is "
    "worth, at 1 % for all together. It changes no limit: those come from the scatter itself.",
    (
        Cell("as expected", LAYOUT, NOISE, Judged(Ways(tests=2)), Named(CHECK), most=0.01, short=40),
        Cell("five times as much", LAYOUT, NOISE, Judged(Ways(tests=2, size=5.0)), Named(CHECK), least=0.95, short=10),
        Cell("three times as much", LAYOUT, NOISE, Judged(Ways(tests=2, size=3.0)), Named(CHECK)),
        Cell("twice as much", LAYOUT, NOISE, Judged(Ways(tests=2, size=2.0)), Named(CHECK)),
        Cell("machines that differ by 50 %", LAYOUT, NOISE, Judged(Ways(tests=2, spread=0.5)), Named(CHECK)),
    ),
    order=3,
)
