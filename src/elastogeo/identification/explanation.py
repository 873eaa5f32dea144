"""What a test can and cannot distinguish, planned or run: its confounding, and what symmetric joints would buy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

from elastogeo.estimate import Confounding
from elastogeo.identification.campaigns.parts import Step, shares_of
from elastogeo.identification.question import (
    Asked,
    confounding_of,
    systems_of,
    what_reciprocity_buys,
    with_question,
)
from elastogeo.identification.symmetric_joints import Reciprocity
from elastogeo.machine import Point
from elastogeo.observe import Askable, Campaign, MachineTest, campaign_of, family_of
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Explanation(Result):
    """What a test can and cannot distinguish.

    Attributes
    ----------
    campaign : Campaign
        The tests, with the question that was asked; one test is a campaign of one.
    confounding : Confounding
    reciprocity : Reciprocity or None
        What symmetric joints would buy; None if it was not asked for.
    steps : tuple of Step
        Of several tests, in order, what each adds to those before it; empty for one.
    family : str or None
        What all tests together load and read between tool and workpiece (`observe.family_of`).
    tools : tuple of tuple of 3 float [mm]
        The functional points that they have.
    """

    campaign: Campaign
    confounding: Confounding
    reciprocity: Reciprocity | None = None
    steps: tuple[Step, ...] = ()
    family: str | None = None
    tools: tuple[Point, ...] = ()

    @property
    def test(self) -> MachineTest:
        """The test that this is said of.

        Raises
        ------
        InputError
            If there are several.
        """
        return self.campaign.only


def explain(one: Askable, **asked: Unpack[Asked]) -> Explanation:
    """Say what a test, or several tests together, can and cannot distinguish; of planned ones as of those that were run.

    Parameters
    ----------
    one : MachineTest, Campaign, sequence of MachineTest, or mapping of str to MachineTest
        Of a planned test the readings count for nothing: `read_test(folder, planned=360)`.
    **asked
        Another question than the tests' own, as in `with_question`.

    Raises
    ------
    SelectionError
        If the question names no error source of the machine.
    UnsupportedError
        If no parameter changes any reading.
    """
    campaign = with_question(campaign_of(one), **asked)
    bought = what_reciprocity_buys(campaign.only) if campaign.question.reciprocal and not campaign.several else None
    systems = systems_of(campaign)
    found = confounding_of(campaign, systems)
    steps = shares_of(systems, found.retained).steps(systems.tests) if campaign.several else ()
    observed = [run.observations for run in systems.runs]
    tools = dict.fromkeys((float(x), float(y), float(z)) for x, y, z in (run.tool for run in observed))
    return Explanation(campaign, found, bought, steps, family_of(campaign.machine, observed), tuple(tools))
