"""Simulated tests: the readings that an instrument would give on a machine whose parameters are known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from elastogeo.machine import Machine
from elastogeo.observe import Imperfection, MachineTest, Run
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

    Returns
    -------
    MachineTest
        Marked as simulated.
    """
    random = np.random.default_rng(seed)
    truth = parameter_values(test.machine, values)
    runs = tuple(_simulated(test, run, truth, imperfection or Imperfection(), random, exact) for run in test.runs)
    return replace(test, runs=runs, simulated=test.simulated or f"simulated with seed {seed}")


def _simulated(
    test: MachineTest,
    run: Run,
    truth: Mapping[Source, float],
    imperfection: Imperfection,
    random: np.random.Generator,
    exact: bool,
) -> Run:
    pose, quantity = test.setup.quantities
    at = run.columns[pose]
    blank = replace(run, columns={pose: at, quantity: np.zeros(len(at))})
    observations = test.setup.observe(test.machine, blank)
    pushed = replace(observations, wrench=observations.wrench * imperfection.force_factor(random))
    response = (exact_response if exact else linear_response)(truth, test.machine, pushed)
    # What the instrument's set-up corrections will take off is what the raw reading has on top.
    raw = response - observations.reading
    return replace(run, columns={pose: at, quantity: imperfection.added_to(raw, at, observations.force, random)})
