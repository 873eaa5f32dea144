"""Whether the retained parameters are far enough from one another: a matter of the levels, not of the readings."""

from studies.bar_tests import LOADED, Layout
from studies.rates import Study, cells

CHECK = "conditioned"
QUESTION = ("elasto-geometric-xy",)
CLOSE = {"616 and 742 N, four times each": Layout((616.0, 742.0) * 4)}

STUDY = Study(
    CHECK,
    "It depends on poses and forces alone: the scaled condition number is 4 at (36, 742) N and 35 at (616, 742) N; "
    "the limit is 30.",
    (
        *cells(
            CHECK,
            "levels far apart",
            [*LOADED, "two runs"],
            ["white"],
            question=QUESTION,
            most=0.0,
            share=0.1,
            short={("two runs", "white"): 4},
        ),
        *cells(
            CHECK,
            "adjacent levels",
            CLOSE,
            ["white"],
            question=QUESTION,
            least=1.0,
            share=0.3,
            short={("616 and 742 N, four times each", "white"): 2},
        ),
    ),
)
