"""What computing series again from their raw records found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from elastogeo.identification import Check
from elastogeo.result import Part, Result

SAME_AGAIN = "the same again"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Differing(Part):
    """One entry of a document that differs from the one that was kept.

    Attributes
    ----------
    path : str
        `parameters[3].value`.
    old, new : str
    relative : float
        Share of the number, or of the largest in its list; infinite for what is no number.
    """

    path: str
    old: str
    new: str
    relative: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class RecomputedTest(Part):
    """One test, computed again.

    Attributes
    ----------
    series : str
        Of machine and recipe.
    test : int
        Its key.
    name : str
    before : str
        Version of the software of the analysis that it is compared with; empty if there was none.
    now : str
        Version that computed it.
    same_bits : bool
        Whether the document is the same to the last bit.
    differing : tuple of Differing
        Entries beyond the tolerance, as they stand in the document.
    error : str
        Why there is no document now; empty if there is one.
    mended : bool
        Whether the same version failed before and has a document now: it is kept.
    """

    series: str
    test: int
    name: str
    before: str
    now: str
    same_bits: bool
    differing: tuple[Differing, ...] = ()
    error: str = ""
    mended: bool = False

    @property
    def is_compared(self) -> bool:
        """Whether it has to be the same: the same version computed it before."""
        return self.before == self.now and not self.mended


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Recomputed(Result):
    """Series that were computed again.

    Attributes
    ----------
    store : str
    tests : tuple of RecomputedTest
    switched : dict of str to tuple of (str, str)
        By series the version that its chart counted with, and the one it counts with now.
    changed : tuple of int
        Keys of the series whose charts are other ones now: they count with another version, or have a test more.
    verdict : tuple of Check
    """

    store: str
    tests: tuple[RecomputedTest, ...]
    switched: dict[str, tuple[str, str]]
    changed: tuple[int, ...]
    verdict: tuple[Check, ...]


def recomputed_same(tests: Sequence[RecomputedTest]) -> Check:
    """Whether what the same version computed before came out again: not tested where nothing was compared."""
    compared = [test for test in tests if test.is_compared]
    differing = [test for test in compared if test.differing]
    largest = max((entry.relative for test in differing for entry in test.differing), default=0.0)
    facts = {
        "compared": len(compared),
        "same_bits": sum(test.same_bits for test in compared),
        "differing": len(differing),
        "first": differing[0].name if differing else "",
        "path": differing[0].differing[0].path if differing else "",
        "largest": largest,
    }
    return Check(SAME_AGAIN, not differing if compared else None, facts, decisive=True)
