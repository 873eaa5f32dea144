"""Whether the uncertainty comes from the scatter of runs."""

from studies.bar_tests import LOADED
from studies.rates import Study, cells

CHECK = "uncertainty by run"
QUESTION = ("loaded-xy",)

STUDY = Study(
    CHECK,
    "It depends on how many runs there are and where. With one or two no uncertainty by run can be had.",
    (
        *cells(
            CHECK,
            "enough runs",
            [*LOADED, "three pairs"],
            ["white"],
            most=0.0,
            share=0.1,
            short={("three pairs", "white"): 4},
        ),
        *cells(
            CHECK,
            "too few runs",
            ["two runs", "one run"],
            ["white"],
            question=QUESTION,
            least=1.0,
            share=0.3,
            short={("two runs", "white"): 4, ("one run", "white"): 4},
        ),
    ),
)
