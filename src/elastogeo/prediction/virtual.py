"""Readings that no instrument takes: a prediction is linear in the parameters exactly as a reading is.

The displacement of the tool along a direction, at any pose under any load, is what an ideal sensor would read there. So
its dependence on the parameters is a row of the design, made by the same columns as every test's (Eq. 4.13); with a unit
force along a unit direction it is an entry of `C_t = J C J^T` (Eq. 4.10).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.machine import Array, Machine
from elastogeo.observe import Observations, check_observations
from elastogeo.sources import Source, design_rows


def virtual_observations(
    machine: Machine, commands: Array, direction: Array, wrench: Array, tool: Array | None = None
) -> Observations:
    """What an ideal sensor of displacement observes at poses under loads; its readings are zero.

    Parameters
    ----------
    machine : Machine
        With n joints.
    commands : array, shape (m, n) or (1, n) [mm, rad]
        Axis commands in the order of `machine.axes`.
    direction : array, shape (m, 6) or (1, 6)
        Unit twist of the tool relative to the workpiece that is asked for, in the foundation.
    wrench : array, shape (m, 6) or (1, 6) [N, N mm]
        On the tool at the functional point; its reaction acts on the workpiece.
    tool : array, shape (3,) [mm], optional
        Functional point in the last tool-branch frame, if not the machine's own.

    Raises
    ------
    InputError
        If a number is not finite.
    """
    commands, direction, wrench = (np.atleast_2d(given) for given in (commands, direction, wrench))
    count = max(len(commands), len(direction), len(wrench))
    commands = np.broadcast_to(commands, (count, len(machine.axes)))
    still, none = np.zeros(commands.shape), np.zeros(count)
    return check_observations(
        Observations(
            run="prediction",
            force=0.0,
            pose=np.arange(count, dtype=float),
            commands=commands,
            velocity=still,
            acceleration=still,
            centre=np.zeros(len(machine.axes)),
            direction=np.asfortranarray(np.broadcast_to(direction, (count, 6))),
            wrench=np.asfortranarray(np.broadcast_to(wrench, (count, 6))),
            reading=none,
            correction=none,
            tool=np.array(machine.tool, dtype=float) if tool is None else tool,
            workpiece=np.zeros(3),
        )
    )


def functionals(sources: Sequence[Source], machine: Machine, observations: Observations) -> Array:
    """How much each observation changes per unit of each parameter, shape (m, p)."""
    return np.asarray(design_rows(sources, machine, observations)[:, :-1])
