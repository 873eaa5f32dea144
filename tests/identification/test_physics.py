"""Physics of the joints: the constrained estimate, the verdict on a negative C_CCY, and what reciprocity buys."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import stdtr, stdtrit

from elastogeo.errors import InputError
from elastogeo.estimate import Confounding, Solution, confounding, solve
from elastogeo.identification import consistency_of, identify, merged, run_systems, systems_of
from elastogeo.identification.physics import (
    BY_READING,
    CONSISTENT,
    CONTRADICTED,
    FEW_DEGREES,
    NEAR_LIMIT,
    NOT_TESTED,
    NOTHING_RESTRICTED,
    consistency,
    joint_blocks,
    physically_consistent,
)
from elastogeo.identification.symmetric_joints import ReciprocalSource, reciprocal_sources, reciprocity
from elastogeo.machine import Array
from elastogeo.observe import MachineTest, Observations
from elastogeo.report import sentence_of
from elastogeo.report.identification.reciprocity import reciprocity_words
from elastogeo.sources import Situation, Source, select_sources, simulate

MakeTest = Callable[..., MachineTest]

SIX = ("C_XXX", "C_XYX", "C_YYY", "C_CXY", "C_CYY", "C_CCY")
TABLE_4_6 = dict(zip(SIX, (7.61e-5, 2.27e-7, 6.05e-5, 1.08e-9, 5.35e-10, -1.73e-11), strict=True))
TABLE_4_8 = dict(zip(SIX, (5.82e-5, -1.69e-6, 6.02e-5, 4.02e-7, -5.64e-8, -7.66e-11), strict=True))
TABLE_4_8_DEVIATION = (2.16e-7, 1.64e-8, 1.88e-7, 1.12e-9, 7.30e-10, 9.98e-13)
"""Of one pair of five repeats at two levels: 4 degrees of freedom at least, 8 at most."""

PHYSICAL = {
    "C_XXX": 5e-5,
    "C_YYX": 2e-5,
    "C_XYX": 1e-6,
    "C_YXX": 1e-6,
    "C_XXY": 2e-5,
    "C_YYY": 4e-5,
    "C_CCY": 4e-10,
    "C_CXY": 5e-8,
    "C_XCY": 5e-8,
    "C_CYY": -6e-8,
    "C_YCY": -6e-8,
}


@pytest.fixture(scope="module")
def planar(make_test: MakeTest) -> tuple[tuple[Source, ...], Confounding]:
    """The 18 planar compliances of the thesis's circle, and what it distinguishes of them."""
    test = make_test("wFYXt", [100.0])
    systems = systems_of(test)
    found = confounding(merged(systems.runs), SIX, systems.ceilings)
    assert found.retained == SIX
    return systems.sources, found


def estimate(values: dict[str, float], uncertainty: tuple[float, ...], degrees: float = np.inf) -> Solution:
    covariance = np.diag(np.square(uncertainty))
    return Solution(tuple(values), np.array(list(values.values())), covariance, np.full(len(values), degrees), 1e-3)


def with_noise(test: MachineTest, values: dict[str, float], noise: float, seed: int = 0) -> MachineTest:
    random = np.random.default_rng(seed)
    simulated = simulate(test, values, exact=False)
    runs = tuple(
        replace(
            run,
            columns={
                **run.columns,
                "radial": run.columns["radial"] + noise * random.standard_normal(len(run.columns["radial"])),
            },
        )
        for run in simulated.runs
    )
    return replace(simulated, runs=runs)


def across(observations: tuple[Observations, ...]) -> tuple[Observations, ...]:
    """The same poses and readings with the force turned by 50 degrees from the sensitive direction, about z."""
    c, s = np.cos(np.radians(50)), np.sin(np.radians(50))
    turn = np.eye(6)
    turn[:2, :2] = [[c, -s], [s, c]]
    return tuple(replace(run, wrench=run.wrench @ turn.T) for run in observations)


def test_the_blocks_are_the_joints_matrices(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    sources, found = planar
    blocks = joint_blocks(sources, found.labels)
    assert set(blocks) == {"X", "Y"}
    for axis, block in blocks.items():
        names = [[found.labels[k] for k in row] for row in block]
        assert names == [[f"C_{d}{f}{axis}" for f in "XYC"] for d in "XYC"]


def test_only_linear_compliances_are_in_a_block(make_test: MakeTest) -> None:
    names = ("C_XXX", "E_XX1", "CF1_XXX", "H_XXX", "C_CXX", "C_YYX")
    sources = select_sources(make_test("wFYXt").machine, names)
    (block,) = joint_blocks(sources, names).values()
    assert_allclose(block, [[0, -1, -1], [-1, 5, -1], [4, -1, -1]])
    with pytest.raises(InputError, match="no source is given for C_XYX"):
        joint_blocks(sources, ["C_XYX"])


@pytest.mark.parametrize(("uncertainty", "state"), [(1.5e-9, NOT_TESTED), (1e-10, CONTRADICTED)])
def test_the_negative_c_ccy_is_settled_by_its_uncertainty(
    uncertainty: float, state: str, planar: tuple[tuple[Source, ...], Confounding]
) -> None:
    """C_CCY = -1.1e-9 rad/(N mm) stands for itself alone: no other joint can excuse its sign."""
    sources, found = planar
    assert found.stands_for("C_CCY") == {"C_CCY": 1.0}
    values = TABLE_4_6 | {"C_CCY": -1.1e-9}
    result = consistency(sources, found, estimate(values, (1e-7, 1e-8, 1e-7, 1e-9, 1e-9, uncertainty)))
    assert result.state == state
    assert result.distance >= 1.1e-9 / uncertainty * (1 - 1e-9)  # the cross terms of Y ask for a little more than zero
    assert result.p_negative["C_CCY"] == pytest.approx(stdtr(np.inf, -1.1e-9 / uncertainty), rel=1e-9, abs=0)
    assert set(result.p_negative) == {"C_XXX", "C_YYY", "C_CCY"}
    both = 2 * min(result.p_joint, 3 * result.p_negative["C_CCY"])  # two looks; three signs in one of them
    assert result.p_value == pytest.approx(min(1.0, both), rel=1e-9, abs=0)
    assert result.violated == (("C_CCY",) if state == CONTRADICTED else ())
    assert result.constrained["C_CCY"] > -1e-6 * uncertainty
    assert result.constrained["C_XXX"] == pytest.approx(7.61e-5, rel=1e-6)
    check = physically_consistent(result, sources, found, estimate(values, (1e-7, 1e-8, 1e-7, 1e-9, 1e-9, uncertainty)))
    assert check.passed is (False if state == CONTRADICTED else None)
    named = "C_CCY is -1.10 nrad/(N·mm) with a standard uncertainty of 0.10"
    unknown = "C_CCY is too close to zero to show that it is positive, -1.1 nrad/(N·mm) with a standard uncertainty of 1.5"
    assert (named if state == CONTRADICTED else unknown) in sentence_of(check)


@pytest.mark.parametrize("degrees", [3.0, np.inf])
@pytest.mark.parametrize("side", [0.95, 1.05])
def test_physics_is_confirmed_where_no_interval_reaches_zero(
    side: float, degrees: float, planar: tuple[tuple[Source, ...], Confounding]
) -> None:
    """C_CCY beside half the 95 % interval: the mark is passed only above it; the cross terms leave it room."""
    sources, found = planar
    uncertainty = (1e-7, 1e-8, 1e-7, 1e-12, 1e-12, 1e-11)
    ccy = side * stdtrit(degrees, 0.975) * 1e-11
    values = dict(zip(SIX, (7e-5, 0.0, 6e-5, 0.0, 0.0, ccy), strict=True))
    by_run = estimate(values, uncertainty, degrees)
    result = consistency(sources, found, by_run)
    assert result.distance == 0
    assert (result.state, result.why) == ((CONSISTENT, "") if side > 1 else (NOT_TESTED, NEAR_LIMIT))
    assert result.closest == "C_CCY"
    check = physically_consistent(result, sources, found, by_run)
    assert check.passed is (True if side > 1 else None)
    assert ("That is no fault; below " in sentence_of(check)) == (side < 1)


def test_what_the_test_would_have_shown_is_shown_so_often(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    """C_CCY at the value that is named, 4 degrees of freedom: called in 95 % of 100 draws, to within 3 sigma (6.5 %)."""
    sources, found = planar
    uncertainty = np.array((1e-7, 1e-8, 1e-7, 1e-12, 1e-12, 1e-11))
    physical = dict(zip(SIX, (7e-5, 0.0, 6e-5, 0.0, 0.0, 0.0), strict=True))
    at = consistency(sources, found, estimate(physical, tuple(uncertainty), 4.0)).shows["C_CCY"]
    random, called = np.random.default_rng(2), 0
    for _ in range(100):
        drawn = physical | {"C_CCY": at + 1e-11 * random.standard_normal()}
        known = np.append(uncertainty[:-1], 1e-11 * np.sqrt(random.chisquare(4) / 4))
        called += "C_CCY" in consistency(sources, found, estimate(drawn, tuple(known), 4.0)).violated
    assert called / 100 == pytest.approx(0.95, abs=0.065)


def test_a_coupling_as_large_as_joints_allow_is_not_confirmed(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    """Half a standard uncertainty inside of 2 sqrt(C_XXX C_YYY), all signs sure: for all the test knows, on either side."""
    sources, found = planar
    values = dict(zip(SIX, (7e-5, 2 * np.sqrt(7e-5 * 6e-5) - 1e-8, 6e-5, 0.0, 0.0, 1e-9), strict=True))
    by_run = estimate(values, (1e-9, 2e-8, 1e-9, 1e-12, 1e-12, 1e-13))
    result = consistency(sources, found, by_run)
    assert result.distance == 0
    assert result.depth <= 0.5
    assert (result.state, result.why, result.closest) == (NOT_TESTED, NEAR_LIMIT, "C_XYX")
    said = sentence_of(physically_consistent(result, sources, found, by_run))
    assert said.startswith("Not tested: C_XYX is, within its uncertainty, the largest that")


def test_the_repeats_of_table_4_8_contradict_physics(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    """Five repeats at each of two levels, 4 degrees of freedom taken: repeatable, so no noise; the model lacks something."""
    sources, found = planar
    by_repeats = estimate(TABLE_4_8, TABLE_4_8_DEVIATION, 4.0)
    result = consistency(sources, found, by_repeats, correlated_as=by_repeats.covariance)
    assert result.state == CONTRADICTED
    assert result.violated == ("C_CCY",)
    assert result.p_negative["C_CCY"] == pytest.approx(stdtr(4.0, -7.66e-11 / 9.98e-13), abs=0)
    assert result.p_value == pytest.approx(2 * min(result.p_joint, 3 * result.p_negative["C_CCY"]), abs=0)  # two looks, Holm


@pytest.mark.parametrize(
    ("degrees", "state", "why"), [(1.5, NOT_TESTED, FEW_DEGREES), (2.0, NOT_TESTED, FEW_DEGREES), (12.0, CONTRADICTED, "")]
)
def test_too_few_degrees_of_freedom_are_no_noise(
    degrees: float, state: str, why: str, planar: tuple[tuple[Source, ...], Confounding]
) -> None:
    """C_XYX ten standard uncertainties beyond 2 sqrt(C_XXX C_YYY): with few degrees of freedom not tested, never noise."""
    sources, found = planar
    beyond = 2 * np.sqrt(7e-5 * 6e-5) + 10 * np.sqrt(1e-8**2 + 1e-8**2 * (6 / 7 + 7 / 6))
    values = dict(zip(SIX, (7e-5, beyond, 6e-5, 0.0, 0.0, 1e-9), strict=True))
    by_run = estimate(values, (1e-8, 1e-8, 1e-8, 1e-12, 1e-12, 1e-13), degrees)
    result = consistency(sources, found, by_run, correlated_as=by_run.covariance)
    assert result.distance == pytest.approx(10, rel=0.01)
    assert (result.state, result.why) == (state, why)
    check = physically_consistent(result, sources, found, by_run)
    assert check.passed is (None if state == NOT_TESTED else False)
    said = sentence_of(check)
    assert "10 standard uncertainties outside" in said
    assert (
        "degrees of freedom" if why else "C_XYX is larger than the compliances of the same joints along one load"
    ) in said


@pytest.mark.parametrize(("ccy", "named"), [(-1.1e-9, "the estimate is 1"), (1.1e-9, "the uncertainty")])
def test_an_uncertainty_by_reading_shows_nothing(
    ccy: float, named: str, planar: tuple[tuple[Source, ...], Confounding]
) -> None:
    """It is too small as a rule: eleven of it contradict nothing, and confirm nothing."""
    sources, found = planar
    values = TABLE_4_6 | {"C_CCY": ccy}
    by_reading = estimate(values, (1e-7, 1e-8, 1e-7, 1e-9, 1e-9, 1e-10), 500.0)
    result = consistency(sources, found, by_reading, by_reading=True)
    assert (result.state, result.why) == (NOT_TESTED, BY_READING)
    said = sentence_of(physically_consistent(result, sources, found, by_reading))
    assert said.startswith(f"Not tested: {named}")
    assert "assumes independent readings" in said


def test_the_scatter_is_counted_as_a_whole_where_its_correlations_are_others(
    planar: tuple[tuple[Source, ...], Confounding],
) -> None:
    """All noise in one direction that the measure takes for six: the p-value is that of one direction, not of six."""
    sources, found = planar
    deviations = np.array((1e-7, 1e-8, 1e-7, 1e-9, 1e-9, 1e-10))
    values = dict(zip(SIX, -2 * deviations, strict=True))
    alone = estimate(values, tuple(deviations), 20.0)
    together = replace(alone, covariance=np.outer(deviations, deviations) * (1 + 1e-9 * np.eye(6)))
    of_six = consistency(sources, found, alone, correlated_as=np.diag(deviations**2))
    of_one = consistency(sources, found, together, correlated_as=np.diag(deviations**2))
    assert of_one.distance == pytest.approx(of_six.distance)
    assert of_one.p_joint > of_six.p_joint
    mean_square = of_one.distance**2 / 6  # of six deviations that are one: its t
    assert of_one.p_joint == pytest.approx(stdtr(20.0, -np.sqrt(mean_square)), rel=1e-6)


def test_a_sum_of_cross_terms_may_be_negative(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    sources, found = planar
    values = dict(zip(SIX, (7e-5, -5e-5, 6e-5, -1e-7, -1e-8, 1e-9), strict=True))
    result = consistency(sources, found, estimate(values, (1e-9, 1e-9, 1e-9, 1e-12, 1e-12, 1e-13)))
    assert result.state == CONSISTENT
    assert result.constrained == values
    assert result.p_value == 1
    assert not result.outward
    assert not result.violated


def test_a_cross_term_too_large_for_its_diagonals_is_found_without_a_negative_sign(
    planar: tuple[tuple[Source, ...], Confounding],
) -> None:
    """C_CXY + C_XCY over twice the root of C_XXX + C_XXY times C_CCY: no joints give that."""
    sources, found = planar
    values = dict(zip(SIX, (7e-5, 0.0, 6e-5, 3e-6, 0.0, 1e-9), strict=True))
    result = consistency(sources, found, estimate(values, (1e-7, 1e-7, 1e-7, 1e-8, 1e-8, 1e-11)))
    assert result.state == CONTRADICTED
    assert not result.violated
    assert result.p_joint < 1e-4
    assert result.outward["C_CXY"] > 0
    constrained = result.constrained
    assert constrained["C_CXY"] ** 2 == pytest.approx(4 * constrained["C_XXX"] * constrained["C_CCY"], rel=1e-4)


@pytest.mark.parametrize("parameters", [("planar-xy",), ("C_*",)])
def test_a_physical_machine_is_consistent(parameters: tuple[str, ...], make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 300.0, 500.0], parameters=parameters)
    identification = identify(with_noise(test, PHYSICAL, 1e-5))
    result = consistency_of(identification)
    assert result.state == CONSISTENT
    assert result.dimension == 6
    assert_allclose(list(result.constrained.values()), identification.solution.values)


def test_a_test_that_determines_nothing_restricted_says_so(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 300.0, 500.0], parameters=("E_Xt0", "E_Yt0"))
    result = consistency_of(identify(with_noise(test, {"E_Xt0": -1e-2}, 1e-5)))
    assert (result.state, result.why, result.dimension) == (NOT_TESTED, NOTHING_RESTRICTED, 0)


@pytest.mark.parametrize(("ccy", "state"), [(-1.1e-9, CONTRADICTED), (-1.5e-10, NOT_TESTED)])
def test_the_verdict_from_readings_by_run(ccy: float, state: str, make_test: MakeTest) -> None:
    test = make_test("wFYXt", [112.0, 238.0, 364.0, 490.0, 616.0, 742.0], readings=90)
    identification = identify(with_noise(test, TABLE_4_6 | {"C_CCY": ccy}, 1e-3, seed=4))
    assert identification.by_run
    result = consistency_of(identification)
    assert result.state == state


def test_the_verdict_does_not_depend_on_units(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    """Metres for millimetres in every parameter: same distance, same p-value, converted values."""
    sources, found = planar
    uncertainty = (1e-7, 1e-8, 1e-7, 1e-9, 1e-9, 1.5e-9)
    values = TABLE_4_6 | {"C_CCY": -1.1e-9}
    plain = consistency(sources, found, estimate(values, uncertainty))
    metre = {source.name: 1e-3 ** ((source.component < 3) - ((source.load or 0) >= 3)) for source in sources}
    factors = np.array([metre[name] for name in SIX])
    combinations = found.combinations * factors[:, np.newaxis] / np.array([metre[name] for name in found.labels])
    solution = estimate(dict(zip(SIX, np.array(list(values.values())) * factors, strict=True)), tuple(uncertainty * factors))
    other = consistency(sources, replace(found, combinations=combinations), solution)
    assert other.distance == pytest.approx(plain.distance, rel=1e-6)
    assert other.p_value == pytest.approx(plain.p_value, rel=1e-6)
    for name, factor in zip(SIX, factors, strict=True):
        assert other.constrained[name] / factor == pytest.approx(plain.constrained[name], rel=1e-4, abs=1e-14)


def test_physical_machines_are_called_contradictory_at_most_as_often_as_stated(make_test: MakeTest) -> None:
    """At the least favourable truth, none of the joints giving way: 100 draws, 3 sigma are 0.066."""
    systems = systems_of(make_test("wFYXt", [100.0, 400.0], readings=24))
    found = confounding(merged(systems.runs), SIX)
    free = solve(merged(systems.runs), SIX)
    design = np.vstack([run.design for run in systems.runs])[:, [found.labels.index(name) for name in SIX]]
    shape = np.linalg.inv(design.T @ design)
    root, degrees = np.linalg.cholesky(shape), len(design) - 6
    random = np.random.default_rng(8)
    called = 0
    for _ in range(100):
        covariance = shape * random.chisquare(degrees) / degrees
        drawn = replace(
            free,
            values=root @ random.standard_normal(6),
            covariance=covariance,
            degrees_of_freedom=np.full(6, float(degrees)),
        )
        called += consistency(systems.sources, found, drawn).state == CONTRADICTED
    assert called / 100 < 0.05 + 0.066


def test_a_solution_of_other_parameters_is_refused(planar: tuple[tuple[Source, ...], Confounding]) -> None:
    sources, found = planar
    with pytest.raises(InputError, match="it must be of C_XXX, C_XYX"):
        consistency(sources, found, estimate({"C_XXX": 1.0}, (1.0,)))


def test_reciprocal_sources_merge_pairs_under_the_name_that_the_thesis_keeps(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0])
    sources = select_sources(test.machine, ["planar-xy", "E_XX1", "C_ABX"])
    together = reciprocal_sources(sources)
    names = [f"C_{entry}{axis}" for axis in "XY" for entry in ("XX", "XY", "YY", "CX", "CY", "CC")]
    assert sorted(source.name for source in together) == sorted([*names, "E_XX1", "C_ABX"])
    (pair,) = (source for source in together if source.name == "C_CXY")
    assert isinstance(pair, ReciprocalSource)
    assert "by reciprocity also translation in x for a moment about z" in pair.meaning
    (situation,) = (Situation(test.machine, run) for run in test.observations())
    columns = {source.name: source.column(situation) for source in sources}
    assert columns["C_XCY"].any()
    assert_allclose(pair.column(situation), columns["C_CXY"] + columns["C_XCY"])
    block = joint_blocks(together, [source.name for source in together])["Y"]
    assert (block == block.T).all()
    assert (block >= 0).all()


def test_a_radial_force_cannot_test_reciprocity(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0])
    sources = select_sources(test.machine, ["planar-xy"])
    bought = reciprocity(sources, test.machine, test.observations(), prefer=SIX)
    assert (len(bought.free.labels), bought.free.rank) == (18, 6)
    assert (len(bought.symmetric.labels), bought.symmetric.rank) == (12, 6)
    assert bought.testable == 0
    assert len(bought.pairs) == 6
    assert bought.alone_free == ("C_CCY",)
    assert set(bought.alone_symmetric) == {"C_CCY", "C_CXY", "C_XCY", "C_CYY", "C_YCY"}  # halves of sums, by assumption
    assert "cannot test the assumption" in reciprocity_words(bought)
    assert "18 parameters into 12" in reciprocity_words(bought)


def test_a_force_across_the_sensitive_direction_tests_reciprocity_and_gains_by_it(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0])
    sources = select_sources(test.machine, ["planar-xy"])
    bought = reciprocity(sources, test.machine, across(test.observations()))
    assert bought.free.rank > 6
    assert bought.testable > 0
    assert bought.symmetric.rank == bought.free.rank - bought.testable
    assert len(bought.symmetric.labels) - bought.symmetric.rank < len(bought.free.labels) - bought.free.rank
    assert bought.symmetric.condition_scaled < bought.free.condition_scaled
    assert set(bought.alone_free) < set(bought.alone_symmetric)
    assert "so test the assumption" in reciprocity_words(bought)


def test_without_pairs_reciprocity_merges_nothing(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0])
    bought = reciprocity(select_sources(test.machine, ["C_XXX", "C_CXY"]), test.machine, test.observations())
    assert not bought.pairs
    assert "merges nothing" in reciprocity_words(bought)


def test_an_asymmetric_joint_contradicts_physics_only_where_the_force_is_across(make_test: MakeTest) -> None:
    test = make_test("wFYXt", [100.0, 300.0], readings=60)
    sources = select_sources(test.machine, ["planar-xy"])
    values = PHYSICAL | {"C_CXY": 5e-8 + 4e-8, "C_XCY": 5e-8 - 4e-8}
    for turned, state in ((False, CONSISTENT), (True, CONTRADICTED)):
        observations = across(test.observations()) if turned else test.observations()
        assert _state_of(sources, test, observations, values) == state
        assert _state_of(sources, test, observations, PHYSICAL) != CONTRADICTED


def _state_of(
    sources: tuple[Source, ...], test: MachineTest, observations: tuple[Observations, ...], values: dict[str, float]
) -> str:
    random = np.random.default_rng(1)
    read = []
    for run in observations:
        situation = Situation(test.machine, run)
        reading: Array = sum(
            (values.get(source.name, 0.0) * source.column(situation) for source in sources), np.zeros(len(run))
        )
        read.append(run.with_reading(reading + 1e-6 * random.standard_normal(len(run))))
    systems = run_systems(sources, test.machine, read)
    factor = merged(systems.runs)
    found = confounding(factor, ceilings=systems.ceilings)
    return consistency(sources, found, solve(factor, found.retained)).state
