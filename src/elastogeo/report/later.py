"""What is made when it is first read: the document and the rows of a view, of which a page shows neither."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import Any, overload

Rows = Sequence[Mapping[str, Any]]


class Later(Mapping[str, Any]):
    """A document that is made when it is first read.

    Parameters
    ----------
    make : callable
        Makes it.
    known : mapping
        Entries of it that are there already, and need the rest not to be made.
    """

    def __init__(self, make: Callable[[], Mapping[str, Any]], known: Mapping[str, Any] = MappingProxyType({})) -> None:
        self._make, self._known = make, known

    @cached_property
    def _made(self) -> Mapping[str, Any]:
        return self._make()

    def __getitem__(self, key: str) -> Any:
        return self._known[key] if key in self._known else self._made[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._made)

    def __len__(self) -> int:
        return len(self._made)


class LaterRows(Sequence[Mapping[str, Any]]):
    """Rows that are made when the first is read.

    Parameters
    ----------
    make : callable
        Makes them.
    """

    def __init__(self, make: Callable[[], Rows]) -> None:
        self._make = make

    @cached_property
    def _made(self) -> Rows:
        return self._make()

    @overload
    def __getitem__(self, place: int) -> Mapping[str, Any]: ...
    @overload
    def __getitem__(self, place: slice) -> Rows: ...
    def __getitem__(self, place: int | slice) -> Mapping[str, Any] | Rows:
        return self._made[place]

    def __len__(self) -> int:
        return len(self._made)
