"""What is asked of a test, and the linear systems and influences that follow from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, TypedDict

from elastogeo.errors import InputError
from elastogeo.estimate import Confounding, confounding
from elastogeo.identification.influences import Effect, effects
from elastogeo.identification.levels import force_levels, force_spread
from elastogeo.identification.preference import retaining_order
from elastogeo.identification.reciprocity import Reciprocity, reciprocal_sources, reciprocity
from elastogeo.identification.rounding import rounding_effects
from elastogeo.identification.systems import Systems, merged, run_systems
from elastogeo.observe import MachineTest, Observations, Question
from elastogeo.sources import Source, select_sources


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
    test: MachineTest,
    parameters: str | Sequence[str] | None = None,
    prefer: str | Sequence[str] | None = None,
    reference: float | Literal["test", "none"] = "test",
    levels: Sequence[float] | None = None,
    without_levels: Sequence[float] | None = None,
    reciprocal: bool = False,
    robust: bool = False,
) -> MachineTest:
    """The test with another question: its own where nothing else is given.

    Parameters
    ----------
    test : MachineTest
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
    question = test.question
    if isinstance(reference, str) and reference not in ("test", "none"):
        raise InputError(f"the reference level is {reference!r}; give a force in N, or 'none' to subtract none")
    force = question.reference_force if reference == "test" else None if reference == "none" else float(reference)
    asked = Question(
        parameters=_listed(parameters) or question.parameters,
        reference_force=force,
        prefer=_listed(prefer) or question.prefer,
        levels=tuple(levels or question.levels),
        without_levels=tuple(without_levels or question.without_levels),
        reciprocal=reciprocal or question.reciprocal,
        robust=robust or question.robust,
        set_up_per_run=question.set_up_per_run,
    )
    return replace(test, question=asked)


def _listed(names: str | Sequence[str] | None) -> tuple[str, ...]:
    """Names, of which one alone may be given as it is."""
    return (names,) if isinstance(names, str) else tuple(names or ())


def systems_of(test: MachineTest, observations: Sequence[Observations] | None = None) -> Systems:
    """The linear systems that a test and its question amount to, of its observations if they were made before."""
    sources = sources_of(test)
    chosen = chosen_observations(test, test.observations() if observations is None else observations)
    reference, own = test.question.reference_force, own_to_run(test, sources)
    return run_systems(sources, test.machine, chosen, reference, own, force_spread(test))


def sources_of(test: MachineTest) -> tuple[Source, ...]:
    """The error sources that a test's question asks for."""
    sources = select_sources(test.machine, test.asked)
    return reciprocal_sources(sources) if test.question.reciprocal else sources


def own_to_run(test: MachineTest, sources: Sequence[Source]) -> tuple[Source, ...]:
    """The set-up that every run has for itself; none where it is asked for as one for all, or a reference subtracted."""
    patterns = test.setup.own_to_run
    if not (patterns and test.question.set_up_per_run) or test.question.reference_force is not None:
        return ()
    own = select_sources(test.machine, patterns)
    asked = {source.name for source in sources}
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


def confounding_of(test: MachineTest, systems: Systems) -> Confounding:
    """What the test can and cannot tell apart of what its question asks for."""
    observations = [run.observations for run in systems.runs]
    order = retaining_order(systems.sources, test.machine, observations, test.question.prefer)
    return confounding(merged(systems.runs), order, systems.ceilings, max(run.collinear for run in observations))


def what_reciprocity_buys(test: MachineTest) -> Reciprocity:
    """What taking each joint as symmetric buys for a test's question."""
    question = test.question
    sources = select_sources(test.machine, test.asked)
    return reciprocity(sources, test.machine, test.observations(), question.reference_force, question.prefer)


def effects_of(test: MachineTest, systems: Systems) -> tuple[Effect, ...]:
    """The effects of the systematic influences that a test states, and of what rounding its repeats share.

    None where a reference level is subtracted: they would enter reference and level alike, and an estimate of differences
    has no interval that they could widen.
    """
    return () if systems.references else (*effects(test, systems), *rounding_effects(systems, test.resolution))
