"""Whether the acceleration explains the change of the velocity."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "sampled fast enough"

STUDY = Study(
    CHECK,
    "The fastest of the sines has 3 Hz: 200 samples a second show its acceleration, 5 do not.",
    (
        Cell("200 samples a second", "sines", "white", Identified(Sines()), Named(CHECK), most=0.05, short=4),
        Cell(
            "5 samples a second",
            "sines",
            "white",
            Identified(Sines(step=0.2)),
            Named(CHECK),
            least=0.95,
            short=4,
        ),
    ),
    order=2,
)
