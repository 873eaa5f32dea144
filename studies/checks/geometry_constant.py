"""Whether one geometry holds at all forces: it follows from the model that the data support, so the two never disagree."""

from __future__ import annotations

from typing import Any

from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import FOUR_LOBE, Truth

CHECK = "geometry constant"


def contradicts(result: Any) -> str:
    """Whether a verdict says that the model lacks nothing, and yet that no geometry holds at all forces."""
    marks = {check.name: check.passed for check in result.verdict}
    return "contradiction" if marks["model adequate"] and marks[CHECK] is not True else "one voice"


STUDY = Study(
    CHECK,
    "It fails only where no model that was tried describes all levels with one geometry. What it says is the model's "
    "own consequence.",
    (
        *cells(CHECK, "one geometry", LOADED, NOISES, most=0.05, short={("7 runs", "white"): 12}),
        *cells(
            CHECK,
            "one geometry, every compliance falls by 20 %",
            LOADED,
            NOISES,
            Truth(softening=-0.2),
            most=0.05,
            share=0.25,
        ),
        *cells(
            CHECK,
            "one voice with `model adequate`, a four-lobe and a fall by 20 %",
            LOADED,
            NOISES,
            Truth(softening=-0.2, four_lobe=FOUR_LOBE),
            judge=contradicts,
            counted=("one voice",),
            least=1.0,
        ),
    ),
)
