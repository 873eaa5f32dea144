"""Where two documents of one result differ: numbers beyond what another platform may change, and all else."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from elastogeo.changes import Differing

TOLERANCE = 1e-12
"""Share of a number that another platform may change (`promises.md`); of a list, share of its largest."""
_NAMELESS = ("software",)


def differences(old: Any, new: Any) -> tuple[Differing, ...]:
    """What differs between two documents; who made them is not compared.

    Parameters
    ----------
    old, new : JSON values

    Returns
    -------
    tuple of Differing
        In the order of the old document; a number that is not equal but within `TOLERANCE` is none.
    """
    return tuple(_differing(old, new, "", 0.0))


def _differing(old: Any, new: Any, path: str, scale: float) -> Iterator[Differing]:
    if isinstance(old, Mapping) and isinstance(new, Mapping):
        for name in dict.fromkeys((*old, *new)):
            if path or name not in _NAMELESS:
                yield from _differing(old.get(name), new.get(name), f"{path}.{name}" if path else name, 0.0)
    elif _is_list(old) and _is_list(new) and len(old) == len(new):
        largest = max((abs(value) for value in (*old, *new) if _is_number(value)), default=0.0)
        for k, (one, other) in enumerate(zip(old, new, strict=True)):
            yield from _differing(one, other, f"{path}[{k}]", largest)
    elif _is_number(old) and _is_number(new):
        apart, size = abs(old - new), max(abs(old), abs(new), scale)
        if apart > TOLERANCE * size:
            yield Differing(path, _said(old), _said(new), apart / size)
    elif old != new or isinstance(old, bool) != isinstance(new, bool):
        yield Differing(path, _said(old), _said(new), float("inf"))


def _is_list(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _said(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."
