"""Whether each test is news, or follows the one before it."""

from studies.histories import Ways
from studies.rates import Cell, Named, Study
from studies.series_samples import Judged

CHECK = "tests independent"
LAYOUT = "8 indicators, baseline of 10, 36 tests"

STUDY = Study(
    CHECK,
    "Correlation of successive departures from the baseline, all indicators together, at 1 %: those before a change alone.",
    (
        Cell("independent", LAYOUT, "scatter of the prior", Judged(), Named(CHECK), most=0.015, short=40),
        Cell(
            "autocorrelation 0.6",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(correlation=0.6)),
            Named(CHECK),
            least=0.95,
            short=10,
        ),
        Cell("autocorrelation 0.3", LAYOUT, "scatter of the prior", Judged(Ways(correlation=0.3)), Named(CHECK)),
        Cell(
            "season of 2 sigma, temperature not known",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(season=2.0)),
            Named(CHECK),
        ),
        Cell(
            "season of 2 sigma, temperature known",
            LAYOUT,
            "scatter of the prior",
            Judged(Ways(season=2.0), covariate=True),
            Named(CHECK),
        ),
        Cell("3 % blunders of 6 sigma", LAYOUT, "scatter of the prior", Judged(Ways(blunders=0.03)), Named(CHECK)),
    ),
    order=3,
)
