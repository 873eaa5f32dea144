"""The rule by which a test is suspect: how many false alarms it may make, what it asks for, when it says nothing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from elastogeo.errors import InputError
from elastogeo.machine import Array

CHARTS = 2
"""Of each indicator: one for this test, one for the running mean."""


@dataclass(frozen=True, slots=True)
class Rule:
    """When a test is suspect, and when a repeat confirms it.

    Attributes
    ----------
    alpha : float
        Probability that a test of a machine that has not changed is suspect, all its indicators and both charts together.
    smoothing : float
        Share of the newest test in the running mean.
    confirm : float
        Share of the limit that a repeat must pass, on the same side.
    least_baseline : int
        Tests of a baseline below which no test is suspect.
    wait : float [d]
        For the repeat of a suspect test. Without one the suspect test is an alarm that nothing confirmed.

    Raises
    ------
    InputError
        If a number is out of its range.
    """

    alpha: float = 0.005
    smoothing: float = 0.4
    confirm: float = 0.8
    least_baseline: int = 6
    wait: float = 7.0

    def __post_init__(self) -> None:
        shares = {"alpha": self.alpha, "smoothing": self.smoothing, "confirm": self.confirm}
        for name, share in shares.items():
            if not 0 < share <= 1:
                raise InputError(f"{name} of a rule is {share}; give a share above 0 and up to 1")
        if self.least_baseline < 2:
            raise InputError(f"a baseline of {self.least_baseline} tests shows no scatter; take 2 or more, 6 is usual")
        if not self.wait >= 0:
            raise InputError(f"the repeat of a suspect test is waited for {self.wait} days; give 0 or more")

    def limit(self, degrees_of_freedom: Array, indicators: Array) -> Array:
        """Of |T|, for each indicator: Student's t at 1 - alpha / (4 q), two charts and two sides of q indicators.

        Parameters
        ----------
        degrees_of_freedom : array, shape (..., q)
            Of the scatter between tests.
        indicators : array, shape (..., 1)
            How many indicators the test determines; where there are none the limit is infinite.
        """
        number = np.asarray(indicators)
        limit = np.full(np.broadcast_shapes(np.shape(degrees_of_freedom), number.shape), np.inf)
        for q in np.unique(number[number > 0]):
            one = -stdtrit(degrees_of_freedom, self.alpha / (2 * CHARTS * q))
            limit = np.where(number == q, one, limit)
        return limit
