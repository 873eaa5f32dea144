'''The register of proposals: which tests an instrument could make with what there is.

To let `elastogeo plan` choose tests of an instrument, write one file in this wing with a function that registers itself. It
gives drafts without end: a `Candidate`, whose test has runs with poses and forces and readings of zero, or None for a draw
that does not fit. What its tests tell comes from the instrument itself. A complete one, `pushes.py`::

    """A push along z and a sensor beside it, anywhere in the travel."""

    import numpy as np

    from elastogeo.observe import MachineTest, Run, StaticForce
    from elastogeo.planning import Candidate, proposes


    @proposes("static-force")
    def pushes(means, random):
        while True:
            setup = StaticForce(direction=(0.0, 0.0, 1.0), pose=means.somewhere(random))
            columns = {"force": np.array(means.forces), "displacement": np.zeros(len(means.forces))}
            test = MachineTest("push", means.machine, setup, (Run("levels", columns),))
            yield Candidate("push", test, minutes=12.0)

`Means` says what there is (tools, forces, bars, the clearance) and draws places and turned axes within the travel.
'''

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from elastogeo.discovery import import_all
from elastogeo.errors import InputError
from elastogeo.planning.offers.candidate import Candidate
from elastogeo.planning.offers.means import Means

Draft = Candidate | None
"""A candidate, or None for a draw that is out of the travel or not clear."""

Propose = Callable[[Means, np.random.Generator], Iterator[Draft]]

_REGISTER: dict[str, Propose] = {}


def proposes(instrument: str) -> Callable[[Propose], Propose]:
    """Register the function that proposes tests of an instrument."""

    def register(propose: Propose) -> Propose:
        _REGISTER[instrument] = propose
        return propose

    return register


def proposals() -> dict[str, Propose]:
    """The proposals of all instruments that have one, by instrument; every file of this wing is looked at."""
    import_all(__name__.rpartition(".")[0])
    return dict(sorted(_REGISTER.items()))


def proposal_of(instrument: str) -> Propose:
    """The proposals of an instrument.

    Raises
    ------
    InputError
        If it has none.
    """
    known = proposals()
    if instrument not in known:
        raise InputError(f"no test of {instrument!r} can be planned; instruments that can: {', '.join(known)}")
    return known[instrument]
