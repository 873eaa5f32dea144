"""What a test can and cannot distinguish, planned or run: its confounding, and what symmetric joints would buy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

from elastogeo.estimate import Confounding
from elastogeo.identification.question import (
    Asked,
    confounding_of,
    systems_of,
    what_reciprocity_buys,
    with_question,
)
from elastogeo.identification.reciprocity import Reciprocity
from elastogeo.observe import MachineTest
from elastogeo.result import Result


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Explanation(Result):
    """What a test can and cannot distinguish.

    Attributes
    ----------
    test : MachineTest
        With the question that was asked.
    confounding : Confounding
    reciprocity : Reciprocity or None
        What symmetric joints would buy; None if it was not asked for.
    """

    test: MachineTest
    confounding: Confounding
    reciprocity: Reciprocity | None = None


def explain(test: MachineTest, **asked: Unpack[Asked]) -> Explanation:
    """Say what a test can and cannot distinguish; of a planned test as of one that was run.

    Parameters
    ----------
    test : MachineTest
        Of a planned one the readings count for nothing: `read_test(folder, planned=360)`.
    **asked
        Another question than the test's own, as in `with_question`.

    Raises
    ------
    SelectionError
        If the question names no error source of the machine.
    UnsupportedError
        If no parameter changes any reading.
    """
    test = with_question(test, **asked)
    bought = what_reciprocity_buys(test) if test.question.reciprocal else None
    return Explanation(test, confounding_of(test, systems_of(test)), bought)
