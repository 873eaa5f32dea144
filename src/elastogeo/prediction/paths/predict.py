"""The deviation of the tool along a path, with its interval: from the result of tests, a path and what loads the tool."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import effective_degrees_of_freedom
from elastogeo.identification import Identification
from elastogeo.machine import Array, Cut, ToolPath
from elastogeo.prediction.knowledge import Flags, Knowledge, knowledge_of
from elastogeo.prediction.paths.deviation import (
    COMPLIANCE,
    DEVIATION_COMPONENTS,
    PARTS,
    Piece,
    PieceDeviation,
    deviations,
    part_members,
)
from elastogeo.prediction.paths.result import PartOfDeviation, PathPrediction, expanded
from elastogeo.prediction.paths.verdict import tested_of, verdict_of

TOOL = "tool"
"""The part that tool and holder give."""


def path_deviation(
    result: Identification, path: ToolPath, cut: Cut | None = None, split: bool = True, prior: bool = False
) -> PathPrediction:
    """Predict how far the tool is off along a path.

    Parameters
    ----------
    result : Identification
        Of the tests of the machine.
    path : ToolPath
    cut : Cut, optional
        What loads the tool and the table; nothing if it is not given.
    split : bool
        Whether the deviation is split into its parts.
    prior : bool
        Whether what the tests do not support is given by the stated prior, and its share said.

    Raises
    ------
    InputError
        If the path is of another machine, or a force does not cover it.
    """
    cut = cut or Cut()
    knowledge = knowledge_of(result)
    if path.machine != knowledge.machine:
        raise InputError(
            f"the path is of machine {path.machine.name!r}, the tests are of {knowledge.machine.name!r}; make the path with "
            f"the machine of the tests"
        )
    found = _gathered(knowledge, path, cut, split, prior)
    named = replace(found, name=result.campaign.name, simulated=knowledge.simulated)
    return replace(named, verdict=verdict_of(named, knowledge, cut, tested_of(result)))


def _gathered(knowledge: Knowledge, path: ToolPath, cut: Cut, split: bool, prior: bool) -> PathPrediction:
    """The pieces of a path as one result, without its verdict."""
    m, width = len(path), len(DEVIATION_COMPONENTS)
    numbers: dict[str, Any] = {
        name: np.full((m, width), np.nan)
        for name in ("value", "standard_uncertainty", "degrees_of_freedom", "unsupported", "prior_share")
    }
    supported: Any = np.zeros((m, width), dtype=bool)
    wrench = np.empty((m, 6))
    names = [*(PARTS if split else ()), *([TOOL] if cut.tool is not None else [])]
    parts = {name: PartOfDeviation(np.full((m, width), np.nan), np.full((m, width), np.nan)) for name in names}
    needs_load = cut.force is not None and cut.force.relative_uncertainty > 0
    for piece in deviations(knowledge, path, cut, split, prior):
        at = piece.part
        no_normal: Flags = np.asarray(np.isnan(path.left[at]).any(axis=1))
        loaded = _by_load(knowledge, path, cut, piece) if needs_load else None
        u, degrees = _combined(piece, cut, loaded)
        wrench[at], supported[at] = piece.wrench, _shaped(piece.machine.supported)
        numbers["value"][at] = _shaped(piece.machine.value) + piece.tool
        numbers["standard_uncertainty"][at], numbers["degrees_of_freedom"][at] = u, degrees
        numbers["unsupported"][at] = _shaped(piece.machine.unsupported)
        numbers["prior_share"][at] = _shaped(piece.machine.prior_share)
        for name, part in piece.parts.items():
            parts[name].value[at], parts[name].expanded[at] = _shaped(part.value), _shaped(part.expanded)
        if cut.tool is not None:
            share = cut.tool.relative_uncertainty
            parts[TOOL].value[at] = piece.tool
            parts[TOOL].expanded[at] = expanded(share * np.abs(piece.tool), np.full(piece.tool.shape, np.inf))
        _blank(numbers, parts, supported, at, _shaped(piece.asked), no_normal)
    return PathPrediction(
        name="",
        path=path,
        force="" if cut.force is None else cut.force.said,
        tool="" if cut.tool is None else cut.tool.source,
        normal_to=cut.normal_to,
        wrench=wrench,
        supported=supported,
        parts=parts,
        verdict=(),
        **numbers,
    )


def _blank(
    numbers: dict[str, Array],
    parts: dict[str, PartOfDeviation],
    supported: Any,
    at: slice,
    asked: Any,
    no_normal: Flags,
) -> None:
    """Take out what is no prediction: components that nothing asked for moves, and normals where the path has none."""
    asked = asked & ~np.column_stack([np.zeros((len(no_normal), 3), dtype=bool), no_normal])
    supported[at] &= asked
    for one in (*numbers.values(), *(a for part in parts.values() for a in (part.value, part.expanded))):
        one[at][~asked] = np.nan


def _combined(piece: PieceDeviation, cut: Cut, loaded: Array | None) -> tuple[Array, Array]:
    """Standard uncertainty with that of force and tool in it, and its degrees of freedom, shape (k, 4) each."""
    own, degrees = _shaped(piece.machine.standard_uncertainty), _shaped(piece.machine.degrees_of_freedom)
    force = np.zeros(own.shape) if loaded is None or cut.force is None else cut.force.relative_uncertainty * loaded
    tool = np.zeros(own.shape) if cut.tool is None else cut.tool.relative_uncertainty * piece.tool
    if not (force.any() or tool.any()):
        return own, degrees
    each = np.abs(np.stack([own, force, tool], axis=-1)).reshape(-1, 3)
    freedom = np.column_stack([degrees.ravel(), np.full((own.size, 2), np.inf)])
    known = np.isfinite(each).all(axis=1) & np.isfinite(freedom[:, 0])
    total, effective = np.full(own.size, np.nan), np.full(own.size, np.nan)
    total[known] = np.linalg.norm(each[known], axis=1)
    effective[known] = effective_degrees_of_freedom(each[known], freedom[known])
    return _shaped(total), _shaped(effective)


def _by_load(knowledge: Knowledge, path: ToolPath, cut: Cut, piece: PieceDeviation) -> Array:
    """What the force does, shape (k, 4) [mm], of the machine and the tool: less what weights do without it."""
    elastic = part_members(knowledge)[COMPLIANCE]
    found = piece.parts.get(COMPLIANCE) or knowledge.predict(_asked(knowledge, path, cut, piece.part) * elastic)
    weighed = cut.workpiece is not None or any(joint.mass for joint in path.machine.joints)
    unloaded = replace(cut, force=None)
    rest = knowledge.predict(_asked(knowledge, path, unloaded, piece.part) * elastic).value if weighed else 0.0
    return np.asarray(_shaped(found.value - rest) + piece.tool)


def _asked(knowledge: Knowledge, path: ToolPath, cut: Cut, part: slice) -> Array:
    asked = Piece(path, cut, part).functionals(knowledge)
    return np.asarray(asked.reshape(-1, asked.shape[2]))


def _shaped(values: Any) -> Any:
    """What stands one after the other, as a row for each point."""
    return np.asarray(values).reshape(-1, len(DEVIATION_COMPONENTS))
