"""Whether the runs are at forces that differ: what counts as one level must not depend on which check looks."""

from studies.bar_tests import LOADED, Layout
from studies.rates import Study, cells

CHECK = "forces distinct"
QUESTION = ("loaded-xy",)
NEAR = {
    "490 and 490.4 N": Layout((490.0, 490.4, 490.0, 490.4)),
    "490.0 to 491.2 N by 0.4 N": Layout((490.0, 490.4, 490.8, 491.2)),
    "364 N five times": Layout((364.0,) * 5),
}

STUDY = Study(
    CHECK,
    "It depends on the forces and their uncertainty alone. Levels nearer than the force is known are one level.",
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
            "one level",
            ["one run"],
            ["white"],
            question=QUESTION,
            least=1.0,
            share=0.3,
            short={("one run", "white"): 4},
        ),
        *cells(CHECK, "levels that are one", NEAR, ["white"], question=QUESTION, least=1.0, share=0.3),
    ),
)
