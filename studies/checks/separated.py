"""Whether compliance and geometry are separated: decisive, since one could be named for the other."""

from studies.bar_tests import LOADED
from studies.checks.forces_distinct import NEAR, QUESTION
from studies.noise import NOISES
from studies.rates import Study, cells

CHECK = "separated"

STUDY = Study(
    CHECK,
    "It depends on poses and forces alone. At one level, or at levels that are one within the force's uncertainty, "
    "the two are "
    "not separated whatever the readings.",
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
            CHECK, "one level", ["one run"], NOISES, question=QUESTION, least=1.0, share=0.3, short={("one run", "white"): 4}
        ),
        *cells(CHECK, "levels that are one", NEAR, ["white"], question=QUESTION, least=1.0, share=0.3),
    ),
)
