"""What a record of a drive cannot distinguish, in words, and what would separate it."""

from __future__ import annotations

from collections.abc import Sequence

from elastogeo.estimate import Confounding

_FRICTION = ("coulomb", "coulomb forward", "coulomb backward")
_SPEED = ("viscous", "viscous forward", "viscous backward")
_MOTION = ("inertia", *_SPEED, *_FRICTION, "constant", "stribeck")


def advice(axis: str, found: Confounding) -> str:
    """What cannot be distinguished of the balance of an axis, and what would separate it; empty if all can."""
    sentences = []
    with_inertia = any("inertia" in terms for terms in map(found.stands_for, found.retained) if len(terms) > 1)
    for name in found.retained:
        terms = found.stands_for(name)
        if len(terms) > 1:
            sentences.append(
                f"axis {axis}: {combination(terms)} is determined as one number only, none of its terms by itself; "
                f"{_remedy(tuple(terms), found.labels, with_inertia)}"
            )
    if found.null:
        sentences.append(
            f"axis {axis}: {', '.join(found.null)} changes no effort in these records and cannot be identified; "
            f"record a motion in which it acts, or leave it out"
        )
    return ". ".join(sentences)


def combination(terms: dict[str, float]) -> str:
    """A combination of terms: `inertia - 0.00045 load`."""
    text = ""
    for name, coefficient in terms.items():
        size = abs(coefficient)
        written = f"{size:.3g}"
        factor = "" if written == "1" else f"{written} "
        sign = "-" if coefficient < 0 else "+"
        text += f" {sign} {factor}{name}" if text else f"{'-' if coefficient < 0 else ''}{factor}{name}"
    return text


def at_rest(count: int, least_speed: float | None, unit: str) -> str:
    """Why no sample can be used."""
    if least_speed is None:
        return f"none of its {count} samples shows a motion: the axis stands still in all of them; record a motion"
    return (
        f"none of its {count} samples moves at more than {least_speed:g} {unit}/s, below which the direction of its "
        f"friction is not known; record a motion, or lower least_speed"
    )


def named(reasons: Sequence[str]) -> str:
    """Reasons in one sentence."""
    return ", and ".join(reasons)


def _remedy(terms: Sequence[str], labels: Sequence[str], with_inertia: bool) -> str:
    """What would separate these terms, where the inertia is one of them or of another combination, or of none."""
    loads = [name for name in terms if name not in _MOTION]
    friction = [name for name in terms if name in _FRICTION]
    if loads and "inertia" in terms:
        return (
            "the load follows the acceleration, as on a circle at constant feed: two feeds, an unloaded run, or a known "
            "inertia would separate them"
        )
    if len(loads) == len(terms) and with_inertia:
        return "what separates the inertia from the loads separates these too"
    if loads:
        return "the load follows the friction: an unloaded run, or known friction, would separate them"
    if friction and "constant" in terms and {"coulomb forward", "coulomb backward"} <= set(labels):
        return (
            "friction of its own in either direction, with a sharp sign, holds the constant already: leave out the "
            "constant, or use coulomb with the constant; in one direction only, neither helps but runs in both"
        )
    if any(name in _SPEED for name in terms):
        return "the speed hardly changes: two speeds or more, in both directions, would separate them"
    if friction and "constant" in terms:
        return "the axis moves in one direction only: runs in both directions would separate them"
    return "a record with a richer motion (two feeds, both directions, accelerations) would separate them"
