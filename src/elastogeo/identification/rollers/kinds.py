"""Three kinds of stiffness from the curves of a test: secant, increment, slope of the law that the engagements support.

The secant of Eq. 6.5 takes all that the encoders show for elastic: what the path is off, and what gives way before the
least engagement, makes it rise with the engagement even where the machine does not stiffen. The increment between two
engagements is free of both. The modelled one is the slope of the law that the engagements support (`laws`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from elastogeo.identification.rollers.curves import Curves
from elastogeo.identification.rollers.laws import Law, LawChoice, choose_law, fit_law, points, within_levels
from elastogeo.identification.rollers.stiffness import INCREMENT, MODELLED, SECANT, Stiffness
from elastogeo.machine import Array


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """What the curves of a test say.

    Attributes
    ----------
    law : Law
        Supported.
    choice : LawChoice
    modelled, secants, increments : tuple of Stiffness
        As in `StiffnessMap`.
    """

    law: Law
    choice: LawChoice
    modelled: tuple[Stiffness, ...]
    secants: tuple[Stiffness, ...]
    increments: tuple[Stiffness, ...]


def fitted(curves: Curves) -> Fitted:
    """The law that the engagements support, and the stiffness of each kind."""
    law, choice = choose_law(curves)
    mean = curves.mean(curves.force)
    at = mean[-1:] if law.name == "constant" else mean
    runs = np.bincount(curves.level)[:, np.newaxis]
    variance, freedom = within_levels(curves, law.compliance(curves.force))
    if freedom <= 1:
        variance, freedom = law.variance, law.degrees_of_freedom
    step = np.diff(mean, axis=0)

    def slope(change: int | None) -> Array:
        return fit_law(curves, law.name, law.powers, change).compliance(at)

    def secant(change: int | None) -> Array:
        force, reading = (curves.mean(values) for values in points(curves, change))
        return np.asarray(reading / force)

    def increment(change: int | None) -> Array:
        force, reading = (curves.mean(values) for values in points(curves, change))
        return np.asarray(np.diff(reading, axis=0) / np.diff(force, axis=0))

    levels = [(level,) for level in curves.levels]
    pairs = list(zip(curves.levels, curves.levels[1:], strict=False))
    return Fitted(
        law=law,
        choice=choice,
        modelled=_kinds(
            MODELLED,
            [()] if law.name == "constant" else levels,
            curves,
            slope,
            (_slope_scatter(curves, law, at), law.degrees_of_freedom),
        ),
        secants=_kinds(SECANT, levels, curves, secant, (np.sqrt(variance / runs) / mean, freedom)),
        increments=_kinds(
            INCREMENT,
            pairs,
            curves,
            increment,
            (np.sqrt(variance * (1 / runs[1:] + 1 / runs[:-1])) / step, freedom),
        ),
    )


def _kinds(
    kind: str,
    forces: Sequence[tuple[float, ...]],
    curves: Curves,
    compliance: Callable[[int | None], Array],
    scatter: tuple[Array, int],
) -> tuple[Stiffness, ...]:
    """A stiffness of one kind at each of some levels, with what every change of the curves does to it."""
    values = compliance(None)
    moved = np.array([compliance(n) - values for n in range(len(curves.changes))]).reshape(-1, *values.shape)
    size, freedom = scatter
    known = size if freedom > 1 else np.full(values.shape, np.inf)
    return tuple(
        Stiffness(
            kind=kind,
            force=force,
            angle=curves.angle,
            compliance=values[n],
            scatter=known[n],
            scatter_freedom=freedom,
            systematic=moved[:, n],
            labels=tuple(change.label for change in curves.changes),
            freedoms=tuple(change.degrees_of_freedom for change in curves.changes),
        )
        for n, force in enumerate(forces)
    )


def _slope_scatter(curves: Curves, law: Law, at: Array) -> Array:
    """Standard uncertainty of the slope of a law at forces, shape of the forces, from the scatter about the law."""
    design = np.stack([*(curves.force.T**power for power in law.powers), np.ones(curves.force.T.shape)], axis=-1)
    norms = np.linalg.norm(design, axis=1, keepdims=True)
    root = np.linalg.pinv(design / norms) / norms.swapaxes(1, 2)
    slopes = [power * at.T ** (power - 1) for power in law.powers]
    gradient = np.stack([*slopes, np.zeros(at.T.shape)], axis=-1)
    return np.asarray((np.linalg.norm(gradient @ root, axis=2) * np.sqrt(law.variance)[:, np.newaxis]).T)
