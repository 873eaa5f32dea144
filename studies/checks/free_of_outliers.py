"""Whether a robust estimate meets readings that noise does not make."""

from elastogeo.observe import Question
from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import Truth

CHECK = "free of outliers"
QUESTION = Question(("loaded-xy",), robust=True)
OFF = (0.005, 5e-3)

STUDY = Study(
    CHECK,
    "Asked of robust estimates only. A reading six robust standard deviations off is an outlier; scatter that differs "
    "much from run to run "
    "can look like it. A spike is found where it is six times what the runs leave, 0.1 to 0.7 um here.",
    (
        *cells(
            CHECK,
            "nothing wrong",
            [*LOADED, "two runs"],
            NOISES,
            question=QUESTION,
            most=0.05,
            share=0.12,
            short={("two runs", "white"): 10},
        ),
        *cells(
            CHECK,
            "one reading in 200 is off by 5 um",
            [*LOADED, "two runs"],
            NOISES,
            Truth(outliers=(0.02, 5e-3)),
            question=QUESTION,
            least=0.95,
            share=0.3,
            short={("two runs", "white"): 8},
        ),
    ),
)
