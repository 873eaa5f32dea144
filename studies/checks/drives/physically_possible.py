"""Whether friction and inertia are positive."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "physically possible"

STUDY = Study(
    CHECK,
    "A current of the wrong sign.",
    (
        Cell("plain friction", "sines", "white", Identified(Sines()), Named(CHECK), most=0.05, short=4),
        Cell(
            "the current has the wrong sign",
            "sines",
            "white",
            Identified(Sines(reversed_effort=True)),
            Named(CHECK),
            least=0.95,
            short=4,
        ),
    ),
    order=2,
)
