"""The bytes of a Parquet file as a table: what runs, logs and recordings in Parquet share."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Any

from elastogeo.errors import FormatError

_MAGIC = b"PAR1"
_LEAST_VALUES = 10_000_000
_VALUES_PER_BYTE = 12


def can_read(head: bytes) -> bool:
    """Whether a file that begins with these bytes is Parquet."""
    return head.startswith(_MAGIC)


def pyarrow_modules() -> tuple[ModuleType, ModuleType]:
    """The modules `pyarrow` and `pyarrow.parquet`, which take a third of a second to load: only where they are used."""
    return importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")


def opened_parquet(data: bytes, source: str) -> tuple[Any, Any]:
    """The `pyarrow.parquet.ParquetFile` of the bytes of a file, with page checksums, and its `pyarrow.Schema`.

    Raises
    ------
    FormatError
        If the file is cut off or damaged.
    """
    if len(data) < 12 or not can_read(data) or not data.endswith(_MAGIC):
        raise FormatError(f"{source}: the Parquet file is cut off (no end mark PAR1); copy or export it again")
    arrow, parquet = pyarrow_modules()
    try:
        file = parquet.ParquetFile(arrow.BufferReader(data), page_checksum_verification=True)
        return file, file.schema_arrow
    except (arrow.ArrowException, OSError, ValueError, MemoryError) as error:
        raise damaged(source, error) from None


def unpacked(file: Any, size: int, source: str, what: str) -> Any:
    """All of an opened Parquet file as a `pyarrow.Table`, checked as far as Parquet can be.

    Parameters
    ----------
    file : pyarrow.parquet.ParquetFile
    size : int
        Of the file, in bytes.
    source, what : str
        Where it came from and what its cells are called, for messages.

    Raises
    ------
    FormatError
        If it is damaged, or unpacks to far more than its size.
    """
    arrow, _ = pyarrow_modules()
    rows, values = file.metadata.num_rows, file.metadata.num_rows * file.metadata.num_columns
    most = max(_LEAST_VALUES, _VALUES_PER_BYTE * size)
    if values > most:
        raise FormatError(f"{source}: {size} bytes claim to hold {values} {what}, at most {most} are unpacked; split it")
    try:
        table = file.read()
        table.validate(full=True)
    except (arrow.ArrowException, OSError, ValueError, MemoryError) as error:
        raise damaged(source, error) from None
    if table.num_rows != rows:
        raise FormatError(f"{source}: promises {rows} rows, {table.num_rows} arrived; copy or export it again")
    return table


def damaged(source: str, error: Exception) -> FormatError:
    """The error for a Parquet file that pyarrow refuses."""
    reason = (str(error).splitlines() or ["no reason given"])[0]
    return FormatError(f"{source}: the Parquet file is damaged ({reason}); copy or export it again")
