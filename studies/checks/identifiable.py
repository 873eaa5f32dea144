"""Whether every parameter asked for is determined: a matter of columns, not of readings, so no noise may change it."""

from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells

CHECK = "identifiable"
PLANAR = ("planar-xy", "E_XX1", "E_YY1", "E_Xt0", "E_Yt0")
BOTH = ("elasto-geometric-xy", "E_R0")

STUDY = Study(
    CHECK,
    "It depends on poses and forces alone: the readings cannot make it alarm or keep it silent.",
    (
        *cells(CHECK, "all 13 determined", LOADED, NOISES, most=0.0, share=0.1, short={("7 runs", "white"): 4}),
        *cells(CHECK, "18 planar compliances, 6 determined", LOADED, ["white"], question=PLANAR, least=1.0, share=0.3),
        *cells(CHECK, "length of the bar beside both gains", LOADED, ["white"], question=BOTH, least=1.0, share=0.3),
        *cells(CHECK, "at one force", ["one run"], NOISES, least=1.0, share=0.3, short={("one run", "white"): 4}),
    ),
)
