"""TOML documents with units in their keys, read into the frozen dataclasses of the rooms below.

The fields are annotated with the unit they have inside (`elastogeo.machine.quantity`). A document writes a field as
`radius_mm`, `radius_um`, `radius_m`; it is converted here, once. All that is wrong with a document is said at once.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from datetime import date
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, TypeVar, Union, cast, get_args, get_origin, get_type_hints

from pydantic import TypeAdapter, ValidationError

from elastogeo.errors import FormatError, InputError
from elastogeo.formats.text.files_read import may_open, noted
from elastogeo.formats.text.units import UNITS, to_internal
from elastogeo.machine import LINEAR, MM_OR_RAD, ROTARY

MAX_BYTES = 10_000_000

T = TypeVar("T")

_WRONG = object()
"""Stands for a value that was refused already."""


def read_document(path: Path) -> dict[str, Any]:
    """The tables of a TOML file.

    Raises
    ------
    FormatError
        If it cannot be opened, is too large, is no UTF-8 or no TOML; the message says the line.
    """
    may_open(path)
    try:
        data = noted(path, path.read_bytes())
    except OSError as error:
        raise FormatError(f"{path}: cannot be opened ({error.strerror}); check the path") from None
    return document_of(data, str(path))


def document_of(data: bytes, source: str) -> dict[str, Any]:
    """The tables of the bytes of a TOML file, as `read_document`; `source` is for messages."""
    if len(data) > MAX_BYTES:
        raise FormatError(
            f"{source}: is larger than {MAX_BYTES // 1_000_000} MB; this is no description of a test or machine"
        )
    try:
        return tomllib.loads(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise FormatError(f"{source}: is no UTF-8 text (byte {error.start}); save it as UTF-8") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise FormatError(f"{source}: is no TOML: {error}; see https://toml.io for how it is written") from None


def build(kind: type[T], table: Mapping[str, Any], where: str) -> T:
    """A dataclass from a table of a document.

    Parameters
    ----------
    kind : type
        A dataclass whose fields are annotated with units.
    table : mapping of str to any
        As it stands in the document.
    where : str
        File and table, for the message.

    Returns
    -------
    kind

    Raises
    ------
    FormatError
        With everything that is wrong: unknown and missing keys, missing and wrong units, wrong types.
    """
    problems: list[str] = []
    built = _built(kind, table, "", problems)
    if problems:
        raise FormatError("\n  ".join([f"{where}:", *problems]) if len(problems) > 1 else f"{where}: {problems[0]}")
    return cast("T", built)


def _built(kind: Any, table: Any, path: str, problems: list[str]) -> Any:
    """The dataclass, or `_WRONG` with what is wrong added to `problems`."""
    before = len(problems)
    values = _internal(kind, table, path, problems)
    hints, marked = _hints(kind)
    for field in fields(kind):
        if field.name in values and not _is_wrong(values[field.name]):
            problems.extend(_type_problems(hints[field.name], values[field.name], f"{path}{field.name}"))
        elif field.name not in values and field.default is MISSING and field.default_factory is MISSING:
            unit = unit_of(marked[field.name])
            problems.append(f"{path}{_spelled(field.name, unit)} is missing")
    if len(problems) > before:
        return _WRONG
    try:
        return kind(**values)
    except InputError as error:
        problems.append(": ".join(filter(None, [path.rstrip("., "), str(error)])))
        return _WRONG


def _is_wrong(value: Any) -> bool:
    """Whether a value, or one inside it, was refused already."""
    if isinstance(value, Mapping):
        return any(map(_is_wrong, value.values()))
    return value is _WRONG or (isinstance(value, tuple) and any(map(_is_wrong, value)))


def _type_problems(hint: Any, value: Any, at: str) -> list[str]:
    """What is wrong with the type of a value; nothing is coerced but whole numbers to floats."""
    if value is None:
        return []
    try:
        _checked_as(hint).validate_python(value, strict=True)
    except ValidationError as error:
        return [
            f"{'.'.join([at, *map(str, found['loc'])])}: {found['msg'].lower()}, got {found['input']!r:.60}"
            for found in error.errors()
        ]
    return []


@cache
def _hints(kind: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """The types of the fields of a dataclass, without and with their units."""
    return get_type_hints(kind), get_type_hints(kind, include_extras=True)


@cache
def _checked_as(hint: Any) -> TypeAdapter[Any]:
    """What checks values of a type: to make it takes longer than to read a test."""
    return TypeAdapter(hint)


def _internal(kind: Any, table: Any, path: str, problems: list[str]) -> dict[str, Any]:
    """Values by field, in the units of the house; what is wrong is added to `problems`."""
    if not isinstance(table, Mapping):
        problems.append(f"{path.rstrip('.') or 'the document'} must be a table, got {table!r:.60}")
        return {}
    hints, marked = _hints(kind)
    units = {field.name: unit_of(marked[field.name]) for field in fields(kind)}
    values: dict[str, Any] = {}
    for key, value in table.items():
        name, unit = _field_of(key, units)
        at = f"{path}{key}"
        if name is None:
            near, known = _nearest(key, units), [_spelled(field, units[field]) for field in units]
            problems.append(f"{at} is not known; " + (f"did you mean {near}?" if near else f"known: {', '.join(known)}"))
            continue
        if name in values:
            problems.append(f"{at} gives {path}{name} a second time; give it once")
        values[name] = _value(value, unit, hints[name], units[name], at, name, problems)
    return values


def _value(value: Any, unit: str, hint: Any, inside: str, at: str, name: str, problems: list[str]) -> Any:
    """What one key says, in the units of the house."""
    nested, several = _nested(hint)
    if nested and several:
        entries = value if isinstance(value, list) else [value]
        return tuple(_built(nested, entry, f"{at} {k}, ", problems) for k, entry in enumerate(entries, 1))
    if nested:
        return _built(nested, value, f"{at}.", problems)
    if inside == MM_OR_RAD and isinstance(value, Mapping):
        return _axis_commands(value, at, problems)
    return _converted(value, unit, inside, at, name, problems)


def _field_of(key: str, units: Mapping[str, str]) -> tuple[str | None, str]:
    """The field that a key names, and the unit it carries."""
    if key in units:
        return key, ""
    for name in sorted(units, key=len, reverse=True):
        if key.startswith(f"{name}_"):
            return name, key[len(name) + 1 :]
    return None, ""


def _nearest(key: str, units: Mapping[str, str]) -> str:
    """The key that was probably meant, with the unit that was written if it fits; empty if none is near."""
    cuts = [(key[:at], key[at + 1 :]) for at in range(len(key)) if key[at] == "_" and _dimensions(key[at + 1 :])]
    for name, unit in [*cuts, (key, "")]:
        near = get_close_matches(name, [field for field in units if units[field] or not unit], n=1)
        if near:
            fits = unit and _same_dimension(unit, units[near[0]])
            return f"{near[0]}_{unit}" if fits else _spelled(near[0], units[near[0]])
    near = get_close_matches(key, [_spelled(field, units[field]) for field in units], n=1)
    return near[0] if near else ""


def _converted(value: Any, unit: str, inside: str, at: str, name: str, problems: list[str]) -> Any:
    """A value in the unit of the house; lists become tuples."""
    if not inside and not unit:
        return _as_tuples(value)
    if not inside or not unit or not _same_dimension(unit, inside):
        arrived = f"has the unit {unit!r}" if unit else "has no unit"
        problems.append(f"{at} {arrived}; write for example {_spelled(name, inside)}")
        return _WRONG
    if not _numeric(value):
        problems.append(f"{at} must be numbers, got {value!r:.60}")
        return _WRONG
    return _scaled(value, unit)


def _axis_commands(value: Mapping[str, Any], at: str, problems: list[str]) -> dict[str, Any]:
    """Commands by axis from `{ X_mm = 0, A_deg = 30 }`."""
    commands: dict[str, Any] = {}
    for key, command in value.items():
        axis, _, unit = key.partition("_")
        inside = "mm" if axis in LINEAR else "rad" if axis in ROTARY else ""
        if not inside:
            problems.append(f"{at}.{key} names no axis; write for example X_mm or A_deg")
        else:
            commands[axis] = _converted(command, unit, inside, f"{at}.{key}", axis, problems)
    return commands


def _scaled(value: Any, unit: str) -> Any:
    if isinstance(value, list):
        return tuple(_scaled(item, unit) for item in value)
    top, _, bottom = unit.partition("_per_")
    factor = float(to_internal(1.0, bottom)) if bottom else 1.0
    return float(to_internal(float(value), top)) / factor


def _numeric(value: Any) -> bool:
    if isinstance(value, list):
        return all(map(_numeric, value))
    return isinstance(value, int | float) and not isinstance(value, bool)


def _as_tuples(value: Any) -> Any:
    """A value as the house holds it: lists become tuples, a date of TOML its text."""
    if isinstance(value, date):
        return value.isoformat()
    return tuple(map(_as_tuples, value)) if isinstance(value, list) else value


def _same_dimension(unit: str, inside: str) -> bool:
    return any(_dimensions(unit) == _dimensions(one) for one in inside.split("|")) and bool(_dimensions(unit))


def _dimensions(unit: str) -> tuple[str, ...]:
    parts = unit.split("_per_")
    return tuple(UNITS[part].dimension for part in parts) if all(part in UNITS for part in parts) else ()


def unit_of(hint: Any) -> str:
    """The unit that a field has inside, by its annotation; empty for none."""
    hint = _given(hint)
    return str(hint.__metadata__[0]) if get_origin(hint) is Annotated else ""


def _given(hint: Any) -> Any:
    """What a field holds if it is given: the `Length` of a `Length | None`."""
    if get_origin(hint) not in (Union, UnionType):
        return hint
    kinds = [kind for kind in get_args(hint) if kind is not NoneType]
    return kinds[0] if len(kinds) == 1 else hint


def _nested(hint: Any) -> tuple[Any, bool]:
    """The dataclass that a field holds, if any, and whether it holds several."""
    hint = _given(hint)
    if get_origin(hint) is tuple and is_dataclass(get_args(hint)[0]):
        return get_args(hint)[0], True
    return (hint if is_dataclass(hint) else None), False


def _spelled(name: str, unit: str) -> str:
    return f"{name}_{unit.split('|')[0]}" if unit else name


def check_schema(table: Mapping[str, Any], schema: str, where: str) -> None:
    """Check that a document says which schema it follows.

    Raises
    ------
    FormatError
        If it names none, or another.
    """
    if table.get("schema") != schema:
        raise FormatError(f'{where}: begin the file with schema = "{schema}", got {table.get("schema")!r:.60}')
