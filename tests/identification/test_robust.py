"""Options of a question: robust weights, a choice of levels, symmetric joints, random draws beside the first order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from statsmodels.api import RLM
from statsmodels.robust.norms import HuberT

from elastogeo.errors import InputError, UnsupportedError
from elastogeo.estimate import HUBER, huber_weights
from elastogeo.identification import identify, systems_of, what_reciprocity_buys, with_question
from elastogeo.observe import Imperfection, KnownInfluence, MachineTest
from elastogeo.report import sentence_of
from elastogeo.report.identification.reciprocity import reciprocity_words
from elastogeo.sources import simulate
from studies.bar_tests import make_test as study_test

MakeTest = Callable[..., MachineTest]
TRUTH = {"C_XXX": 6e-5, "C_YYY": 5e-5, "E_XX1": -1e-4, "E_Xt0": 0.004}


def noisy(make_test: MakeTest, *, repeats: int = 2, seed: int = 1) -> MachineTest:
    test = make_test("wFYXt", [36.0, 364.0, 742.0], repeats=repeats, parameters=list(TRUTH))
    return simulate(test, TRUTH, Imperfection(noise=1e-4), seed=seed, exact=False)


def with_outliers(test: MachineTest) -> MachineTest:
    """Every twelfth reading of the first run of each level is off by 20 um."""
    runs = []
    for run in test.runs:
        radial = run.columns["radial"].copy()
        if run.repeat == 1:
            radial[::12] += 0.02
        runs.append(replace(run, columns={**run.columns, "radial": radial}))
    return replace(test, runs=tuple(runs))


def test_huber_weights_are_those_of_their_definition() -> None:
    residual = np.array([0.0, 1.0, -1.0, 2.0, -8.0])
    limit = HUBER * 1.0 / 0.6744897501960817
    assert_allclose(huber_weights(residual), [1, 1, 1, limit / 2, limit / 8])
    assert_allclose(huber_weights(np.zeros(3)), 1)


def test_the_robust_estimate_is_that_of_statsmodels(make_test: MakeTest) -> None:
    test = with_outliers(noisy(make_test))
    result = identify(with_question(test, robust=True))
    systems = systems_of(test)
    rows = np.concatenate([run.rows for run in systems.runs])
    norms = np.linalg.norm(rows[:, :-1], axis=0)
    fit = RLM(rows[:, -1], rows[:, :-1] / norms, M=HuberT(HUBER)).fit(maxiter=500, tol=1e-12)
    order = [systems.runs[0].factor.labels.index(label) for label in result.solution.labels]
    assert_allclose(result.solution.values, (fit.params / norms)[order], rtol=1e-5)


def test_outliers_move_the_robust_estimate_less_and_the_verdict_counts_them(make_test: MakeTest) -> None:
    test = with_outliers(noisy(make_test))
    truth = np.array([TRUTH[name] for name in identify(test).solution.labels])
    plain, robust = identify(test), identify(with_question(test, robust=True))
    assert (np.abs(robust.solution.values / truth - 1) < 0.2 * np.abs(plain.solution.values / truth - 1).max()).all()
    check = next(check for check in robust.verdict if check.name == "free of outliers")
    sentence = sentence_of(check)
    assert check.passed is False
    assert "readings count less than one" in sentence
    assert "2.6 %" in sentence


def test_a_robust_estimate_with_a_reference_is_refused(make_test: MakeTest) -> None:
    with pytest.raises(UnsupportedError, match="robust estimate needs the model without a reference"):
        identify(with_question(noisy(make_test), ["C_XXX", "C_YYY"], reference=36.0, robust=True))


def test_levels_are_chosen_and_left_out(make_test: MakeTest) -> None:
    test = noisy(make_test)
    forces = [level.force for level in identify(with_question(test, levels=[36.0, 742.0])).levels]
    assert forces == [36.0, 742.0]
    assert [level.force for level in identify(with_question(test, without_levels=[364.0])).levels] == forces
    with pytest.raises(InputError, match=r"no run has the force 500 N; there are 36, 364, 742 N"):
        identify(with_question(test, levels=[500.0]))


def test_symmetric_joints_merge_columns_and_change_no_prediction(make_test: MakeTest) -> None:
    test = simulate(make_test("wFYXt", [36.0, 742.0], repeats=3, reference=36.0), {"C_XYX": 1e-6}, exact=True)
    free, symmetric = identify(test), identify(with_question(test, reciprocal=True))
    assert len(symmetric.confounding.labels) < len(free.confounding.labels) == 18
    assert symmetric.confounding.rank == free.confounding.rank
    for one, other in zip(free.traces, symmetric.traces, strict=True):
        assert_allclose(other.predicted, one.predicted, atol=1e-12)
    assert "merges 6 pairs, 18 parameters into 12. The rank is 6" in reciprocity_words(what_reciprocity_buys(test))


def test_random_draws_stand_beside_the_first_order(make_test: MakeTest) -> None:
    known = (
        KnownInfluence("force-scale", "gauge", relative=0.01),
        KnownInfluence("bar-length", "bar", length=0.001),
    )
    result = identify(replace(noisy(make_test, repeats=4), influences=known))
    assert result.agreement is not None
    check = next(check for check in result.verdict if check.name == "first order enough")
    assert check.passed
    assert "The intervals leave 2.5% of" in sentence_of(check)
    k = result.solution.labels.index("C_XXX")
    drawn = result.agreement.draws
    assert_allclose(drawn.standard_uncertainty[k], result.budget.standard_uncertainty[k], rtol=0.1)
    assert identify(noisy(make_test)).agreement is None


def test_few_degrees_of_freedom_are_no_fault_of_first_order() -> None:
    """The audit's nine of nine: seven runs and a force scale, all normal. A rectangular bar length that rules is one."""
    scale = KnownInfluence("force-scale", "gauge", relative=0.01)
    bar = KnownInfluence("bar-length", "bar", length=0.01, distribution="rectangular")
    test = study_test("7 runs", noise="of the run", question=("C_XXX", "C_YYY", "E_XX1", "E_YY1", "E_Xt0", "E_Yt0"))
    (calm,) = [c for c in identify(replace(test, influences=(scale,))).verdict if c.name == "first order enough"]
    assert calm.passed
    result = identify(replace(test, influences=(scale, bar)))
    (alarm,) = [c for c in result.verdict if c.name == "first order enough"]
    assert set(alarm.facts["apart"]) == {"E_XX1", "E_YY1"}
    assert alarm.facts["apart"]["E_XX1"]["above"] < 0.01
    assert result.agreement is not None
    low, high = result.agreement.draws.interval[result.solution.labels.index("E_XX1")]
    assert f"E_XX1 {1e6 * low:.4g} to {1e6 * high:.4g} µm/m" in sentence_of(alarm)
