"""The Cartesian compliance: exact without noise, covered by its intervals with noise, honest where it cannot tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import stats

from elastogeo.errors import DegreesOfFreedomError, InputError, RankError, UnsupportedError
from elastogeo.identification.static_tests.by_run import Counted
from elastogeo.identification.static_tests.cartesian import (
    CartesianCompliance,
    cartesian_compliance,
    cartesian_from_vectors,
    cartesian_of,
    with_influences,
)
from elastogeo.machine import Array, Machine, parse_topology
from elastogeo.observe import Circle, LoadedBallBar, Run
from elastogeo.report import sentence_of

TURN = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))[0]
PRINCIPAL = np.array([9e-5, 5e-5, 2e-5])
TRUE = TURN @ np.diag(PRINCIPAL) @ TURN.T
NOISE = 2e-4
FORCES = 400 * np.random.default_rng(4).standard_normal((30, 3))


ANEW = np.arange(len(FORCES))
"""Each force is put on anew: a run of its own."""


def noisy(seed: int, truth: Array = TRUE, noise: float = NOISE) -> CartesianCompliance:
    random = np.random.default_rng(seed)
    return cartesian_from_vectors(FORCES, FORCES @ truth.T + noise * random.standard_normal(FORCES.shape), ANEW)


def test_vectors_without_noise_give_the_matrix_whether_symmetric_or_not() -> None:
    truth = np.random.default_rng(1).standard_normal((3, 3)) * 1e-5
    assert_allclose(cartesian_from_vectors(FORCES, FORCES @ truth.T).compliance, truth, rtol=1e-9)


def test_skew_probes_give_what_their_vectors_would() -> None:
    probes = np.array([[1, 0.3, 0], [0, 1, 0.4], [0.5, 0, 1]])
    probes /= np.linalg.norm(probes, axis=1, keepdims=True)
    k = np.arange(90) % 3
    force, direction = np.repeat(FORCES, 3, axis=0), probes[k]
    zeros = np.array([0.01, -0.02, 0.005])
    reading = np.einsum("mi,ij,mj->m", direction, TRUE, force) + zeros[k]
    found = cartesian_compliance(force, direction, reading, sensor=k)
    assert_allclose(found.compliance, TRUE, rtol=0, atol=1e-9 * TRUE.max())
    assert_allclose([zero.value for zero in found.zeros], zeros, rtol=1e-9)
    by_vectors = cartesian_from_vectors(FORCES, np.linalg.solve(probes, (reading - zeros[k]).reshape(-1, 3).T).T)
    assert_allclose(by_vectors.compliance, found.compliance, atol=1e-9 * TRUE.max())


def test_intervals_cover_at_their_rate() -> None:
    """Elements, stiffness, principal compliance (to first order), and the symmetry's false alarms."""
    draws = 400
    elements, stiffness, principal, alarms = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3), 0
    K_true = np.linalg.inv(TRUE)
    for seed in range(draws):
        found = noisy(seed)
        low, high = np.moveaxis(found.interval(), -1, 0)
        elements += (low <= TRUE) & (high >= TRUE)
        K, covariance = found.stiffness()
        half = stats.t.ppf(0.975, found.degrees_of_freedom.min()) * np.sqrt(np.diag(covariance)).reshape(3, 3)
        stiffness += np.abs(K - K_true) <= half
        for k, one in enumerate(found.principal()):
            least, most = one.compliance.interval()
            principal[k] += least <= PRINCIPAL[k] <= most
        alarms += found.symmetry().probability < 0.05
    low, high = stats.binom.ppf([0.0005 / 21, 1 - 0.0005 / 21], draws, 0.95) / draws
    for rates in (elements / draws, stiffness / draws, principal / draws):
        assert (rates >= low).all(), rates
        assert (rates <= high).all(), rates
    assert 1 - alarms / draws >= low  # by runs of few degrees of freedom the test errs to the safe side


def test_principal_directions_turn_as_their_uncertainty_says() -> None:
    draws = 200
    found = [noisy(seed).principal() for seed in range(draws)]
    for k in range(3):
        v = TURN[:, k] * np.sign(TURN[np.argmax(np.abs(TURN[:, k])), k])
        assert abs(v @ found[0][k].direction) > 0.99
        others = [TURN[:, j] for j in range(3) if j != k]
        turned = np.max([np.std([p[k].direction @ other for p in found]) for other in others])
        assert turned == pytest.approx(np.mean([p[k].direction_uncertainty for p in found]), rel=0.15)
        assert found[0][k].stiffness().value == pytest.approx(1 / found[0][k].compliance.value)


def test_a_round_compliance_has_no_direction() -> None:
    """All directions are principal ones: what noise makes of them is uncertain by a good part of a turn."""
    found = [noisy(seed, 5e-5 * np.eye(3)).principal() for seed in range(20)]
    assert np.median([one.direction_uncertainty for each in found for one in each]) > 0.3
    assert np.median([one.direction_uncertainty for one in noisy(1).principal()]) < 0.03


def test_asymmetry_is_found_and_named() -> None:
    assert all(check.passed for check in noisy(0).checks())
    skew = TRUE + np.array([[0, 4e-6, 0], [0, 0, 0], [0, 0, 0]])
    found = noisy(0, skew)
    assert found.symmetry().probability < 1e-3
    assert found.symmetry().differences[0] == pytest.approx(4e-6, rel=0.2)
    checks = {check.name: check for check in found.checks()}
    assert not checks["reciprocity"].passed
    assert "look at the directions of the probes" in sentence_of(checks["reciprocity"])


def test_a_force_that_gains_energy_is_named() -> None:
    wrong = TURN @ np.diag([9e-5, 5e-5, -2e-5]) @ TURN.T
    checks = {check.name: check for check in noisy(0, wrong).checks()}
    assert not checks["no energy gained"].passed
    assert "a force would gain energy" in sentence_of(checks["no energy gained"])


def test_a_compliance_that_may_be_zero_has_no_stiffness() -> None:
    with pytest.raises(UnsupportedError, match="which holds zero: its inverse is unbounded"):
        noisy(0, TURN @ np.diag([9e-5, 5e-5, 1e-9]) @ TURN.T).stiffness()


@pytest.mark.parametrize(("flat", "missing"), [(2, "Z"), (0, "X")])
def test_forces_in_one_plane_leave_a_column_out(flat: int, missing: str) -> None:
    force = FORCES.copy()
    force[:, flat] = 0.0
    found = cartesian_from_vectors(force, force @ TRUE.T)
    assert found.undetermined == tuple(f"C_{i}{missing}" for i in "XYZ")
    kept = [k for k in range(3) if k != flat]
    assert_allclose(found.compliance[:, kept], TRUE[:, kept], atol=1e-9 * TRUE.max())
    assert np.isnan(found.compliance[:, flat]).all()
    for ask in (found.stiffness, found.principal, found.symmetry, lambda: found.along((1, 0, 0))):
        with pytest.raises(RankError, match=f"do not determine the columns of the forces along {missing}"):
            ask()
    (check,) = found.checks()
    assert not check.passed
    assert f"forces along {missing}" in sentence_of(check)


def test_forces_in_an_oblique_plane_give_sums_only() -> None:
    plane = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 1.0]])
    force = FORCES[:, :2] @ plane
    found = cartesian_from_vectors(force, force @ TRUE.T)
    assert found.undetermined == tuple(f"C_{i}{j}" for i in "XYZ" for j in "YZ")
    assert_allclose(found.compliance[:, 0], TRUE[:, 0], atol=1e-9 * TRUE.max())
    with pytest.raises(RankError, match="do not determine the columns of the forces along Y, Z"):
        found.stiffness()


def test_sensors_in_one_plane_leave_a_row_out() -> None:
    k = np.arange(90) % 2
    force, direction = np.repeat(FORCES, 3, axis=0), np.eye(3)[k]
    found = cartesian_compliance(force, direction, np.einsum("mi,ij,mj->m", direction, TRUE, force))
    assert found.undetermined == ("C_ZX", "C_ZY", "C_ZZ")
    with pytest.raises(RankError, match="No sensor shows the displacement along Z by itself; add one that does"):
        found.stiffness()


def test_a_force_that_never_changes_cannot_be_told_from_zeros_of_the_probes() -> None:
    k = np.arange(30) % 3
    force = np.tile([300.0, 100.0, -200.0], (30, 1))
    found = cartesian_compliance(force, np.eye(3)[k], np.zeros(30) + 0.01, sensor=k)
    assert len(found.undetermined) == 9
    assert found.zeros == ()


def test_compliance_along_a_direction() -> None:
    u = np.array([1.0, -2.0, 0.5])
    found = noisy(2)
    along = found.along(tuple(u))
    weights = np.outer(u, u).ravel() / (u @ u)
    assert along.value == pytest.approx(weights @ found.compliance.ravel())
    assert along.standard_uncertainty == pytest.approx(np.sqrt(weights @ found.covariance @ weights))
    assert abs(along.value - u @ TRUE @ u / (u @ u)) < 4 * along.standard_uncertainty
    with pytest.raises(InputError, match="it must be three finite numbers"):
        found.along((0.0, 0.0, 0.0))


def test_runs_that_differ_count_as_runs() -> None:
    """Each run has its own factor on the force: readings are many, runs are ten."""
    random = np.random.default_rng(6)
    run = np.repeat(np.arange(10), 60)
    force = 400 * random.standard_normal((600, 3))
    scale = 1 + 0.05 * random.standard_normal(10)
    displacement = scale[run, np.newaxis] * force @ TRUE.T + 1e-5 * random.standard_normal((600, 3))
    by_run, as_one = cartesian_from_vectors(force, displacement, run), cartesian_from_vectors(force, displacement)
    assert by_run.counted == Counted(10, True, None)
    assert_allclose(by_run.compliance, as_one.compliance)
    assert by_run.standard_uncertainty[0, 0] == pytest.approx(0.05 * TRUE[0, 0] / np.sqrt(10), rel=0.5)


def test_one_run_gives_values_and_no_interval() -> None:
    """Readings of one run are not independent, however many they are."""
    found = cartesian_from_vectors(FORCES, FORCES @ TRUE.T + NOISE * np.random.default_rng(5).standard_normal((30, 3)))
    assert found.counted == Counted(1, False, 3)
    assert_allclose(found.compliance, TRUE, atol=2e-6)
    assert np.isinf(found.standard_uncertainty).all()
    assert not found.along((1.0, 0.0, 0.0)).known
    assert all(not one.compliance.known and np.isinf(one.direction_uncertainty) for one in found.principal())
    K, covariance = found.stiffness()
    assert_allclose(K, np.linalg.inv(TRUE), rtol=0.1, atol=2e3)
    assert np.isinf(covariance).all()
    with pytest.raises(UnsupportedError, match="the runs are too few to tell how symmetric the compliance is"):
        found.symmetry()
    checks = {check.name: check.passed for check in found.checks()}
    assert checks == {"compliance determined": True, "reciprocity": None, "no energy gained": None}


def test_what_an_influence_moves_the_elements_by_is_in_their_uncertainty() -> None:
    """A force that is off by 1 % moves every element by 1 % of itself, and all of them together."""
    found = noisy(1, noise=1e-6)
    moved = replace(found, compliance=found.compliance / 1.01)
    wider = with_influences(found, [moved], [np.inf])
    assert_allclose(wider.standard_uncertainty, np.abs(found.compliance) * 0.01 / 1.01, rtol=0.05)
    softest = wider.principal()[0]
    assert softest.compliance.standard_uncertainty == pytest.approx(0.01 / 1.01 * softest.compliance.value, rel=0.01)
    assert softest.compliance.degrees_of_freedom > 1e3
    assert softest.direction_uncertainty == pytest.approx(found.principal()[0].direction_uncertainty, rel=1e-3)


def test_units_and_order_do_not_matter() -> None:
    found = noisy(3)
    random = np.random.default_rng(3)
    displacement = FORCES @ TRUE.T + NOISE * random.standard_normal(FORCES.shape)
    order = random.permutation(len(FORCES))
    other = cartesian_from_vectors(FORCES[order] / 1000, 1000 * displacement[order], order)
    assert_allclose(other.compliance / 1e6, found.compliance, rtol=1e-10)
    assert_allclose(other.standard_uncertainty / 1e6, found.standard_uncertainty, rtol=1e-10)
    assert other.symmetry().chi_squared == pytest.approx(found.symmetry().chi_squared, rel=1e-8)


def test_bad_input_is_refused() -> None:
    one = np.ones(4)
    forces, directions = np.ones((4, 3)), np.tile([1.0, 0, 0], (4, 1))
    with pytest.raises(InputError, match=r"must have the shape \(m, 3\), got \(30, 3\) and \(30, 2\)"):
        cartesian_from_vectors(FORCES, FORCES[:, :2])
    with pytest.raises(
        InputError, match=r"m readings need m forces and m directions of three components each: got \(4,\), \(3, 3\)"
    ):
        cartesian_compliance(np.ones((3, 3)), directions, one)
    with pytest.raises(InputError, match="the force of reading 2 is no finite number"):
        cartesian_compliance(np.where(np.arange(12).reshape(4, 3) == 4, np.inf, 1.0), directions, one)
    with pytest.raises(InputError, match="the reading of reading 4 is no finite number"):
        cartesian_compliance(forces, directions, np.array([1, 1, 1, np.nan]))
    with pytest.raises(InputError, match="the directions of the sensors must be unit vectors"):
        cartesian_compliance(forces, forces, one)
    with pytest.raises(InputError, match="4 readings need the sensor of each"):
        cartesian_compliance(forces, directions, one, sensor=np.zeros(3))
    with pytest.raises(RankError, match="the force is zero at every reading"):
        cartesian_compliance(0 * forces, directions, one)
    with pytest.raises(DegreesOfFreedomError, match="9 readings cannot give 9 parameters an uncertainty"):
        cartesian_from_vectors(FORCES[:3], FORCES[:3])
    with pytest.raises(InputError, match="there is no run"):
        cartesian_of(Machine("m", parse_topology("wFYXt")), [])


def test_a_ball_bar_reads_no_displacement_vector() -> None:
    machine = Machine("m", parse_topology("wFYXt"))
    run = Run("bar", {"angle": np.arange(4.0), "radial": np.zeros(4)}, force=100.0)
    observed = LoadedBallBar(Circle(150.0), feed=30.0).observe(machine, run)
    with pytest.raises(InputError, match="run 'bar' reads a distance or a rotation"):
        cartesian_of(machine, [observed])
