"""Whether a level that does not follow the others is named, and none where all follow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from studies.bar_tests import LOADED
from studies.noise import NOISES
from studies.rates import Study, cells
from studies.truth import Truth

CHECK = "levels agree"
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
    "Each level is predicted from all others, at 2 % for all together. Under noise of the run of 0.5 um an offset and four "
    "more coefficients of a trace scatter by that much each, 1.1 um in all.",
    (
        *cells(CHECK, "all levels follow one model", LOADED, NOISES, most=0.02),
        *cells(
            CHECK,
            "490 N lies 3 um off",
            LOADED,
            NOISES,
            Truth(off_level=((OFF, 3e-3, 0),)),
            judge=NamesLevel(OFF),
            counted=("this level",),
            least=0.6,
            short={("15 runs", "white"): 6},
        ),
    ),
)
