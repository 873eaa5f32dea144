"""How many of a machine's compliances the best tests between tool and workpiece could ever distinguish, and which not.

Two compliances that follow each other in the loop, with some axes moving between them, exchange a tensor `T` unseen if
each of these motions leaves `T` unchanged (`invariants`): what one gains and the other loses, carried to its frame, moves
no tool at any pose, under any load, with any tool. Six loads and six readings of a twist at poses that fill the travel miss
these exchanges and no others, so that

    rank = columns - sum over neighbours in the loop of dim Inv(the axes that move between them).

On a branch the motion between two joints is that of the outer one; across the foundation it is that of the first joint of
each branch. A rigid axis that moves adds its motion to the pair that it separates; one that is held separates nothing.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.estimate import RANK_TOLERANCE
from elastogeo.identification import reciprocal_sources
from elastogeo.machine import Array, Frame, LoopFrames, Machine, Site, loop_frames
from elastogeo.planning.invariants import generator, invariants, twist_map
from elastogeo.planning.rank import counted, rank_of, unit_rows
from elastogeo.prediction import parameter_scales
from elastogeo.sources import Source, select_sources

DEPENDENT = 1e-9
"""Relative tolerance of ranks of scaled directions."""


@dataclass(frozen=True, slots=True, eq=False)
class Pair(ByValue):
    """Two neighbouring compliances of the loop, and what they exchange unseen.

    Attributes
    ----------
    first, second : str
        Axis letters, or names of places, in the order from workpiece to tool.
    moving : tuple of str
        The axes that move between them, and are not held; none if nothing does.
    exchanges : array, shape (k, p)
        What each invariant tensor changes in every compliance: the second gains it, the first loses it.
    """

    first: str
    second: str
    moving: tuple[str, ...]
    exchanges: Array


@dataclass(frozen=True, eq=False)
class Ceiling(ByValue):
    """What tests between tool and workpiece can tell of the compliances of a machine, at most.

    Attributes
    ----------
    sources : tuple of Source
        The p compliances, in the order of the catalogue; those of a reciprocal pair are one.
    pairs : tuple of Pair
        From workpiece to tool.
    reciprocal : bool
        Whether every joint counts as symmetric.
    held : mapping of str to float [mm, rad]
        The axes that no test moves.
    """

    sources: tuple[Source, ...]
    pairs: tuple[Pair, ...]
    reciprocal: bool
    held: Mapping[str, float]

    @cached_property
    def labels(self) -> tuple[str, ...]:
        """The names of the compliances."""
        return tuple(source.name for source in self.sources)

    @cached_property
    def scales(self) -> Array:
        """The size that each is expected to have, shape (p,), in its unit: what a direction is small against."""
        return parameter_scales(self.sources)

    @property
    def columns(self) -> int:
        """How many compliances there are."""
        return len(self.sources)

    @cached_property
    def kernel(self) -> Array:
        """What no test sees, shape (k, p): a basis, each row a change of the compliances in their units."""
        return np.vstack([np.zeros((0, self.columns)), *(pair.exchanges for pair in self.pairs)])

    @property
    def rank(self) -> int:
        """How many combinations of the compliances six loads and six readings determine: no test tells more."""
        return self.columns - sum(len(pair.exchanges) for pair in self.pairs)

    def among(self, names: Collection[str]) -> int:
        """The same of some of the compliances, all others being rigid.

        Raises
        ------
        InputError
            If a name is none of the compliances.
        """
        inside = self._places_of(names)
        outside = np.delete(self.kernel / self.scales, inside, axis=1)
        return len(inside) - (len(outside) - rank_of(unit_rows(outside), DEPENDENT))

    def gain(self, names: Collection[str]) -> int:
        """By how much the rank grows if each of these compliances becomes known by itself, by a reading elsewhere."""
        return rank_of(unit_rows((self.kernel / self.scales)[:, self._places_of(names)]), DEPENDENT)

    def unseen(self, name: str) -> bool:
        """Whether a compliance is never known by itself: something that no test sees changes it."""
        return bool(self.kernel[:, self._places_of([name])].any())

    def alike(self, names: Collection[str]) -> tuple[tuple[str, ...], ...]:
        """Groups of these compliances that make the same trace, but for its size, in every test; all others are rigid."""
        inside = self._places_of(names)
        rows = self.kernel / self.scales
        hidden = rows[:, inside] if len(inside) == self.columns else _vanishing(rows, inside)
        _, _, Vt = np.linalg.svd(hidden)
        seen = unit_rows(Vt[len(hidden) :].T)
        groups: list[tuple[str, ...]] = []
        left = np.flatnonzero(seen.any(axis=1))
        while left.size:
            along = seen[left] @ seen[left[0]]
            same = np.linalg.norm(seen[left] - np.outer(along, seen[left[0]]), axis=1) < RANK_TOLERANCE
            groups.append(tuple(self.labels[inside[k]] for k in left[same]))
            left = left[~same]
        return tuple(group for group in groups if len(group) > 1)

    def _places_of(self, names: Collection[str]) -> list[int]:
        place = {label: k for k, label in enumerate(self.labels)}
        unknown = [name for name in names if name not in place]
        if unknown:
            raise InputError(
                f"{', '.join(unknown)}: no compliance of a joint of this machine"
                + (" (of a reciprocal pair the name of the one that stands for both)" if self.reciprocal else "")
                + f"; they are {self.labels[0]} to {self.labels[-1]}"
            )
        return [place[name] for name in dict.fromkeys(names)]


def ceiling(machine: Machine, reciprocal: bool = False, held: Mapping[str, float] | None = None) -> Ceiling:
    """The ceiling of what tests between tool and workpiece tell of the compliances of all joints and places.

    Parameters
    ----------
    machine : Machine
    reciprocal : bool
        Whether every joint counts as symmetric: 21 compliances instead of 36.
    held : mapping of str to float [mm, rad], optional
        Axes that no test moves, and where they stand. All others move over an interval of their travel.

    Raises
    ------
    SelectionError
        If the machine has no compliance.
    MachineError
        If it has no axis that is held.
    """
    held = dict(held or {})
    compliances = compliances_of(machine)
    sources = reciprocal_sources(compliances) if reciprocal else compliances
    commands = np.zeros((1, len(machine.axes)))
    for axis, command in held.items():
        commands[0, machine.index(axis)] = command
    frames = loop_frames(machine, commands)
    loop = _Loop(machine, frames, sources, reciprocal)
    return Ceiling(
        sources=sources,
        pairs=tuple(loop.pair(first, second, moving) for first, second, moving in _neighbours(machine, held)),
        reciprocal=reciprocal,
        held=held,
    )


def compliances_of(machine: Machine) -> tuple[Source, ...]:
    """All 36 compliances of every compliant joint and place, in the order of the catalogue.

    Raises
    ------
    SelectionError
        If there are none.
    """
    return tuple(select_sources(machine, ["C_*", *(["CL_*"] if machine.places else [])]))


@dataclass(frozen=True, slots=True)
class _Loop:
    """The structural loop at one pose, and the compliances in it."""

    machine: Machine
    frames: LoopFrames
    sources: tuple[Source, ...]
    reciprocal: bool

    def pair(self, first: Site, second: Site, moving: tuple[str, ...]) -> Pair:
        """What two neighbours exchange: tensors in the frame of the second, carried to the first."""
        here, there = (twist_map(_alone(self.frames.carried_at(name)[0])) for _, name in (second, first))
        into = np.linalg.inv(here)
        generators = [into @ self._generator(axis) @ here for axis in moving]
        tensors = invariants(generators, self.reciprocal)
        carried = np.linalg.inv(there) @ here
        exchanges = self._entries(second, tensors) - self._entries(first, carried @ tensors @ carried.T)
        return Pair(first[1], second[1], moving, exchanges)

    def _generator(self, axis: str) -> Array:
        joint = self.machine.joints[self.machine.index(axis)]
        return generator(_alone(self.frames.joints[axis].location), joint.direction, joint.is_rotary)

    def _entries(self, site: Site, tensors: Array) -> Array:
        """The tensors as changes of all compliances, shape (k, p), with what rounding leaves set to zero."""
        rows = np.zeros((len(tensors), len(self.sources)))
        for k, source in enumerate(self.sources):
            if source.site == site:
                rows[:, k] = tensors[:, source.component, source.load or 0]
        scaled = rows / parameter_scales(self.sources)  # an entry of 1e-9 of the greatest is rounding error
        rows[np.abs(scaled) < DEPENDENT * np.abs(scaled).max(axis=1, keepdims=True, initial=0.0)] = 0.0
        return rows


def _neighbours(machine: Machine, held: Collection[str]) -> list[tuple[Site, Site, tuple[str, ...]]]:
    """Neighbouring compliances from workpiece to tool, with the axes that move between them."""
    found: list[tuple[Site, Site, tuple[str, ...]]] = []
    last: Site | None = None
    moving: tuple[str, ...] = ()
    for kind, name in _around(machine):
        if kind == "move":
            moving = moving if name in held else (*moving, name)
            continue
        if last is not None:
            found.append((last, (kind, name), moving))
        last, moving = (kind, name), ()
    return found


def _around(machine: Machine) -> list[Site]:
    """The loop from workpiece to tool: `("motion", axis)` and `("place", name)` give way, `("move", axis)` moves.

    A compliance acts at the carriage, so on the workpiece branch it comes before the motion of its axis, on the tool branch
    after it; a place sits on its carriage, away from the foundation.
    """
    compliant = {joint.name for joint in machine.compliant}

    def places(on: str) -> list[Site]:
        return [("place", place.name) for place in machine.places if place.on == on]

    def gives_way(axis: str) -> list[Site]:
        return [("motion", axis)] if axis in compliant else []

    outward = places("tool")
    for axis in reversed(machine.topology.tool):
        outward = [("move", axis), *gives_way(axis), *places(axis), *outward]
    inward = places("workpiece")[::-1]
    for axis in machine.topology.workpiece:
        inward = [*inward, *places(axis)[::-1], *gives_way(axis), ("move", axis)]
    return [*inward, *outward]


def _alone(frame: Frame) -> Frame:
    """A frame at the first pose, upright or not."""
    return Frame(np.asarray(frame.rotation[:1]), np.asarray(frame.origin[:1]))


def _vanishing(rows: Array, inside: list[int]) -> Array:
    """What combinations of rows leave inside, shape (k, len(inside)), that vanish everywhere else."""
    outside = np.delete(rows, inside, axis=1)
    U, values, _ = np.linalg.svd(outside)
    return np.asarray(U[:, counted(values, DEPENDENT) :].T @ rows[:, inside])
