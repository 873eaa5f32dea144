"""Whether a compensation is worth loading: what was left out and why, what the file leaves, whether its sign is sure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from elastogeo.identification import Check
from elastogeo.machine import SIDES
from elastogeo.prediction.compensation.result import CompensatedError, LeftOut

FINE = 0.5
"""Share of its uncertainty that the points of a file may add to what is left."""


def checks(errors: Sequence[CompensatedError], left_out: Sequence[LeftOut], public: bool) -> tuple[Check, ...]:
    """The checks of a compensation.

    Parameters
    ----------
    errors : sequence of CompensatedError
    left_out : sequence of LeftOut
    public : bool
        Whether a public text, or a run of the control, says the sign of its files.
    """
    return (
        Check("something to compensate", bool(errors), {"tables": _names(errors)}, decisive=True),
        *([_falls(errors), _fine(errors), _sign(errors, public)] if errors else []),
        left_check("determined by the tests", left_out, "not determined"),
        left_check("greater than its uncertainty", left_out, "uncertainty"),
        left_check("uncertainty known", left_out, "no interval"),
        left_check("within the control's means", left_out, "control"),
    )


def _names(errors: Sequence[CompensatedError]) -> tuple[str, ...]:
    return tuple(one.error.name for one in errors)


def _falls(errors: Sequence[CompensatedError]) -> Check:
    """Whether every error is smaller after, whatever it truly is within its interval."""
    grown = [one for one in errors if one.bound >= one.before[0]]
    facts = {
        "grown": _names(grown),
        "angular": tuple(one.error.is_angular for one in errors),
        "names": _names(errors),
        "before": tuple(one.before[0] for one in errors),
        "after": tuple(one.bound for one in errors),
    }
    return Check("error falls for sure", not grown, facts)


def _fine(errors: Sequence[CompensatedError]) -> Check:
    """Whether the points of the files are so close that what lies between them does not count."""
    shares = {one.error.name: one.by_interpolation / float(np.max(one.error.uncertainty)) for one in errors}
    coarse = tuple(name for name, share in shares.items() if share > FINE)
    worst = max(errors, key=lambda one: shares[one.error.name])
    facts = {
        "coarse": coarse,
        "worst": worst.error.name,
        "left": worst.by_interpolation,
        "uncertainty": float(np.max(worst.error.uncertainty)),
        "angular": worst.error.is_angular,
        "points": len(worst.written.position),
    }
    return Check("points close enough", not coarse, facts)


def _sign(errors: Sequence[CompensatedError], public: bool) -> Check:
    """One point at which to see on the machine whether the sign is right: where the greatest correction is made."""
    largest = max(errors, key=lambda one: float(np.abs(one.correction).max()) / (1e3 if one.error.is_angular else 1.0))
    k, side = np.unravel_index(int(np.abs(largest.correction).argmax()), largest.correction.shape)
    before, after = float(largest.error.value[k, side]), float(largest.residual.value[k, side])
    facts = {
        "name": largest.error.name,
        "axis": largest.error.axis,
        "rotary": largest.error.is_rotary,
        "angular": largest.error.is_angular,
        "position": float(largest.error.position[k]),
        "direction": SIDES[side],
        "before": before,
        "after": after,
        "wrong": 2 * before - after,
        "uncertainty": float(largest.error.uncertainty[k, side]),
    }
    return Check("sign sure", True if public else None, facts)


def left_check(name: str, left_out: Sequence[LeftOut], reason: str) -> Check:
    """Whether nothing was left out for this reason."""
    found = [one for one in left_out if one.reason == reason]
    facts = {
        "names": tuple(dict.fromkeys(name for one in found for name in one.names)),
        "tables": tuple(dict.fromkeys(one.table for one in found)),
        "why": tuple(dict.fromkeys(one.why for one in found if one.why)),
    }
    return Check(name, not found, facts)
