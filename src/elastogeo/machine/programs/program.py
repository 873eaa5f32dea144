"""A program: blocks in order, whatever control it was written for, and the path that it commands a machine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import radians

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.machine.machine import Machine
from elastogeo.machine.programs.blocks import Block
from elastogeo.machine.programs.motion import MovesOf, ProgramPath, Rows, check_moves, moves_of, path_of
from elastogeo.machine.programs.packed import PROGRAM_AXES, PackedBlocks, packed

_TURN = radians(0.5)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Program(ByValue):
    """What a machine is told to do, in axis commands.

    Attributes
    ----------
    name : str
    blocks : sequence of Block
        In order. They are kept packed: a million take a hundred megabytes.
    lines : array of int, shape (k,), or None
        The line of each block in the file it was read from.
    notes : tuple of str
        What of that file was left out, in words: tools, spindle, coolant.
    """

    name: str
    blocks: Sequence[Block]
    lines: Rows | None = None
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Pack the blocks."""
        object.__setattr__(self, "blocks", packed(self.blocks))

    def __repr__(self) -> str:
        return f"<Program {self.name!r}: {len(self.blocks)} blocks, {' '.join(self.axes) or 'no axis moves'}>"

    @property
    def packed(self) -> PackedBlocks:
        """The blocks as arrays."""
        return packed(self.blocks)

    @property
    def axes(self) -> tuple[str, ...]:
        """The axes that it moves."""
        to = self.packed.to
        return tuple(axis for k, axis in enumerate(PROGRAM_AXES) if not np.isnan(to[:, k]).all())

    def moves(self, start: Mapping[str, float] | None = None) -> MovesOf:
        """Every move with the commands of all axes at both ends; `start` as of `path`."""
        return moves_of(self.packed, start or {})

    def path(
        self,
        machine: Machine,
        step: float,
        *,
        turn: float = _TURN,
        start: Mapping[str, float] | None = None,
        tolerance: float | None = None,
    ) -> ProgramPath:
        """The path that it commands, along lines and arcs; rapid moves only lead from one to the next.

        Parameters
        ----------
        machine : Machine
            With n joints; it must have every axis that the program moves.
        step : float [mm]
            Greatest distance of two points along a block.
        turn : float [rad]
            Greatest turn of a rotary axis from point to point.
        start : mapping of str to float [mm, rad], optional
            Where axes are at the beginning; an axis not named is where its first command puts it, or at zero.
        tolerance : float [mm], optional
            Refuse an arc whose end is farther than this from its circle.

        Returns
        -------
        ProgramPath

        Raises
        ------
        MachineError
            If the machine has no such axis.
        PathError
            If a number is not finite, a feed not positive, or an arc is none; with its block.
        """
        moves = check_moves(self.moves(start), tolerance, self.lines)
        return path_of(moves, machine, step, turn)

    def paths(self, machine: Machine, step: float, *, blocks: int = 50_000, turn: float = _TURN) -> Iterator[ProgramPath]:
        """The same path in parts of so many blocks, one after the other, for programs whose path fills the memory."""
        moves = check_moves(self.moves(), None, self.lines)
        time = 0.0
        for first in range(0, len(moves.block), blocks):
            part = path_of(moves.at(slice(first, first + blocks)), machine, step, turn, time)
            time = part.end_time
            if len(part.block):
                yield part

    def extent(self) -> dict[str, tuple[float, float]]:
        """Least and greatest command [mm, rad] of each axis that it moves, within arcs too."""
        low, high = self.moves().extent()
        ends = dict(zip(PROGRAM_AXES, zip(low.tolist(), high.tolist(), strict=True), strict=True))
        return {axis: ends[axis] for axis in self.axes}
