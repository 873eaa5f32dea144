"""What a map of the compliance at the tool says: frozen numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elastogeo.equality import ByValue
from elastogeo.estimate import Estimate
from elastogeo.identification import Check
from elastogeo.machine import Array
from elastogeo.observe import Campaign
from elastogeo.prediction.maps.acceptance import Acceptance
from elastogeo.prediction.maps.design import AgainstDesign
from elastogeo.prediction.maps.places import Grid
from elastogeo.prediction.tool_compliances import ToolCompliance
from elastogeo.result import Result

Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Place(ByValue):
    """One place of a map.

    Attributes
    ----------
    index : tuple of int
        In the grid.
    commands : array, shape (n,) [mm, rad]
    compliance : Estimate [mm/N]
        Along the direction of the map there; without known uncertainty where the runs are too few.
    at_tool : ToolCompliance
        All of the compliance there.
    """

    index: tuple[int, ...]
    commands: Array
    compliance: Estimate
    at_tool: ToolCompliance


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ComplianceMap(Result):
    """The compliance at the tool over the volume.

    **Compliances that were not asked for count as rigid** (`rigid`); where the tests do not support it there is no number,
    unless a prior was asked for.

    Attributes
    ----------
    campaign : Campaign
        The tests that it rests on.
    grid : Grid
        The arrays below have its shape.
    tool : array, shape (3,) [mm]
        Functional point in the last tool-branch frame.
    direction : array, shape (3,), or None
        Along which a force acts and the displacement counts, in the foundation; None for the softest at each place.
    compliance : array [mm/N]
        NaN where not supported.
    expanded : array [mm/N]
        U of 95 %; NaN where there is none.
    supported : array of bool
    unsupported : array
        Share of what is asked that no test sees, 0 to 1.
    prior_share : array
        Share of the variance that is the stated prior's.
    directions : array, shape (..., 3)
        The softest direction of each place, or `direction`.
    prior : bool
        Whether the stated prior was asked for.
    by_run : bool
        Whether the runs are enough for an uncertainty.
    stiffest, softest : Place or None
        The best place and the worst; None where nothing is known.
    corners : tuple of Place
        The corners of the grid and its middle, where something is known.
    difference : Estimate or None [mm/N]
        By how much the worst place is softer than the best.
    acceptance : Acceptance or None
        Against a limit, if one was given.
    design : AgainstDesign or None
        Against design or finite elements, if any was given.
    rigid : tuple of str
        Compliances of joints and places that were not asked for.
    verdict : tuple of Check
    """

    campaign: Campaign
    grid: Grid
    tool: Array
    direction: Array | None
    compliance: Array
    expanded: Array
    supported: Flags
    unsupported: Array
    prior_share: Array
    directions: Array
    prior: bool
    by_run: bool
    stiffest: Place | None
    softest: Place | None
    corners: tuple[Place, ...]
    difference: Estimate | None
    acceptance: Acceptance | None
    design: AgainstDesign | None
    rigid: tuple[str, ...]
    verdict: tuple[Check, ...]

    @property
    def share_supported(self) -> float:
        """Share of the places where the tests support it, 0 to 1."""
        return float(np.mean(self.supported))

    @property
    def stiffness(self) -> Array:
        """Its inverse [N/mm], NaN where the compliance is not positive."""
        positive = self.compliance > 0
        return np.where(positive, 1.0 / np.where(positive, self.compliance, 1.0), np.nan)
