"""Two tests of one machine: has anything changed?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from elastogeo.identification import compare, identify
from studies.bar_tests import LOADED, make_test
from studies.noise import NOISES
from studies.rates import Cell, Named, Study
from studies.truth import BALL_BAR, TABLE_5_5, Truth, with_values

CHECK = "unchanged"


@dataclass(frozen=True)
class Compared:
    """A test before, a test after."""

    layout: str
    noise: str
    before: Truth
    after: Truth
    question: tuple[str, ...]

    def draw(self, seed: tuple[int, ...]) -> object:
        """What `compare` says."""
        pair = ((self.before, (*seed, 0)), (self.after, (*seed, 1)))
        tests = (make_test(self.layout, truth, self.noise, drawn, question=self.question) for truth, drawn in pair)
        return compare(*map(identify, tests))


def pairs(
    truth: str,
    layouts: Iterable[str],
    noises: Iterable[str],
    after: Truth,
    short: Mapping[tuple[str, str], int] | None = None,
    share: float = 0.1,
    **wanted: float,
) -> Iterator[Cell]:
    for layout, noise in product(layouts, noises):
        bar = layout == "three pairs"
        question = ("ball-bar-xy",) if bar else ("loaded-xy",)
        sample = Compared(layout, noise, Truth(BALL_BAR) if bar else Truth(), after, question)
        few = (short or {}).get((layout, noise), 0)
        yield Cell(truth, layout, noise, sample, Named(CHECK), short=few, share=share, **wanted)


STUDY = Study(
    CHECK,
    "Nominally 5 %: each parameter by its share of it, all together by the surest. Systematic influences that both "
    "tests share count as "
    "independent, which makes it more cautious.",
    (
        *pairs("nothing changed", LOADED, NOISES, Truth(), most=0.05),
        *pairs(
            "nothing changed",
            ["three pairs"],
            NOISES,
            Truth(BALL_BAR),
            {("three pairs", "of the run"): 8},
            share=1.0,
            most=0.05,
        ),
        *pairs(
            "C_XXX has grown by 20 %: 9 um at 742 N",
            LOADED,
            NOISES,
            Truth(with_values(TABLE_5_5, C_XXX=1.2 * 6.19e-5)),
            least=0.95,
            share=0.25,
        ),
        *pairs(
            "backlash of X from 3 to 8 um",
            ["three pairs"],
            NOISES,
            Truth(with_values(BALL_BAR, B_XX=0.008)),
            {("three pairs", "white"): 6},
            share=1.0,
            least=0.95,
        ),
    ),
    order=2,
)
