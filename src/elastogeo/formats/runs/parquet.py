"""Parquet: column names carry their units as in delimited text; metadata is the schema's."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from elastogeo.errors import FormatError
from elastogeo.formats.run_files import RunFormat, register
from elastogeo.formats.text.parquet_bytes import can_read, opened_parquet, pyarrow_modules, unpacked
from elastogeo.formats.text.table import SHOWN, Column, Table, named_columns, parse_headers, problems_error
from elastogeo.machine import Array


def read_parquet(data: bytes, source: str) -> Table:
    """Read a Parquet file.

    Parameters
    ----------
    data : bytes
        The whole file.
    source : str
        Its name, for messages.

    Returns
    -------
    Table
        The readings in internal units [mm, rad, N, N mm, s, mm/s; bar, A, V, degC].

    Raises
    ------
    FormatError
        If the file is cut off or damaged, a column is not of numbers or has no unit, a reading is missing or not
        finite, or the file unpacks to far more than its size.
    """
    return _read(data, source, None)


def read_parquet_columns(data: bytes, source: str, columns: Mapping[str, str]) -> Table:
    """Read the columns that a test names (our name with its unit -> column of the file) as `read_parquet` does.

    Raises
    ------
    FormatError
        As `read_parquet`, and if a column is not there.
    """
    return _read(data, source, columns)


def _read(data: bytes, source: str, wanted: Mapping[str, str] | None) -> Table:
    file, schema = opened_parquet(data, source)
    metadata = {_text(key): _text(value) for key, value in (schema.metadata or {}).items()}
    names = list(schema.names)
    named = parse_headers(names, source) if wanted is None else named_columns(names, wanted, source)
    content = unpacked(file, len(data), source, "readings")
    places = [place for place, column in enumerate(named) if column is not None]
    columns = [column for column in named if column is not None]
    _check_types(columns, [schema.types[place] for place in places], source)
    content = content.select(places)
    if not content.num_rows:
        raise FormatError(f"{source}: the Parquet file has no row of readings; export the run again")
    problems: list[str] = []
    bad = 0
    arrays = {}
    for column, cells in zip(columns, content.columns, strict=True):
        values = _numbers(column, cells, source)
        wrong = np.flatnonzero(~np.isfinite(values))
        bad += len(wrong)
        for row in wrong[: SHOWN - len(problems)].tolist():
            problems.append(f"row {row + 1}, column {column.header}: {cells[row].as_py()} is no reading; correct it")
        arrays[column.quantity] = column.internal(values)
    if bad:
        raise problems_error(source, problems, bad, "cells cannot be read (nothing was read)")
    units = {column.quantity: column.unit for column in columns}
    return Table(arrays, {k: v for k, v in metadata.items() if k != "pandas"}, source, units)


def write_parquet(columns: Mapping[str, ArrayLike], metadata: Mapping[str, str]) -> bytes:
    """Write a run as Parquet with page checksums; read back, every number is the same bit for bit.

    Parameters
    ----------
    columns : mapping of str to array, shape (m,)
        Values in the units that their headers name (`radial_um`).
    metadata : mapping of str to str
        Kept in the schema.

    Raises
    ------
    FormatError
        If headers or columns could not be read back.
    """
    parsed = parse_headers(list(columns), "columns to write")
    arrays = {c.header: np.asarray(columns[c.header], dtype=np.float64) for c in parsed}
    table = Table(arrays, metadata, "columns to write")
    arrow, parquet = pyarrow_modules()
    content = arrow.table(dict(table.columns)).replace_schema_metadata(dict(table.metadata))
    sink = arrow.BufferOutputStream()
    parquet.write_table(content, sink, write_page_checksum=True)
    return bytes(sink.getvalue())


def _check_types(columns: list[Column], types: list[Any], source: str) -> None:
    arrow, _ = pyarrow_modules()
    for column, kind in zip(columns, types, strict=True):
        if not (arrow.types.is_integer(kind) or arrow.types.is_floating(kind)):
            raise FormatError(f"{source}: column {column.header} is of type {kind}; store it as numbers (float64)")


def _numbers(column: Column, cells: Any, source: str) -> Array:
    """Values of one column, shape (m,), exactly as stored; a null becomes NaN."""
    arrow, _ = pyarrow_modules()
    try:
        values: Array = cells.cast(arrow.float64()).to_numpy()
    except arrow.ArrowInvalid:
        raise FormatError(
            f"{source}: column {column.header} has integers that a float64 would round; store them as float64"
        ) from None
    return values


def _text(value: bytes) -> str:
    return value.decode("utf-8", "replace")


def _sample() -> bytes:
    return write_parquet(
        {"angle_deg": [0.0, 90.0, 180.0], "radial_um": [0.1, -2.5, 1e-17], "force_N": [36.0, 36.25, 35.5]},
        {"machine": "a sample, of no machine"},
    )


register(RunFormat("Parquet", ".parquet", can_read, read_parquet, _sample, write_parquet, read_columns=read_parquet_columns))
