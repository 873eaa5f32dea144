"""Simulated tests: the readings that an instrument would give on a machine whose parameters are known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from elastogeo.machine import Array, AxisCommands, Machine
from elastogeo.observe import Imperfection, MachineTest, Observations
from elastogeo.sources.catalogue import select_sources
from elastogeo.sources.response import exact_response, linear_response
from elastogeo.sources.source import Source


def parameter_values(machine: Machine, values: Mapping[str, float]) -> dict[Source, float]:
    """Values by source, of values by name.

    Raises
    ------
    SelectionError
        If the machine has no such error source.
    """
    return dict(zip(select_sources(machine, values), values.values(), strict=True))


def simulate(
    test: MachineTest,
    values: Mapping[str, float],
    imperfection: Imperfection | None = None,
    seed: int = 0,
    exact: bool = True,
    centre: AxisCommands | None = None,
) -> MachineTest:
    """The test with simulated readings in its runs, in the order in which they stand.

    Parameters
    ----------
    test : MachineTest
        Its runs need the column of poses (for a ball bar, `angle`); their readings are replaced.
    values : mapping of str to float
        True parameters by name.
    imperfection : Imperfection, optional
        Of the instrument; none by default.
    seed : int
        Of the random numbers.
    exact : bool
        By products of transforms, or to first order.
    centre : mapping of str to float, optional [mm, rad]
        Axis commands from which the polynomials of the true values count; of an axis not named, and by default, those of the
        test's own centre. **Tests with centres of their own are of one machine only with the same centre here**, where a
        true value is of the second degree or higher, or changes along the axis.

    Returns
    -------
    MachineTest
        Marked as simulated; its runs say their truth.
    """
    random = np.random.default_rng(seed)
    truth = parameter_values(test.machine, values)
    response = exact_response if exact else linear_response

    given = {test.machine.index(axis): value for axis, value in (centre or {}).items()}

    def respond(observations: Observations) -> Array:
        about = observations.centre.copy()
        about[list(given)] = list(given.values())
        return response(truth, test.machine, replace(observations, weight=test.workpiece, centre=about))

    instrument = imperfection or Imperfection()
    made = (test.setup.simulated(test.machine, run, respond, instrument, random) for run in test.runs)
    runs = tuple(replace(run, truth=dict(values)) for run in made)
    return replace(test, runs=runs, simulated=test.simulated or f"simulated with seed {seed}")
