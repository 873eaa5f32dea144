"""The columns of the sliders: from them alone a page finds what a what-if says."""

from __future__ import annotations

import json

import numpy as np
import pytest

from elastogeo.formats import read_test
from elastogeo.identification import cause_parts, diagnose, identify, thinned_parts, what_if
from elastogeo.observe import Imperfection
from elastogeo.report.faults.columns import PLACES, columns_document, for_a_page
from elastogeo.sources import simulate
from tests.history.analyses.kept import EXAMPLES
from tests.report.faults.slider_arithmetic import circular_deviation, corrected, radial_deviation


@pytest.mark.parametrize(("places", "within"), [(None, 1e-6), (PLACES, 2e-3)])
def test_a_page_finds_what_a_what_if_says(separated, places: int | None, within: float) -> None:
    parts = cause_parts(separated)
    document = columns_document(parts, places=places)
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    levels = {run["force_N"] for run in document["runs"].values()}
    assert levels == {level.force for level in separated.levels}
    for count in (0, 1, 3):
        names = [name for cause in parts.causes[:count] for name in cause.names]
        found = what_if(separated, names) if names else None
        after = found.after if found else diagnose(separated).circularity
        factors = [0.0 if k < count else 1.0 for k in range(len(parts.causes))]
        for run in document["runs"].values():
            radial = corrected(run, factors)
            wanted = after[run["force_N"]]
            way = run["direction"]
            g, lowest, highest = (getattr(wanted, f"{name}_{way}") for name in ("g", "f_min", "f_max"))
            assert circular_deviation(run, radial, document["radius_mm"]) == pytest.approx(1000 * g, abs=within)
            assert radial_deviation(run, radial, document["radius_mm"]) == pytest.approx(
                (1000 * lowest, 1000 * highest), abs=within
            )


def test_the_set_up_is_no_cause_and_a_cyclic_error_is_one(separated) -> None:
    document = columns_document(cause_parts(separated))
    names = [name for cause in document["causes"] for name in cause]
    assert ["P_XXc1", "P_XXs1"] in [sorted(cause) for cause in document["causes"]]
    assert {p.name for p in separated.parameters if p.axis} == set(names)
    for run in document["runs"].values():
        assert {len(column) for column in run["columns"]} == {len(run["deg"])} == {len(run["measured"])}
        assert len(run["columns"]) == len(document["causes"])


def test_without_every_cause_the_set_up_and_the_residual_are_left(separated) -> None:
    for run in cause_parts(separated).runs:
        left = run.predicted - run.parts.sum(axis=0)
        first = np.column_stack([np.ones_like(run.angle), np.cos(run.angle), np.sin(run.angle)])
        explained = first @ np.linalg.lstsq(first, left, rcond=None)[0]
        assert np.abs(left - explained).max() < 1e-6 * np.abs(run.predicted).max()


def test_very_many_readings_are_thinned_and_the_deviations_stay(make_test) -> None:
    test = make_test("wFYXt", (100.0, 400.0), readings=2400)
    made = simulate(test, {"C_XXX": 6.19e-5, "C_YYY": 4.61e-5}, Imperfection(noise=7e-5), seed=9)
    parts = cause_parts(identify(made))
    radius = parts.radius
    whole = columns_document(parts, places=None)
    thin = columns_document(for_a_page(parts), places=None)
    for name, run in thin["runs"].items():
        assert len(run["deg"]) < 0.6 * len(whole["runs"][name]["deg"])
        for factors in ([1.0, *[1.0] * (len(parts.causes) - 1)], [0.0, *[1.0] * (len(parts.causes) - 1)]):
            found = [
                circular_deviation(one["runs"][name], corrected(one["runs"][name], factors), radius) for one in (whole, thin)
            ]
            assert found[1] == pytest.approx(found[0], abs=0.03)
    assert thinned_parts(parts, 2400, 1e-6).runs == parts.runs


def test_what_is_no_circle_has_no_runs() -> None:
    parts = cause_parts(identify(read_test(EXAMPLES / "static-probes")))
    assert parts.causes
    assert (parts.radius, parts.runs, columns_document(parts)["runs"]) == (None, (), {})


def test_a_sum_that_cannot_be_split_moves_as_one(mixed) -> None:
    parts = cause_parts(mixed)
    together = [cause for cause in parts.causes if cause.also]
    assert together
    run, at = parts.runs[0], parts.causes.index(together[0])
    part = what_if(mixed, together[0].names)
    left = next(trace for trace in part.traces if trace.run == run.run)
    assert np.allclose(run.measured - run.parts[at], left.measured, rtol=0.0, atol=1e-12)
