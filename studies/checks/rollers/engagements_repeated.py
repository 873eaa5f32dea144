"""Whether the scatter within the engagements is known."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Mapped

CHECK = "engagements repeated"

STUDY = Study(
    CHECK,
    "Repeats within the engagements: five engagements of four runs give 15, which is enough.",
    (
        Cell("4 runs each", "5 engagements", "white", Mapped(), Named(CHECK), most=0.0, short=2),
        Cell("4 runs each: counted", "5 engagements", "white", Mapped(), Named(CHECK), ("silent",), least=1.0),
    ),
    order=2,
)
