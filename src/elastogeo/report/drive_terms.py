"""The terms of a drive's torque balance in the field's words, and the unit in which a motor's effort is shown."""

from __future__ import annotations

_WORDS = {
    "viscous": "viscous friction",
    "coulomb": "Coulomb friction",
    "coulomb forward": "Coulomb friction forward",
    "coulomb backward": "Coulomb friction backward",
    "viscous forward": "viscous friction forward",
    "viscous backward": "viscous friction backward",
    "stribeck": "Stribeck friction",
    "load": "load of the ball",
}


def term_name(term: str) -> str:
    """A term in words: `Coulomb friction` for `coulomb`; `inertia` and what else is a word already as it is."""
    return _WORDS.get(term, term)


def effort_unit(unit: str) -> tuple[str, float]:
    """The unit in which the effort of a motor is shown, and its factor."""
    return ("N m", 1e-3) if unit == "N mm" else (unit, 1.0)
