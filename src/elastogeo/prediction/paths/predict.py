"""The deviation of the tool along a path, with its interval: from the result of tests, a path and what loads the tool."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import effective_degrees_of_freedom
from elastogeo.identification import Identification
from elastogeo.machine import Array, Cut, ToolPath
from elastogeo.prediction.knowledge import Knowledge, knowledge_of
from elastogeo.prediction.paths.along import Rows, predicted_along
from elastogeo.prediction.paths.datum import Datum, check_datum, probed_motion
from elastogeo.prediction.paths.deviation import (
    COMPLIANCE,
    DEVIATION_COMPONENTS,
    Piece,
    PieceDeviation,
    deviations,
    part_members,
    parts_of,
)
from elastogeo.prediction.paths.result import PartOfDeviation, PathPrediction, expanded
from elastogeo.prediction.paths.verdict import tested_of, verdict_of

TOOL = "tool"
"""The part that tool and holder give."""

SPLIT_POINTS = 2000
"""Points of a long path at which it is split into its parts, besides those where it is off most."""


def path_deviation(
    result: Identification,
    path: ToolPath,
    cut: Cut | None = None,
    split: bool = True,
    prior: bool = False,
    datum: Datum = "machine",
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
    datum : {"machine", "probed"}
        Whether the workpiece sits as the machine says, or as its own probe finds it there: see `datum`.

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
    found = known_deviation(knowledge, path, cut, prior, datum)
    if split:
        found = _split(found, knowledge, cut, prior)
    named = replace(found, name=result.campaign.name, simulated=knowledge.simulated)
    return replace(named, verdict=verdict_of(named, knowledge, cut, tested_of(result)))


def known_deviation(
    knowledge: Knowledge, path: ToolPath, cut: Cut, prior: bool = False, datum: Datum = "machine"
) -> PathPrediction:
    """How far the tool is off along a path, by what is known of the machine: without parts, verdict and names of tests."""
    check_datum(datum)
    moved = probed_motion(knowledge, path, cut) if datum == "probed" else None
    m, width = len(path), len(DEVIATION_COMPONENTS)
    numbers: dict[str, Any] = {
        name: np.full((m, width), np.nan)
        for name in ("value", "standard_uncertainty", "degrees_of_freedom", "unsupported", "prior_share")
    }
    supported: Any = np.zeros((m, width), dtype=bool)
    wrench = np.empty((m, 6))
    needs_load = cut.force is not None and cut.force.relative_uncertainty > 0
    for piece in deviations(knowledge, path, cut, prior, moved):
        at = piece.part
        loaded = _by_load(knowledge, path, cut, piece) if needs_load else None
        u, degrees = _combined(piece, cut, loaded)
        wrench[at], supported[at] = piece.wrench, _shaped(piece.machine.supported)
        numbers["value"][at] = _shaped(piece.machine.value) + piece.tool
        numbers["standard_uncertainty"][at], numbers["degrees_of_freedom"][at] = u, degrees
        numbers["unsupported"][at] = _shaped(piece.machine.unsupported)
        numbers["prior_share"][at] = _shaped(piece.machine.prior_share)
        asked = piece.asked.T.copy()
        asked[:, 3] &= np.isfinite(path.left[at]).all(axis=1)
        supported[at] &= asked
        for one in numbers.values():
            one[at][~asked] = np.nan
    return PathPrediction(
        name="",
        path=path,
        force="" if cut.force is None else cut.force.said,
        tool="" if cut.tool is None else cut.tool.source,
        normal_to=cut.normal_to,
        datum=datum,
        wrench=wrench,
        supported=supported,
        parts={},
        split_at=np.zeros(0, dtype=np.intp),
        verdict=(),
        **numbers,
    )


def _split(found: PathPrediction, knowledge: Knowledge, cut: Cut, prior: bool) -> PathPrediction:
    """With its parts: at all points of a short path, at some of a long one and where it is off most."""
    at = _shown(found)
    moved = probed_motion(knowledge, found.path, cut) if found.datum == "probed" else None
    asked = found.asked[at]
    parts = {}
    for name, part in parts_of(knowledge, found.path, cut, at, prior, moved).items():
        value, wide = _shaped(part.value), _shaped(part.expanded)
        parts[name] = PartOfDeviation(np.where(asked, value, np.nan), np.where(asked, wide, np.nan))
    if cut.tool is not None:
        value = Piece(found.path, cut, at).tool_deflection()
        wide = expanded(cut.tool.relative_uncertainty * np.abs(value), np.full(value.shape, np.inf))
        parts[TOOL] = PartOfDeviation(np.where(asked, value, np.nan), np.where(asked, wide, np.nan))
    return replace(found, parts=parts, split_at=at)


def _shown(found: PathPrediction) -> Rows:
    """Points whose parts are wanted: evenly chosen, and the least and greatest deviation of every component."""
    m = len(found.path)
    if m <= SPLIT_POINTS:
        return np.arange(m)
    ends = [
        extreme(column) for column in found.value.T if np.isfinite(column).any() for extreme in (np.nanargmin, np.nanargmax)
    ]
    return np.unique([*np.linspace(0, m - 1, SPLIT_POINTS).round().astype(np.intp), *ends])


def _combined(piece: PieceDeviation, cut: Cut, loaded: Array | None) -> tuple[Array, Array]:
    """Standard uncertainty with that of force and tool in it, and its degrees of freedom, shape (k, 4) each."""
    own, degrees = _shaped(piece.machine.standard_uncertainty), _shaped(piece.machine.degrees_of_freedom)
    force = np.zeros(own.shape) if loaded is None or cut.force is None else cut.force.relative_uncertainty * loaded
    tool = np.zeros(own.shape) if cut.tool is None else cut.tool.relative_uncertainty * piece.tool
    if not (force.any() or tool.any()):
        return own, degrees
    each = np.abs(np.stack([own, force, tool], axis=-1)).reshape(-1, 3)
    freedom = np.column_stack([degrees.ravel(), np.full((own.size, 2), np.inf)])
    known = np.isfinite(each).all(axis=1) & ~np.isnan(freedom[:, 0])
    total, effective = np.full(own.size, np.nan), np.full(own.size, np.nan)
    total[known] = np.linalg.norm(each[known], axis=1)
    effective[known] = effective_degrees_of_freedom(each[known], freedom[known])
    return total.reshape(own.shape), effective.reshape(own.shape)


def _by_load(knowledge: Knowledge, path: ToolPath, cut: Cut, piece: PieceDeviation) -> Array:
    """What the force does, shape (k, 4) [mm], of the machine and the tool: less what weights do without it."""
    elastic = part_members(knowledge)[COMPLIANCE]

    asked = Piece(path, cut, piece.part).functionals(knowledge)
    if cut.workpiece is not None or any(joint.mass for joint in path.machine.joints):
        asked -= Piece(path, replace(cut, force=None), piece.part).functionals(knowledge)
    return np.asarray(_shaped(predicted_along(knowledge, asked * elastic).value) + piece.tool)


def _shaped(values: Any) -> Any:
    """What stands component after component, as a row for each point."""
    return np.asarray(values).reshape(len(DEVIATION_COMPONENTS), -1).T
