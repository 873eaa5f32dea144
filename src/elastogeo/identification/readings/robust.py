"""The systems of a test with outlying readings counting less (Huber)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import huber_weights, solve
from elastogeo.identification.run_system import reweighted
from elastogeo.identification.systems import Systems, merged

_SETTLED = 1e-9
_STEPS = 100


def downweighted(systems: Systems, retained: Sequence[str]) -> Systems:
    """The same systems, whose factors hold each reading with its Huber weight.

    Parameters
    ----------
    systems : Systems
        No reference subtracted.
    retained : sequence of str
        Parameters that the residuals are those of.

    Raises
    ------
    UnsupportedError
        If a reference level is subtracted (its outliers are in every difference), or the weights do not settle.
    """
    if systems.references:
        raise UnsupportedError("a robust estimate needs the model without a reference level; leave reference_force out")
    systems = systems.holding(systems.runs[0].factor.labels)
    weighted, last = systems.runs, solve(merged(systems.runs), retained).values
    for _ in range(_STEPS):
        residual = [np.sqrt(run.precision) * (run.reading - run.design_of(retained) @ last) for run in weighted]
        weights = np.split(huber_weights(np.concatenate(residual)), np.cumsum([len(r) for r in residual])[:-1])
        weighted = tuple(reweighted(run, w) for run, w in zip(systems.runs, weights, strict=True))
        values = solve(merged(weighted), retained).values
        if (np.abs(values - last) <= _SETTLED * np.abs(values).clip(np.finfo(float).tiny)).all():
            return replace(systems, runs=weighted)
        last = values
    raise UnsupportedError(f"the robust weights did not settle in {_STEPS} steps; look at the plain residuals")
