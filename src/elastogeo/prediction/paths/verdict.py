"""What must be said of a predicted deviation before it is believed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from elastogeo.identification import Check, Identification
from elastogeo.machine import Array, Cut
from elastogeo.prediction.knowledge import Flags, Knowledge

if TYPE_CHECKING:
    from elastogeo.prediction.paths.result import PathPrediction

PATH_SUPPORTED = "path supported"
INTERVALS_SHOWN = "intervals shown"
FAULTS_ASKED_FOR = "faults asked for"
WITHIN_THE_TESTS = "within the tests"
FORCE_UNCERTAIN = "force with its uncertainty"
TOOL_COUNTED = "tool counted"

BEYOND = 0.05
"""Part of the tested range by which a path may leave it, and a force exceed the greatest, before it is said."""


@dataclass(frozen=True, slots=True)
class Tested:
    """What the tests covered.

    Attributes
    ----------
    low, high : array, shape (n,) [mm, rad]
        Least and greatest command of each axis.
    force : float [N]
        The greatest.
    """

    low: Array
    high: Array
    force: float


def tested_of(result: Identification) -> Tested:
    """What the tests of a result covered."""
    every = [run for runs in result.campaign.observations().values() for run in runs]
    low = np.min([run.commands.min(axis=0) for run in every], axis=0)
    high = np.max([run.commands.max(axis=0) for run in every], axis=0)
    return Tested(low, high, max(float(np.linalg.norm(run.wrench[:, :3], axis=1).max()) for run in every))


def verdict_of(found: PathPrediction, knowledge: Knowledge, cut: Cut, tested: Tested) -> tuple[Check, ...]:
    """The checks of a prediction along a path."""
    checks = (
        _supported(found, knowledge),
        _intervals(found),
        _asked_for(knowledge, found, cut),
        _within(found, tested),
        _force(cut),
        _tool(found, cut),
    )
    return tuple(check for check in checks if check is not None)


def _supported(found: PathPrediction, knowledge: Knowledge) -> Check:
    mirrors = [getattr(source, "mirror", None) for source in knowledge.sources if source.elastic]
    reciprocal = not mirrors or any(mirror is not None for mirror in mirrors)
    asked = found.asked
    points: Flags = np.asarray((found.supported | ~asked)[:, :3].all(axis=1) & asked[:, :3].any(axis=1))
    missing = np.flatnonzero(~points)
    facts = {
        "points": len(points),
        "supported": int(points.sum()),
        "first": int(missing[0]) + 1 if len(missing) else None,
        "unsupported": float(np.nanmax(found.unsupported[:, :3], initial=0.0)),
        "prior": bool(np.isfinite(found.value[missing, :3]).any()),
        "datum": found.datum,
        "reciprocal": reciprocal,
        "not_asked": [axis for k, axis in enumerate("xyz") if not asked[:, k].any()],
    }
    return Check(PATH_SUPPORTED, not len(missing), facts, decisive=True)


def _intervals(found: PathPrediction) -> Check | None:
    known = found.supported[:, :3]
    without = (known & ~np.isfinite(found.standard_uncertainty[:, :3])).any(axis=1)
    if not known.any():
        return None
    return Check(INTERVALS_SHOWN, not without.any(), {"points": len(known), "without": int(without.sum())})


def _asked_for(knowledge: Knowledge, found: PathPrediction, cut: Cut) -> Check:
    machine = [source for source in knowledge.sources if not source.of_test]
    elastic, loaded = any(s.elastic for s in machine), bool(found.wrench.any()) or cut.workpiece is not None
    geometric = any(not source.elastic for source in machine)
    facts = {
        "geometry": geometric,
        "compliance": elastic,
        "loaded": loaded,
        "rigid": len(knowledge.rigid),
        "first_rigid": list(knowledge.rigid[:6]),
    }
    return Check(FAULTS_ASKED_FOR, geometric and (elastic or not loaded), facts)


def _within(found: PathPrediction, tested: Tested) -> Check:
    commands = found.path.commands
    room = BEYOND * np.maximum(tested.high - tested.low, 1.0)
    low, high = commands.min(axis=0), commands.max(axis=0)
    outside = (low < tested.low - room) | (high > tested.high + room)
    joints = found.path.machine.joints
    force = float(np.linalg.norm(found.wrench[:, :3], axis=1).max())
    facts = {
        "axes": [
            {
                "axis": joint.name,
                "rotary": joint.is_rotary,
                "path": [float(low[k]), float(high[k])],
                "tested": [float(tested.low[k]), float(tested.high[k])],
            }
            for k, joint in enumerate(joints)
            if outside[k]
        ],
        "force": force,
        "tested_force": tested.force,
    }
    return Check(WITHIN_THE_TESTS, not outside.any() and force <= (1 + BEYOND) * tested.force, facts)


def _force(cut: Cut) -> Check | None:
    if cut.force is None:
        return None
    share = cut.force.relative_uncertainty
    return Check(FORCE_UNCERTAIN, share > 0, {"relative": share})


def _tool(found: PathPrediction, cut: Cut) -> Check | None:
    if not found.wrench.any():
        return None
    share = None if cut.tool is None else cut.tool.relative_uncertainty
    return Check(TOOL_COUNTED, cut.tool is not None, {"tool": found.tool, "relative": share})
