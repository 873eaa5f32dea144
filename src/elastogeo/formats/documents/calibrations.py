"""Calibration files: what `elastogeo calibrate` found, for test files to name: `calibration = "gauge.toml"`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, isfinite
from pathlib import Path
from typing import Any

from elastogeo.drive import SetupCompliance
from elastogeo.errors import FormatError
from elastogeo.estimate import Estimate
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.formats.text.whole_files import write_whole
from elastogeo.machine import About, LengthPerPressure
from elastogeo.observe import Calibration

SCHEMA = "elastogeo.calibration/1"
_OF_SETUP = {
    "value": "setup_deflection",
    "standard_uncertainty": "setup_deflection_uncertainty",
    "degrees_of_freedom": "setup_deflection_degrees_of_freedom",
}


@dataclass(frozen=True, slots=True)
class DeflectionDocument:
    """Deflection of a set-up per pressure (Eq. 5.38)."""

    value: LengthPerPressure
    standard_uncertainty: LengthPerPressure = 0.0
    degrees_of_freedom: float = inf


@dataclass(frozen=True, slots=True)
class CalibrationDocument:
    """What a calibration file says: the force of a bar, its set-up's deflection, or both; or a ball-roller's set-up.

    Attributes
    ----------
    schema : str
    name : str
    force : Calibration or None
    setup_deflection : DeflectionDocument or None
    setup_compliance : SetupCompliance or None
        Of ball and roller bearing.
    about : About
    """

    schema: str = SCHEMA
    name: str = ""
    force: Calibration | None = None
    setup_deflection: DeflectionDocument | None = None
    setup_compliance: SetupCompliance | None = None
    about: About = field(default_factory=About)


def read_calibration(path: str | Path) -> CalibrationDocument:
    """Read a calibration file.

    Raises
    ------
    FormatError
        If it is no such document, or holds no calibration.
    """
    path = Path(path)
    table = read_document(path)
    check_schema(table, SCHEMA, str(path))
    document = build(CalibrationDocument, table, str(path))
    if document.force is None and document.setup_deflection is None and document.setup_compliance is None:
        raise FormatError(f"{path}: holds no calibration; write a table [force], [setup_deflection] or [setup_compliance]")
    return document


def with_calibration(setup: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The table `setup` of a test file, with the calibration file that it names read into it.

    Parameters
    ----------
    setup : mapping of str to any
    folder : Path
        Of the test file.

    Raises
    ------
    FormatError
        If the file is no calibration, or the test itself gives a deflection of the set-up that the file gives too.
    """
    named = setup.get("calibration")
    if not isinstance(named, str):
        return dict(setup)
    read_calibration(folder / named)
    tables = read_document(folder / named)
    entries = {key: value for key, value in setup.items() if key != "calibration"}
    if "force" in tables:
        entries["calibration"] = tables["force"]
    given = [key for key in setup if key.startswith("setup_deflection")]
    if given and "setup_deflection" in tables:
        raise FormatError(f"{folder / named}: gives the deflection of the set-up, and the test gives {given[0]}; keep one")
    if "setup_compliance" in tables:
        if "setup" in setup:
            raise FormatError(f"{folder / named}: gives the set-up's compliance, and the test gives [setup.setup]; keep one")
        entries["setup"] = tables["setup_compliance"]
    for key, value in tables.get("setup_deflection", {}).items():
        name = next(name for name in _OF_SETUP if key == name or key.startswith(f"{name}_"))
        entries[_OF_SETUP[name] + key.removeprefix(name)] = value
    return entries


def calibration_text(document: CalibrationDocument) -> str:
    """A calibration file as TOML; read back, every number is the same."""
    lines = [f'schema = "{SCHEMA}"', *([f"name = {_text(document.name)}"] if document.name else [])]
    if document.force is not None:
        found = document.force
        lines += ["", "[force]", f"pressure_bar = {list(found.pressure)}", f"force_N = {list(found.force)}"]
        if found.standard_uncertainty:
            lines.append(f"standard_uncertainty_N = {list(found.standard_uncertainty)}")
        lines += _unless(found.correlation, "correlation", 0.0)
        lines += _unless(found.degrees_of_freedom, "degrees_of_freedom", inf)
        lines += _unless(found.relative, "relative", 0.0)
        lines += _unless(found.relative_degrees_of_freedom, "relative_degrees_of_freedom", inf)
    if document.setup_deflection is not None:
        post = document.setup_deflection
        lines += ["", "[setup_deflection]", f"value_mm_per_bar = {post.value!r}"]
        lines += _unless(post.standard_uncertainty, "standard_uncertainty_mm_per_bar", 0.0)
        lines += _unless(post.degrees_of_freedom, "degrees_of_freedom", inf)
    if document.setup_compliance is not None:
        rollers = document.setup_compliance
        lines += ["", "[setup_compliance]", f"engagement_mm = {list(rollers.engagement)}"]
        lines.append(f"compliance_mm_per_N = {list(rollers.compliance)}")
        lines += _unless(rollers.standard_uncertainty or 0.0, "standard_uncertainty_mm_per_N", 0.0)
    about = [
        f"{key} = {_text(value) if isinstance(value, str) else repr(value)}" for key, value in document.about.said().items()
    ]
    return "\n".join([*lines, *(["", "[about]", *about] if about else []), ""])


def write_calibration(
    path: str | Path,
    force: Calibration | None = None,
    setup: Estimate | None = None,
    name: str = "",
    *,
    rollers: SetupCompliance | None = None,
) -> Path:
    """Write a calibration file that test files can name.

    Parameters
    ----------
    path : str or Path
        It must not exist.
    force : Calibration or None
    setup : Estimate or None [mm/bar]
        Deflection of the set-up per pressure.
    name : str
    rollers : SetupCompliance or None
        Of ball and roller bearing, a table over the engagement.

    Raises
    ------
    FormatError
        If the file is there already, or cannot be written.
    """
    path = Path(path)
    if path.exists():
        raise FormatError(f"{path} is there already; choose another name, nothing was changed")
    post = None
    if setup is not None:
        post = DeflectionDocument(setup.value, setup.standard_uncertainty, setup.degrees_of_freedom)
    text = calibration_text(CalibrationDocument(name=name, force=force, setup_deflection=post, setup_compliance=rollers))
    return write_whole({path: text.encode()})[0]


def _unless(value: float, key: str, default: float) -> list[str]:
    return [f"{key} = {value!r}"] if value != default and isfinite(value) else []


def _text(value: str) -> str:
    """A basic string of TOML."""
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in escaped) + '"'
