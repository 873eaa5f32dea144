"""Drives that are driven back: whether losses that are not stated leave the interval."""

from studies.rates import Cell, Named, Study
from studies.roller_samples import Covers, Mapped

CHECK = "losses when driven back known"

STUDY = Study(
    CHECK,
    "Not tested where nothing is stated; the intervals are then to hold whatever the losses are: those of a friction in "
    "proportion to the load (0.889), the same efficiency both ways (0.9), worse (0.85). Held: nine of ten directions.",
    (
        *(
            Cell(
                f"efficiency back {back:.3g}, not stated: map",
                "5 engagements",
                "white",
                Mapped(back=back),
                Covers(),
                ("missed",),
                most=0.05,
            )
            for back in (2 - 1 / 0.9, 0.9, 0.85)
        ),
        Cell("not stated", "5 engagements", "white", Mapped(), Named(CHECK), ("not tested",), least=1.0, short=1),
        Cell(
            "stated",
            "5 engagements",
            "white",
            Mapped(back=0.8, stated=True),
            Named(CHECK),
            ("not tested",),
            most=0.0,
            short=1,
        ),
    ),
    order=2,
)
