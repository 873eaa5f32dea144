"""Whether the uncertainties come from the scatter of runs."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "runs repeated"

STUDY = Study(
    CHECK,
    "Five runs do; one is cut into pieces, which hold less.",
    (
        Cell("5 runs", "sines", "white", Identified(Sines()), Named(CHECK), most=0.05, short=4),
        Cell("1 run", "sines", "white", Identified(Sines(1)), Named(CHECK), least=0.95, short=4),
    ),
    order=2,
)
