"""Forces on an end mill, by the mechanistic model: each length of edge is loaded by its chip and by its own rubbing.

After Altintas, Manufacturing Automation, chapter 2. The feed is along +x; an edge stands at the angle phi from +y, clockwise
seen from the holder, as the mill turns (M3). Its chip is `h = c sin(phi)` thick, and on a length dz of it act

    dFt = (Ktc h + Kte) dz   against its motion,
    dFr = (Krc h + Kre) dz   towards the axis of the mill,
    dFa = (Kac h + Kae) dz   along it,

on the mill, so that dFx = -dFt cos(phi) - dFr sin(phi), dFy = dFt sin(phi) - dFr cos(phi), dFz = dFa. An edge of helix angle
b lags by `z tan(b) / R` at the height z. **The sign of Fz is a convention of the coefficients, not of the machine**: a
right-hand helix with positive Kac draws the mill out of its holder (see `forces.MillingForce`).

These are forces of a mill and a workpiece that do not give way and do not vibrate; how a deflection changes the chip is left
out.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, cos, isfinite, pi, sin, tan

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Array
from elastogeo.machine.cutting.coefficients import CuttingCoefficients

SLICES = 400
"""Heights at which the edges are cut, if the helix is to be seen."""


@dataclass(frozen=True, slots=True)
class Mill:
    """A cylindrical end mill.

    Attributes
    ----------
    diameter : float [mm]
    teeth : int
    helix : float [rad]
    run_out : float [mm]
        Distance of the axis of the mill from the axis of rotation.
    run_out_angle : float [rad]
        From the first tooth to the direction in which the axis is off, in the direction of rotation.
    """

    diameter: float
    teeth: int
    helix: float = 0.0
    run_out: float = 0.0
    run_out_angle: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no mill."""
        if not (isfinite(self.diameter) and self.diameter > 0 and self.teeth >= 1):
            raise InputError(f"a mill of {self.diameter:g} mm with {self.teeth} teeth is none; both must be positive")
        if not 0 <= self.helix < pi / 2:
            raise InputError(f"the helix is {np.degrees(self.helix):g} degrees; it lies from 0 to below 90")
        if not 0 <= self.run_out < self.diameter / 2:
            raise InputError(f"the run-out is {self.run_out * 1e3:g} um; it lies from 0 to below the radius of the mill")

    @property
    def offsets(self) -> Array:
        """By how much each tooth reaches farther out than the mean, shape (teeth,) [mm] (Kline and DeVor 1983)."""
        angles = self.run_out_angle - 2 * pi * np.arange(self.teeth) / self.teeth
        return np.asarray(self.run_out * np.cos(angles))


@dataclass(frozen=True, slots=True)
class Engagement:
    """Where a mill cuts.

    Attributes
    ----------
    depth : float [mm]
        Along the axis.
    entry, exit : float [rad]
        Angles at which an edge enters and leaves the cut, from 0 to pi.
    """

    depth: float
    entry: float = 0.0
    exit: float = pi

    def __post_init__(self) -> None:
        """Refuse an engagement that is none."""
        if not (isfinite(self.depth) and self.depth > 0):
            raise InputError(f"the axial depth of cut is {self.depth:g} mm; it must be positive")
        if not 0 <= self.entry < self.exit <= pi:
            raise InputError(
                f"the edges enter at {np.degrees(self.entry):g} and leave at {np.degrees(self.exit):g} degrees; give "
                f"0 <= entry < exit <= 180, counted from the left of the feed, clockwise"
            )


def engagement_of(depth: float, width: float, diameter: float, material: str = "right") -> Engagement:
    """The engagement of a radial depth of cut.

    Parameters
    ----------
    depth, width : float [mm]
        Along the axis, and across the feed; a width of the whole diameter is a slot.
    diameter : float [mm]
    material : {"right", "left"}
        Where the material is, seen along the feed: on the right the mill climbs (it leaves with no chip), on the left it
        cuts conventionally.

    Raises
    ------
    InputError
        If the width is none of this mill, or the side none.
    """
    if not 0 < width <= diameter:
        raise InputError(f"the radial depth of cut is {width:g} mm; it lies above 0 and up to the diameter, {diameter:g} mm")
    over = acos(1 - 2 * width / diameter)
    if material == "right":
        return Engagement(depth, pi - over, pi)
    if material == "left":
        return Engagement(depth, 0.0, over)
    raise InputError(f"the material is on the side {material!r}; write left or right, seen along the feed")


def mean_force(edge: CuttingCoefficients, teeth: int, engagement: Engagement, feed_per_tooth: float) -> Array:
    """Mean force on the mill over a turn, shape (3,) [N]: closed form, the same for every helix, without run-out.

    Parameters
    ----------
    edge : CuttingCoefficients
    teeth : int
    engagement : Engagement
    feed_per_tooth : float [mm]
    """
    depth, c = engagement.depth, feed_per_tooth

    def until(phi: float) -> Array:
        chip, rub = teeth * depth * c / (8 * pi), teeth * depth / (2 * pi)
        return np.array(
            [
                chip * (edge.tangential * cos(2 * phi) - edge.radial * (2 * phi - sin(2 * phi)))
                + rub * (-edge.tangential_edge * sin(phi) + edge.radial_edge * cos(phi)),
                chip * (edge.tangential * (2 * phi - sin(2 * phi)) + edge.radial * cos(2 * phi))
                - rub * (edge.tangential_edge * cos(phi) + edge.radial_edge * sin(phi)),
                rub * (-edge.axial * c * cos(phi) + edge.axial_edge * phi),
            ]
        )

    return until(engagement.exit) - until(engagement.entry)


def forces_over_a_turn(
    edge: CuttingCoefficients,
    mill: Mill,
    engagement: Engagement,
    feed_per_tooth: float,
    angles: Array,
    slices: int = SLICES,
) -> Array:
    """Force on the mill while it turns, shape (k, 3) [N]: all edges over all heights, with helix and run-out.

    Where a tooth runs out, its chip is what the deepest of the teeth before it have left: the least of
    `m c sin(phi) + offset_j - offset_(j-m)` over m = 1, 2, ... teeth, none where it is negative.

    Parameters
    ----------
    edge : CuttingCoefficients
    mill : Mill
    engagement : Engagement
    feed_per_tooth : float [mm]
    angles : array, shape (k,) [rad]
        Of the tip of the first tooth, growing as the mill turns.
    slices : int
        Heights that stand for the whole depth.
    """
    heights = (np.arange(slices) + 0.5) / slices * engagement.depth
    lag = heights * tan(mill.helix) / (mill.diameter / 2)
    teeth = np.arange(mill.teeth)
    offsets = mill.offsets
    total = np.zeros((len(angles), 3))
    for j in teeth:
        phi = np.mod(angles[:, np.newaxis] + 2 * pi * j / mill.teeth - lag, 2 * pi)
        before = [m * feed_per_tooth * np.sin(phi) + offsets[j] - offsets[j - m] for m in range(1, mill.teeth + 1)]
        chip = np.min(before, axis=0)
        cuts = (phi >= engagement.entry) & (phi <= engagement.exit) & (chip > 0)
        chip = np.where(cuts, chip, 0.0)
        tangential = edge.tangential * chip + edge.tangential_edge * cuts
        radial = edge.radial * chip + edge.radial_edge * cuts
        total[:, 0] += np.sum(-tangential * np.cos(phi) - radial * np.sin(phi), axis=1)
        total[:, 1] += np.sum(tangential * np.sin(phi) - radial * np.cos(phi), axis=1)
        total[:, 2] += np.sum(edge.axial * chip + edge.axial_edge * cuts, axis=1)
    return total * (engagement.depth / slices)
