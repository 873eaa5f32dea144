"""The parameters of a positioning test: do they say what the means by target say?"""

from studies.positioning_samples import positioned
from studies.rates import Study

CHECK = "error motion followed"
SOUND = "a polynomial of the third degree and a reversal"
NOISES = ("white", "of the cycle", "quantised")

STUDY = Study(
    CHECK,
    "F of the lack of fit against the scatter of the cycles, at 1 %. Rounding repeats in all cycles, so that it is lack of "
    "fit too, and is shown as it comes. Noises of its own: white of 0.4 um, which is in all; a zero of each cycle of 1 um; "
    "steps of 1 um.",
    (
        *positioned(
            CHECK, "a polynomial of the third degree and a reversal", ("white", "of the cycle"), short=10, most=0.01
        ),
        *positioned(CHECK, "a polynomial of the third degree and a reversal", ("quantised",)),
        *positioned(CHECK, "a periodic error of 37 mm, 1 um", NOISES, wave=1e-3, short=5, least=0.95),
    ),
    order=2,
)
