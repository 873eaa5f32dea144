"""Whether a delay is told from an average of neighbouring samples."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "time shift distinct from averaging"

STUDY = Study(
    CHECK,
    "Said only where a delay helps at all. An average of neighbours must not pass for a delay.",
    (
        Cell("8 ms of delay", "5 runs", "white", Identified(Sines(delay=0.008), True), Named(CHECK), most=0.05),
        Cell(
            "motion averaged, no delay",
            "5 runs",
            "white",
            Identified(Sines(averaged=0.5, step=0.02, samples=400), True),
            Named(CHECK),
            ("alarm", "absent"),
            least=0.95,
            short=2,
        ),
    ),
    order=2,
)
