"""Timestamps of a log -> seconds since the first of them, without the loss of a digit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime, timedelta

import numpy as np
from numpy.typing import NDArray

from elastogeo.errors import FormatError
from elastogeo.formats.text.heading import STAMP
from elastogeo.formats.text.rows import NO_NUMBER
from elastogeo.machine import Array

_WHOLE = len("2026-01-31T12:00:00")
_ALIKE = re.compile(r"(?:\d{4}-\d{2}-\d{2}[T ]\d{2}:\d{2}:\d{2}(?:[.,]\d{1,12})?Z?\n)+", re.ASCII)
_EPOCH = datetime(1970, 1, 1)


class Timestamps:
    """ISO 8601 times with their dates, taken block by block: whole seconds as integers, their fractions beside them.

    Attributes
    ----------
    first : str
        The first of them as it was written; empty until there is one.
    """

    def __init__(self) -> None:
        self.first = ""
        self._whole: list[NDArray[np.int64]] = []
        self._part: list[Array] = []
        self._count = 0
        self._zoned: bool | None = None
        self._wrong: tuple[int, str, str] | None = None

    def take(self, cells: Sequence[str]) -> None:
        """Add the times of a block; an empty cell is a sample without a time."""
        whole, part = self._alike(cells) or self._each(cells)
        self.first = self.first or next(filter(None, cells), "")
        self._whole.append(whole)
        self._part.append(part)
        self._count += len(cells)

    def seconds(self, where: str) -> Array:
        """Seconds since the first timestamp, shape (m,); NaN where there is none.

        Raises
        ------
        FormatError
            If a cell is no time, or some have a zone and some have none.
        """
        if self._wrong is not None:
            sample, cell, reason = self._wrong
            raise FormatError(f"{where}: {cell[:40]!r} of sample {sample} {reason}")
        whole, part = np.concatenate(self._whole), np.concatenate(self._part)
        there = np.flatnonzero(np.isfinite(part))
        if not len(there):
            return np.full(self._count, np.nan)
        return np.asarray((whole - whole[there[0]]) + (part - part[there[0]]))

    def _alike(self, cells: Sequence[str]) -> tuple[NDArray[np.int64], Array] | None:
        """All cells at once, where each is a time of one kind; None otherwise."""
        text = "\n".join(cells) + "\n"
        zoned = text.count("Z")
        if not _ALIKE.fullmatch(text) or zoned not in (0, len(cells)) or self._zoned not in (None, zoned > 0):
            return None
        try:
            whole = np.array([cell[:_WHOLE] for cell in cells], dtype="M8[s]").astype(np.int64)
        except ValueError:
            return None
        self._zoned = zoned > 0
        rest = [cell[_WHOLE + 1 :].rstrip("Z") for cell in cells]
        return whole, np.array([float(f"0.{part or 0}") for part in rest])

    def _each(self, cells: Sequence[str]) -> tuple[NDArray[np.int64], Array]:
        whole = np.zeros(len(cells), dtype=np.int64)
        part = np.full(len(cells), np.nan)
        for k, cell in enumerate(cells):
            if cell.lower() in NO_NUMBER or self._wrong is not None:
                continue
            found = STAMP.fullmatch(cell)
            try:
                if found is None:
                    raise ValueError
                time = datetime.fromisoformat(found["whole"] + (found["zone"] or ""))
            except ValueError:
                self._wrong = (self._count + k + 1, cell, "is no ISO 8601 time with its date; correct it")
                continue
            zoned = time.tzinfo is not None
            self._zoned = zoned if self._zoned is None else self._zoned
            if zoned != self._zoned:
                self._wrong = (self._count + k + 1, cell, "has a zone or has none, unlike the first; use one kind")
                continue
            since = time.replace(tzinfo=None) - (time.utcoffset() or timedelta())
            whole[k] = int((since - _EPOCH).total_seconds())
            part[k] = float(f"0.{found['part'] or 0}")
        return whole, part
