"""A column that counts samples or cycles: what it leaves out is missing in the log."""

from __future__ import annotations

import re

import numpy as np

from elastogeo.errors import FormatError
from elastogeo.machine import Array

_NAME = re.compile(
    r"(?i:(hf)?cycle(s|[ _]?(count(er)?|number|no\.?))?|counter|count|ticks?|row|index|zyklus|z(ä|ae)hler"
    r"|(sample|record|line|row|data)[ _]?(number|no\.?|index|count(er)?|id)|sample)"
)
_TURNS = tuple(2.0**bits for bits in (8, 16, 31, 32))
_DISTINCT = 0.9


def counted(name: str, values: Array, where: str, notes: list[str]) -> Array | None:
    """The counts of a column, shape (m,), made continuous where the counter began again; None if it counts nothing.

    Parameters
    ----------
    name : str
    values : array, shape (m,)
        NaN where a cell is no number.
    where : str
        File and column, for messages.
    notes : list of str
        Sentences on what it leaves out are added.

    Raises
    ------
    FormatError
        If it counts, but not forward from row to row: the rows were sorted by something else, or stand there twice.
    """
    whole = np.isfinite(values).all() and bool((values == np.rint(values)).all())
    if not _NAME.fullmatch(name) or len(values) < 3 or not whole or len(np.unique(values)) < _DISTINCT * len(values):
        return None
    steps = np.diff(values)
    forward = steps[steps > 0]
    if not len(forward):
        return None
    step = _most_common(forward)
    again = np.zeros(len(steps))
    for turn in _TURNS:
        again[steps == step - turn] = turn
    counts: Array = values + np.concatenate(([0.0], np.cumsum(again)))
    steps = np.diff(counts)
    back = np.flatnonzero(steps <= 0)
    if len(back):
        raise FormatError(
            f"{where}: counts samples, but does not go forward at sample {back[0] + 2} ({values[back[0]]:.12g}, then "
            f"{values[back[0] + 1]:.12g}; {len(back)} such places); put the rows in the order in which they were recorded"
        )
    if again.any():
        notes.append(f"column {name}: the counter began again {int((again > 0).sum())} times: counted on")
    gaps = np.flatnonzero(steps > step)
    if len(gaps):
        lost = int((steps[gaps] / step - 1).sum())
        where = f"{len(gaps)} places, the first" if len(gaps) > 1 else "one place,"
        notes.append(f"column {name} counts samples and leaves out {lost} in {where} after sample {gaps[0] + 1}")
    return counts / step


def _most_common(steps: Array) -> float:
    values, counts = np.unique(steps, return_counts=True)
    return float(values[np.argmax(counts)])
