"""Whether repeats show the scatter of an indicator test."""

from studies.indicator_samples import Dials
from studies.rates import Cell, Named, Study

CHECK = "readings repeated"

STUDY = Study(
    CHECK,
    "Five engagements, each read once or three times: without a repeat the scatter is not tested.",
    (
        Cell("once", "read once", "rounding", Dials(), Named(CHECK), ("not tested",), least=1.0, short=2),
        Cell("repeated", "read 3 times", "0.5 um", Dials(scatter=5e-4, repeats=3), Named(CHECK), most=0.0, short=2),
    ),
    order=2,
)
