"""The kinds of indicator: what is watched, by how much it scatters between tests, and from when on a change matters."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Kind:
    """What indicators of one kind have in common.

    Attributes
    ----------
    name : str
    unit : str
        Of its values, in the units of the house.
    reproducibility : float
        Standard deviation between tests of one recipe that is expected before a fleet says better.
    relevance : float
        Least change that matters; a smaller one is no alarm, however significant.
    relative : bool
        Whether both count as a share of the mean of the baseline instead of in `unit`.
    """

    name: str
    unit: str
    reproducibility: float
    relevance: float
    relative: bool = False


KINDS = {
    kind.name: kind
    for kind in (
        Kind("stiffness", "N/mm", 0.015, 0.03, relative=True),
        Kind("squareness", "rad", 2e-6, 3e-6),
        Kind("scale", "mm/mm", 4e-6, 6e-6),
        Kind("straightness", "mm", 0.5e-3, 1e-3),
        Kind("backlash", "mm", 0.5e-3, 1e-3),
        Kind("circular deviation", "mm", 1e-3, 2e-3),
        Kind("positioning", "mm", 1e-3, 2e-3),
        Kind("angular backlash", "rad", 5e-6, 1e-5),
        Kind("angular positioning", "rad", 5e-6, 1e-5),
        *(Kind(f"friction, {unit}", unit, 0.05, 0.15, relative=True) for unit in ("A", "N mm", "N", "%")),
    )
}
"""By name. Positioning scatters as a circle does, by temperature; 5 urad is one second, to which a rotary table repeats.
Coulomb friction follows lubrication and warmth by several per cent from day to day; wear or jamming changes it by more."""
