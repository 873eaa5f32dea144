"""What is asked of a test, or of several, and the linear systems and influences that follow from it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Literal, TypedDict, TypeVar

import numpy as np

from elastogeo.errors import InputError
from elastogeo.estimate import Confounding, Influence, confounding
from elastogeo.identification.campaigns.precision import weighted
from elastogeo.identification.campaigns.scopes import Scopes, preferred, scopes_of
from elastogeo.identification.influences import Effect, Quantity, on_all_runs, stated_effects, together
from elastogeo.identification.levels import force_levels, force_spread
from elastogeo.identification.preference import retaining_order
from elastogeo.identification.readings.rounding import rounding_effects
from elastogeo.identification.symmetric_joints import Reciprocity, reciprocity
from elastogeo.identification.systems import Systems, joined, merged, run_systems
from elastogeo.machine import Array
from elastogeo.observe import Askable, Campaign, MachineTest, Observations, ObservedInfluence, campaign_of
from elastogeo.sources import Source, select_sources

One = TypeVar("One", MachineTest, Campaign)


class Asked(TypedDict, total=False):
    """What may be asked otherwise than a test asks itself: see `with_question`."""

    parameters: str | Sequence[str] | None
    prefer: str | Sequence[str] | None
    reference: float | Literal["test", "none"]
    levels: Sequence[float] | None
    without_levels: Sequence[float] | None
    reciprocal: bool
    robust: bool


def with_question(
    one: One,
    parameters: str | Sequence[str] | None = None,
    prefer: str | Sequence[str] | None = None,
    reference: float | Literal["test", "none"] = "test",
    levels: Sequence[float] | None = None,
    without_levels: Sequence[float] | None = None,
    reciprocal: bool = False,
    robust: bool = False,
) -> One:
    """The test, or the tests of a campaign, with another question: their own where nothing else is given.

    Parameters
    ----------
    one : MachineTest or Campaign
    parameters : str or sequence of str, optional
        Names, patterns (`C_??X`) or presets (`planar-xy`) of the parameters to identify.
    prefer : str or sequence of str, optional
        Parameters to retain before others that cannot be told from them.
    reference : float [N], "none" or "test"
        Force level to subtract from all others; `"test"`: that of the test, if it has one.
    levels, without_levels : sequence of float [N], optional
        Force levels to use alone, and to leave out.
    reciprocal : bool
        Take each joint as symmetric: C_dfj and C_fdj are one parameter.
    robust : bool
        Let outlying readings count less (Huber).

    Raises
    ------
    InputError
        If the reference is neither a force nor one of the two words.
    """
    if isinstance(reference, str) and reference not in ("test", "none"):
        raise InputError(f"the reference level is {reference!r}; give a force in N, or 'none' to subtract none")

    def asked(test: MachineTest) -> MachineTest:
        own = test.question
        force = own.reference_force if reference == "test" else None if reference == "none" else float(reference)
        question = replace(
            own,
            parameters=_listed(parameters) or own.parameters,
            reference_force=force,
            prefer=_listed(prefer) or own.prefer,
            levels=tuple(levels or own.levels),
            without_levels=tuple(without_levels or own.without_levels),
            reciprocal=reciprocal or own.reciprocal,
            robust=robust or own.robust,
        )
        return replace(test, question=question)

    if isinstance(one, Campaign):
        return replace(one, tests={name: asked(test) for name, test in one.tests.items()})
    return asked(one)


def _listed(names: str | Sequence[str] | None) -> tuple[str, ...]:
    """Names, of which one alone may be given as it is."""
    return (names,) if isinstance(names, str) else tuple(names or ())


def systems_of(one: Askable, observations: Sequence[Observations] | None = None) -> Systems:
    """The linear systems that a test, or several, and their question amount to.

    Parameters
    ----------
    one : MachineTest, Campaign, or several tests
    observations : sequence of Observations, optional
        Of one test, if they were made before.

    Raises
    ------
    InputError
        If a reference level is to be subtracted in one of several tests.
    """
    campaign, scopes = campaign_of(one), scopes_of(campaign_of(one))
    if not campaign.several:
        name, test = next(iter(campaign.tests.items()))
        return _of_test(name, test, test.observations() if observations is None else observations, scopes)
    again = _ObservedAgain(campaign)
    tests = [_of_test(name, test, again(name), scopes, partial(again, name)) for name, test in campaign.tests.items()]
    return weighted(joined(tests), {name: test.resolution for name, test in campaign.tests.items()})


class _ObservedAgain:
    """The observations of the tests of a campaign, made when they are asked for: those of the last one are kept.

    Of several tests the runs bear the name of their test too.
    """

    def __init__(self, campaign: Campaign) -> None:
        self._campaign, self._centre = campaign, campaign.centre()
        self._name, self._last = "", tuple[Observations, ...]()

    def __call__(self, name: str) -> tuple[Observations, ...]:
        if name != self._name:
            test = self._campaign.tests[name]
            reference = test.question.reference_force
            if reference is not None:
                raise InputError(
                    f"test {name!r} subtracts the readings at {reference:g} N; several tests are asked together without a "
                    f"reference level, with geometry and set-up in the model: ask with reference 'none'"
                )
            seen = chosen_observations(test, self._campaign.observed(name, self._centre))
            self._name, self._last = name, tuple(replace(run, run=f"{name}/{run.run}") for run in seen)
        return self._last


def _of_test(
    name: str,
    test: MachineTest,
    observed: Sequence[Observations],
    scopes: Scopes,
    again: Callable[[], Sequence[Observations]] | None = None,
) -> Systems:
    """The systems of one test, with the columns of all; of several tests with how its observations are made again."""
    chosen = observed if again else chosen_observations(test, observed)
    reference, own = test.question.reference_force, own_to_run(test)
    spread, absent = force_spread(test), scopes.absent[name]
    return run_systems(scopes.sources, test.machine, chosen, reference, own, spread, name, absent, again)


def sources_of(one: Askable) -> tuple[Source, ...]:
    """The error sources that a question asks for, one per column."""
    return scopes_of(campaign_of(one)).sources


def own_to_run(test: MachineTest) -> tuple[Source, ...]:
    """The set-up that every run has for itself; none where it is asked for as one for all, or a reference subtracted."""
    patterns = test.setup.own_to_run
    if not (patterns and test.question.set_up_per_run) or test.question.reference_force is not None:
        return ()
    own = select_sources(test.machine, patterns)
    asked = {source.name for source in select_sources(test.machine, test.asked)}
    return () if any(source.name in asked for source in own) else own


def chosen_observations(test: MachineTest, observations: Sequence[Observations]) -> tuple[Observations, ...]:
    """The runs at the force levels that a question wants; the reference stays.

    Raises
    ------
    InputError
        If it names a level at which no run is.
    """
    question, levels = test.question, force_levels((run.force for run in observations), force_spread(test))
    wanted = {levels.level(force) for force in question.levels} or set(levels.forces)
    if question.reference_force is not None and question.reference_force in levels:
        wanted.add(levels.level(question.reference_force))
    wanted -= {levels.level(force) for force in question.without_levels}
    return tuple(run for run in observations if levels.level(run.force) in wanted)


def confounding_of(one: Askable, systems: Systems) -> Confounding:
    """What the tests can and cannot distinguish of what their question asks for."""
    campaign = campaign_of(one)
    prefer = preferred(campaign.question.prefer, systems.sources)
    order = retaining_order(systems.sources, campaign.machine, [run.spans for run in systems.runs], prefer)
    return confounding(merged(systems.runs), order, systems.ceilings, max(run.collinear for run in systems.runs))


def what_reciprocity_buys(test: MachineTest) -> Reciprocity:
    """What taking each joint as symmetric buys for a test's question."""
    question = test.question
    sources = select_sources(test.machine, test.asked)
    return reciprocity(sources, test.machine, test.observations(), question.reference_force, question.prefer)


def effects_of(one: Askable, systems: Systems) -> tuple[Effect, ...]:
    """The effects of the systematic influences that tests state, and of what rounding their repeats share.

    None where a reference level is subtracted: they would enter reference and level alike, and an estimate of differences
    has no interval that they could widen.
    """
    if systems.references:
        return ()
    found: dict[Quantity, list[tuple[str, Effect]]] = {}
    rounded: list[Effect] = []
    for name, test in campaign_of(one).tests.items():
        own = systems.of(name)
        for quantity, effect in stated_effects(name, test, own) if own.runs else ():
            found.setdefault(quantity, []).append((name, effect))
        rounded += [on_all_runs(effect, name, systems) for effect in rounding_effects(own, test.resolution)]
    return (*(together(quantity, parts, systems) for quantity, parts in found.items()), *rounded)


def stated_shifts(test: MachineTest, observations: Sequence[Observations]) -> list[tuple[Influence, Array]]:
    """What each stated influence adds to the readings of a test, run after run, per unit of its quantity, shape (m,)."""
    systems = systems_of(test, observations)
    return [
        (effect.influence, np.concatenate([effect.shift(run) for run in systems.runs]))
        for effect in effects_of(test, systems)
        if effect.shift is not None
    ]


def with_stated(test: MachineTest, observations: Sequence[Observations]) -> Sequence[Observations]:
    """The observations with all that is known of systematic influences, beside what they came with.

    What an instrument shows by itself takes it from there.
    """
    own = len(observations[0].influences)
    question = replace(test.question, reference_force=None, levels=(), without_levels=())
    systems = systems_of(replace(test, question=question), observations)
    known = effects_of(test, systems)[own:]
    return [
        replace(
            run,
            influences=(
                *run.influences,
                *(
                    ObservedInfluence(
                        effect.influence.label,
                        effect.influence.standard_uncertainty,
                        effect.influence.degrees_of_freedom,
                        effect.stretch[k] * run.wrench,
                        np.zeros(len(run)) if effect.shift is None else -effect.shift(systems.runs[k]),
                    )
                    for effect in known
                ),
            ),
        )
        for k, run in enumerate(observations)
    ]
