"""Whether rounding of the effort matters."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "effort resolved"

STUDY = Study(
    CHECK,
    "Digits of the log against the noise of 0.2 A.",
    (
        Cell("all digits", "sines", "white", Identified(Sines()), Named(CHECK), most=0.05, short=4),
        Cell("one digit", "sines", "white", Identified(Sines(digits=1)), Named(CHECK), least=0.95, short=4),
    ),
    order=2,
)
