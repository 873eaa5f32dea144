"""Whether one compliance describes the set-up of an indicator test."""

from studies.indicator_samples import Dials
from studies.rates import Cell, Named, Study

CHECK = "set-up's compliance constant"

STUDY = Study(
    CHECK,
    "Five engagements, 40 to 200 um, dials of 1 um. The fault is a roller bearing that softens by 30 % up to the greatest.",
    (
        Cell("constant", "read once", "rounding", Dials(), Named(CHECK), most=0.05, short=10),
        Cell("constant", "read 3 times", "0.5 um", Dials(scatter=5e-4, repeats=3), Named(CHECK), most=0.05),
        Cell("softens by 30 %", "read once", "rounding", Dials(softens=0.3), Named(CHECK), least=0.95, short=5),
    ),
    order=2,
)
