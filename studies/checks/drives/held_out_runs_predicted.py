"""Whether held-out runs are predicted as well as the others."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "held-out runs predicted"

STUDY = Study(
    CHECK,
    "A quarter more of RMSE than at the identified runs is an alarm.",
    (
        Cell(
            "one friction in all runs",
            "sines",
            "white",
            Identified(Sines(), held_out=("run 4",)),
            Named(CHECK),
            most=0.05,
            short=4,
        ),
        Cell(
            "friction of the held-out run 30 % greater",
            "sines",
            "white",
            Identified(Sines(heavier=1.3), held_out=("run 4",)),
            Named(CHECK),
            least=0.95,
            short=4,
        ),
    ),
    order=2,
)
