"""Whether the model that the runs support is the one that is true."""

from studies.drive_samples import FOUND, Identified, Supports
from studies.rates import Cell, Named, Study
from studies.sines import Sines

TRUTHS = (
    ("plain friction", Sines(), ("plain",), 0.95),
    ("friction that sets in over 3 mm/s", Sines(smooth=3.0), ("smooth sign",), 0.90),
    ("8 ms of delay", Sines(delay=0.008), ("time shift", "averaged motion, time shift"), 0.90),
)

CHECK = "friction model adequate"

STUDY = Study(
    CHECK,
    "Five runs of sines. The check itself compares the model that is shown with the one that the runs support; counted is "
    "which one that is. A delay that averaging explains as well is to be called neither.",
    (
        *(
            Cell(truth, "5 runs", "white", Identified(records, compare=True), Supports(wanted), (FOUND,), least=least)
            for truth, records, wanted, least in TRUTHS
        ),
        Cell(
            "no comparison with one run",
            "1 run",
            "white",
            Identified(Sines(1), True),
            Named(CHECK),
            ("not tested",),
            1.0,
            short=4,
        ),
        Cell("plain friction, plain shown", "5 runs", "white", Identified(Sines(3), True), Named(CHECK), most=0.05),
    ),
    order=2,
)
