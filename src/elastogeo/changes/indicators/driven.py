"""Of feed drives: the Coulomb friction of each axis, which jamming, preload and lubrication change."""

from __future__ import annotations

from collections.abc import Iterator

from elastogeo.changes.indicators.register import indicates
from elastogeo.changes.kinds import KINDS
from elastogeo.changes.series import Indicator
from elastogeo.identification import DriveIdentification


@indicates(DriveIdentification)
def of_feed_drives(result: DriveIdentification) -> tuple[Indicator, ...]:
    """By axis, where it is told from all other terms."""
    return tuple(_friction(result))


def _friction(result: DriveIdentification) -> Iterator[Indicator]:
    for axis in result.axes:
        for parameter in axis.parameters:
            kind = KINDS.get(f"friction, {axis.effort_unit}")
            if parameter.name == "coulomb" and kind is not None and set(parameter.stands_for) == {"coulomb"}:
                yield Indicator(
                    f"friction {axis.axis}", kind, parameter.estimate.value, parameter.estimate.standard_uncertainty
                )
