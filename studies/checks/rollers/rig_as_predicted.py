"""Whether a rig of known compliance adds what it should."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Mapped

CHECK = "compliance with the rig as predicted"

STUDY = Study(
    CHECK,
    "A rig of 2.65 N/um, known to 4 nm/N; the fault is a rig that is a fifth softer than stated.",
    (
        Cell("the stated rig", "5 engagements", "white", Mapped(rig=1.0), Named(CHECK), most=0.05, short=1),
        Cell("20 % softer", "5 engagements", "white", Mapped(rig=1.2), Named(CHECK), least=0.95, short=1),
    ),
    order=2,
)
