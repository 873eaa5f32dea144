"""Whether the residuals have structure left."""

from studies.drive_samples import Identified
from studies.rates import Cell, Named, Study
from studies.sines import Sines

CHECK = "residuals like noise"

STUDY = Study(
    CHECK,
    "White noise against friction that sets in smoothly where the model has a sharp sign, and against noise that holds on.",
    (
        Cell("plain friction", "sines", "white", Identified(Sines()), Named(CHECK), most=0.05, short=4),
        Cell(
            "friction that sets in over 3 mm/s",
            "sines",
            "white",
            Identified(Sines(smooth=3.0)),
            Named(CHECK),
            least=0.95,
            short=4,
        ),
    ),
    order=2,
)
