"""Design files: how stiff joints are by design or by finite elements, as a table (CSV) or as TOML.

A table has the columns `name`, `value`, `unit`, a row a compliance or a stiffness: `C_XXX, 12, nm/N` (translation in x for a
force in x, at joint X), `C_CXY, 4e-3, urad/N`, `K_ZZZ, 180, N/um` (a stiffness on the diagonal: its inverse). A TOML file
has the same as `[[values]]`, and whole matrices as finite elements give them, in mm, N and rad::

    schema = "elastogeo.design/1"
    name = "FE model, release 4"
    relative_uncertainty = 0.1

    [[values]]
    name = "K_XXX"
    value = 180
    unit = "N/um"

    [[matrices]]
    at = "Z"
    stiffness = [[6 rows of 6 numbers]]      # or compliance
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import FormatError
from elastogeo.formats.text.by_content import opened
from elastogeo.formats.text.delimited import NUMBER, comment_text, split_cells, utf8_text
from elastogeo.formats.text.toml_documents import build, check_schema, document_of
from elastogeo.formats.text.units import UNITS
from elastogeo.machine import COMPONENTS, Array

SCHEMA = "elastogeo.design/1"

MAX_BYTES = 1_000_000
_COLUMNS = ["name", "value", "unit"]
_NAME = re.compile(r"(C|K|CL|KL)_([XYZABC])([XYZABC])(\w+)")
_UNIT = re.compile(r"\s*([^/()]+?)\s*/\s*\(?([^/()]+?)\)?\s*")
_DIMENSIONS = (("length", "angle"), ("force", "moment"))
_SYMMETRIC = 1e-3


@dataclass(frozen=True, slots=True)
class DesignValue:
    """One entry: a compliance or a stiffness by its name, with its unit."""

    name: str
    value: float
    unit: str


@dataclass(frozen=True, slots=True)
class DesignMatrix:
    """One joint or place: its compliance, or its stiffness, rows and columns X Y Z A B C, in mm, N, rad."""

    at: str
    compliance: tuple[tuple[float, ...], ...] = ()
    stiffness: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True, slots=True)
class DesignDocument:
    """What a TOML design file says.

    Attributes
    ----------
    schema : str
    name : str
        Where it comes from.
    relative_uncertainty : float
        Standard uncertainty of each value, relative.
    values : tuple of DesignValue
    matrices : tuple of DesignMatrix
    """

    schema: str
    name: str = ""
    relative_uncertainty: float = 0.0
    values: tuple[DesignValue, ...] = ()
    matrices: tuple[DesignMatrix, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Design(ByValue):
    """Compliances of joints by design.

    Attributes
    ----------
    name : str
        Where they come from.
    values : mapping of str to float
        Compliances by name, in the units of the house; what is not in it is rigid by design.
    relative_uncertainty : float
        Standard uncertainty of each, relative.
    """

    name: str
    values: Mapping[str, float]
    relative_uncertainty: float = 0.0


def read_design(path: str | Path) -> Design:
    """Read a design file; whether it is a table or TOML is told from its content.

    Raises
    ------
    FormatError
        If it is neither, a name, a number or a unit is wrong, or a value stands twice: with file, line, and what to write.
    """
    path = Path(path)
    data = opened(path, str(path))
    if len(data) > MAX_BYTES:
        raise FormatError(f"{path}: is larger than {MAX_BYTES // 1_000_000} MB; this is no table of joints")
    try:
        lines = utf8_text(data).decode().split("\n")
    except FormatError as error:
        raise FormatError(f"{path}: {error}") from None
    separator = _separator(lines)
    return _of_toml(path, data) if separator is None else _of_table(path, lines, separator)


def _separator(lines: Iterable[str]) -> str | None:
    """What separates the columns of a table; None if this is none."""
    for line in lines:
        if line.strip() and comment_text(line, ",") is None:
            found = [one for one in ";,\t" if [cell.strip().lower() for cell in split_cells(line, one)][:3] == _COLUMNS]
            return found[0] if found else None
    return None


def _of_table(path: Path, lines: Iterable[str], separator: str) -> Design:
    values: dict[str, float] = {}
    below = False
    for number, line in enumerate(lines, 1):
        if not line.strip() or comment_text(line, separator) is not None:
            continue
        where = f"{path}, line {number}"
        cells = [cell.strip() for cell in split_cells(line, separator)]
        if not below:
            below = True
            continue
        if len(cells) < len(_COLUMNS) or not NUMBER.fullmatch(cells[1]):
            raise FormatError(
                f"{where}: {line[:60]!r} is no entry; write a name, a number and a unit, as in C_XXX, 12, nm/N"
            )
        value = float(cells[1].replace(",", "."))
        _add(values, _entry(DesignValue(cells[0], value, cells[2]), where), where)
    return _checked(path, Design(path.name, MappingProxyType(values)))


def _of_toml(path: Path, data: bytes) -> Design:
    table = document_of(data, str(path))
    check_schema(table, SCHEMA, str(path))
    document = build(DesignDocument, table, str(path))
    if not 0 <= document.relative_uncertainty < 1:
        raise FormatError(
            f"{path}: relative_uncertainty is {document.relative_uncertainty:g}; write 0.1 for 10 %, at least 0 and below 1"
        )
    values: dict[str, float] = {}
    for k, value in enumerate(document.values, 1):
        where = f"{path}, [[values]] {k}"
        _add(values, _entry(value, where), where)
    for k, matrix in enumerate(document.matrices, 1):
        where = f"{path}, [[matrices]] {k}"
        letter = "C" if len(matrix.at) == 1 else "CL"
        spring = _spring(matrix, where)
        names = [f"{letter}_{d}{f}{matrix.at}" for d in COMPONENTS for f in COMPONENTS]
        _add(values, dict(zip(names, map(float, spring.ravel()), strict=True)), where)
    return _checked(path, Design(document.name or path.name, MappingProxyType(values), document.relative_uncertainty))


def _entry(given: DesignValue, where: str) -> dict[str, float]:
    """The compliance that an entry amounts to, in the units of the house, by its name."""
    named = _NAME.fullmatch(given.name)
    if named is None:
        raise FormatError(
            f"{where}: {given.name[:40]!r} is no compliance or stiffness; write C_XXX, or K_XXX for a stiffness"
        )
    kind, d, f, at = named.groups()
    stiff = kind.startswith("K")
    if stiff and d != f:
        raise FormatError(f"{where}: {given.name} is no stiffness on the diagonal; give the whole matrix as [[matrices]]")
    turned = [COMPONENTS.index(d) >= 3, COMPONENTS.index(f) >= 3]
    wanted = _DIMENSIONS[0][turned[0]], _DIMENSIONS[1][turned[1]]
    factor = _factor(given.unit, wanted[::-1] if stiff else wanted, where)
    if not np.isfinite(given.value) or (stiff and given.value <= 0):
        raise FormatError(f"{where}: {given.name} is {given.value:g}; it must be finite, and a stiffness positive")
    value = given.value * factor
    return {f"{kind.replace('K', 'C')}_{d}{f}{at}": 1.0 / value if stiff else value}


def _factor(unit: str, wanted: tuple[str, str], where: str) -> float:
    """From a unit such as `nm/N` or `N m/mrad` to that of the house."""
    parts = _UNIT.fullmatch(unit)
    known = parts is not None and all(part in UNITS for part in parts.groups())
    if parts is None or not known or tuple(UNITS[part].dimension for part in parts.groups()) != wanted:
        raise FormatError(
            f"{where}: the unit {unit[:30]!r} is no {wanted[0]} per {wanted[1]}; write for example {_EXAMPLES[wanted]}"
        )
    above, below = (UNITS[part] for part in parts.groups())
    return above.multiply / above.divide * below.divide / below.multiply


_EXAMPLES = {
    ("length", "force"): "nm/N",
    ("length", "moment"): "nm/(N m)",
    ("angle", "force"): "urad/N",
    ("angle", "moment"): "urad/(N m)",
    ("force", "length"): "N/um",
    ("moment", "angle"): "N m/mrad",
}


def _spring(matrix: DesignMatrix, where: str) -> Array:
    """The compliance of one joint, shape (6, 6)."""
    given = [one for one in (matrix.compliance, matrix.stiffness) if one]
    if len(given) != 1:
        raise FormatError(f"{where}: write compliance or stiffness, one of the two")
    if [len(row) for row in given[0]] != [6] * 6 or not np.isfinite(given[0]).all():
        raise FormatError(f"{where}: the matrix must have 6 rows of 6 finite numbers, X Y Z A B C")
    found = np.array(given[0])
    scale = np.sqrt(np.abs(np.diag(found)))
    scale = np.where(scale > 0, scale, 1.0)
    scaled = found / np.outer(scale, scale)
    if np.abs(scaled - scaled.T).max() > _SYMMETRIC:
        raise FormatError(f"{where}: the matrix is not symmetric, as that of a spring is; look at its rows and columns")
    least = float(np.linalg.eigvalsh((scaled + scaled.T) / 2)[0])
    if least < (1e-12 if matrix.stiffness else -_SYMMETRIC):
        raise FormatError(f"{where}: the matrix is no spring's: a load in some direction would gain energy")
    return np.linalg.inv(scaled) / np.outer(scale, scale) if matrix.stiffness else found


def _add(values: dict[str, float], more: Mapping[str, float], where: str) -> None:
    twice = sorted(set(values) & set(more))
    if twice:
        raise FormatError(f"{where}: {twice[0]} was given before; keep one")
    values.update(more)


def _checked(path: Path, design: Design) -> Design:
    if not design.values:
        raise FormatError(f"{path}: holds no compliance; write a row for each, as in C_XXX, 12, nm/N")
    return design
