"""Since when: the change point, by the likelihood of one step in the mean after the baseline. It never says whether."""

from __future__ import annotations

from dataclasses import dataclass

from elastogeo.result import Part


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ChangePoint(Part):
    """The first test after a change, as the likelihood has it, and those it may be as well.

    Attributes
    ----------
    test : str
        The likeliest first changed test.
    date : float [d]
        Of it.
    last_before : float [d]
        Date of the last test before it: the change lies between both.
    interval : tuple of 2 float [d]
        Between which dates it lies with 95 %: of the last test before the earliest that may be the first changed one, and of
        the latest that may be it.
    tests : tuple of str
        All that may be the first changed one.
    """

    test: str
    date: float
    last_before: float
    interval: tuple[float, float]
    tests: tuple[str, ...]
