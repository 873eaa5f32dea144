"""Whether a machine is stiff enough: the decision rule of ISO 14253-1, with the expanded uncertainty as guard band.

A compliance conforms if it is below its limit by U at least, and does not conform if it is above by more than U; in
between, and where nothing is known, the measurement does not decide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.machine import Array

CONFORMS, UNDECIDED, FAILS = 1, 0, -1


@dataclass(frozen=True, slots=True, eq=False)
class Acceptance(ByValue):
    """What is decided of each place.

    Attributes
    ----------
    limit : float [mm/N]
        Greatest compliance that is allowed.
    decided : array of int
        Of each place: 1 conforms, 0 not decided, -1 does not conform.
    """

    limit: float
    decided: NDArray[np.int8]

    @property
    def conforming(self) -> int:
        """How many places conform."""
        return int(np.sum(self.decided == CONFORMS))

    @property
    def failing(self) -> int:
        """How many do not."""
        return int(np.sum(self.decided == FAILS))

    @property
    def undecided(self) -> int:
        """Of how many nothing is decided."""
        return int(np.sum(self.decided == UNDECIDED))

    @property
    def passed(self) -> bool | None:
        """Of the whole: True if every place conforms, False if one does not, else None."""
        return False if self.failing else None if self.undecided else True


def accepted(compliance: Array, expanded: Array, least_stiffness: float) -> Acceptance:
    """What is decided of compliances.

    Parameters
    ----------
    compliance, expanded : array [mm/N]
        Values and U of 95 %, NaN where there is none.
    least_stiffness : float [N/mm]

    Raises
    ------
    InputError
        If the limit is no positive number.
    """
    if not (np.isfinite(least_stiffness) and least_stiffness > 0):
        raise InputError(f"the limit is a stiffness of {least_stiffness:g} N/mm; give a positive number")
    limit = 1.0 / least_stiffness
    conforms, fails = compliance + expanded <= limit, compliance - expanded > limit
    decided = np.where(conforms, CONFORMS, np.where(fails, FAILS, UNDECIDED)).astype(np.int8)
    return Acceptance(limit, decided)
