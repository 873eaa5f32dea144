"""Thesis chapter 4, number by number: Tables 4.2 to 4.6, Eqs. 4.26 to 4.29, and what recomputing them adds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.estimate import confounding, factor_blocks, solve
from elastogeo.identification import (
    Identification,
    adjacent,
    confounding_of,
    identify,
    local_estimates,
    merged,
    systems_of,
)
from elastogeo.machine import Array, Joint, Machine, parse_topology
from elastogeo.observe import THESIS_CALIBRATION, Circle, MachineTest, Run, force_from_pressure
from elastogeo.report import sentence_of
from elastogeo.sources import simulate

MakeTest = Callable[..., MachineTest]

NULL_FIVE = ("C_XCX", "C_YCX", "C_CXX", "C_CYX", "C_CCX")
GROUPS = {
    frozenset({"C_XXX", "C_XXY"}),
    frozenset({"C_XYX", "C_YXX", "C_XYY", "C_YXY"}),
    frozenset({"C_YYX", "C_YYY"}),
    frozenset({"C_XCY", "C_CXY"}),
    frozenset({"C_YCY", "C_CYY"}),
    frozenset({"C_CCY"}),
}

SIX = ("C_XXX", "C_XYX", "C_YYY", "C_CXY", "C_CYY", "C_CCY")


def planar(printed: str) -> dict[str, str]:
    """A table of both axes as the thesis prints it: rows are twist components X Y C, columns F_X F_Y M_C at X, then at Y."""
    rows = [line.split() for line in printed.strip().splitlines()]
    return {f"C_{d}{f}{'XY'[k // 3]}": row[k] for d, row in zip("XYC", rows, strict=True) for k, f in enumerate("XYCXYC")}


TABLE_4_2 = {
    name: float(value)
    for name, value in planar("""
        1.1E-04  1.2E-04  1.3E-06  4.4E-04  4.5E-04  4.6E-06
        2.1E-04  2.2E-04  2.3E-06  5.4E-04  5.5E-04  5.6E-06
        3.1E-06  3.2E-06  3.3E-08  6.4E-06  6.5E-06  6.6E-08
    """).items()
}
TABLE_4_3 = planar("""
        2.75E-04 3.3E-04  0        2.75E-04 3.3E-04  5.5E-06
        3.3E-04  3.85E-04 0        3.3E-04  3.85E-04 6.05E-06
        0        0        0        5.5E-06  6.05E-06 6.6E-08
""")
TABLE_4_5 = dict(zip(SIX, ("5.5E-04", "1.32E-03", "7.7E-04", "1.1E-05", "1.21E-05", "6.6E-08"), strict=True))
TABLE_4_6 = dict(zip(SIX, (7.61e-5, 2.27e-7, 6.05e-5, 1.08e-9, 5.35e-10, -1.73e-11), strict=True))
GEOMETRY = {
    "E_XX1": -1.3e-4,
    "E_YX2": 4.34e-7,
    "E_XY2": -7.26e-7,
    "E_YY1": -9.86e-5,
    "E_C(0Y)X": 1.15e-6,
    "E_Xt0": 3.891e-3,
    "E_Yt0": -6.2e-4,
}
"""Table 5.6: errors that do not change with the load."""

RESOLUTION = 0.00024
"""Of the thesis's readings [mm]."""


def assert_printed(value: float, printed: str) -> None:
    """The value, rounded to the printed digits, is what is printed; below a millionth of 1e-4, it is zero."""
    if printed == "0":
        assert abs(value) < 1e-18
        return
    decimals = len(printed.partition(".")[2].partition("E")[0])
    assert float(f"{value:.{decimals}E}") == float(printed)
    assert value == pytest.approx(float(printed), rel=1e-9)  # and the printed digits are all there are


@pytest.fixture(scope="module")
def section_4_5(make_test: MakeTest) -> Identification:
    """Section 4.5.1: Table 4.2 simulated at R = 150 mm and F = 100 N, all 18 asked for."""
    return identify(simulate(make_test("wFYXt", [100.0], readings=360), TABLE_4_2, exact=False))


@pytest.fixture(scope="module")
def section_4_6(make_test: MakeTest, thesis_forces: tuple[float, ...]) -> Identification:
    """Section 4.6: Table 4.6 and errors that do not change with the load, seven levels, 36 N subtracted."""
    test = make_test("wCAFYXZSt", thesis_forces, reference=36.0, readings=120)
    return identify(simulate(replace(test, resolution=RESOLUTION), TABLE_4_6 | GEOMETRY, exact=False))


def test_table_4_2_gives_table_4_3_by_the_minimum_norm(section_4_5: Identification) -> None:
    assert set(section_4_5.minimum_norm) == set(TABLE_4_3)
    for name, printed in TABLE_4_3.items():
        assert_printed(section_4_5.minimum_norm[name], printed)


def test_table_4_2_gives_table_4_5_by_the_retained_six(section_4_5: Identification) -> None:
    values = {parameter.name: parameter.value for parameter in section_4_5.parameters}
    assert set(values) == set(TABLE_4_5)
    for name, printed in TABLE_4_5.items():
        assert_printed(values[name], printed)


def test_both_solutions_predict_the_readings(section_4_5: Identification) -> None:
    """Figures 4.7 and 4.8."""
    (trace,) = section_4_5.traces
    assert np.ptp(trace.measured) > 0.05
    assert_allclose(trace.predicted, trace.measured, atol=1e-12)
    (run,) = systems_of(section_4_5.test).runs
    by_minimum_norm = run.design @ [section_4_5.minimum_norm[name] for name in section_4_5.confounding.labels]
    assert_allclose(by_minimum_norm, trace.measured, atol=1e-12)


def test_eighteen_planar_terms_have_rank_six(section_4_5: Identification) -> None:
    found = section_4_5.confounding
    assert len(found.labels) == 18
    assert found.rank == 6
    assert found.retained == SIX
    assert set(found.null) == set(NULL_FIVE)
    assert {frozenset(group) for group in found.groups} == GROUPS
    assert found.condition_raw == pytest.approx(9742.79, abs=0.005)
    assert found.condition_scaled == pytest.approx(3.186, abs=0.0005)


def test_every_retained_term_stands_for_the_sum_of_its_group(section_4_5: Identification) -> None:
    for parameter in section_4_5.parameters:
        (group,) = (group for group in GROUPS if parameter.name in group)
        assert parameter.stands_for == pytest.approx(dict.fromkeys(group, 1.0))
        assert parameter.value == pytest.approx(sum(TABLE_4_2[name] for name in group), rel=1e-9)
        assert parameter.truth == pytest.approx(float(TABLE_4_5[parameter.name]), rel=1e-9)


def test_the_patterns_are_those_of_table_4_4(section_4_5: Identification) -> None:
    patterns = {pattern.names[0]: pattern for pattern in section_4_5.patterns}
    assert {frozenset(pattern.names) for pattern in section_4_5.patterns} == GROUPS
    c, s = np.cos(patterns["C_CCY"].pose), np.sin(patterns["C_CCY"].pose)
    shapes = {"C_XXX": c * c, "C_XYX": c * s, "C_YYX": s * s, "C_XCY": c * c * s, "C_YCY": c * s * s, "C_CCY": (c * s) ** 2}
    for name, shape in shapes.items():
        assert_allclose(np.abs(patterns[name].response), np.abs(shape) / np.abs(shape).max(), atol=1e-12)
    assert np.sum(patterns["C_CCY"].response > 0.999) >= 4  # four lobes, at 45 degrees
    assert_allclose(patterns["C_CCY"].response[::90], 0, atol=1e-12)


@pytest.mark.parametrize(("topology", "terms"), [("wFYXt", 72), ("wCAFYXZSt", 180)])
def test_the_full_model_keeps_the_same_six(topology: str, terms: int, make_test: MakeTest) -> None:
    test = make_test(topology, [100.0], readings=360, parameters=["C_*"])
    found = confounding_of(test, systems_of(test))
    assert len(found.labels) == terms
    assert found.retained == SIX
    assert found.condition_raw == pytest.approx(9742.79, abs=0.005)
    assert found.condition_scaled == pytest.approx(3.186, abs=0.0005)


@pytest.mark.parametrize("topology", ["wFYXt", "wCAFYXZSt"])
@pytest.mark.parametrize("seed", range(3))
def test_links_and_tools_of_any_length_keep_the_same_six(topology: str, seed: int, make_test: MakeTest) -> None:
    random = np.random.default_rng(seed)
    axes = parse_topology(topology)
    joints = tuple(Joint(a, offset=tuple(random.uniform(-400, 400, 3)), compliant=a != "S") for a in axes.axes)
    machine = Machine("offset", axes, joints, tool=tuple(random.uniform(-150, 150, 3)))
    test = make_test(machine, [100.0], parameters=["C_*"], circle=Circle(150.0, centre={"X": 120.0, "Y": -210.0}))
    found = confounding_of(test, systems_of(test))
    assert found.retained == SIX


def test_a_richer_test_raises_the_rank(make_test: MakeTest) -> None:
    """The same circle on a tilted plane of the same machine."""
    flat = make_test("wCAFYXZSt", [100.0], parameters=["C_*"])
    circle = Circle(150.0, ((1.0, 0.0, 1.0), (0.0, 1.0, 0.0)))
    tilted = make_test("wCAFYXZSt", [100.0], parameters=["C_*"], circle=circle)
    assert confounding_of(tilted, systems_of(tilted)).rank > confounding_of(flat, systems_of(flat)).rank


@pytest.mark.parametrize(("bar", "newton"), [(0.4, 36), (1, 112), (2, 238), (3, 364), (4, 490), (5, 616), (6, 742)])
def test_the_force_calibration(bar: float, newton: float) -> None:
    """Section 4.6; 0.4 bar gives 36.4 N on the line and is printed as 36 N."""
    assert force_from_pressure(bar, THESIS_CALIBRATION) == pytest.approx(newton, abs=0.5 if bar < 1 else 1e-9)


def test_taking_the_reference_off_is_eqs_4_26_and_4_27(section_4_6: Identification) -> None:
    test = section_4_6.test
    raw = {run.name: run.columns["radial"] for run in test.runs}
    assert [trace.force for trace in section_4_6.traces] == [76, 202, 328, 454, 580, 706]
    assert [level.force for level in section_4_6.levels] == [76, 202, 328, 454, 580, 706]
    for trace in section_4_6.traces:
        assert_allclose(trace.measured, raw[trace.run] - raw["36 N, 1"], atol=1e-15)
    # each row of the model is that of the difference of the forces
    direct = systems_of(replace(test, runs=test.runs[1:], question=replace(test.question, reference_force=None)))
    for run, at_full_force in zip(systems_of(test).runs, direct.runs, strict=True):
        assert_allclose(run.design, at_full_force.design * run.force / (run.force + 36), rtol=1e-9, atol=1e-9)


def test_the_global_estimate_of_eq_4_28_is_free_of_what_does_not_change_with_the_load(
    section_4_6: Identification,
) -> None:
    for parameter in section_4_6.parameters:
        assert parameter.value == pytest.approx(TABLE_4_6[parameter.name], rel=1e-6)
    with_geometry = replace(section_4_6.test, question=replace(section_4_6.test.question, reference_force=None))
    biased = {parameter.name: parameter.value for parameter in identify(with_geometry).parameters}
    assert abs(biased["C_XXX"] / TABLE_4_6["C_XXX"] - 1) > 1e-3


def test_local_estimates_come_from_adjacent_levels_as_in_eq_4_29(section_4_6: Identification) -> None:
    """By hand: two stacked differences, their pseudo-inverse on scaled columns."""
    assert [local.forces for local in section_4_6.local] == [(76, 202), (202, 328), (328, 454), (454, 580), (580, 706)]
    systems = systems_of(section_4_6.test)
    labels = section_4_6.solution.labels
    columns = [section_4_6.confounding.labels.index(label) for label in labels]
    for local, pair in zip(section_4_6.local, zip(systems.runs, systems.runs[1:], strict=False), strict=True):
        A = np.vstack([run.design[:, columns] for run in pair])
        y = np.concatenate([run.reading for run in pair])
        scale = np.linalg.norm(A, axis=0)
        assert_allclose(local.solution.values * scale, np.linalg.pinv(A / scale) @ y, rtol=1e-7)
        assert local.solution.labels == labels


def test_local_estimates_differ_where_the_machine_does(make_test: MakeTest) -> None:
    """A machine that softens with the load, as in Table 4.7: each pair sees its own compliance."""
    forces = (36.0, 112.0, 238.0, 364.0)
    test = make_test("wFYXt", forces, reference=36.0)
    runs = []
    for run, softness in zip(test.runs, (1.0, 1.0, 1.1, 1.2), strict=True):
        (alone,) = simulate(replace(test, runs=(run,)), {"C_XXX": 7e-5 * softness}, exact=False).runs
        runs.append(alone)
    result = identify(replace(test, runs=tuple(runs)))
    local = [estimate.solution.values[0] for estimate in result.local]
    assert local[0] < result.solution.values[0] < local[1]
    systems = systems_of(replace(test, runs=tuple(runs)))
    wide, triple = local_estimates(systems, result.solution.labels, [(76, 328), (76, 202, 328)])
    assert wide.forces == (76, 328)
    assert local[0] < wide.solution.values[0]
    assert_allclose(triple.solution.values, result.solution.values, rtol=1e-9)
    assert adjacent((1.0, 2.0, 3.0)) == ((1.0, 2.0), (2.0, 3.0))


def test_c_ccy_is_below_the_resolution_of_the_readings(section_4_6: Identification) -> None:
    """Section 4.6.1: 0.07 um at 706 N against 0.24 um; the largest of the others 0.17 um."""
    spans = {parameter.name: abs(parameter.peak_to_peak) * 1000 for parameter in section_4_6.parameters}
    assert spans["C_CCY"] == pytest.approx(0.07, abs=0.002)
    assert max(spans[name] for name in spans if name not in ("C_XXX", "C_YYY")) == pytest.approx(0.17, abs=0.012)
    assert spans["C_XXX"] == pytest.approx(53.7, abs=0.1)
    signs = {parameter.name: np.sign(parameter.peak_to_peak) for parameter in section_4_6.parameters}
    assert signs["C_CCY"] == -1
    assert sum(parameter.share for parameter in section_4_6.parameters) == pytest.approx(1.0)
    check = {check.name: check for check in section_4_6.verdict}["above resolution"]
    assert not check.passed
    assert "C_CCY (0.069 µm)" in sentence_of(check)
    assert "C_XXX" not in sentence_of(check)
    assert "0.24 µm" in sentence_of(check)


def elasto_geometric(make_test: MakeTest, forces: tuple[float, ...], radius: float = 150.0) -> MachineTest:
    return make_test("wFYXt", forces, readings=360, parameters=["elasto-geometric-xy"], circle=Circle(radius))


def test_one_force_level_cannot_tell_load_from_geometry(make_test: MakeTest) -> None:
    test = simulate(elasto_geometric(make_test, (364.0,)), TABLE_4_6 | GEOMETRY, exact=False)
    found = confounding_of(test, systems_of(test))
    assert len(found.labels) == 13
    assert found.rank == 8
    assert "E_XX1" in found.stands_for("C_XXX")
    checks = {check.name: check for check in identify(test).verdict}
    assert not checks["forces distinct"].passed
    assert "Measure at two clearly different forces" in sentence_of(checks["forces distinct"])
    assert not checks["identifiable"].passed


def test_seven_force_levels_tell_all_thirteen(make_test: MakeTest, thesis_forces: tuple[float, ...]) -> None:
    test = simulate(elasto_geometric(make_test, thesis_forces), TABLE_4_6 | GEOMETRY, exact=False)
    found = confounding_of(test, systems_of(test))
    assert found.rank == 13
    assert found.condition_raw == pytest.approx(3.05e6, rel=0.002)
    assert found.condition_scaled == pytest.approx(5.4, abs=0.05)
    result = identify(test)
    for parameter in result.parameters:
        assert parameter.value == pytest.approx((TABLE_4_6 | GEOMETRY)[parameter.name], rel=1e-5)
    checks = {check.name: check.passed for check in result.verdict}
    assert checks["identifiable"]
    assert checks["forces distinct"]
    assert checks["conditioned"]


def test_adjacent_levels_are_coupled_the_more_the_higher(make_test: MakeTest, thesis_forces: tuple[float, ...]) -> None:
    """Why the thesis sees the geometry "change with the load": the variance inflation of C_XXX grows 28, 54, 89, 133."""
    found = {}
    inflation = {}
    for pair in [(36.0, 742.0), *adjacent(thesis_forces)]:
        test = elasto_geometric(make_test, pair)
        systems = systems_of(test)
        found[pair] = confounding_of(test, systems).condition_scaled
        R = merged(systems.runs).R
        R = R / np.linalg.norm(R, axis=0)
        inflation[pair] = np.linalg.inv(R.T @ R)[0, 0]
    assert found[36.0, 742.0] == pytest.approx(4, abs=0.2)
    assert found[616.0, 742.0] == pytest.approx(35, abs=0.5)
    assert list(inflation.values())[-4:] == pytest.approx([28, 54, 89, 133], abs=0.5)


UNIT_POWERS = dict(zip((*SIX, *GEOMETRY), (1, 1, 1, 0, 0, -1, 0, -1, -1, 0, 0, 1, 1), strict=True))
"""With which power of the unit of length each parameter's value converts."""


def in_unit(make_test: MakeTest, forces: tuple[float, ...], per_mm: float) -> MachineTest:
    """The test with every length counted in a unit of which there are `per_mm` in a millimetre, noise included."""
    truth = {name: value * per_mm ** UNIT_POWERS[name] for name, value in (TABLE_4_6 | GEOMETRY).items()}
    test = simulate(elasto_geometric(make_test, forces, 150.0 * per_mm), truth, exact=False)
    random = np.random.default_rng(8)
    runs = []
    for run in test.runs:
        noisy = run.columns["radial"] + 1e-4 * per_mm * random.standard_normal(360)
        runs.append(replace(run, columns={**run.columns, "radial": noisy}))
    return replace(test, runs=tuple(runs))


@pytest.mark.parametrize("per_mm", [1e3, 1e-3])
def test_the_answer_does_not_depend_on_the_unit_of_length(
    per_mm: float, make_test: MakeTest, thesis_forces: tuple[float, ...]
) -> None:
    plain, other = (identify(in_unit(make_test, thesis_forces, unit)) for unit in (1.0, per_mm))
    assert other.confounding.retained == plain.confounding.retained
    assert other.confounding.rank == 13
    assert other.confounding.condition_scaled == pytest.approx(plain.confounding.condition_scaled, rel=1e-10)
    for one, two in zip(plain.parameters, other.parameters, strict=True):
        back = per_mm ** -UNIT_POWERS[one.name]
        assert two.value * back == pytest.approx(one.value, rel=1e-10, abs=1e-10 * one.standard_uncertainty)
        assert two.standard_uncertainty * back == pytest.approx(one.standard_uncertainty, rel=1e-10)
        assert two.share == pytest.approx(one.share, rel=1e-10)
    # the bare factor, which knows no units, gives the same
    bare = confounding(merged(systems_of(other.test).runs))
    assert bare.rank == 13


def test_unscaled_micrometres_would_have_dropped_two_of_thirteen(
    make_test: MakeTest, thesis_forces: tuple[float, ...]
) -> None:
    """What the house avoids: numpy's default on raw columns in micrometres, silently wrong by far over 100 %."""
    truth = TABLE_4_6 | GEOMETRY
    runs = systems_of(in_unit(make_test, thesis_forces, 1e3)).runs
    A, y = np.vstack([run.design for run in runs]), np.concatenate([run.reading for run in runs])
    values, _, rank, _ = np.linalg.lstsq(A, y, rcond=None)
    assert rank == 11
    wrong = [abs(v / (truth[n] * 1e3 ** UNIT_POWERS[n]) - 1) for n, v in zip(runs[0].factor.labels, values, strict=True)]
    assert max(wrong) > 0.9
    ours = solve(merged(runs))
    names = [n for n in ours.labels if n in ("C_XXX", "C_YYY", "E_XX1", "E_YX2", "E_XY2", "E_YY1")]
    for name in names:
        value = ours.values[ours.labels.index(name)]
        assert value == pytest.approx(truth[name] * 1e3 ** UNIT_POWERS[name], rel=0.05)


def test_a_purely_radial_force_shows_only_sums_of_mirrored_terms(
    make_test: MakeTest, make_machine: Callable[..., Machine]
) -> None:
    """What the force drives and what the bar reads are the same direction: the columns of C_df and C_fd are equal."""
    machine = make_machine("wCAYfXZt", tool=(20.0, 30.0, -100.0), seed=5)
    test = make_test(machine, [300.0], parameters=["C_*"], circle=Circle(150.0, centre={"A": 0.4, "C": 0.7}))
    (run,) = systems_of(test).runs
    columns = dict(zip(run.factor.labels, run.design.T, strict=True))
    mirrored = [name for name in columns if name[2] < name[3]]
    assert len(mirrored) == 15 * 5
    for name in mirrored:
        twin = columns[f"C_{name[3]}{name[2]}{name[4]}"]
        assert np.ptp(twin) > 1.0
        assert_allclose(columns[name], twin, rtol=0, atol=1e-12 * np.abs(twin).max())


def test_repeats_at_two_levels_report_both_uncertainties(make_test: MakeTest) -> None:
    """Section 4.7: five runs at 364 and 490 N less one of 36 N: 25 combinations, and the run-level figure."""
    test = make_test("wFYXt", (364.0, 490.0), repeats=5, readings=60)
    reference = make_test("wFYXt", (36.0,), readings=60).runs
    random = np.random.default_rng(47)
    runs: list[Run] = []
    for run in (*reference, *test.runs):
        day = {name: value * (1 + 0.003 * random.standard_normal()) for name, value in TABLE_4_6.items()}
        runs.extend(simulate(replace(test, runs=(run,)), day, exact=False).runs)
    result = identify(replace(test, runs=tuple(runs), question=replace(test.question, reference_force=36.0)))
    repeats = result.repeats
    assert repeats is not None
    assert repeats.runs == {"328 N": 5, "454 N": 5}
    assert repeats.combinations.shape == (25, 6)
    assert_allclose(repeats.combination_mean, result.solution.values, rtol=1e-6)
    # Without the reference this is 2.04 (tests/estimate/test_repeats.py); its scatter is in every difference.
    assert np.all(repeats.combination_std / repeats.solution.standard_uncertainty < 2.04)
    assert np.all((repeats.solution.degrees_of_freedom >= 4 - 1e-9) & (repeats.solution.degrees_of_freedom <= 16))


def test_streaming_the_rows_changes_nothing(make_test: MakeTest, thesis_forces: tuple[float, ...]) -> None:
    test = in_unit(make_test, thesis_forces, 1.0)
    systems = systems_of(test)
    rows: Array = np.vstack([run.rows for run in systems.runs])
    one_by_one = factor_blocks(systems.runs[0].factor.labels, (rows[k : k + 1].copy() for k in range(len(rows))))
    assert_allclose(solve(one_by_one).values, identify(test).solution.values, rtol=1e-10)
