"""The catalogue of a machine's error sources, and how a user selects from it: by name, by pattern, by preset."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from fnmatch import fnmatchcase

from elastogeo.errors import SelectionError
from elastogeo.machine import Machine
from elastogeo.sources.families import families
from elastogeo.sources.source import Source

_PLANES = {"xy": ("XYC", "XY"), "yz": ("YZA", "YZ"), "zx": ("ZXB", "ZX")}

PRESETS: dict[str, tuple[str, ...]] = {
    "compliance": ("C_*",),
    **{
        f"planar-{plane}": tuple(f"C_[{parts}][{parts}]{joint}" for joint in sorted(joints))
        for plane, (parts, joints) in _PLANES.items()
    },
    "elasto-geometric-xy": (
        *("C_XXX", "C_XYX", "C_YYY", "C_CXY", "C_CYY", "C_CCY"),
        *("E_XX1", "E_YX2", "E_XY2", "E_YY1", "E_C(0Y)X", "E_Xt0", "E_Yt0"),
    ),
}
"""Named selections: all joint compliances; those that act in one plane (Eq. 4.14); the 13 of Table 5.1."""


def catalogue(machine: Machine) -> dict[str, Source]:
    """Every error source of a machine, by name."""
    return {source.name: source for sources in families().values() for source in sources(machine)}


def select_sources(machine: Machine, patterns: Iterable[str]) -> tuple[Source, ...]:
    """The sources that names, patterns or presets select, each once, in the order of the patterns.

    Parameters
    ----------
    machine : Machine
    patterns : iterable of str
        Names (`C_XXX`), shell patterns (`C_*`, `C_??X`, `C_[XY][XY]Y`) or presets (`planar-xy`).

    Raises
    ------
    SelectionError
        If one of them selects nothing, or there is none.
    """
    known = catalogue(machine)
    selected: dict[str, Source] = {}
    for pattern in patterns:
        for part in PRESETS.get(pattern, (pattern,)):
            selected.update(_matching(known, part, machine))
    if not selected:
        raise SelectionError("no parameter was asked for; name some, for example C_XXX, C_??X or planar-xy")
    return tuple(selected.values())


def _matching(known: dict[str, Source], pattern: str, machine: Machine) -> dict[str, Source]:
    if pattern in known:
        return {pattern: known[pattern]}
    matching = {name: source for name, source in known.items() if fnmatchcase(name, pattern)}
    if not matching:
        near = get_close_matches(pattern, [*known, *PRESETS], n=3)
        hint = f"; close to it: {', '.join(near)}" if near else f"; presets: {', '.join(PRESETS)}"
        raise SelectionError(f"{pattern!r} selects no error source of {machine.topology.compact}{hint}")
    return matching
