"""Whether the engagements follow the supported law."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Mapped

CHECK = "engagements follow the law"

STUDY = Study(
    CHECK,
    "The machine of Table 6.6 is soft up to the first engagement and even from there: none of the laws.",
    (
        Cell("one spring", "5 engagements", "white", Mapped(), Named(CHECK), most=0.05, short=2),
        Cell("falls by 20 %", "5 engagements", "white", Mapped("falls"), Named(CHECK), most=0.05),
        Cell("Table 6.6", "5 engagements", "white", Mapped("table 6.6"), Named(CHECK), least=0.95, short=2),
    ),
    order=2,
)
