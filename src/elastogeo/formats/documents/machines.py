"""Machine files: a machine as a TOML document, one's own or one that ships with elastogeo."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path
from typing import Any

from elastogeo.errors import FormatError
from elastogeo.formats.text.files_read import may_open
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.formats.text.units import UNITS
from elastogeo.machine import DOWN, ROTARY, SPINDLE, Joint, Machine, Place, Point, parse_topology

SCHEMA = "elastogeo.machine/1"


@dataclass(frozen=True, slots=True)
class MachineDocument:
    """The tables of a machine file."""

    schema: str
    name: str
    topology: str
    tool: Point = (0.0, 0.0, 0.0)
    assumed: tuple[str, ...] = ()
    gravity: tuple[float, float, float] = DOWN
    axes: Mapping[str, Any] = field(default_factory=dict)
    places: Mapping[str, Any] = field(default_factory=dict)


def shipped_machines() -> dict[str, Path]:
    """The machine files that ship with elastogeo, by name."""
    folder = Path(str(resources.files("elastogeo.formats"))) / "machines"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def machines() -> dict[str, Machine]:
    """The machines that ship with elastogeo, by name."""
    return {name: read_machine(path) for name, path in shipped_machines().items()}


def find_machine(name: str, beside: Path) -> Machine:
    """The machine that a document names: a shipped one, or a file, relative to the folder of the document.

    Raises
    ------
    FormatError
        If it is neither.
    """
    shipped = shipped_machines()
    if name in shipped:
        return read_machine(shipped[name])
    path = beside / name
    may_open(path)
    if path.suffix == ".toml" and path.is_file():
        return read_machine(path)
    raise FormatError(
        f"there is no machine {name!r}: it is no file beside {beside}, and elastogeo ships with {', '.join(shipped)}"
    )


def read_machine(path: str | Path) -> Machine:
    """Read a machine file, or a machine that ships with elastogeo.

    Parameters
    ----------
    path : str or Path
        The name of a shipped machine (`hermle_c50`), or a TOML file with `schema`, `name`, `topology`, `tool_mm`, and a
        table per axis with `offset_mm`, `tilt_deg`, `travel_mm` or `travel_deg`, `compliant`; and a table
        `[places.NAME]` with `on` and `offset_mm` per place that gives way beside the joints.

    Raises
    ------
    FormatError
        If it is no such document.
    MachineError
        If the topology is none, or the machine contradicts itself.
    """
    shipped = shipped_machines()
    if str(path) not in shipped and Path(path).suffix != ".toml":
        raise FormatError(
            f"there is no machine {str(path)!r}: elastogeo ships with {', '.join(shipped)}; a file ends in .toml"
        )
    path = shipped.get(str(path), Path(path))
    table = read_document(path)
    check_schema(table, SCHEMA, str(path))
    document = build(MachineDocument, table, str(path))
    topology = parse_topology(document.topology)
    strangers = [axis for axis in document.axes if axis not in topology.axes]
    if strangers:
        raise FormatError(f"{path}: the table axes.{strangers[0]} names no axis of {topology.compact}; remove it")
    joints = tuple(_joint(axis, document.axes.get(axis, {}), path) for axis in topology.axes)
    places = tuple(_place(name, table, path) for name, table in document.places.items())
    return Machine(document.name, topology, joints, document.tool, document.assumed, document.gravity, places)


def _place(name: str, table: Any, path: Path) -> Place:
    where = f"{path}, places.{name}"
    if not isinstance(table, Mapping):
        raise FormatError(f"{where}: must be a table, got {table!r:.60}")
    return build(Place, {**table, "name": name}, where)


def _joint(axis: str, table: Any, path: Path) -> Joint:
    where = f"{path}, axes.{axis}"
    if not isinstance(table, Mapping):
        raise FormatError(f"{where}: must be a table, got {table!r:.60}")
    for key in table:
        unit = UNITS.get(key.removeprefix("travel_"))
        if unit is not None and unit.dimension != ("angle" if axis in ROTARY else "length"):
            raise FormatError(
                f"{where}: {key} is no travel of the axis {axis}; write travel_{'deg' if axis in ROTARY else 'mm'}"
            )
    return build(Joint, {"compliant": axis != SPINDLE, **table, "name": axis}, where)
