"""Candidates: tests of the instruments that there are, drawn within the travel and clear of collisions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import Means
from elastogeo.planning.offers.proposal import proposal_of

TRIES = 60
"""Draws for each candidate that is wanted before the generator gives up."""


def candidates(
    means: Means, instruments: Sequence[str] = ("loaded-ball-bar",), count: int = 400, seed: int = 1
) -> tuple[Candidate, ...]:
    """Tests that could be made, of each instrument as many.

    Parameters
    ----------
    means : Means
    instruments : sequence of str
        Under the names that test files use.
    count : int
        Of all instruments together.
    seed : int
        Of the draws: the same gives the same candidates.

    Raises
    ------
    InputError
        If an instrument proposes no tests.
    UnsupportedError
        If an instrument finds none within the travel that keeps clear.
    """
    found: list[Candidate] = []
    for k, instrument in enumerate(dict.fromkeys(instruments)):
        share = len(range(k, count, len(set(instruments))))
        random = np.random.default_rng([seed, k])
        own: list[Candidate] = []
        for tried, draft in enumerate(proposal_of(instrument)(means, random)):
            if draft is not None:
                own.append(replace(draft, name=f"{draft.name}_{len(own) + 1}"))
            if len(own) >= share or tried >= TRIES * share:
                break
        if not own:
            raise UnsupportedError(
                f"no test of {instrument} fits into the travel of {means.machine.name!r} and keeps clear of spindle and "
                f"table; take a shorter bar, a smaller clearance cone, or another tool"
            )
        found += own
    return tuple(found)
