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
from elastogeo.identification.run_system import RunSystem
from elastogeo.identification.systems import Systems
from elastogeo.machine import Array, Machine
from elastogeo.observe import KnownInfluence, MachineTest, ObservedInfluence
from elastogeo.sources import Source, design_rows, load_derivative, select_sources

FORM_ORDERS = (2, 3, 4, 5)
"""Harmonics of a ball's form that are let loose; the first order is an offset of the ball."""


Rule = Callable[[RunSystem], Array]
"""What something does to the readings, or to the design, of a run."""


@dataclass(frozen=True, slots=True)
class Effect:
    """How one influence quantity changes a test, per unit of the quantity.

    What changes reading by reading is a rule, not held: it is made of a run while its rows are.

    Attributes
    ----------
    influence : Influence
    stretch : array, shape (runs,)
        Relative change of the force of each run.
    shift : callable, from a run to an array, shape (m,), or None
        By how much its readings are too great [mm]; None if none is.
    columns : callable, from a run to an array, shape (m, p), or None
        Change of its design where it does not change with the force of the whole run; None if there is none.
    tests : frozenset of str, or None
        Tests on whose readings it acts; None for all.
    """

    influence: Influence
    stretch: Array
    shift: Rule | None = None
    columns: Rule | None = None
    tests: frozenset[str] | None = None

    def acts_in(self, test: str) -> bool:
        """Whether it changes readings, or single loads, of a test."""
        return (self.shift is not None or self.columns is not None) and (self.tests is None or test in self.tests)


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
class Quantity:
    """Which influence quantity an effect is of: those of one owner and one name are one."""

    owner: str
    kind: str
    label: str
    number: int


def stated_effects(name: str, test: MachineTest, systems: Systems) -> Iterator[tuple[Quantity, Effect]]:
    """The effects of one test on its own runs, each with the quantity that it is of.

    Raises
    ------
    InputError
        If a kind is unknown, or an entry lacks the size that its kind needs.
    """
    count: Counter[tuple[str, str, str]] = Counter()
    for kind, of, stated in _stated(test, systems):
        one = _beside_weights(stated, test, systems)
        serial = test.about.instrument_serial.strip()
        owner = f"instrument {serial}" if serial and of == "instrument" else f"test {name}"
        label = one.influence.label
        yield Quantity(owner, kind, label, count[owner, kind, label]), one
        count[owner, kind, label] += 1


def _beside_weights(effect: Effect, test: MachineTest, systems: Systems) -> Effect:
    """The effect as it is where weights load the machine too: what stretches the force does not stretch them."""
    masses = [joint.mass for joint in test.machine.joints]
    masses += [test.workpiece.mass or 0.0] if test.workpiece else []
    if not effect.stretch.any() or not any(masses):
        return effect
    stretch = {run.name: float(size) for run, size in zip(systems.runs, effect.stretch, strict=True)}

    def columns(run: RunSystem) -> Array:
        change = load_derivative(systems.sources, test.machine, run.observations, run.observations.wrench)
        own = stretch[run.name] * run.without_own(change)
        return own if effect.columns is None else own + effect.columns(run)

    return replace(effect, stretch=np.zeros_like(effect.stretch), columns=columns)


def _stated(test: MachineTest, systems: Systems) -> Iterator[tuple[str, Belonging, Effect]]:
    for one in _observed(test.machine, systems):
        yield "", "instrument", one
    for known in test.influences:
        if known.kind not in _KINDS:
            raise InputError(f"there is no influence {known.kind!r}; there are {', '.join(_KINDS)}")
        make, of = _KINDS[known.kind]
        for one in make(known, test, systems):
            yield known.kind, of, one


def together(quantity: Quantity, parts: Sequence[tuple[str, Effect]], systems: Systems) -> Effect:
    """The effect of one quantity, with that in each test that has it by name, on all runs: none on those of other tests.

    Raises
    ------
    InputError
        If two tests state different things of one instrument.
    """
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
    stretch = np.zeros(len(systems.runs))
    for name, part in by_test.items():
        stretch[[k for k, run in enumerate(systems.runs) if run.test == name]] = part.stretch
    return Effect(
        one.influence,
        stretch,
        _by_test({name: part.shift for name, part in by_test.items() if part.shift is not None}),
        _by_test({name: part.columns for name, part in by_test.items() if part.columns is not None}, len(systems.sources)),
        frozenset(by_test),
    )


def _by_test(rules: Mapping[str, Rule], *columns: int) -> Rule | None:
    """The rule of the test that a run is of; in others nothing changes."""
    if not rules:
        return None
    return lambda run: rules[run.test](run) if run.test in rules else np.zeros((run.readings, *columns))


def _said(influence: Influence) -> str:
    return f"{influence.distribution}, {influence.scale:g} with {influence.degrees_of_freedom:g} degrees of freedom"


def _observed(machine: Machine, systems: Systems) -> Iterator[Effect]:
    """The effects of what is uncertain in the observations themselves."""
    several = [run.observations.influences for run in systems.runs]
    for k, of_runs in enumerate(zip(*several, strict=True)):
        first = of_runs[0]
        yield Effect(
            Influence(first.label, first.standard_uncertainty, "normal", first.degrees_of_freedom),
            np.array([_stretch(run, one) for run, one in zip(systems.runs, of_runs, strict=True)]),
            partial(_reads_less, k) if any(one.reading.any() for one in of_runs) else None,
            partial(_loads_otherwise, k, systems.sources, machine) if any(one.wrench.any() for one in of_runs) else None,
        )


def _reads_less(k: int, run: RunSystem) -> Array:
    """By how much the readings are too great for the k-th influence that came in with them."""
    return -run.observations.influences[k].reading


def _loads_otherwise(k: int, sources: Sequence[Source], machine: Machine, run: RunSystem) -> Array:
    """What the k-th influence that came in with the observations changes of the design."""
    seen = run.observations
    return run.without_own(load_derivative(sources, machine, seen, seen.influences[k].wrench))


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
    yield _reading_effect(_influence(known, known.length, "length_um"), systems, lambda run: np.ones(run.readings))


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


def _reading_effect(influence: Influence, systems: Systems, shift: Rule) -> Effect:
    return Effect(influence, np.zeros(len(systems.runs)), shift)
