"""Systematic influences: what is known of a test's force, bar, balls, sensor, and how it would shift the estimate.

Each kind is one small function that turns an entry of the test file into effects. A new kind is such a function, registered
by `@effect`. An effect is either a relative change of the force of each run (the force stands in the design matrix, so this
changes columns, each by its own power of the force, exactly), or a change of the readings, or of single loads, which changes
the columns reading by reading. What is uncertain in the observations themselves comes with them.

Tests that share an instrument (its serial number) share what is uncertain of it: one gauge is off by one amount in all of
them. What is of the day or the place (`of="test"`) is of each test for itself.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import sqrt
from typing import Literal

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Influence
from elastogeo.identification.systems import RunSystem, Systems
from elastogeo.machine import Array, Machine
from elastogeo.observe import Campaign, KnownInfluence, MachineTest, ObservedInfluence
from elastogeo.sources import Source, design_rows, load_derivative, select_sources

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
Belonging = Literal["instrument", "test"]
_KINDS: dict[str, tuple[EffectMaker, Belonging]] = {}


def effect(kind: str, of: Belonging = "instrument") -> Callable[[EffectMaker], EffectMaker]:
    """Register a kind of influence under the name that test files use; `of` says what all tests of it have in common."""

    def register(make: EffectMaker) -> EffectMaker:
        _KINDS[kind] = make, of
        return make

    return register


@dataclass(frozen=True, slots=True)
class _Quantity:
    """Which influence quantity an effect is of: those of one owner and one name are one."""

    owner: str
    kind: str
    label: str
    number: int


def effects(campaign: Campaign, systems: Systems) -> tuple[Effect, ...]:
    """The effects of all influences that the tests state; of those that share an instrument, one.

    Raises
    ------
    InputError
        If a kind is unknown, an entry lacks the size that its kind needs, or two tests state different things of one
        instrument.
    """
    found: dict[_Quantity, list[tuple[str, Effect]]] = {}
    for name, test in campaign.tests.items():
        own = systems.of(name)
        if own.runs:
            for quantity, one in _of_test(name, test, own):
                found.setdefault(quantity, []).append((name, one))
    return tuple(_together(quantity, parts, systems) for quantity, parts in found.items())


def _of_test(name: str, test: MachineTest, systems: Systems) -> Iterator[tuple[_Quantity, Effect]]:
    """The effects of one test on its own runs, each with the quantity that it is of."""
    count: Counter[tuple[str, str, str]] = Counter()
    for kind, of, stated in _stated(test, systems):
        one = _beside_weights(stated, test, systems)
        serial = test.about.instrument_serial.strip()
        owner = f"instrument {serial}" if serial and of == "instrument" else f"test {name}"
        label = one.influence.label
        yield _Quantity(owner, kind, label, count[owner, kind, label]), one
        count[owner, kind, label] += 1


def _beside_weights(effect: Effect, test: MachineTest, systems: Systems) -> Effect:
    """The effect as it is where weights load the machine too: what stretches the force does not stretch them."""
    masses = [joint.mass for joint in test.machine.joints]
    masses += [test.workpiece.mass or 0.0] if test.workpiece else []
    if not effect.stretch.any() or not any(masses):
        return effect
    changes = [
        run.without_own(load_derivative(systems.sources, test.machine, run.observations, run.observations.wrench))
        for run in systems.runs
    ]
    columns = [size * change for size, change in zip(effect.stretch, changes, strict=True)]
    if effect.columns is not None:
        columns = [column + other for column, other in zip(columns, effect.columns, strict=True)]
    return replace(effect, stretch=np.zeros_like(effect.stretch), columns=tuple(columns))


def _stated(test: MachineTest, systems: Systems) -> Iterator[tuple[str, Belonging, Effect]]:
    for one in _observed(test.machine, systems):
        yield "", "instrument", one
    for known in test.influences:
        if known.kind not in _KINDS:
            raise InputError(f"there is no influence {known.kind!r}; there are {', '.join(_KINDS)}")
        make, of = _KINDS[known.kind]
        for one in make(known, test, systems):
            yield known.kind, of, one


def _together(quantity: _Quantity, parts: Sequence[tuple[str, Effect]], systems: Systems) -> Effect:
    """The effect of one quantity on all runs: none on those of tests that do not have it."""
    (first, one), *others = parts
    for name, other in others:
        if other.influence != one.influence:
            raise InputError(
                f"tests {first!r} and {name!r} have the same {quantity.owner} and state different things of "
                f"{quantity.label!r}: {_said(one.influence)}, and {_said(other.influence)}; state what is known of an "
                f"instrument once, under [[instruments]] of the campaign"
            )
    return _on_all_runs(dict(parts), systems)


def on_all_runs(effect: Effect, test: str, systems: Systems) -> Effect:
    """An effect on the runs of one test as one on the runs of all: none on those of others."""
    return _on_all_runs({test: effect}, systems)


def _on_all_runs(by_test: Mapping[str, Effect], systems: Systems) -> Effect:
    """The effect of one quantity on all runs: none on those of tests that do not have it."""
    one = next(iter(by_test.values()))
    if len(systems.tests) == 1:
        return one
    at = {name: [k for k, run in enumerate(systems.runs) if run.test == name] for name in by_test}
    stretch = np.zeros(len(systems.runs))
    for name, part in by_test.items():
        stretch[at[name]] = part.stretch
    shifts = {k: s for name, part in by_test.items() for k, s in zip(at[name], part.shift or (), strict=False)}
    columns = {k: c for name, part in by_test.items() for k, c in zip(at[name], part.columns or (), strict=False)}
    none = len(systems.sources)
    return Effect(
        one.influence,
        stretch,
        tuple(shifts.get(k, _nothing(run)) for k, run in enumerate(systems.runs)) if shifts else None,
        tuple(columns.get(k, _nothing(run, none)) for k, run in enumerate(systems.runs)) if columns else None,
    )


def _nothing(run: RunSystem, *columns: int) -> Array:
    """Zeros for every reading of a run, which take no memory."""
    return np.broadcast_to(0.0, (len(run.reading), *columns))


def _said(influence: Influence) -> str:
    return f"{influence.distribution}, {influence.scale:g} with {influence.degrees_of_freedom:g} degrees of freedom"


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


@effect("tool-offset", of="test")
def tool_offset(known: KnownInfluence, test: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The tool point is off by an unknown amount in each direction of its frame: a ball that does not run true."""
    yield from _end_offset(known, test.machine, systems, "t")


@effect("workpiece-offset", of="test")
def workpiece_offset(known: KnownInfluence, test: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The point on the workpiece side is off by an unknown amount in each direction of its frame."""
    yield from _end_offset(known, test.machine, systems, "w")


@effect("sensor-scale")
def sensor_scale(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The sensor reads a relative amount too much."""
    yield _reading_effect(_influence(known, known.relative, "relative"), systems, _measured)


@effect("ball-form", of="test")
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


@effect("thermal-drift", of="test")
def thermal_drift(known: KnownInfluence, _: MachineTest, systems: Systems) -> Iterator[Effect]:
    """The readings drift by an amount over the whole test, evenly, in the order of the runs and of time in each.

    Sensors that are read at once drift alike.
    """
    lasted = [run.observations.instants.max() + 1 for run in systems.runs]
    starts = dict(zip((run.name for run in systems.runs), np.cumsum([0, *lasted]), strict=False))
    yield _reading_effect(
        _influence(known, known.length, "length_um"),
        systems,
        lambda run: (starts[run.name] + run.observations.instants) / sum(lasted) - 0.5,
    )


def _end_offset(known: KnownInfluence, machine: Machine, systems: Systems, end: str) -> Iterator[Effect]:
    influence = _influence(known, known.length, "length_um")
    for source in select_sources(machine, [f"E_{axis}{end}0" for axis in "XYZ"]):
        yield _reading_effect(influence, systems, partial(_column, source, machine))


def _column(source: Source, machine: Machine, run: RunSystem) -> Array:
    """How a source moves the readings of a run, less what the run's own set-up explains of it."""
    return np.asarray(run.without_own(design_rows([source], machine, run.observations)[:, :-1])[:, 0])


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
