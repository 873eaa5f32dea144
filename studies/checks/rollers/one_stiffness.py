"""Whether the engagements support one stiffness, or a law that stiffens."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Laws, Mapped

CHECK = "one stiffness at every engagement"

STUDY = Study(
    CHECK,
    "Five engagements, four runs each. A fall of 20 % and a contact of 30 % up to the greatest engagement, and the machine "
    "of Table 6.6, which no law describes. *found* or *alike* (named together) count as found.",
    (
        Cell("one spring", "5 engagements", "white", Mapped(), Named(CHECK), most=0.05, short=2),
        Cell("falls by 20 %", "5 engagements", "white", Mapped("falls"), Named(CHECK), least=0.95, short=2),
        Cell(
            "falls by 20 %: law", "5 engagements", "white", Mapped("falls"), Laws("linear"), ("found", "alike"), least=0.95
        ),
        Cell("contact of 30 %", "5 engagements", "white", Mapped("contact"), Named(CHECK), least=0.95),
        Cell(
            "contact of 30 %: law",
            "5 engagements",
            "white",
            Mapped("contact"),
            Laws("contact"),
            ("found", "alike"),
            least=0.95,
        ),
        Cell("Table 6.6", "5 engagements", "white", Mapped("table 6.6"), Named(CHECK), least=0.95),
        Cell(
            "one spring", "3 engagements", "white", Mapped(engagements=(0, 2, 4)), Named(CHECK), ("not tested",), least=1.0
        ),
    ),
    order=2,
)
