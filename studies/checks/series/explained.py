"""Which component a change points to, and whether one explains it."""

from studies.rates import Cell, Named, Study
from studies.series_samples import Faulty, Pointed

CHECK = "change explained by one component"
LAYOUT, NOISE = "wFYXt, circles in XY, 10 and 5 tests", "white"
GUIDEWAY = Faulty((("C_XXY", 1e-5), ("E_XY2", 2e-7)))
NUT = Faulty((("C_XXX", 1e-5), ("B_XX", 6e-3)))
SOFT = Faulty((("C_XXX", 1e-5),))
CRASH = Faulty((("E_C(0Y)X", 3e-5),))
GAUGE = Faulty(gauge=0.06)
TWO = Faulty((("E_C(0Y)X", 3e-5), ("E_XY2", 3e-7)))
TOLD = ("first", "not told apart")

STUDY = Study(
    CHECK,
    "Signatures from the design of the test; a component is named if it explains half of the changes. A softness along an "
    "axis alone is in the compliance of every carriage: then the first named is one of several that the test cannot tell.",
    (
        Cell("a guideway: 10 nm/N across, path bent by 4.5 um", LAYOUT, NOISE, GUIDEWAY, Named(CHECK), most=0.05, short=4),
        Cell("a nut: 10 nm/N along, backlash of 6 um", LAYOUT, NOISE, NUT, Named(CHECK), most=0.05),
        Cell("a collision: squareness of 30 urad", LAYOUT, NOISE, CRASH, Named(CHECK), most=0.05),
        Cell("a collision, and another guideway's path bent by 6.8 um", LAYOUT, NOISE, TWO, Named(CHECK), least=0.9),
        Cell("the guideway is named first", LAYOUT, NOISE, GUIDEWAY, Pointed("guideway Y"), ("first",), least=0.9, short=4),
        Cell("the drive is named first", LAYOUT, NOISE, NUT, Pointed("drive X"), ("first",), least=0.9),
        Cell("softness along X alone: the drive first", LAYOUT, NOISE, SOFT, Pointed("drive X"), ("first",)),
        Cell(
            "softness along X alone: the drive among those named", LAYOUT, NOISE, SOFT, Pointed("drive X"), TOLD, least=0.95
        ),
        Cell("the collision is named first", LAYOUT, NOISE, CRASH, Pointed("squareness XY"), ("first",), least=0.9),
        Cell("a gauge that is off by 6 %: the instrument first", LAYOUT, NOISE, GAUGE, Pointed("instrument"), ("first",)),
        Cell(
            "a gauge that is off by 6 %: the instrument among those named",
            LAYOUT,
            NOISE,
            GAUGE,
            Pointed("instrument"),
            TOLD,
            least=0.9,
        ),
    ),
    order=3,
)
