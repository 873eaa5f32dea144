"""Write the keys of all files, docs/keys.md, from the classes that they become: `python docs/make_keys.py`."""

import dataclasses
import inspect
import json
import re
import types
import typing
from pathlib import Path

from elastogeo.formats.documents.campaigns import CampaignDocument
from elastogeo.formats.documents.feed_drives import DriveDocument
from elastogeo.formats.documents.machine_tests import TestDocument
from elastogeo.formats.documents.machines import MachineDocument
from elastogeo.formats.documents.simulations import Simulation
from elastogeo.observe import instruments
from elastogeo.recording.settings import RecordingPlan

PAGE = Path(__file__).with_name("keys.md")
FILES = {
    "drive.toml: feed drives": DriveDocument,
    "test.toml: a test": TestDocument,
    "campaign.toml: tests of one machine": CampaignDocument,
    "simulation.toml: what to simulate": Simulation,
    "A machine file": MachineDocument,
    "A recording file": RecordingPlan,
}
INTRODUCTION = """\
# Keys of the files

Every key that a file may have. A key carries its unit: where `least_speed_mm_s` stands, `least_speed_mm_min` or `_m_s`
may be written, any unit of the same dimension. `[table]` is a table, `[[table]]` a list of them.

This page is written from the program by `docs/make_keys.py`.
"""


def reference() -> str:
    """The page as it should be."""
    parts = [INTRODUCTION, *(_section(title, kind) for title, kind in FILES.items()), "## The table `setup` of a test\n"]
    ours = {name: kind for name, kind in instruments().items() if kind.__module__.startswith("elastogeo.")}
    parts += [_section(f'instrument = "{name}"', kind, "### ", "setup") for name, kind in sorted(ours.items())]
    return "\n".join(parts)


def _section(title: str, kind: type, mark: str = "## ", path: str = "") -> str:
    """The keys of one document, and below them those of its tables."""
    tables: list[tuple[str, type]] = [(path, kind)]
    lines = [f"{mark}{title}\n"]
    done = set()
    while tables:
        where, one = tables.pop(0)
        if where in done:
            continue
        done.add(where)
        several = where.startswith("[")
        name = where.strip("[]")
        rows, inner = _rows(one, name)
        if name:
            lines.append(f"**`{'[[' if several else '['}{name}{']]' if several else ']'}`**\n")
        lines += ["| key | default | what it is |", "| --- | --- | --- |", *rows, ""]
        tables += inner
    return "\n".join(lines)


def _rows(kind: type, path: str) -> tuple[list[str], list[tuple[str, type]]]:
    hints = typing.get_type_hints(kind, include_extras=True)
    said = described(kind)
    rows, tables = [], []
    for field in dataclasses.fields(kind):
        unit, nested, several = _kind_of(hints[field.name])
        if nested is not None:
            name = f"{path}.{field.name}" if path else field.name
            tables.append((f"[{name}]" if several else name, nested))
        key = f"{field.name}_{unit.split('|')[0]}" if unit else field.name
        shown = f"[[{field.name}]]" if nested and several else f"[{field.name}]" if nested else key
        rows.append(f"| `{shown}` | {_default(field, bool(nested))} | {said.get(field.name, '')} |")
    return rows, tables


def _kind_of(hint: object) -> tuple[str, type | None, bool]:
    """The unit of a field, the table that it holds, and whether it holds several."""
    if typing.get_origin(hint) in (types.UnionType, typing.Union):
        hint = next(one for one in typing.get_args(hint) if one is not type(None))
    unit = str(hint.__metadata__[0]) if hasattr(hint, "__metadata__") else ""
    inner = typing.get_args(hint)
    several = typing.get_origin(hint) is tuple and bool(inner) and dataclasses.is_dataclass(inner[0])
    nested = inner[0] if several else hint if dataclasses.is_dataclass(hint) else None
    return unit, nested, several


def _default(field: dataclasses.Field, table: bool) -> str:
    if field.default is dataclasses.MISSING:
        return "" if table or field.default_factory is not dataclasses.MISSING else "must be there"
    if table or field.default in (None, "", ()):
        return ""
    return f"`{json.dumps(field.default)}`"


def described(kind: type) -> dict[str, str]:
    """What the docstring of a class says of each attribute, in one line each."""
    text = inspect.getdoc(kind) or ""
    found = re.search(r"^Attributes\n-+\n(.*?)(?=^\w[^\n]*\n-+\n|\Z)", text, re.DOTALL | re.MULTILINE)
    said: dict[str, str] = {}
    names: list[str] = []
    for line in (found[1] if found else "").splitlines():
        if line and not line.startswith(" ") and " : " in line:
            names = [name.strip() for name in line.partition(" : ")[0].split(",")]
            said.update(dict.fromkeys(names, ""))
        elif line.startswith("    "):
            for name in names:
                said[name] = f"{said[name]} {line.strip()}".strip().replace("|", "\\|")
        elif line:
            break
    return said


if __name__ == "__main__":
    PAGE.write_text(reference(), encoding="utf-8")
