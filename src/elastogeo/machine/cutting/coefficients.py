"""Cutting force coefficients of published experiments, for the mechanistic model of `milling`.

Every entry is one experiment with one tool and one material as it was bought: take it for a first look, and measure your
own. Source of all: Chinese Journal of Mechanical Engineering 34 (2021), doi 10.1186/s10033-021-00536-9, Table 5, which
collects them from the literature.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass
from math import isfinite
from types import MappingProxyType

from elastogeo.errors import InputError

_TABLE_5 = "Chin. J. Mech. Eng. 34 (2021), doi 10.1186/s10033-021-00536-9, Table 5"


@dataclass(frozen=True, slots=True)
class CuttingCoefficients:
    """How a cutting edge loads the tool: per area of the chip, and per length of the edge.

    Attributes
    ----------
    tangential, radial, axial : float [N/mm^2]
        Ktc, Krc, Kac.
    tangential_edge, radial_edge, axial_edge : float [N/mm]
        Kte, Kre, Kae.
    source : str
        Where the numbers come from.
    """

    tangential: float
    tangential_edge: float
    radial: float
    radial_edge: float
    axial: float = 0.0
    axial_edge: float = 0.0
    source: str = ""

    def __post_init__(self) -> None:
        """Refuse what is no number, and a tangential force that does not resist."""
        numbers = astuple(self)[:-1]
        if not all(map(isfinite, numbers)) or not self.tangential > 0:
            raise InputError(
                f"cutting force coefficients are {numbers}; all must be numbers, and the tangential one (N/mm^2) positive"
            )


def _of_table_5(
    tangential: float,
    tangential_edge: float,
    radial: float,
    radial_edge: float,
    axial: float = 0.0,
    axial_edge: float = 0.0,
) -> CuttingCoefficients:
    return CuttingCoefficients(tangential, tangential_edge, radial, radial_edge, axial, axial_edge, _TABLE_5)


COEFFICIENTS = MappingProxyType(
    {
        "Al6061-T6": _of_table_5(243.77, 7.53, 113.5, 7.83),
        "Al6082-T6": _of_table_5(631.0, 13.0, 99.0, 10.0, 273.0, 2.8),
        "Al7075": _of_table_5(1319.41, 19.65, 788.83, 26.77, 48.75, 2.05),
        "Al7075-HSS": _of_table_5(951.365, 11.115, 262.597, 11.314, 323.33, 1.105),
        "Al7075-T6": _of_table_5(767.01, 27.7, 168.8, 26.6, 222.0, 0.7),
        "Al7075-T6-planar": _of_table_5(600.46, 17.9, 180.96, 20.42),
        "AlMgSi0.5": _of_table_5(561.2, 204.3, 194.4, 16.2, 6.7, 2.2),
    }
)
"""By material; those with no axial coefficient in the source say nothing of the axial force."""


def coefficients_of(material: str) -> CuttingCoefficients:
    """The coefficients of a material that is listed.

    Raises
    ------
    InputError
        If it is not.
    """
    if material not in COEFFICIENTS:
        raise InputError(
            f"there are no cutting force coefficients of {material!r}; there are {', '.join(COEFFICIENTS)}. Give your own, "
            f"as tangential, radial and axial in N/mm^2 and N/mm"
        )
    return COEFFICIENTS[material]
