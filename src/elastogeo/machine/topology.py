"""Topology: the order of the axes from the workpiece, through the foundation, to the tool.

Two spellings are read, and mean the same: the compact one of the thesis, `wCAFYXZSt`, and that of ISO 10791-6,
`[w C' A' b Y X Z (C1) t]`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from elastogeo.errors import MachineError

LINEAR = {"X": 0, "Y": 1, "Z": 2, "U": 0, "V": 1, "W": 2}
ROTARY = {"A": 0, "B": 1, "C": 2, "S": 2}
SPINDLE = "S"
AXIS_ORDER = "XYZUVWABCS"
"""The order in which axes are listed, whatever the topology."""

_FOUNDATION = ("F", "f", "b")
_EXPECTED = "expected for example 'wCAFYXZSt' or \"[w C' A' b Y X Z (C1) t]\""


@dataclass(frozen=True, slots=True)
class Topology:
    """The two branches of a serial machine.

    Attributes
    ----------
    workpiece : tuple of str
        Axes of the workpiece branch, from the workpiece to the foundation.
    tool : tuple of str
        Axes of the tool branch, from the foundation to the tool.
    """

    workpiece: tuple[str, ...]
    tool: tuple[str, ...]

    @property
    def axes(self) -> tuple[str, ...]:
        """All axes, from the workpiece to the tool."""
        return self.workpiece + self.tool

    @property
    def compact(self) -> str:
        """The spelling of the thesis: `wCAFYXZSt`."""
        return f"w{''.join(self.workpiece)}F{''.join(self.tool)}t"

    @property
    def iso(self) -> str:
        """The spelling of ISO 10791-6: `[w C' A' b Y X Z (C1) t]`."""
        workpiece = [f"{axis}'" for axis in self.workpiece]
        tool = ["(C1)" if axis == SPINDLE else axis for axis in self.tool]
        return f"[{' '.join(['w', *workpiece, 'b', *tool, 't'])}]"


def parse_topology(text: str) -> Topology:
    """Read a topology in either spelling.

    Raises
    ------
    MachineError
        If the text is not a topology: no workpiece, tool or foundation, an unknown or repeated axis, a primed axis on the
        tool side.
    """
    stripped = text.strip()
    tokens = _iso_tokens(stripped) if stripped.startswith("[") else list(stripped)
    if len(tokens) < 3 or tokens[0] != "w" or tokens[-1] != "t":
        raise MachineError(f"topology {text!r} must begin with w (workpiece) and end with t (tool); {_EXPECTED}")
    inner = tokens[1:-1]
    grounds = [i for i, token in enumerate(inner) if token in _FOUNDATION]
    if len(grounds) != 1:
        raise MachineError(
            f"topology {text!r} names the foundation (F, f or b) {len(grounds)} times, it must be once; {_EXPECTED}"
        )
    topology = Topology(
        workpiece=tuple(token.rstrip("'") for token in inner[: grounds[0]]),
        tool=tuple(inner[grounds[0] + 1 :]),
    )
    _check_axes(topology, text)
    return topology


def _iso_tokens(text: str) -> list[str]:
    if not text.endswith("]"):
        raise MachineError(f"topology {text!r} has no closing bracket; {_EXPECTED}")
    words = text[1:-1].replace("’", "'").replace("′", "'").split()
    return [SPINDLE if re.fullmatch(r"\([A-Z]\d?\)", word) else word for word in words]


def _check_axes(topology: Topology, text: str) -> None:
    axes = topology.axes
    for axis in axes:
        if axis not in LINEAR and axis not in ROTARY:
            known = " ".join([*LINEAR, *ROTARY])
            raise MachineError(f"topology {text!r}: {axis!r} is no axis; axes are {known}; {_EXPECTED}")
        if axes.count(axis) > 1:
            raise MachineError(f"topology {text!r} names the axis {axis} {axes.count(axis)} times; each may stand once")
    if not axes:
        raise MachineError(f"topology {text!r} has no axis; {_EXPECTED}")
