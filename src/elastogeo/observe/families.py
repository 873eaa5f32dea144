"""Families of tests between tool and workpiece, by what they load and what they read."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from elastogeo.machine import Machine
from elastogeo.observe.observations import Observations

BAR, PROBES, SIX = "bar", "probes", "six"
"""A force and a reading along one line; forces and displacements in any direction; wrenches and twists."""

_ALONG = 1e-9


def family_of(machine: Machine, observations: Iterable[Observations]) -> str | None:
    """The narrowest family that tests belong to; None where something loads or reads elsewhere than tool and workpiece.

    Parameters
    ----------
    machine : Machine
        Carriages with a mass load the joints by themselves, which no family assumes.
    observations : iterable of Observations
        Of all runs. A probe across a joint, and a known weight on the table, belong to no family.
    """
    if any(joint.mass for joint in machine.joints):
        return None
    found = BAR
    for run in observations:
        if run.span is not None or (run.weight is not None and run.weight.mass):
            return None
        if run.wrench[:, 3:].any() or run.direction[:, 3:].any():
            return SIX
        across = np.cross(run.wrench[:, :3], run.direction[:, :3])
        if (np.abs(across) > _ALONG * np.abs(run.wrench).max(initial=0.0)).any():
            found = PROBES
    return found
