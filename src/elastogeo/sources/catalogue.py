"""The catalogue of a machine's error sources, and how a user selects from it: by name, by pattern, by preset."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from fnmatch import fnmatchcase
from functools import cache, lru_cache
from types import MappingProxyType

from elastogeo.errors import SelectionError
from elastogeo.machine import Machine
from elastogeo.sources.families import families, source_named
from elastogeo.sources.source import Source

_PLANES = {"xy": ("XYC", "XY"), "yz": ("YZA", "YZ"), "zx": ("ZXB", "ZX")}


def _planar(parts: str, axes: str) -> tuple[str, ...]:
    """Compliances that act in one plane (Eq. 4.14)."""
    return tuple(f"C_[{parts}][{parts}]{axis}" for axis in sorted(axes))


def _ball_bar(parts: str, axes: str) -> tuple[str, ...]:
    """What users of ball bar software look for in one plane."""
    one, other, turn = axes[0], axes[1], parts[2]
    return (
        *(f"E_{axis}{axis}1" for axis in axes),
        f"E_{turn}(0[XYZ])[{axes}]|E_{turn}(0){one}",
        *(f"E_{other}{one}2", f"E_{one}{other}2"),
        *(f"B_{d}{axis}" for axis in axes for d in axes),
        *(f"S_{axis}{axis}" for axis in axes),
        *(f"P_{axis}{axis}[cs]1|" for axis in axes),
        *(f"T_{axis}1" for axis in axes),
    )


def _loaded(parts: str, axes: str) -> tuple[str, ...]:
    """What a loaded circle in one plane shows: compliance, geometry, location; the set-up is of each run for itself."""
    one, other, turn = axes[0], axes[1], parts[2]
    return (
        *_planar(parts, axes),
        *(f"E_{axis}{axis}1" for axis in axes),
        *(f"E_{other}{one}2", f"E_{one}{other}2"),
        f"E_{turn}(0[XYZ])[{axes}]|E_{turn}(0){one}",
    )


PRESETS: dict[str, tuple[str, ...]] = {
    "compliance": ("C_*",),
    **{f"planar-{plane}": _planar(*letters) for plane, letters in _PLANES.items()},
    **{f"ball-bar-{plane}": _ball_bar(*letters) for plane, letters in _PLANES.items()},
    **{f"loaded-{plane}": _loaded(*letters) for plane, letters in _PLANES.items()},
    "elasto-geometric-xy": (
        *("C_XXX", "C_XYX", "C_YYY", "C_CXY", "C_CYY", "C_CCY"),
        *("E_XX1", "E_YX2", "E_XY2", "E_YY1", "E_C(0Y)X", "E_Xt0", "E_Yt0"),
    ),
    "rotary-axes": tuple(f"E_[{across}](0*){axis}|" for axis, across in {"A": "YZBC", "B": "XZAC", "C": "XYAB"}.items()),
    "volumetric": ("V_*", "G_*"),
    "geometry-3-axis": ("E_[XYZABC][XYZ][12]", "E_[ABC](0*)[XYZ]"),
    "geometry-5-axis": ("E_[XYZABC][XYZ][12]", "E_[XYZABC][ABC][cs]1", "E_?(0*)[XYZABC]"),
}
"""Named selections: all joint compliances; those of one plane; ball bar diagnosis; compliance, geometry and location of a
loaded circle; the 13 of Table 5.1, whose set-up is one for all runs; the location errors of rotary axes across themselves
(ISO 230-1: two positions and two orientations each); compliance and path by direction; whole machines.

In a pattern `|` separates alternatives, of which the first that selects anything counts; an empty one may select nothing.
"""


@cache
def catalogue(machine: Machine) -> Mapping[str, Source]:
    """Every error source that the families list for a machine, by name."""
    return MappingProxyType({source.name: source for sources in families().values() for source in sources(machine)})


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
        If one of them selects nothing or is empty, or there is none.
    """
    return _selected(machine, tuple(patterns))


@lru_cache(maxsize=256)
def _selected(machine: Machine, patterns: tuple[str, ...]) -> tuple[Source, ...]:
    """As `select_sources`: the tests of a campaign ask for the same again and again."""
    known = catalogue(machine)
    selected: dict[str, Source] = {}
    for pattern in patterns:
        if not pattern.strip("| "):
            raise SelectionError(f"{pattern!r} among the parameters names none; take it out, or name one, for example C_XXX")
        for part in PRESETS.get(pattern, (pattern,)):
            selected.update(_first_matching(known, part, machine))
    if not selected:
        raise SelectionError("no parameter was asked for; name some, for example C_XXX, C_??X or planar-xy")
    return tuple(selected.values())


def _first_matching(known: Mapping[str, Source], pattern: str, machine: Machine) -> dict[str, Source]:
    """What the first of several alternatives selects that selects anything."""
    *first, last = pattern.split("|")
    for alternative in first:
        if any(fnmatchcase(name, alternative) for name in known):
            return _matching(known, alternative, machine)
    return _matching(known, last, machine) if last else {}


def _matching(known: Mapping[str, Source], pattern: str, machine: Machine) -> dict[str, Source]:
    if pattern in known:
        return {pattern: known[pattern]}
    meant = source_named(machine, pattern)
    if meant is not None:
        return {pattern: meant}
    matching = {name: source for name, source in known.items() if fnmatchcase(name, pattern)}
    if not matching:
        near = get_close_matches(pattern, [*known, *PRESETS], n=3)
        hint = f"; close to it: {', '.join(near)}" if near else f"; presets: {', '.join(PRESETS)}"
        raise SelectionError(f"{pattern!r} selects no error source of {machine.topology.compact}{hint}")
    return matching
