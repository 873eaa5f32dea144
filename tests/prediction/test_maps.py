"""Maps of the compliance at the tool: against single places, the rule of acceptance by hand, what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from elastogeo.errors import ElastogeoError, InputError
from elastogeo.identification import Identification, identify
from elastogeo.observe import Campaign
from elastogeo.prediction import (
    ComplianceMap,
    accepted,
    compliance_along,
    knowledge_of,
    map_compliance,
    tool_compliance,
)
from tests.prediction.circles import MIDDLE, circles

ALONG = {"X": (-200.0, 200.0, 5), "Y": (-150.0, 150.0, 4), "Z": (-100.0, 50.0, 3)}
PLACES = [(0, 0, 0), (4, 3, 2), (2, 1, 1), (1, 3, 0)]


@pytest.fixture(scope="module")
def result() -> Identification:
    return identify(circles(reciprocal=True))


@pytest.fixture(scope="module")
def softest(result: Identification) -> ComplianceMap:
    return map_compliance(result, ALONG)


def commands_at(found: ComplianceMap, index: tuple[int, ...]) -> np.ndarray:
    return found.grid.commands(np.array([np.ravel_multi_index(index, found.grid.shape)]))[0]


def test_the_softest_direction_is_that_of_each_place_by_itself(result: Identification, softest: ComplianceMap) -> None:
    known = knowledge_of(result)
    for index in PLACES:
        one = tool_compliance(known, commands_at(softest, index)).principal[0]
        assert softest.compliance[index] == pytest.approx(one.compliance.value, rel=1e-9)
        assert softest.expanded[index] == pytest.approx(one.compliance.expanded(), rel=1e-6)
        assert softest.directions[index] == pytest.approx(one.direction, abs=1e-7)


@pytest.mark.parametrize("direction", ["Z", (1.0, -2.0, 0.5)])
def test_along_a_direction_it_is_what_single_places_say(result: Identification, direction: str | tuple[float, ...]) -> None:
    found, known = map_compliance(result, ALONG, direction=direction), knowledge_of(result)
    assert found.direction is not None
    assert np.linalg.norm(found.direction) == pytest.approx(1.0)
    for index in PLACES:
        one = compliance_along(known, commands_at(found, index), found.direction)
        assert found.compliance[index] == pytest.approx(one.value[0], rel=1e-9)
        assert found.expanded[index] == pytest.approx(one.expanded[0], rel=1e-6)
        assert (found.directions[index] == found.direction).all()


def test_the_worst_and_the_best_place_and_what_is_between_them(softest: ComplianceMap) -> None:
    assert softest.softest is not None
    assert softest.stiffest is not None
    assert softest.compliance.max() == softest.compliance[softest.softest.index] == softest.softest.compliance.value
    assert softest.compliance.min() == softest.compliance[softest.stiffest.index]
    assert softest.difference is not None
    assert softest.difference.value == pytest.approx(np.ptp(softest.compliance))
    assert len(softest.corners) == 9


def test_what_is_uncertain_of_all_places_alike_cancels_in_the_difference(result: Identification) -> None:
    """A gauge that is 1 % off makes every compliance 1 % off, and so of a difference 1 % of the difference only."""
    gauge = {"systematic": 0.01 * result.solution.values[np.newaxis], "freedoms": np.array([20.0])}
    found = map_compliance(replace(result, budget=replace(result.budget, **gauge)), ALONG, direction="X")
    without = map_compliance(result, ALONG, direction="X")
    for index in PLACES:
        u = without.expanded[index] / 2
        assert found.expanded[index] / 2 == pytest.approx(np.hypot(u, 0.01 * found.compliance[index]), rel=0.15)
    for one in (found, without):
        assert one.difference is not None
    added = [one.difference.standard_uncertainty**2 for one in (found, without) if one.difference]
    assert added[0] - added[1] == pytest.approx((0.01 * np.ptp(found.compliance)) ** 2, rel=1e-6)


def test_where_no_test_tells_there_is_no_number() -> None:
    """Three circles in the middle tell the middle."""
    asked = identify(circles(MIDDLE, reciprocal=True))
    found = map_compliance(asked, {"X": (0.0, 400.0, 3), "Y": (0.0, 400.0, 3)}, {"Z": 0.0}, direction="X")
    assert 0 < found.share_supported < 1
    assert found.supported[0, 0]
    assert np.isfinite(found.compliance[found.supported]).all()
    for numbers in (found.compliance, found.expanded):
        assert np.isnan(numbers[~found.supported]).all()
    by_prior = map_compliance(asked, {"X": (0.0, 400.0, 3), "Y": (0.0, 400.0, 3)}, {"Z": 0.0}, direction="X", prior=True)
    assert (by_prior.supported == found.supported).all()
    assert np.isfinite(by_prior.expanded).all()
    assert (by_prior.prior_share[~found.supported] > 0.5).all()
    accepted_by = map_compliance(
        asked, {"X": (0.0, 400.0, 3), "Y": (0.0, 400.0, 3)}, {"Z": 0.0}, direction="X", prior=True, least_stiffness=1.0
    )
    assert accepted_by.acceptance is not None
    assert accepted_by.acceptance.undecided == int((~found.supported).sum())
    assert (by_prior.expanded[~found.supported] > found.expanded[0, 0]).all()


def test_nothing_supported_fails_the_verdict() -> None:
    found = map_compliance(identify(circles(MIDDLE[:1])), {"X": (300.0, 400.0, 2)}, {"Z": 300.0}, direction=(0.0, 0.0, 1.0))
    check = found.verdict[0]
    assert (check.passed, check.decisive) == (False, True)
    assert found.softest is found.stiffest is found.difference is None


def test_too_few_runs_give_values_without_uncertainty() -> None:
    found = map_compliance(identify(circles(MIDDLE[:1], repeats=1)), {"X": (0.0, 0.0, 1)}, {"Y": 0.0, "Z": 0.0}, "X")
    assert not found.by_run
    assert np.isfinite(found.compliance).all()
    assert np.isnan(found.expanded).all()
    assert [check.passed for check in found.verdict if check.name == "prediction has an uncertainty"] == [None]


def test_what_was_not_asked_for_is_named(result: Identification) -> None:
    partly = map_compliance(circles(MIDDLE[:1]), {"X": (0.0, 0.0, 1)}, {"Y": 0.0, "Z": 0.0}, "X", parameters=["C_??X"])
    check = next(check for check in partly.verdict if check.name == "all compliances asked for")
    assert check.passed is False
    assert set(check.facts["kinds"]) == {"Y", "Z"}
    assert check.facts["rigid"] == len(partly.rigid) == 72
    assert map_compliance(result, {"X": (0.0, 0.0, 1)}, {"Y": 0.0, "Z": 0.0}).rigid == ()


def test_the_rule_of_acceptance() -> None:
    """Limit 1e-4 mm/N (10 000 N/mm): below by U, in between, above by U, exactly at the guard bands, unknown."""
    values = np.array([8e-5, 9.5e-5, 1.05e-4, 1.2e-4, 9e-5, 1.1e-4, np.nan, 8e-5])
    expanded = np.array([1e-5] * 6 + [1e-5, np.nan])
    found = accepted(values, expanded, 1e4)
    assert found.decided.tolist() == [1, 0, 0, -1, 1, 0, 0, 0]
    assert (found.conforming, found.failing, found.undecided) == (2, 1, 5)
    assert found.passed is False
    assert accepted(values[:1], expanded[:1], 1e4).passed is True
    assert accepted(values[:2], expanded[:2], 1e4).passed is None


def test_a_map_decides_every_place(result: Identification, softest: ComplianceMap) -> None:
    limit = 1.0 / float(np.median(softest.compliance))
    found = map_compliance(result, ALONG, least_stiffness=limit)
    assert found.acceptance is not None
    assert found.acceptance.passed is False
    assert found.acceptance.conforming + found.acceptance.failing + found.acceptance.undecided == softest.grid.size
    assert found.acceptance.undecided > 0


def test_a_place_is_one_place(result: Identification) -> None:
    found = map_compliance(result, {"X": (10.0, 10.0, 1)}, {"Y": 5.0, "Z": 0.0})
    assert found.compliance.shape == (1,)
    assert found.softest is not None
    assert dict(zip("YXZ", found.softest.commands, strict=True)) == {"X": 10.0, "Y": 5.0, "Z": 0.0}


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"along": {"X": (0.0, 1.0, 2)}, "at": {"X": 0.0}}, "axis X is to be gone along and to stand"),
        ({"along": {"X": (0.0, 1.0, 1)}}, "give first, last and how many"),
        ({"along": {"X": (0.0, 0.0, 3)}}, "give first, last and how many"),
        ({"along": {"X": (0.0, float("nan"), 3)}}, "axis X cannot stand at nan"),
        ({"along": {"Q": (0.0, 1.0, 3)}}, "has no axis 'Q'"),
        ({"along": {"X": (0.0, 1.0, 1000), "Y": (0.0, 1.0, 1000), "Z": (0.0, 1.0, 1000)}}, "1000000000 places"),
        ({"direction": "W"}, "give softest, X, Y, Z, or three numbers"),
        ({"direction": (0.0, 0.0, 0.0)}, "three finite numbers that are not all zero"),
        ({"tool": (0.0, 1.0)}, "the tool point is"),
        ({"least_stiffness": 0.0}, "give a positive number"),
        ({"reciprocal": True}, "reciprocal cannot be asked of a result"),
    ],
)
def test_what_is_no_map_is_refused(result: Identification, wrong: dict[str, object], why: str) -> None:
    with pytest.raises(ElastogeoError, match=why):
        map_compliance(result, **wrong)  # type: ignore[arg-type]


def test_an_axis_stays_within_its_travel() -> None:
    one = circles(MIDDLE[:1])
    machine = next(iter(one.tests.values())).machine
    bounded = replace(machine, joints=tuple(replace(joint, travel=(-300.0, 300.0)) for joint in machine.joints))
    test = replace(next(iter(one.tests.values())), machine=bounded)
    asked = identify(Campaign("one", {"xy": test}))
    with pytest.raises(InputError, match="axis X cannot stand at 400: its travel is -300 to 300"):
        map_compliance(asked, {"X": (0.0, 400.0, 3)})
    assert map_compliance(asked, at={"Y": 0.0, "Z": 0.0}, direction="X").grid.along[0][[0, -1]].tolist() == [-300.0, 300.0]
