"""The ground of the readers: delimited text, numbers and units, XML, TOML with units in its keys, tables of columns."""

from elastogeo.formats.text.parquet_bytes import pyarrow_modules
from elastogeo.formats.text.toml_documents import build, check_schema, read_document
from elastogeo.formats.text.units import UNITS, spellings, split_unit

__all__ = [
    "UNITS",
    "build",
    "check_schema",
    "pyarrow_modules",
    "read_document",
    "spellings",
    "split_unit",
]
