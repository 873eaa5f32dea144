"""The stiffness at the tool that joint compliances amount to, in words and numbers: collinear stiffness values (2.7)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any

from elastogeo.errors import UnsupportedError
from elastogeo.estimate import Estimate
from elastogeo.identification import CollinearStiffness, Identification, Principal, StiffnessScrew
from elastogeo.machine import Array
from elastogeo.prediction import collinear_stiffness_of
from elastogeo.report.document import UM, uncertainty_entries
from elastogeo.report.numbers import UNKNOWN, pretty, significant, value_with_uncertainty
from elastogeo.report.view import Section, Table

_MICRO = 1e6
_NM_PER_MRAD = 1e-6
"""Newton metres per milliradian in a newton millimetre per radian."""


def collinear_section(result: Identification) -> Iterator[Section]:
    """Where a load and its displacement are collinear, and how stiff the machine is there; or nothing."""
    found = _found(result)
    if found is None:
        return
    tables = [
        *_table(found.translational, "A force moves the tool along itself", "N/µm", 1 / UM),
        *_table(found.rotational, "A moment turns the tool about itself", "N m/mrad", _NM_PER_MRAD),
        *([_screws(found.screws)] if found.screws else []),
    ]
    machine = result.campaign.machine
    where = ", ".join(f"{axis} {value:.4g}" for axis, value in zip(machine.axes, found.commands, strict=True))
    words = (
        f"The compliances that were asked for add up to these collinear stiffness values at the tool point, with the axes "
        f"at {where} (mm, rad). What was not asked for counts as rigid.",
    )
    yield Section("Stiffness at the tool", tuple(map(pretty, words)), tables=tuple(tables))


def collinear_json(result: Identification) -> dict[str, Any] | None:
    """The entry `collinear` of an identification."""
    found = _found(result)
    if found is None:
        return None
    return {
        "commands": dict(zip(result.campaign.machine.axes, map(float, found.commands), strict=True)),
        "compliance": [[float(value) if isfinite(value) else None for value in row] for row in found.compliance],
        "translational": [_entry(one, UM, "um_per_N") for one in found.translational],
        "rotational": [_entry(one, _MICRO, "urad_per_N_mm") for one in found.rotational],
        "screws": [
            {
                "direction": screw.direction.tolist(),
                "point_mm": screw.point.tolist(),
                "pitch_mm": screw.pitch,
                "along_N_per_um": screw.along / UM,
                "about_N_mm_per_rad": screw.about,
            }
            for screw in found.screws
        ],
    }


def _found(result: Identification) -> CollinearStiffness | None:
    try:
        found = collinear_stiffness_of(result)
    except UnsupportedError:
        return None
    return found if found.translational or found.rotational else None


def _entry(one: Principal, scale: float, unit: str) -> dict[str, Any]:
    value = {"value": one.compliance.value * scale, **uncertainty_entries(one.compliance, scale)}
    return {"direction": one.direction.tolist(), f"compliance_{unit}": value}


def _table(values: Sequence[Principal], title: str, unit: str, scale: float) -> Iterator[Table]:
    if values:
        rows = tuple((_vector(one.direction), pretty(_stiffness(one, scale))) for one in values)
        yield Table(("direction", f"stiffness ± U (95 %) [{unit}]"), rows, words=(0,), title=f"{title}, the softest first")


def _screws(screws: Sequence[StiffnessScrew]) -> Table:
    rows = tuple(
        (
            _vector(screw.direction),
            pretty(", ".join(f"{value:.4g}" for value in screw.point)),
            pretty(significant(screw.pitch, 4)),
            significant(screw.along / UM, 4),
            significant(screw.about * _NM_PER_MRAD, 4),
        )
        for screw in screws
    )
    return Table(
        ("direction", "through, from the tool [mm]", "pitch [mm]", "along [N/µm]", "about [N m/mrad]"),
        rows,
        words=(0, 1),
        title="A force and a moment move the tool along and about one axis, the softest first",
    )


def _stiffness(one: Principal, scale: float) -> str:
    """With its uncertainty, where one is known; unknown where the compliance may as well be zero."""
    try:
        stiffness: Estimate = one.stiffness()
    except UnsupportedError:
        return UNKNOWN
    if not stiffness.known:
        return significant(stiffness.value * scale, 4)
    return value_with_uncertainty(stiffness.value * scale, stiffness.expanded() * scale)


def _vector(direction: Array) -> str:
    return pretty("(" + ", ".join(f"{part:.3f}" for part in direction) + ")")
