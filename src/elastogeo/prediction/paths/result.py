"""What is predicted of a tool path: frozen numbers; how they are written is decided in `report`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.estimate import coverage_factor
from elastogeo.identification import Check
from elastogeo.machine import Array, ToolPath
from elastogeo.prediction.knowledge import Flags
from elastogeo.prediction.paths.along import Rows
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False)
class PartOfDeviation(ByValue):
    """What a part of the machine, or of its faults, adds to the deviation; NaN where the tests do not tell it apart.

    Attributes
    ----------
    value : array, shape (k, 4) [mm]
        Along x, y, z of the workpiece and along the normal of the path.
    expanded : array, shape (k, 4) [mm]
        U: half the width of the 95 % interval.
    """

    value: Array
    expanded: Array

    @property
    def supported(self) -> Flags:
        """Whether the tests determine it, along all axes of the workpiece, shape (k,)."""
        return np.asarray(np.isfinite(self.value[:, :3]).all(axis=1))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class PathPrediction(Result):
    """How far the tool is off along a path: of the tool relative to the workpiece, along x, y, z of the workpiece.

    Attributes
    ----------
    name : str
        Of the test or campaign it rests on.
    path : ToolPath
    force : str
        Which force, in words; empty without one.
    tool : str
        Which tool and holder give way, in words; empty if they count as rigid.
    normal_to : str
        `left` or `right` of the travel: where along the normal counts as positive.
    datum : str
        `machine`: the workpiece sits as the machine says; `probed`: as the machine's probe finds it along the path.
    wrench : array, shape (m, 6) [N, N mm]
        On the tool, along the axes of the workpiece.
    value : array, shape (m, 4) [mm]
        Deviation along x, y, z and the normal: NaN where the tests do not support it and no prior was asked for, and along
        the normal where the tool moves along itself.
    standard_uncertainty, degrees_of_freedom : array, shape (m, 4)
        NaN where there is none.
    supported : array of bool, shape (m, 4)
    unsupported : array, shape (m, 4)
        Share of what is asked that no test sees; NaN where no parameter that was asked for moves the component.
    prior_share : array, shape (m, 4)
        Share of the variance that is the stated prior's.
    parts : mapping of str to PartOfDeviation
        `geometry` and `compliance` of the machine; `spindle side` and `workpiece side` of it; `tool`: tool and holder.
    split_at : array of int, shape (k,)
        The points at which the parts are given: all of a short path.
    verdict : tuple of Check
    simulated : str
        From what the readings of the tests are simulated, in words; empty if all were measured.
    """

    name: str
    path: ToolPath
    force: str
    tool: str
    normal_to: str
    datum: str
    wrench: Array
    value: Array
    standard_uncertainty: Array
    degrees_of_freedom: Array
    supported: Flags
    unsupported: Array
    prior_share: Array
    parts: Mapping[str, PartOfDeviation]
    split_at: Rows
    verdict: tuple[Check, ...]
    simulated: str = ""

    @property
    def expanded(self) -> Array:
        """Expanded uncertainty U, shape (m, 4) [mm]: half the width of the 95 % interval; NaN where there is none."""
        return expanded(self.standard_uncertainty, self.degrees_of_freedom)

    @property
    def asked(self) -> Flags:
        """Whether any parameter that was asked for moves a component, shape (m, 4); false for a normal that is none."""
        return np.asarray(np.isfinite(self.unsupported))

    @property
    def size(self) -> Array:
        """Length of the deviation, shape (m,) [mm], of the components that are predicted; NaN where none is."""
        known = np.isfinite(self.value[:, :3])
        length = np.linalg.norm(np.where(known, self.value[:, :3], 0.0), axis=1)
        return np.where(known.any(axis=1), length, np.nan)


def expanded(standard_uncertainty: Array, degrees_of_freedom: Array) -> Array:
    """Half the width of 95 % intervals; NaN where there is no uncertainty."""
    known = np.isfinite(standard_uncertainty)
    factor = coverage_factor(np.where(known, degrees_of_freedom, np.inf))
    return np.asarray(np.where(known, factor * standard_uncertainty, np.nan))
