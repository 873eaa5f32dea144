"""Whether a contradiction to physics is geometry that the model lacks: the test solved again with it.

A force-independent shape that no parameter holds is forced through the origin by the load columns, and may show as a
compliance that no joint can have. Once it has a parameter of its own, physics holds, or it does not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from elastogeo.errors import DegreesOfFreedomError, InputError, UnsupportedError
from elastogeo.estimate import Estimate, solve_by_run
from elastogeo.identification.budget import uncertainty_budget
from elastogeo.identification.model_choice.candidates import GEOMETRY
from elastogeo.identification.model_choice.result import ModelChoice
from elastogeo.identification.physics import Consistency, consistency
from elastogeo.identification.question import confounding_of, effects_of, sources_of, systems_of
from elastogeo.identification.systems import Systems
from elastogeo.observe import MachineTest
from elastogeo.sources import catalogue


@dataclass(frozen=True, slots=True)
class MissingGeometry:
    """The answer to the same question with the geometry that the data support besides.

    Attributes
    ----------
    added : tuple of str
        Its parameters.
    stands_for : tuple of tuple of str
        For each of these, what coincides with it: a test cannot distinguish them.
    parameters : dict of str to Estimate
        Every parameter, these among them.
    consistency : Consistency
        Whether the compliances now agree with physics.
    """

    added: tuple[str, ...]
    stands_for: tuple[tuple[str, ...], ...]
    parameters: dict[str, Estimate]
    consistency: Consistency

    def facts_of(self, negative: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
        """What becomes of parameters that were negative beyond their uncertainty, as facts of a check."""
        values = {
            name: {
                **found,
                "value": self.parameters[name].value,
                "standard_uncertainty": self.parameters[name].standard_uncertainty,
            }
            for name, found in negative.items()
            if name in self.parameters
        }
        return {"state": self.consistency.state, "owners": self.stands_for, "values": values}


def with_missing_geometry(test: MachineTest, systems: Systems, models: ModelChoice) -> MissingGeometry | None:
    """The test solved with the geometry of the model that its data support; None if that has none, or it is not determined.

    Parameters
    ----------
    test : MachineTest
    systems : Systems
        As it was solved, without a reference.
    models : ModelChoice
    """
    if models.supported is None or systems.references:
        return None
    best, known = models.of(models.supported), catalogue(test.machine)
    pairs = [
        (name, others)
        for name, others in zip(best.added, best.stands_for, strict=True)
        if name in known and GEOMETRY in best.places and not known[name].elastic
    ]
    if not pairs:
        return None
    added = tuple(name for name, _ in pairs)
    richer = replace(test, question=replace(test.question, parameters=(*test.asked, *added)))
    try:
        return _solved(richer, systems, added, tuple(others for _, others in pairs))
    except (InputError, UnsupportedError, DegreesOfFreedomError):
        return None


def _solved(
    test: MachineTest, systems: Systems, added: tuple[str, ...], stands_for: tuple[tuple[str, ...], ...]
) -> MissingGeometry | None:
    again = systems_of(test, [run.observations for run in systems.runs])
    found = confounding_of(test, again)
    if not set(added) <= set(found.retained):
        return None
    solution = solve_by_run([run.factor for run in again.runs], found.retained)
    budget = uncertainty_budget(again, solution, effects_of(test, again))
    known = replace(solution, covariance=budget.covariance, degrees_of_freedom=budget.degrees_of_freedom)
    u, freedom = budget.standard_uncertainty, budget.degrees_of_freedom
    return MissingGeometry(
        added=added,
        stands_for=stands_for,
        parameters={
            name: Estimate(float(solution.values[k]), float(u[k]), float(freedom[k]))
            for k, name in enumerate(solution.labels)
        },
        consistency=consistency(sources_of(test), found, known),
    )
