"""Whether the force from the currents agrees with a dynamometer."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Mapped

CHECK = "force agrees with the dynamometer"

STUDY = Study(
    CHECK,
    "A dynamometer with 3 N of noise; the fault is a force that is 10 % too great.",
    (
        Cell("the same force", "5 engagements", "white", Mapped(dynamometer=1.0), Named(CHECK), most=0.05),
        Cell("10 % too great", "5 engagements", "white", Mapped(dynamometer=1.1), Named(CHECK), least=0.95, short=1),
    ),
    order=2,
)
