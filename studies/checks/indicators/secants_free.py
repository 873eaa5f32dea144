"""Whether the machine's secants of an indicator test show the machine, or an offset."""

from studies.indicator_samples import Dials
from studies.rates import Cell, Named, Study

CHECK = "machine's secants free of an offset"

STUDY = Study(
    CHECK,
    "Five engagements, 40 to 200 um, dials of 1 um. The fault is 18 um that give way first, as in Table 6.5.",
    (
        Cell("no offset", "read once", "rounding", Dials(), Named(CHECK), most=0.05, short=10),
        Cell("no offset", "read 3 times", "0.5 um", Dials(scatter=5e-4, repeats=3), Named(CHECK), most=0.05),
        Cell("18 um", "read once", "rounding", Dials(offset=0.018), Named(CHECK), least=0.95, short=5),
    ),
    order=2,
)
