"""Whether the geometry that adjacent force levels give changes with the force."""

from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import Truth

CHECK = "geometry constant"
QUESTION = ("loaded-xy",)
FALL = "a compliance that falls by 20 %, taken as constant"

STUDY = Study(
    CHECK,
    "Nominally 5 %. Each parameter is judged by its own scatter: with repeats any change, without repeats a trend "
    "with the force, by four "
    "degrees of freedom. A change of geometry that is really a compliance that is not constant is the realistic "
    "fault: 8 um at 742 N. "
    "Where runs scatter by 0.5 um in its own shape it is seen in part of the draws only; the choice of the model sees "
    "it better.",
    (
        *cells(CHECK, "nothing wrong", LOADED, NOISES, most=0.05, share=0.35, short={("7 runs", "of the run"): 6}),
        *cells(
            CHECK,
            FALL,
            LOADED,
            ["white", "autocorrelated", "quantised", "eccentricity"],
            Truth(softening=-0.2),
            question=QUESTION,
            least=0.95,
            share=0.6,
            short={("7 runs", "white"): 3},
        ),
        *cells(CHECK, FALL, LOADED, ["of the run", "harmonic"], Truth(softening=-0.2), question=QUESTION, share=0.6),
    ),
)
