"""Whether the intervals to first order hold as many random draws as they should."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from elastogeo.identification import identify
from elastogeo.observe import KnownInfluence
from studies.bar_tests import make_test
from studies.rates import Cell, Named, Study

CHECK = "first order enough"
QUESTION = ("C_XXX", "C_YYY", "E_XX1", "E_YY1", "E_C(0Y)X")
FORCE = KnownInfluence("force-scale", "gauge", relative=0.01)
LENGTH = KnownInfluence("bar-length", "bar", length=1e-3)
RULING = KnownInfluence("bar-length", "bar", length=0.01, distribution="rectangular")
COARSE = KnownInfluence("force-scale", "gauge", relative=0.15)


@dataclass(frozen=True)
class Influenced:
    """A test that states influences, identified with its random draws."""

    layout: str
    noise: str
    influences: tuple[KnownInfluence, ...]

    def draw(self, seed: tuple[int, ...]) -> object:
        """The result of `identify`."""
        return identify(
            replace(make_test(self.layout, None, self.noise, seed, question=QUESTION), influences=self.influences)
        )


def stated(truth: str, influences: tuple[KnownInfluence, ...], short: int = 0, **wanted: float) -> Iterator[Cell]:
    for layout in ("7 runs",):
        for noise in ("white", "of the run", "harmonic"):
            few = short if (layout, noise) == ("7 runs", "of the run") else 0
            yield Cell(
                truth,
                layout,
                noise,
                Influenced(layout, noise, influences),
                Named(CHECK),
                short=few,
                share=0.06 if wanted.get("most") else 0.12,
                **wanted,
            )


STUDY = Study(
    CHECK,
    "The interval must leave 2.5 % of the draws on either side, to within half of that. What makes it fail is an influence "
    "that is not normal, or not small, and rules; few degrees of freedom do not.",
    (
        *stated("1 % of force and 1 um of bar length, normal", (FORCE, LENGTH), short=1, most=0.05),
        *stated("10 um of bar length, rectangular, rules the gains", (RULING,), short=1, least=0.95),
        *stated("15 % of force, normal: the model is not linear in it", (COARSE,), least=0.95),
    ),
    order=1,
)
