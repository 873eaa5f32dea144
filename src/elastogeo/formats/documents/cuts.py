"""Cut files: what loads tool and table along a path, as a TOML document: `elastogeo predict ... --cut roughing.toml`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, cast

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.formats.tool_paths import read_forces
from elastogeo.machine import (
    Angle,
    ConstantForce,
    Cut,
    CuttingCoefficients,
    Directions,
    Feed,
    Forces,
    HeldTool,
    Length,
    LengthPerForce,
    Mill,
    MillingForce,
    PathForce,
    ToolSection,
    Workpiece,
    cantilever,
    coefficients_of,
    engagement_of,
    measured_tool,
)

SCHEMA = "elastogeo.cut/1"

Stress = Annotated[float, "N_mm2"]
ForcePerLength = Annotated[float, "N_per_mm"]
Turning = Annotated[float, "rad_s"]


@dataclass(frozen=True, slots=True)
class ForceDocument:
    """The table `force`: one force, or a file of measured ones.

    Attributes
    ----------
    constant : tuple of 3 float or None [N]
        On the tool while it cuts.
    file : str
        Measured forces, beside this file.
    along : str
        Directions in which they count: `workpiece`, `machine` or `path`.
    on : str
        What was measured: the force on the `tool`, or on the `workpiece`, which is the opposite.
    relative_uncertainty : float
    """

    constant: Forces | None = None
    file: str = ""
    along: str = "workpiece"
    on: str = "tool"
    relative_uncertainty: float = 0.0


@dataclass(frozen=True, slots=True)
class MillingDocument:
    """The table `milling`: an end mill, its engagement, and how the material cuts.

    Attributes
    ----------
    diameter : float [mm]
    teeth : int
    depth : float [mm]
        Along the axis.
    speed : float [rad/s]
        Of the spindle.
    width : float or None [mm]
        Across the feed; a slot if it is not given.
    side : str
        Where the material is, seen along the feed: `right` (the mill climbs) or `left`.
    material : str
        One of the list; or the coefficients themselves.
    tangential, radial, axial : float or None [N/mm^2]
    tangential_edge, radial_edge, axial_edge : float [N/mm]
    source : str
        Where the coefficients come from.
    helix, run_out_angle : float [rad]
    run_out : float [mm]
    feed : float or None [mm/s]
        Where the path says none.
    moment : str
        `mean` over a turn, or `surface`: when an edge makes the surface.
    axial_force : str
        `draws out` the mill, as a right-hand helix does, or `pushes in`.
    relative_uncertainty : float
        Of the coefficients.
    """

    diameter: Length
    teeth: int
    depth: Length
    speed: Turning
    width: Length | None = None
    side: str = "right"
    material: str = ""
    tangential: Stress | None = None
    radial: Stress | None = None
    axial: Stress = 0.0
    tangential_edge: ForcePerLength = 0.0
    radial_edge: ForcePerLength = 0.0
    axial_edge: ForcePerLength = 0.0
    source: str = ""
    helix: Angle = 0.0
    run_out: Length = 0.0
    run_out_angle: Angle = 0.0
    feed: Feed | None = None
    moment: str = "mean"
    axial_force: str = "draws out"
    relative_uncertainty: float = 0.0


@dataclass(frozen=True, slots=True)
class SectionDocument:
    """A cylindrical part of the tool, from the tip; a fluted one counts with about 0.8 of its diameter."""

    length: Length
    diameter: Length
    modulus: Stress


@dataclass(frozen=True, slots=True)
class ToolDocument:
    """The table `tool`: tool and holder by their sections, or as measured at the tip.

    Attributes
    ----------
    sections : tuple of SectionDocument
        From the tip to the clamping.
    across, along : float or None [mm/N]
        Compliance as measured.
    relative_uncertainty : float
    """

    sections: tuple[SectionDocument, ...] = ()
    across: LengthPerForce | None = None
    along: LengthPerForce = 0.0
    relative_uncertainty: float = 0.0


@dataclass(frozen=True, slots=True)
class CutDocument:
    """What a cut file says.

    Attributes
    ----------
    schema : str
    name : str
    normal_to : str
        `left` or `right` of the travel: where along the normal counts as positive.
    force : ForceDocument or None
    milling : MillingDocument or None
    tool : ToolDocument or None
    workpiece : Workpiece or None
    """

    schema: str = SCHEMA
    name: str = ""
    normal_to: str = "left"
    force: ForceDocument | None = None
    milling: MillingDocument | None = None
    tool: ToolDocument | None = None
    workpiece: Workpiece | None = None


_AXIAL = {"draws out": True, "pushes in": False}


def read_cut(path: str | Path) -> Cut:
    """Read a cut file; the files that it names are beside it.

    Raises
    ------
    FormatError
        If it is no such document.
    InputError
        If what it says is no cut.
    """
    path = Path(path)
    table = read_document(path)
    check_schema(table, SCHEMA, str(path))
    document = build(CutDocument, table, str(path))
    if document.force is not None and document.milling is not None:
        raise FormatError(f"{path}: has a table [force] and a table [milling]; the force comes from one of the two")
    try:
        force = _force(document.force, path.parent) or _milling(document.milling)
        return Cut(force, _tool(document.tool), document.workpiece, document.normal_to)
    except FormatError:
        raise
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def _force(said: ForceDocument | None, folder: Path) -> PathForce | None:
    if said is None:
        return None
    if (said.constant is None) == (not said.file):
        raise InputError('the table [force] says constant_N = [x, y, z], or file = "forces.csv": one of the two')
    along = cast(Directions, said.along)
    if said.constant is None:
        return read_forces(folder / said.file, along, cast(Literal["tool", "workpiece"], said.on), said.relative_uncertainty)
    force = said.constant
    if len(force) != 3:
        raise InputError(f"constant_N holds {len(force)} numbers; a force has three, along x, y and z")
    return ConstantForce((force[0], force[1], force[2]), along, relative_uncertainty=said.relative_uncertainty)


def _milling(said: MillingDocument | None) -> PathForce | None:
    if said is None:
        return None
    if said.axial_force not in _AXIAL:
        raise InputError(f"axial_force is {said.axial_force!r}; write {' or '.join(map(repr, _AXIAL))}")
    width = said.diameter if said.width is None else said.width
    return MillingForce(
        edge=_edge(said),
        mill=Mill(said.diameter, said.teeth, said.helix, said.run_out, said.run_out_angle),
        engagement=engagement_of(said.depth, width, said.diameter, said.side),
        speed=said.speed,
        feed=said.feed,
        moment=cast(Literal["mean", "surface"], said.moment),
        draws_out=_AXIAL[said.axial_force],
        relative_uncertainty=said.relative_uncertainty,
    )


def _edge(said: MillingDocument) -> CuttingCoefficients:
    if bool(said.material) == (said.tangential is not None):
        raise InputError("the table [milling] says a material of the list, or its own tangential_N_mm2: one of the two")
    if said.tangential is None:
        return coefficients_of(said.material)
    edges = (said.tangential_edge, said.radial_edge, said.axial_edge)
    return CuttingCoefficients(
        said.tangential, edges[0], said.radial or 0.0, edges[1], said.axial, edges[2], source=said.source
    )


def _tool(said: ToolDocument | None) -> HeldTool | None:
    if said is None:
        return None
    if bool(said.sections) == (said.across is not None):
        raise InputError("the table [tool] has sections, or across_um_per_N as measured: one of the two")
    if said.across is not None:
        return measured_tool(said.across, said.along, said.relative_uncertainty)
    sections = [ToolSection(part.length, part.diameter, part.modulus) for part in said.sections]
    return cantilever(sections, said.relative_uncertainty)
