"""Whether the residuals hold a structure that the stated uncertainty does not cover."""

from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import BALL_BAR, FOUR_LOBE, Truth

CHECK = "residuals without structure"
QUESTION = ("loaded-xy",)
ORDER_5 = ((5, 0.5e-3, 0.7),)

STUDY = Study(
    CHECK,
    "With an uncertainty by run, what differs from run to run is covered and no alarm; what runs share, or what grows "
    "with their "
    "force, is one: nominally 1 %. With one or two runs the uncertainty assumes independent readings, and any "
    "structure is a fault. "
    "A shared harmonic is seen once it is about three times what that order scatters from run to run (7 runs).",
    (
        *cells(
            CHECK,
            "nothing wrong",
            [*LOADED, "three pairs"],
            NOISES,
            most=0.01,
            share=0.35,
            short={("three pairs", "of the run"): 12, ("three pairs", "eccentricity"): 12},
        ),
        *cells(
            CHECK,
            "independent readings",
            ["two runs", "one run"],
            ["white", "quantised"],
            question=QUESTION,
            most=0.01,
            short={("two runs", "white"): 20},
        ),
        *cells(
            CHECK,
            "readings that are not independent",
            ["two runs"],
            ["autocorrelated"],
            question=QUESTION,
            least=0.95,
            short={("two runs", "autocorrelated"): 12},
        ),
        *cells(
            CHECK,
            "a four-lobe of -13.5 um cos² sin² in every run",
            LOADED,
            ["white", "autocorrelated", "of the run", "quantised", "eccentricity"],
            Truth(four_lobe=FOUR_LOBE),
            question=QUESTION,
            least=0.95,
            share=0.6,
            short={("7 runs", "of the run"): 4},
        ),
        *cells(
            CHECK,
            "a four-lobe of -13.5 um cos² sin² in every run",
            LOADED,
            ["harmonic"],
            Truth(four_lobe=FOUR_LOBE),
            question=QUESTION,
            share=0.6,
        ),
        *cells(
            CHECK,
            "order 5 of 0.5 um in every run",
            ["three pairs"],
            ["white", "autocorrelated", "of the run", "quantised", "eccentricity"],
            Truth(BALL_BAR, harmonics=ORDER_5),
            least=0.95,
            short={("three pairs", "white"): 6},
        ),
        *cells(CHECK, "order 5 of 0.5 um in every run", ["three pairs"], ["harmonic"], Truth(BALL_BAR, harmonics=ORDER_5)),
    ),
)
