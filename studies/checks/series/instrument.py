"""One alarm on an instrument with which several machines move alike."""

from studies.rates import Cell, Study
from studies.series_samples import Fleet, moved

LAYOUT = "6 machines, 10 tests before a calibration and 6 after"

STUDY = Study(
    "machines that move alike",
    "Three machines or more to the same side by the same amount, one of them in alarm, and not half as many that the same "
    "instrument shows where they were.",
    (
        Cell("nothing wrong", LAYOUT, "white", Fleet((0.0,) * 6), moved, most=0.01, short=10),
        Cell(
            "three machines with faults of their own, 3 to 12 sigma",
            LAYOUT,
            "white",
            Fleet((-3.0,) * 3 + (0.0,) * 3, True),
            moved,
            most=0.02,
            short=10,
        ),
        Cell("six machines with faults of their own, 3 to 12 sigma", LAYOUT, "white", Fleet((-3.0,) * 6, True), moved),
        Cell("the instrument is off by 4 sigma", LAYOUT, "white", Fleet((-4.0,) * 6), moved, least=0.95, short=10),
        Cell("the instrument is off by 3 sigma", LAYOUT, "white", Fleet((-3.0,) * 6), moved, least=0.9),
        Cell("the instrument is off by 2 sigma", LAYOUT, "white", Fleet((-2.0,) * 6), moved),
    ),
    order=3,
)
