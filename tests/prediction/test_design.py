"""What was measured against design: the truth agrees, a design that is off does not, as sums and at the tool."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.errors import InputError
from elastogeo.formats import Design
from elastogeo.identification import Identification, identify
from elastogeo.prediction import compliance_along, knowledge_of, map_compliance
from tests.prediction.circles import MIDDLE, circles, machine, springs

ALONG = {"X": (-200.0, 200.0, 3), "Y": (-150.0, 150.0, 3), "Z": (-100.0, 50.0, 2)}
TRUTH = springs(machine())


@pytest.fixture(scope="module")
def result() -> Identification:
    return identify(circles(reciprocal=True))


def test_the_true_design_agrees_and_is_what_the_jacobian_says(result: Identification) -> None:
    found = map_compliance(result, ALONG, direction=(1.0, 1.0, 0.0), design=Design("truth", TRUTH, 0.01))
    assert found.design is not None
    assert found.design.passed is True
    assert found.design.missing == found.design.unused == ()
    assert all(one.agrees for one in found.design.parameters)
    # the design through the same measurement, by hand: its own values in the place of the estimate
    known = knowledge_of(result)
    exact = [sum(c * TRUTH[name] for name, c in p.stands_for.items()) for p in result.parameters]
    pairs = {s.name: s for s in known.sources}
    assert set(pairs) == set(result.confounding.labels)
    as_design = replace(known, solution=replace(known.solution, values=np.array(exact)))
    for index in ((0, 0, 0), (2, 1, 1)):
        commands = found.grid.commands(np.array([np.ravel_multi_index(index, found.grid.shape)]))[0]
        assert found.direction is not None
        along = compliance_along(as_design, commands, found.direction)
        assert found.design.compliance[index] == pytest.approx(along.value[0], rel=1e-9)


def test_a_design_that_is_a_third_too_stiff_differs(result: Identification) -> None:
    stiff = {name: value / 1.5 for name, value in TRUTH.items()}
    found = map_compliance(result, ALONG, direction="X", design=Design("stiff", stiff))
    assert found.design is not None
    assert found.design.passed is False
    assert (found.design.agrees == -1).all()
    assert found.design.share == 0.0
    check = next(check for check in found.verdict if check.name == "as designed")
    assert (check.passed, check.facts["differ"]) == (False, found.grid.size)
    unsure = map_compliance(result, ALONG, direction="X", design=Design("stiff", stiff, 0.9))
    assert unsure.design is not None
    assert unsure.design.passed is True


def test_what_the_tests_do_not_tell_is_not_compared() -> None:
    asked = identify(circles(MIDDLE, reciprocal=True))
    found = map_compliance(
        asked, {"X": (0.0, 400.0, 3)}, {"Y": 300.0, "Z": 0.0}, "Z", design=Design("truth", TRUTH), prior=True
    )
    assert found.design is not None
    assert not found.supported.any()
    assert not found.design.agrees.any()
    assert found.design.passed is None
    assert len(found.design.parameters) == asked.confounding.rank


def test_what_is_in_one_of_the_two_only_is_named(result: Identification) -> None:
    few = {"C_XXX": 1e-5, "CL_XXholder": 1e-6}
    found = map_compliance(result, {"X": (0.0, 0.0, 1)}, {"Y": 0.0, "Z": 0.0}, "X", design=Design("few", few))
    assert found.design is not None
    assert found.design.unused == ("CL_XXholder",)
    assert len(found.design.missing) == len(result.confounding.labels) - 1


@pytest.mark.parametrize(
    ("values", "why"),
    [
        ({"C_XXQ": 1e-5}, "has none of the compliances that were asked for"),
        ({"C_XYX": 1e-5, "C_YXX": 2e-5}, "taken as symm"),
    ],
)
def test_what_is_no_design_of_this_machine_is_refused(result: Identification, values: dict[str, float], why: str) -> None:
    with pytest.raises(InputError, match=why):
        map_compliance(result, {"X": (0.0, 0.0, 1)}, {"Y": 0.0, "Z": 0.0}, "X", design=Design("wrong", values))
