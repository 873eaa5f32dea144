"""The doors' contract: keys, plain types, the result's own numbers, never a number that is none."""

from __future__ import annotations

import json
from dataclasses import replace
from math import inf, isfinite

import numpy as np
import pytest

import elastogeo
from elastogeo.identification import Explanation, compare, diagnose, what_if
from elastogeo.report.faults.comparison_document import comparison_json
from elastogeo.report.faults.diagnosis_document import diagnosis_json
from elastogeo.report.faults.what_if_document import what_if_json
from elastogeo.report.identification.document import identification_json
from elastogeo.report.identification.explanation_document import explanation_json
from elastogeo.report.machines.document import machine_json

KEYS = {
    "correlation",
    "tests",
    "together",
    "tests_agreement",
    "schema",
    "software",
    "test",
    "parameters",
    "null",
    "confounded",
    "rank",
    "columns",
    "condition_raw",
    "condition_scaled",
    "singular_values",
    "linear",
    "rmse_um",
    "levels",
    "local",
    "repeats",
    "minimum_norm",
    "set_up",
    "verdict",
    "by_run",
    "local_change",
    "models",
    "consistency",
    "collinear",
}
PARAMETER_KEYS = {
    "name",
    "value",
    "unit",
    "standard_uncertainty",
    "interval95",
    "stands_for",
    "peak_to_peak_um",
    "share",
    "meaning",
    "axis",
    "elastic",
    "separated",
    "degrees_of_freedom",
    "naive_standard_uncertainty",
    "budget",
    "monte_carlo",
    "truth",
}


def types_in(value: object) -> set[type]:
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return {type(value)}.union(*(types_in(item) for item in inside))


@pytest.mark.parametrize("name", ["rich", "poor", "geometric", "separated", "mixed"])
def test_keys_and_plain_types(name, request) -> None:
    document = identification_json(request.getfixturevalue(name))
    assert set(document) == KEYS
    assert {frozenset(parameter) for parameter in document["parameters"]} == {frozenset(PARAMETER_KEYS)}
    assert types_in(document) <= {dict, list, str, int, float, bool, type(None)}
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def test_numbers_are_those_of_the_result(rich, separated) -> None:
    document = identification_json(rich)
    assert document["schema"] == "elastogeo.identification/1"
    assert document["software"] == {"name": "elastogeo", "version": elastogeo.__version__}
    assert document["test"] == {
        "name": "test",
        "machine": "wCAFYXZSt",
        "topology": "wCAFYXZSt",
        "instrument": "loaded-ball-bar",
        "simulated": "the global parameters of Table 5.5",
        "reference_force_N": 36.0,
        "resolution_um": pytest.approx(0.24),
        "runs": 11,
        "about": {},
        "files": [],
    }
    first, parameter = document["parameters"][0], rich.parameters[0]
    assert first["value"] == parameter.value
    assert first["interval95"] is first["standard_uncertainty"] is first["degrees_of_freedom"] is None
    by_run = identification_json(separated)["parameters"][0]
    assert by_run["interval95"] == list(separated.parameters[0].interval)
    assert by_run["standard_uncertainty"] == separated.parameters[0].standard_uncertainty > 0
    assert first["peak_to_peak_um"] == 1000 * parameter.peak_to_peak
    assert first["stands_for"] == parameter.stands_for
    assert document["rank"] == 6
    assert document["columns"] == 18
    assert document["null"] == ["C_XCX", "C_YCX", "C_CXX", "C_CYX", "C_CCX"]
    assert ["C_CCY"] not in document["confounded"]
    assert ["C_XXX", "C_XXY"] in document["confounded"]
    assert [level["force_N"] for level in document["levels"]] == [76, 202, 328, 454, 580, 706]
    assert document["levels"][0]["rmse_um"] == 1000 * rich.levels[0].rmse
    assert document["local"][0]["forces_N"] == [76, 202]
    assert document["local"][0]["values"][0]["value"] == rich.local[0].solution.values[0]
    assert [check["passed"] for check in document["verdict"]] == [check.passed for check in rich.verdict]
    assert {frozenset(check) for check in document["verdict"]} == {frozenset({"name", "passed", "sentence", "decisive"})}


def test_negative_parameters_have_a_negative_peak_to_peak(rich) -> None:
    by_name = {p["name"]: p for p in identification_json(rich)["parameters"]}
    assert by_name["C_CCY"]["peak_to_peak_um"] < 0 < by_name["C_XXX"]["peak_to_peak_um"]


def test_repeats(rich, poor) -> None:
    repeats = identification_json(rich)["repeats"]
    assert identification_json(poor)["repeats"] is None
    assert repeats["levels"] == {"328 N": 3, "454 N": 3}
    assert repeats["combinations"] == 9
    assert repeats["combination_std"]["C_XXX"] == rich.repeats.combination_std[0]
    assert repeats["standard_uncertainty"]["C_XXX"] == rich.repeats.solution.standard_uncertainty[0]
    assert 2 <= repeats["degrees_of_freedom"]["C_XXX"] <= 8
    assert "not independent" in repeats["note"]
    assert "reference" in repeats["note"]


def test_a_number_that_is_none_is_null(rich) -> None:
    level = replace(rich.levels[0], fitness=None)
    solution = replace(rich.repeats.solution, degrees_of_freedom=np.full(6, inf))
    document = identification_json(
        replace(rich, levels=(level,), repeats=replace(rich.repeats, solution=solution), rmse=np.float64(inf))
    )
    assert document["levels"][0]["fitness_percent"] is None
    assert set(document["repeats"]["degrees_of_freedom"].values()) == {None}
    assert document["rmse_um"] is None
    assert "NaN" not in json.dumps(document, allow_nan=False)


def test_the_correlation_and_the_uncertainties_are_the_covariance(separated, rich) -> None:
    document = identification_json(separated)
    u = np.array([parameter["standard_uncertainty"] for parameter in document["parameters"]])
    whole = np.eye(len(u))
    for k, row in enumerate(document["correlation"]):
        whole[k, : len(row)] = whole[: len(row), k] = row
        assert len(row) == k
    np.testing.assert_allclose(whole * np.outer(u, u), separated.budget.covariance, rtol=1e-9)
    assert np.abs(whole - np.eye(len(u))).max() > 0.1
    assert identification_json(rich)["correlation"] is None


def test_confounding(rich) -> None:
    document = explanation_json(Explanation(rich.campaign, rich.confounding), None)
    assert document["schema"] == "elastogeo.explanation/1"
    assert document["retained"][0]["name"] == "C_XXX"
    assert set(document["retained"][0]["stands_for"]) == {"C_XXX", "C_XXY"}
    assert ["C_CCY"] in document["groups"]
    assert list(document["weakest"]) == list(rich.confounding.retained)
    assert sum(c**2 for c in document["weakest"].values()) == pytest.approx(1)
    assert all(isfinite(s) for s in document["singular_values"])
    assert types_in(document) <= {dict, list, str, int, float, bool, type(None)}
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def test_machine(make_machine) -> None:
    document = machine_json(make_machine("wCAFYXZSt"))
    assert document["schema"] == "elastogeo.machine/1"
    assert document["topology_iso"] == "[w C' A' b Y X Z (C1) t]"
    assert [axis["name"] for axis in document["axes"]] == list("CAYXZS")
    assert document["axes"][0]["travel_unit"] == "rad"
    assert document["axes"][2]["travel"] == [None, None]
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def strict(document: dict) -> None:
    assert types_in(document) <= {dict, list, str, int, float, bool, type(None)}
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def test_the_budget_goes_with_every_parameter(separated) -> None:
    document = identification_json(separated)
    assert document["by_run"] is True
    for k, (entry, parameter) in enumerate(zip(document["parameters"], separated.parameters, strict=True)):
        sizes = [line["contribution"] for line in entry["budget"]]
        assert sizes == sorted(sizes, reverse=True)
        assert np.hypot.reduce(sizes) == pytest.approx(parameter.standard_uncertainty)
        by_label = {line["label"]: line for line in entry["budget"]}
        assert by_label["scatter of the readings"]["type"] == "A"
        assert by_label["form of the balls"] == {
            "label": "form of the balls",
            "type": "B",
            "distribution": "rectangular",
            "degrees_of_freedom": None,
            "contribution": by_label["form of the balls"]["contribution"],
        }
        assert entry["naive_standard_uncertainty"] == separated.naive.standard_uncertainty[k]


def test_what_models_forces_and_physics_say(separated, poor) -> None:
    document = identification_json(separated)
    assert document["models"]["supported"] == separated.models.supported
    first = document["models"]["models"][0]
    assert first["p_value"] == separated.models.candidates[0].p_value
    assert first["log_ratio"] is None
    assert first["left_out_level_um"] == 1000 * separated.models.candidates[0].left_out_level
    assert document["local_change"]["p_value"] == separated.local_change.p_value
    assert document["consistency"]["state"] == separated.consistency.state
    assert document["levels"][-1]["elastic_um"] == [1000 * bound for bound in separated.levels[-1].elastic]
    assert identification_json(poor)["models"] is None
    assert identification_json(replace(poor, consistency=None, local_change=None))["consistency"] is None


def test_the_linear_model_and_the_fit_of_each_level(separated, rich) -> None:
    document = identification_json(separated)
    model = {entry["name"]: entry for entry in document["linear"]["values"]}
    assert document["linear"]["by_run"] is True
    assert document["linear"]["compliances"] == [name for name in separated if name.startswith("C_")]
    assert model["CF1_XXX"]["value"] == separated.variable.solution.estimate("CF1_XXX").value
    assert document["linear"]["rmse_um"] == 1000 * separated.variable.rmse
    for entry, level in zip(document["levels"], separated.levels, strict=True):
        assert entry["linear"] == {"rmse_um": 1000 * level.variable.rmse, "fitness_percent": level.variable.fitness}
        assert entry["local"]["rmse_um"] == 1000 * level.local.rmse
    without = replace(separated, variable=replace(separated.variable, by_run=False))
    assert {entry["standard_uncertainty"] for entry in identification_json(without)["linear"]["values"]} == {None}
    assert identification_json(rich)["linear"] is None
    assert identification_json(rich)["levels"][0]["linear"] is None


def test_the_truth_of_simulated_readings(separated, poor) -> None:
    truth = {entry["name"]: entry["truth"] for entry in identification_json(separated)["parameters"]}
    assert truth["C_XXX"] == 6.19e-5
    assert truth["E_YX2"] == 0.0
    assert {entry["truth"] for entry in identification_json(poor)["parameters"]} == {None}


def test_what_is_not_separated_says_so(mixed) -> None:
    document = identification_json(mixed)
    apart = {entry["name"]: entry["separated"] for entry in document["parameters"]}
    assert apart["C_XXX"] is False
    assert apart["E_Xt0"] is True
    assert document["levels"][0]["elastic_um"] is None
    assert [check["name"] for check in document["verdict"] if check["decisive"] and not check["passed"]] == [
        "forces distinct",
        "separated",
    ]


def test_diagnosis(separated, mixed) -> None:
    diagnosis = diagnose(separated)
    document = diagnosis_json(diagnosis)
    strict(document)
    assert document["schema"] == "elastogeo.diagnosis/1"
    assert document["joints"] == identification_json(separated)
    first = document["faults"][0]
    assert first["distortion_um"] == 1000 * diagnosis.faults[0].distortion
    assert set(first) >= {
        "names",
        "meaning",
        "axis",
        "value",
        "unit",
        "standard_uncertainty",
        "share",
        "significant",
        "also",
    }
    pair = next(fault for fault in document["faults"] if len(fault["names"]) == 2)
    assert sorted(pair["names"]) == ["P_XXc1", "P_XXs1"]
    low, high = first["distortion_interval95_um"]
    assert low < first["distortion_um"] < high
    assert [entry["force_N"] for entry in document["circularity"]] == [level.force for level in separated.levels]
    assert document["circularity"][0]["g_ccw_um"] == 1000 * diagnosis.circularity[36.0].g_ccw
    assert document["circularity"][0]["g_cw_um"] is None
    assert document["circularity"][0]["not_determined"]
    untold = diagnosis_json(diagnose(mixed))["faults"]
    together = next(fault for fault in untold if "C_XXX" in fault["names"])
    assert together["names"] == ["C_XXX", "E_XX1"]
    assert together["separated"] is False
    assert together["axis"] is None
    assert "not distinguished" in together["meaning"]


def test_comparison(separated) -> None:
    compared = compare(separated, separated)
    document = comparison_json(compared)
    strict(document)
    assert document["schema"] == "elastogeo.comparison/1"
    assert document["before"] == document["after"] == identification_json(separated)["test"]
    assert {entry["change"] for entry in document["differences"]} == {0.0}
    assert document["joint"]["significant"] is False
    assert document["verdict"][0]["passed"] is True


def test_what_if(separated) -> None:
    told = what_if(separated, ["C_XXX", "E_XX1"])
    document = what_if_json(told)
    strict(document)
    assert document["schema"] == "elastogeo.what-if/1"
    assert [entry["name"] for entry in document["corrected"]] == ["C_XXX", "E_XX1"]
    assert len(document["traces"]) == len(separated.traces)
    assert document["traces"][0]["peak_to_peak_before_um"] == 1000 * told.peak_to_peak[separated.traces[0].run][0]
    assert document["after"][-1]["g_ccw_um"] == 1000 * told.after[742.0 if 742.0 in told.after else max(told.after)].g_ccw
    assert document["verdict"] == identification_json(separated)["verdict"]


def test_two_results_are_not_one_document(rich, poor) -> None:
    assert identification_json(rich)["parameters"] != identification_json(poor)["parameters"]
