"""Whether noise decides the sign of the velocity."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "direction known"

STUDY = Study(
    CHECK,
    "Signs that differ from both neighbours, with every sample taken.",
    (
        Cell(
            "a velocity without noise",
            "sines",
            "white",
            Identified(Sines(), least_speed=0.0),
            Named(CHECK),
            most=0.05,
            short=4,
        ),
        Cell(
            "3 mm/s of noise of the velocity",
            "sines",
            "white",
            Identified(Sines(trembling=3.0), least_speed=0.0),
            Named(CHECK),
            least=0.95,
            short=4,
        ),
    ),
    order=2,
)
