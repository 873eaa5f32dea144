"""What a whole family of tests tells of a machine: every pose of its travel, every load and reading of one kind.

The closed form (`ceilings`) is for six loads and six readings. A bar sees the force along its own line only, probes see no
rotation, and what they see of a lever they see with the tools that they are given; so their ceiling is counted, as the rank
of all their readings at many random poses at once.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from elastogeo.equality import ByValue
from elastogeo.errors import InputError
from elastogeo.identification import reciprocal_sources
from elastogeo.machine import Array, Machine, Point
from elastogeo.observe import BAR, PROBES, SIX
from elastogeo.planning.ceilings import compliances_of
from elastogeo.planning.rank import counted, decomposed, rank_of, unit_rows
from elastogeo.prediction import functionals, parameter_scales, virtual_observations

SEEN = 1e-9
"""Relative tolerance of the rank. Every machine looked at has ten orders between what counts and what does not."""

_LINEAR_REACH, _ROTARY_REACH = 300.0, pi
_AT_LEAST = 24


@dataclass(frozen=True, slots=True, eq=False)
class FamilyCeiling(ByValue):
    """What all tests of a family tell together.

    Attributes
    ----------
    family : str
        `bar`, `probes` or `six`.
    labels : tuple of str
        The p compliances.
    seen : array, shape (p, r)
        Orthonormal basis of what is seen, in scaled parameters (`prediction.parameter_scales`).
    gap : float
        The last singular value that counts over the first that does not; infinite where none is left.
    """

    family: str
    labels: tuple[str, ...]
    seen: Array
    gap: float

    @property
    def rank(self) -> int:
        """How many combinations of the compliances are told."""
        return int(self.seen.shape[1])

    @property
    def columns(self) -> int:
        """How many compliances there are."""
        return len(self.labels)

    def among(self, names: Collection[str]) -> int:
        """The rank of some of the compliances, all others being rigid.

        Raises
        ------
        InputError
            If a name is none of the compliances.
        """
        unknown = [name for name in names if name not in self.labels]
        if unknown:
            raise InputError(f"{', '.join(unknown)}: no compliance of a joint of this machine")
        rows = self.seen[[self.labels.index(name) for name in dict.fromkeys(names)]]
        return rank_of(rows / np.linalg.norm(rows, axis=1, keepdims=True).clip(SEEN), SEEN)


def family_ceiling(
    machine: Machine,
    family: str,
    tools: Sequence[Point] = (),
    reciprocal: bool = False,
    held: Mapping[str, float] | None = None,
    seed: int = 0,
) -> FamilyCeiling:
    """The rank of all tests of a family at random poses within the travel.

    Parameters
    ----------
    machine : Machine
    family : {"bar", "probes", "six"}
        A loaded bar; static forces with three probes; six loads with six readings.
    tools : sequence of tuple of 3 float [mm]
        Functional points that the tests are made with, in the frame of the last carriage; the machine's own if none.
    reciprocal : bool
        Whether every joint counts as symmetric.
    held : mapping of str to float [mm, rad], optional
        Axes that do not move, and where they stand.
    seed : int
        Of the poses.

    Raises
    ------
    InputError
        If there is no such family.
    """
    loads, readings = _pairs(family)
    compliances = compliances_of(machine)
    sources = reciprocal_sources(compliances) if reciprocal else compliances
    tools = list(tools) or [machine.tool]
    poses = max(_AT_LEAST, 2 * len(sources) // (len(loads) * len(tools)) + 1)
    random = np.random.default_rng(seed)
    scales = parameter_scales(sources)
    blocks = []
    for tool in tools:
        commands = np.repeat(_poses(machine, held or {}, poses, random), len(loads), axis=0)
        observed = virtual_observations(
            machine, commands, np.tile(readings, (poses, 1)), np.tile(loads, (poses, 1)), np.asarray(tool, dtype=float)
        )
        rows = functionals(sources, machine, observed) * scales
        blocks.append(unit_rows(rows))
    values, turns = decomposed(np.vstack(blocks))
    rank = counted(values, SEEN)
    left = values[rank] if rank < len(values) else 0.0
    gap = float(values[rank - 1] / left) if left else float("inf")
    return FamilyCeiling(family, tuple(source.name for source in sources), np.ascontiguousarray(turns[:rank].T), gap)


def _pairs(family: str) -> tuple[Array, Array]:
    """Loads and readings that span what a family sees at one pose, shape (k, 6) each [N and mm, or N mm and rad]."""
    unit = np.eye(6)
    match family:
        case "bar":  # six lines in general position span the symmetric 3 x 3 tensors
            lines = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]], dtype=float)
            along = np.hstack([lines / np.linalg.norm(lines, axis=1, keepdims=True), np.zeros((6, 3))])
            return along, along
        case "probes":
            return np.tile(unit[:3], (3, 1)), np.repeat(unit[:3], 3, axis=0)
        case "six":
            return np.tile(unit, (6, 1)), np.repeat(unit, 6, axis=0)
    raise InputError(f"there is no family {family!r} of tests; the families are {BAR}, {PROBES} and {SIX}")


def _poses(machine: Machine, held: Mapping[str, float], count: int, random: np.random.Generator) -> Array:
    """Random commands within the travel; within 300 mm and half a turn where it has no end."""
    columns = []
    for joint in machine.joints:
        reach = _ROTARY_REACH if joint.is_rotary else _LINEAR_REACH
        low, high = (end if np.isfinite(end) else other for end, other in zip(joint.travel, (-reach, reach), strict=True))
        columns.append(random.uniform(min(low, high), max(low, high), count))
    commands = np.column_stack(columns)
    for axis, command in held.items():
        commands[:, machine.index(axis)] = command
    return commands
