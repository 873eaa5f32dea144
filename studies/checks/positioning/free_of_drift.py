"""Cycles of a positioning test: do they go one way?"""

from studies.positioning_samples import positioned
from studies.rates import Study

CHECK = "free of drift"
NOISES = ("white", "of the cycle", "quantised")

STUDY = Study(
    CHECK,
    "Student's t of the trend of the means of the cycles, at 1 %: with five cycles it has three degrees of freedom, so a "
    "drift must stand out. Noises of its own: white of 0.4 um, which is in all; a zero of each cycle of 1 um; steps of "
    "1 um.",
    (
        *positioned(CHECK, "nothing wrong", NOISES, short=10, most=0.01),
        *positioned(CHECK, "each cycle is 1 um off the one before", ("white", "quantised"), drift=1e-3, short=5, least=0.95),
        *positioned(CHECK, "each cycle is 6 um off the one before", ("of the cycle",), drift=6e-3, least=0.95),
    ),
    order=2,
)
