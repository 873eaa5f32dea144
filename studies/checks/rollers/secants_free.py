"""Whether the secants show the machine, or an offset."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Mapped

CHECK = "secants free of an offset"

STUDY = Study(
    CHECK,
    "A radius that is off by 18 um is 60 % of the deflection at the least engagement.",
    (
        Cell("no offset", "5 engagements", "white", Mapped(), Named(CHECK), most=0.05, short=2),
        Cell("18 um", "5 engagements", "white", Mapped(path=0.018), Named(CHECK), least=0.95, short=1),
        Cell("Table 6.6", "5 engagements", "white", Mapped("table 6.6"), Named(CHECK), least=0.95),
    ),
    order=2,
)
