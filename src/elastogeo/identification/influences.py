"""Systematic influences: what is known of a test's force, bar, balls, sensor, and how it would shift the estimate.

Each kind is one small function that turns an entry of the test file into effects. A new kind is such a function, registered
by `@effect`. An effect is either a relative change of the force of each run (the force stands in the design matrix, so this
changes columns, each by its own power of the force, exactly), or a change of the readings, or of single loads, which changes
the columns reading by reading. What is uncertain in the observations themselves comes with them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import sqrt

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Influence
from elastogeo.identification.systems import RunSystem, Systems
from elastogeo.machine import Array, Machine
from elastogeo.observe import KnownInfluence, MachineTest, ObservedInfluence
from elastogeo.sources import load_derivative

FORM_ORDERS = (2, 3, 4, 5)
"""Harmonics of a ball's form that are let loose; the first order is an offset of the ball."""


@dataclass(frozen=True, slots=True)
class Effect:
    """How one influence quantity changes a test, per unit of the quantity.

    Attributes
    ----------
    influence : Influence
    stretch : array, shape (runs,)
        Relative change of the force of each run.
    shift : tuple of array, shape (m,), one per run, or None
        By how much the readings are too great [mm]; None if they are not.
    columns : tuple of array, shape (m, p), one per run, or None
        Change of the design where it does not change with the force of the whole run; None if there is none.
    """

    influence: Influence
    stretch: Array
    shift: tuple[Array, ...] | None = None
    columns: tuple[Array, ...] | None = None


EffectMaker = Callable[[KnownInfluence, MachineTest, Systems], Iterator[Effect]]
_KINDS: dict[str, EffectMaker] = {}


def effect(kind: str) -> Callable[[EffectMaker], EffectMaker]:
    """Register a kind of influence under the name that test files use."""

    def register(make: EffectMaker) -> EffectMaker:
        _KINDS[kind] = make
        return make

    return register


def effects(test: MachineTest, systems: Systems) -> tuple[Effect, ...]:
    """The effects of all influences that a test states.

    Raises
    ------
    InputError
        If a kind is unknown, or an entry lacks the size that its kind needs.
    """
    found = list(_observed(test.machine, systems))
    for known in test.influences:
        if known.kind not in _KINDS:
            raise InputError(f"there is no influence {known.kind!r}; there are {', '.join(_KINDS)}")
        found.extend(_KINDS[known.kind](known, test, systems))
    return tuple(found)


def _observed(machine: Machine, systems: Systems) -> Iterator[Effect]:
    """The effects of what is uncertain in the observations themselves."""
    for several in zip(*(run.observations.influences for run in systems.runs), strict=True):
        first = several[0]
        loads = any(one.wrench.any() for one in several)
        yield Effect(
            Influence(first.label, first.standard_uncertainty, "normal", first.degrees_of_freedom),
            np.array([_stretch(run, one) for run, one in zip(systems.runs, several, strict=True)]),
            tuple(-one.reading for one in several) if any(one.reading.any() for one in several) else None,
            tuple(
                run.without_own(load_derivative(systems.sources, machine, run.observations, one.wrench))
                for run, one in zip(systems.runs, several, strict=True)
            )
            if loads
            else None,
        )


def _stretch(run: RunSystem, influence: ObservedInfluence) -> float:
    """Relative change of the force of a run per unit of an influence quantity."""
    if not influence.force:
        return 0.0
    if not run.observations.force:
        raise InputError(
            f"run {run.name!r} has no force by its calibration, whose uncertainty ({influence.label}) cannot be a part of "
            f"it; leave the run out, or state no uncertainty of the calibration"
        )
    return influence.force / run.observations.force


@effect("force-scale")
def force_scale(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """All forces are off by one relative amount: the gauge's calibration."""
    yield Effect(_influence(known, known.relative, "relative"), np.ones(len(systems.runs)))


@effect("force-offset")
def force_offset(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """All forces are off by one amount in newtons: friction in the cylinder, the gauge's zero."""
    unloaded = next((run.name for run in systems.runs if not run.force), None)
    if unloaded is not None:
        raise InputError(
            f"the influence {known.kind!r} cannot be stated for run {unloaded!r}, which has no force that could be off by a "
            f"part of itself; leave the run out, or state the influence as a force-level"
        )
    yield Effect(_influence(known, known.force, "force_N"), np.array([1.0 / run.force for run in systems.runs]))


@effect("force-level")
def force_level(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The force of each level is off by a relative amount of its own, the same for all runs of the level."""
    for level in systems.levels:
        at = np.array([float(run.force == level) for run in systems.runs])
        yield Effect(_influence(known, known.relative, "relative", f" at {level:g} N"), at)


@effect("bar-length")
def bar_length(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The bar is longer than its calibration says."""
    yield _reading_effect(_influence(known, known.length, "length_um"), systems, lambda run: np.ones(len(run.rows)))


@effect("sensor-scale")
def sensor_scale(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The sensor reads a relative amount too much."""
    yield _reading_effect(_influence(known, known.relative, "relative"), systems, _measured)


@effect("ball-form")
def ball_form(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The balls are not round: half the peak-to-valley of their form, as harmonics of unknown phase, alike in all runs."""
    whole = _influence(known, known.length, "length_um")
    part = replace(whole, scale=whole.scale / sqrt(len(FORM_ORDERS)))
    for order in FORM_ORDERS:
        for wave in (np.cos, np.sin):
            yield _reading_effect(part, systems, partial(_harmonic, order, wave))


@effect("setup-deflection")
def setup_deflection(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The deflection that the set-up correction took off is wrong by a relative amount."""
    yield _reading_effect(_influence(known, known.relative, "relative"), systems, lambda run: run.observations.correction)


@effect("thermal-drift")
def thermal_drift(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The readings drift by an amount over the whole test, evenly, in the order of the runs."""
    total = sum(len(run.rows) for run in systems.runs)
    before = np.cumsum([0, *(len(run.rows) for run in systems.runs)])
    starts = {run.name: int(first) for run, first in zip(systems.runs, before, strict=False)}
    yield _reading_effect(
        _influence(known, known.length, "length_um"),
        systems,
        lambda run: (starts[run.name] + np.arange(len(run.rows))) / total - 0.5,
    )


def _measured(run: RunSystem) -> Array:
    """All that the sensor measured: what it would on a perfect machine, and the departure from it."""
    seen = run.observations
    return run.reading if seen.nominal is None else seen.reading + seen.nominal


def _harmonic(order: int, wave: Callable[[Array], Array], run: RunSystem) -> Array:
    return wave(order * run.observations.pose)


def _influence(known: KnownInfluence, scale: float | None, field: str, where: str = "") -> Influence:
    if scale is None:
        raise InputError(f"the influence {known.kind!r} needs its size in {field}")
    return Influence(f"{known.label or known.kind}{where}", scale, known.distribution, known.degrees_of_freedom)


def _reading_effect(influence: Influence, systems: Systems, shift: Callable[[RunSystem], Array]) -> Effect:
    return Effect(influence, np.zeros(len(systems.runs)), tuple(shift(run) for run in systems.runs))
