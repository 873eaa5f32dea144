"""Whether each parameter moves the readings by more than the instrument resolves."""

from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import TABLE_5_5, Truth, with_values

CHECK = "above resolution"
QUESTION = ("loaded-xy",)
LARGE = Truth(with_values(TABLE_5_5, C_XYX=5e-6, **{"E_C(0Y)X": 2e-5}))
ONE_NONE = Truth(with_values(TABLE_5_5, C_XYX=5e-6, **{"E_C(0Y)X": 0.0}))
RESOLUTION = 0.24e-3

STUDY = Study(
    CHECK,
    "It compares estimates with the stated resolution, here 0.24 um. It says nothing of scatter: where runs scatter "
    "by more than that, a "
    "parameter that is nothing seems larger, and only its U says so.",
    (
        *cells(
            CHECK,
            "every parameter moves the readings by 3 um or more",
            [*LOADED, "two runs"],
            NOISES,
            LARGE,
            question=QUESTION,
            resolution=RESOLUTION,
            most=0.05,
            share=0.12,
            short={("two runs", "white"): 12},
        ),
        *cells(
            CHECK,
            "the squareness is nothing",
            [*LOADED, "two runs"],
            ["white", "quantised"],
            ONE_NONE,
            question=QUESTION,
            resolution=RESOLUTION,
            least=0.95,
            share=0.3,
            short={("two runs", "white"): 12},
        ),
        *cells(
            CHECK,
            "the squareness is nothing",
            [*LOADED, "two runs"],
            ["autocorrelated", "of the run", "harmonic", "eccentricity"],
            ONE_NONE,
            question=QUESTION,
            resolution=RESOLUTION,
            share=0.3,
        ),
    ),
)
