"""Whether a level that does not follow the others is named, and none where all follow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from studies.bar_tests import LOADED, SET_ANEW
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import Truth

CHECK = "levels agree"
LAYOUTS, ALL_NOISES = (*LOADED, "8 runs"), (*NOISES, SET_ANEW)
OFF = 490.0


@dataclass(frozen=True)
class NamesLevel:
    """Judge: which level is named."""

    force: float

    def __call__(self, result: Any) -> str:
        """`this level`, `another level` or `no level`."""
        off = None if result.models is None else result.models.off_level
        return "no level" if off is None else "this level" if off.force == self.force else "another level"


STUDY = Study(
    CHECK,
    "Each level is predicted from all others, at 2 % for all together: over all orders, and order by order. Under noise of "
    "the run of 0.5 um an offset and four more coefficients of a trace scatter by that much each, 1.1 um in all. A force "
    "that is set anew is taken to scatter by 0.2 %, by what is stated, or by more if the runs show it.",
    (
        *cells(CHECK, "all levels follow one model", LAYOUTS, ALL_NOISES, most=0.02),
        *cells(
            CHECK,
            "490 N lies 3 um off",
            LAYOUTS,
            ALL_NOISES,
            Truth(off_level=((OFF, 3e-3, 0),)),
            judge=NamesLevel(OFF),
            counted=("this level",),
            least=0.6,
            short={("15 runs", "white"): 6},
        ),
    ),
)
