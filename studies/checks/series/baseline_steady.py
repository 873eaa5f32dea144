"""Whether nothing was on its way while the baseline was made."""

from studies.histories import Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "baseline steady"
LAYOUT = "8 indicators, baseline of 10"

STUDY = Study(
    CHECK,
    "Student's t of the slope of each indicator, at 1 % for all of them together; scatter shrunk to the prior.",
    (
        Cell("nothing wrong", LAYOUT, "scatter of the prior", Judged(Ways(tests=2)), Named(CHECK), most=0.01, short=40),
        Cell(
            "1 sigma from test to test",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(tests=2), trend=1.0),
            Named(CHECK),
            least=0.9,
            short=10,
        ),
        Cell("0.5 sigma from test to test", LAYOUT, "scatter of the prior", Judged(Ways(tests=2), trend=0.5), Named(CHECK)),
        Cell("3 % blunders of 6 sigma", LAYOUT, "scatter of the prior", Judged(Ways(tests=2, blunders=0.03)), Named(CHECK)),
    ),
    order=3,
)
