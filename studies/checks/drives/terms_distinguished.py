"""Whether each term of a torque balance has a number of its own."""

from studies.drive_samples import Identified
from studies.dwells import Dwells
from studies.rates import Cell, Named, Study

CHECK = "terms distinguished"

STUDY = Study(
    CHECK,
    "A record in one direction holds Coulomb friction and constant as one number; dwells must not make two of it.",
    (
        Cell("both directions", "4 runs with dwells", "none", Identified(Dwells()), Named(CHECK), most=0.0, short=6),
        Cell("both directions", "4 runs with dwells", "0.5 um", Identified(Dwells(noise=5e-4)), Named(CHECK), most=0.0),
        Cell(
            "one direction", "4 runs with dwells", "none", Identified(Dwells(one_way=True)), Named(CHECK), least=1.0, short=6
        ),
        Cell(
            "one direction",
            "4 runs with dwells",
            "0.5 um",
            Identified(Dwells(noise=5e-4, one_way=True)),
            Named(CHECK),
            least=1.0,
        ),
    ),
    order=2,
)
