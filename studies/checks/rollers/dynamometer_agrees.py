"""Whether the force from the currents agrees with a dynamometer."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Mapped

CHECK = "force agrees with the dynamometer"
FIVE = "5 engagements"

STUDY = Study(
    CHECK,
    "A dynamometer with 3 N of noise; motor constants and losses of the drives are exact, or off by what is stated of them. "
    "The fault is a force that is 10 % too great.",
    (
        Cell("the same force, drives exact", FIVE, "white", Mapped(dynamometer=1.0), Named(CHECK), most=0.05),
        Cell("the same force", FIVE, "white", Mapped(dynamometer=1.0, drives_off=True), Named(CHECK), most=0.05),
        Cell("10 % too great", FIVE, "white", Mapped(dynamometer=1.1, drives_off=True), Named(CHECK), least=0.95, short=1),
    ),
    order=2,
)
