"""Tool and holder as the last compliant link: a stepped cantilever, or what was measured at its tip.

A cantilever that is clamped where the spindle ends gives way at its tip, at the distance x from there inwards, by Euler and
Bernoulli:

    per force across   d = int x^2 / (E I) dx,  turned by  int x / (E I) dx
    per moment across  turned by int 1 / (E I) dx
    per force along    d = int 1 / (E A) dx
    per moment along   turned by int 1 / (G J) dx

With a fluted end of length Lf and second moment If, and a shank Is up to L, the first is
`[Lf^3 / If + (L^3 - Lf^3) / Is] / (3 E)`. The fluted part counts with an equivalent diameter of about 0.8 D (Kops and Vo,
CIRP Annals 39 (1990) 93, of two and four teeth); shear, and what the clamping gives, are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, pi

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Array

FLUTED = 0.8
"""Equivalent diameter of the fluted part, as a share of the diameter of the mill (Kops and Vo 1990)."""

POISSON = 0.22
"""Of cemented carbide: it enters the twist about the axis only."""


@dataclass(frozen=True, slots=True)
class ToolSection:
    """A cylindrical part of tool or holder.

    Attributes
    ----------
    length, diameter : float [mm]
        The diameter is that of a full cylinder as stiff: of a fluted part about 0.8 of it.
    modulus : float [N/mm^2]
        Young's modulus: cemented carbide about 600e3, steel 210e3.
    """

    length: float
    diameter: float
    modulus: float

    def __post_init__(self) -> None:
        """Refuse what is no cylinder."""
        numbers = (self.length, self.diameter, self.modulus)
        if not all(isfinite(number) and number > 0 for number in numbers):
            raise InputError(
                f"a section of a tool is {self.length:g} mm long, {self.diameter:g} mm thick and has a modulus of "
                f"{self.modulus:g} N/mm^2; all must be positive"
            )


@dataclass(frozen=True, slots=True)
class HeldTool:
    """How far the tip of the tool gives way, relative to where the machine's own model ends.

    Attributes
    ----------
    matrix : array, shape (6, 6) [mm/N, rad/N, mm/(N mm), rad/(N mm)]
        In the frame of the last carriage of the tool branch, at the tip; z points from the tip to the holder.
    relative_uncertainty : float
        Standard uncertainty of all of it together, as a share.
    source : str
        Where it comes from, in words.
    """

    matrix: Array
    relative_uncertainty: float = 0.0
    source: str = ""

    def __post_init__(self) -> None:
        """Refuse what no tool is like."""
        if self.matrix.shape != (6, 6) or not np.isfinite(self.matrix).all():
            raise InputError("the compliance of a tool is a matrix of 6 x 6 finite numbers")
        scaled = self.matrix / np.outer([1, 1, 1, 100, 100, 100], [1, 1, 1, 100, 100, 100])
        if not np.allclose(scaled, scaled.T, rtol=1e-6, atol=1e-9 * np.abs(scaled).max()):
            raise InputError("the compliance of a tool is not symmetric, as reciprocity wants it; check its entries")
        if not 0 <= self.relative_uncertainty < 1:
            raise InputError(
                f"the relative uncertainty of the tool is {self.relative_uncertainty:g}; it is a share, from 0 to below 1"
            )


def cantilever(sections: Sequence[ToolSection], relative_uncertainty: float = 0.0) -> HeldTool:
    """The compliance at the tip of a stepped cantilever.

    Parameters
    ----------
    sections : sequence of ToolSection
        From the tip to where it is clamped.
    relative_uncertainty : float
        What is not known of it: equivalent diameter, clamping.

    Raises
    ------
    InputError
        If there is no section.
    """
    if not sections:
        raise InputError("a tool has at least one section; give its length, diameter and modulus")
    matrix = np.zeros((6, 6))
    start = 0.0
    for section in sections:
        end = start + section.length
        bending = section.modulus * pi * section.diameter**4 / 64
        twisting = section.modulus / (2 * (1 + POISSON)) * pi * section.diameter**4 / 32
        across, turned = (end**3 - start**3) / (3 * bending), (end**2 - start**2) / (2 * bending)
        matrix[[0, 1], [0, 1]] += across
        matrix[[0, 4, 1, 3], [4, 0, 3, 1]] += np.array([-1.0, -1.0, 1.0, 1.0]) * turned
        matrix[[3, 4], [3, 4]] += section.length / bending
        matrix[2, 2] += section.length / (section.modulus * pi * section.diameter**2 / 4)
        matrix[5, 5] += section.length / twisting
        start = end
    said = " + ".join(f"{s.length:g} mm of {s.diameter:g} mm" for s in sections)
    return HeldTool(matrix, relative_uncertainty, f"stepped cantilever, {said}")


def measured_tool(across: float, along: float = 0.0, relative_uncertainty: float = 0.0) -> HeldTool:
    """The compliance of tool and holder as it was measured at the tip, alike in all directions across.

    Parameters
    ----------
    across, along : float [mm/N]
    relative_uncertainty : float

    Raises
    ------
    InputError
        If one is negative.
    """
    if not (isfinite(across) and isfinite(along) and across >= 0 and along >= 0):
        raise InputError(f"the compliance of a tool is {across:g} across and {along:g} mm/N along; neither may be negative")
    return HeldTool(np.diag([across, across, along, 0.0, 0.0, 0.0]), relative_uncertainty, "measured at its tip")
