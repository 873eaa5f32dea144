"""Blocks packed in arrays: a program of a million blocks takes a hundred megabytes, not a gigabyte."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import nan
from typing import Any, overload

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Array
from elastogeo.machine.programs.blocks import PLANE_AXES, Arc, Block, Comment, Dwell, Line, Rapid, Stop

PROGRAM_AXES = "XYZUVWABC"
"""Axes that a block may move, in the order of the columns."""

PLANES = tuple(PLANE_AXES)
RAPID, LINE, ARC, OTHER = range(4)
_COLUMN = {axis: k for k, axis in enumerate(PROGRAM_AXES)}
_NOWHERE = (nan,) * len(PROGRAM_AXES)

Small = np.ndarray[tuple[int], np.dtype[np.int8]]
Counts = np.ndarray[tuple[int], np.dtype[np.int16]]


class PackedBlocks(Sequence[Block]):
    """The blocks of a program as arrays, one row a block.

    Attributes
    ----------
    kind : array of int, shape (k,)
        `RAPID`, `LINE`, `ARC` or `OTHER`.
    to : array, shape (k, 9) [mm, rad]
        Axis commands at the end, in the order of `PROGRAM_AXES`; NaN for an axis that the block does not name.
    feed : array, shape (k,) [mm/s or rad/s]
    plane : array of int, shape (k,)
        Of an arc, its place in `PLANES`.
    centre : array, shape (k, 2) [mm]
        Of an arc.
    turns : array of int, shape (k,)
        Of an arc, with the sign of its sense.
    others : mapping of int to Dwell, Stop or Comment
        By their place in the program.
    """

    __slots__ = ("centre", "feed", "kind", "others", "plane", "to", "turns")

    def __init__(
        self,
        kind: Small,
        to: Array,
        feed: Array,
        plane: Small,
        centre: Array,
        turns: Counts,
        others: Mapping[int, Dwell | Stop | Comment],
    ) -> None:
        self.kind, self.to, self.feed, self.plane, self.centre, self.turns = kind, to, feed, plane, centre, turns
        self.others = others

    def __len__(self) -> int:
        return len(self.kind)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PackedBlocks):
            return NotImplemented
        arrays = ("kind", "to", "feed", "plane", "centre", "turns")
        same = (np.array_equal(getattr(self, n), getattr(other, n), equal_nan=True) for n in arrays)
        return all(same) and self.others == other.others

    __hash__ = None  # type: ignore[assignment]

    @overload
    def __getitem__(self, place: int) -> Block: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Block]: ...
    def __getitem__(self, place: int | slice) -> Block | Sequence[Block]:
        if isinstance(place, slice):
            return [self[k] for k in range(*place.indices(len(self)))]
        if not -len(self) <= place < len(self):
            raise IndexError(f"block {place} of {len(self)}")
        return self._block(place % len(self))

    def __iter__(self) -> Iterator[Block]:
        return map(self._block, range(len(self)))

    def _block(self, k: int) -> Block:
        kind = self.kind[k]
        if kind == OTHER:
            return self.others[k]
        to = {axis: value for axis, value in zip(PROGRAM_AXES, self.to[k].tolist(), strict=True) if value == value}
        if kind == RAPID:
            return Rapid(to)
        feed = float(self.feed[k])
        if kind == LINE:
            return Line(to, feed)
        turns, (first, second) = int(self.turns[k]), self.centre[k].tolist()
        return Arc(PLANES[self.plane[k]], to, (first, second), 1 if turns > 0 else -1, feed, abs(turns))


class Packing:
    """Blocks that are being packed, one after the other."""

    __slots__ = ("_centre", "_feed", "_kind", "_others", "_plane", "_to", "_turns")

    def __init__(self) -> None:
        self._kind, self._plane, self._turns = array("b"), array("b"), array("h")
        self._to, self._feed, self._centre = array("d"), array("d"), array("d")
        self._others: dict[int, Dwell | Stop | Comment] = {}

    def __len__(self) -> int:
        return len(self._kind)

    def rapid(self, to: Sequence[float]) -> None:
        """Add a rapid move; its end has one number for each of `PROGRAM_AXES`, NaN for one that stays."""
        self._row(RAPID, to, nan, 0, (nan, nan), 0)

    def line(self, to: Sequence[float], feed: float) -> None:
        """Add a line, as `rapid`."""
        self._row(LINE, to, feed, 0, (nan, nan), 0)

    def arc(self, plane: int, to: Sequence[float], centre: Sequence[float], turns: int, feed: float) -> None:
        """Add an arc, as `rapid`; the turns have the sign of its sense."""
        self._row(ARC, to, feed, plane, centre, turns)

    def other(self, block: Dwell | Stop | Comment) -> None:
        """Add a block that moves nothing."""
        self._others[len(self)] = block
        self._row(OTHER, _NOWHERE, nan, 0, (nan, nan), 0)

    def add(self, block: Block) -> None:
        """Add any block.

        Raises
        ------
        InputError
            If it moves an axis that is none, or an arc has no such plane, sense or number of turns.
        """
        match block:
            case Rapid(to):
                self.rapid(_row_of(to))
            case Line(to, feed):
                self.line(_row_of(to), feed)
            case Arc(plane, to, centre, sense, feed, turns):
                if plane not in PLANE_AXES or sense not in (1, -1) or not 1 <= turns < 1000:
                    raise InputError(
                        f"an arc in plane {plane!r} of sense {sense} with {turns} turns; the plane is {', '.join(PLANES)}, "
                        f"the sense 1 or -1, and the turns 1 to 999"
                    )
                self.arc(PLANES.index(plane), _row_of(to), centre, sense * turns, feed)
            case Dwell() | Stop() | Comment():
                self.other(block)

    def packed(self) -> PackedBlocks:
        """What was added; nothing can be added after it, as the arrays are the same memory."""
        width = len(PROGRAM_AXES)
        if not len(self):
            return _NOTHING
        return PackedBlocks(
            np.frombuffer(self._kind, dtype=np.int8),
            np.frombuffer(self._to).reshape(-1, width),
            np.frombuffer(self._feed),
            np.frombuffer(self._plane, dtype=np.int8),
            np.frombuffer(self._centre).reshape(-1, 2),
            np.frombuffer(self._turns, dtype=np.int16),
            self._others,
        )

    def _row(self, kind: int, to: Iterable[float], feed: float, plane: int, centre: Iterable[float], turns: int) -> None:
        self._kind.append(kind)
        self._to.extend(to)
        self._feed.append(feed)
        self._plane.append(plane)
        self._centre.extend(centre)
        self._turns.append(turns)


_NOTHING = PackedBlocks(
    np.zeros(0, dtype=np.int8),
    np.zeros((0, len(PROGRAM_AXES))),
    np.zeros(0),
    np.zeros(0, dtype=np.int8),
    np.zeros((0, 2)),
    np.zeros(0, dtype=np.int16),
    {},
)


def packed(blocks: Iterable[Block]) -> PackedBlocks:
    """Blocks, packed; those that are packed already, as they are."""
    if isinstance(blocks, PackedBlocks):
        return blocks
    packing = Packing()
    for block in blocks:
        packing.add(block)
    return packing.packed()


def _row_of(to: Mapping[str, float]) -> list[float]:
    row: list[Any] = list(_NOWHERE)
    for axis, value in to.items():
        if axis not in _COLUMN:
            raise InputError(f"a block moves the axis {axis!r}; axes are {' '.join(PROGRAM_AXES)}")
        if value != value:
            raise InputError(f"a block moves {axis} to {value}; give a number, or leave the axis out if it stays")
        row[_COLUMN[axis]] = value
    return row
