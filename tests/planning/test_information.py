"""What a planned test tells, against generalised least squares written out; and that it comes true."""

from dataclasses import replace

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import InputError
from elastogeo.machine import loop_frames
from elastogeo.observe import Circle, Imperfection, LoadedBallBar, MachineTest, Run
from elastogeo.planning import Means, ReadingNoise, candidates, unknowns, whitened
from elastogeo.planning.made import at_planned_poses
from elastogeo.planning.workspaces import workspace
from elastogeo.prediction import knowledge_of
from elastogeo.sources import simulate
from studies.plans import three_axes

NOISE = ReadingNoise()


def circle(forces: tuple[float, ...] = (100.0, 700.0), readings: int = 12) -> MachineTest:
    angle = np.linspace(0.0, 2 * np.pi, readings, endpoint=False)
    setup = LoadedBallBar(Circle(150.0, "YZ", {"X": 40.0, "Y": -60.0}), 2000 / 60)
    runs = tuple(Run(f"{force:g} N", {"angle": angle, "radial": 0 * angle}, force=force) for force in forces)
    return MachineTest("circle", three_axes(), setup, runs)


def by_hand(test: MachineTest) -> np.ndarray:  # type: ignore[type-arg]
    """Information on the scaled compliances, from (J^T b) (J^T w) by hand and explicit nuisance columns."""
    machine, asked = test.machine, unknowns(test.machine)
    angle, forces = test.runs[0].columns["angle"], [run.force or 0.0 for run in test.runs]
    bar = np.column_stack([0 * angle, np.cos(angle), np.sin(angle)])
    commands = np.zeros((len(angle), 3))
    commands[:, machine.index("X")] = 40.0
    commands[:, machine.index("Y")] = -60.0 + 150.0 * bar[:, 1]
    commands[:, machine.index("Z")] = 150.0 * bar[:, 2]
    frames = loop_frames(machine, commands)
    unit = np.zeros((len(angle), len(asked.names)))
    for k, source in enumerate(asked.sources):
        joint = frames.joints[source.site[1]]
        lever = frames.point - joint.motion.origin
        carried = joint.side * np.hstack([bar, np.cross(lever, bar)])
        unit[:, k] = carried[:, source.component] * carried[:, source.load or 0] * asked.scales[k]
    rows = np.vstack([force * unit for force in forces])
    m, runs = len(angle), len(forces)
    pose = np.tile(np.eye(m), (runs, 1))
    wander = []
    for r, force in enumerate(forces):
        columns = np.column_stack([bar * NOISE.set_up, np.full(m, NOISE.set_up), NOISE.force * force * unit @ asked.nominal])
        whole = np.zeros((m * runs, columns.shape[1]))
        whole[r * m : (r + 1) * m] = columns
        wander.append(whole)
    drift = np.hstack(wander)
    # least squares with the nuisance as columns: free at each pose, with a prior of one standard deviation where it wanders
    A = np.vstack(
        [np.hstack([rows, pose, drift]) / NOISE.reading, np.eye(rows.shape[1] + m + drift.shape[1])[-drift.shape[1] :]]
    )
    p = rows.shape[1]
    nuisance, _ = np.linalg.qr(A[:, p:])
    left = A[:, :p] - nuisance @ (nuisance.T @ A[:, :p])
    return np.asarray(left.T @ left)


def test_rows_are_what_generalised_least_squares_leaves_of_a_test() -> None:
    """Schur complement: nuisance columns first, what they leave is the information; the same by a covariance."""
    test = circle()
    rows = whitened([test], unknowns(test.machine), NOISE)[0]
    exact = by_hand(test)
    assert np.abs(rows.T @ rows - exact).max() < 1e-6 * np.abs(exact).max()
    assert len(rows) == np.linalg.matrix_rank(exact, tol=1e-12 * np.abs(exact).max())


def test_three_levels_are_told_from_their_pose_too() -> None:
    test = circle((50.0, 300.0, 700.0))
    rows = whitened([test], unknowns(test.machine), NOISE)[0]
    exact = by_hand(test)
    assert np.abs(rows.T @ rows - exact).max() < 1e-6 * np.abs(exact).max()


def test_the_order_of_runs_and_readings_does_not_matter() -> None:
    test, asked = circle(), unknowns(three_axes())
    turned = replace(
        test, runs=tuple(replace(run, columns={k: v[::-1] for k, v in run.columns.items()}) for run in test.runs[::-1])
    )
    one, other = (whitened([each], asked, NOISE)[0] for each in (test, turned))
    assert np.allclose(one.T @ one, other.T @ other, rtol=1e-8, atol=1e-8 * np.abs(one.T @ one).max())


def test_angles_that_differ_by_chance_are_the_same_poses() -> None:
    """A test that was made: 400 readings a run at angles of its own, one run from end to begin."""
    random, planned = np.random.default_rng(4), circle(readings=36)
    angles = [np.sort(random.uniform(0, 2 * np.pi, 400)), np.sort(random.uniform(0, 2 * np.pi, 400))[::-1]]
    runs = tuple(
        replace(run, columns={"angle": angle, "radial": 0 * angle}) for run, angle in zip(planned.runs, angles, strict=True)
    )
    seen = at_planned_poses(replace(planned, runs=runs), 36)
    assert [len(run) for run in seen] == [36, 36]
    assert np.array_equal(seen[0].commands, seen[1].commands)
    assert np.linalg.norm(seen[1].wrench[:, :3], axis=1) == pytest.approx(700.0)
    assert np.abs(np.linalg.norm(seen[0].direction[:, :3], axis=1) - 1).max() < 1e-12


def test_noise_and_means_refuse_wrong_units() -> None:
    with pytest.raises(InputError, match=r"the force's is a share below 1: 0\.01 is 1 %"):
        ReadingNoise(force=1.0)
    with pytest.raises(InputError, match="the noise of a reading is 0 mm"):
        ReadingNoise(reading=0.0)
    with pytest.raises(InputError, match="the lengths of the bars"):
        Means(three_axes(), radii=(float("nan"),))
    with pytest.raises(InputError, match="4 readings of a turn are too few"):
        Means(three_axes(), readings=4)


def test_what_a_plan_expects_comes_true() -> None:
    """Readings with the noise of the plan, identified, asked for the compliance at the tool: errors are as expected."""
    means = Means(three_axes(), readings=36)
    plan = eg.plan(means, tests=8, count=60)
    asked, random = unknowns(means.machine), np.random.default_rng(8)
    truth = (asked.nominal + 0.2 * random.standard_normal(len(asked.names))) * asked.scales
    wander = Imperfection(noise=1e-4, eccentricity=2e-4, force_scatter=0.01)
    values = dict(zip(asked.names, map(float, truth), strict=True))
    tests = {name: simulate(test, values, wander, seed=k) for k, (name, test) in enumerate(plan.campaign.tests.items())}
    found = knowledge_of(eg.identify(tests, parameters="compliance"))
    over = workspace(means, asked, 40, seed=99)
    names = [source.name for source in found.sources]
    functional = (over.functionals / asked.scales)[:, [asked.names.index(name) for name in names]]
    predicted = found.predict(functional)
    assert predicted.supported.all()
    rows = np.vstack(whitened([test.candidate.test for test in plan.tests], asked, NOISE))
    expected = np.linalg.norm(over.functionals @ np.linalg.pinv(rows, rcond=1e-9), axis=1)
    error = predicted.value - functional @ [values[name] for name in names]
    assert 0.4 < np.sqrt(np.mean((error / expected) ** 2)) < 2.0  # some thirty combinations, errors shared by all poses


def test_ball_roller_tests_are_planned_with_the_drives_of_one_that_is_there() -> None:
    test = eg.read_test("examples/ball-roller")
    with pytest.raises(InputError, match="planned with the drives of one that is there; name its folder"):
        candidates(Means(test.machine), ["ball-roller"], 2)
    means = Means(test.machine, devices={"ball-roller": test.setup})
    drawn = candidates(means, ["ball-roller"], 1)
    rows = whitened([one.test for one in drawn], unknowns(test.machine), NOISE)
    assert [len(own) for own in rows] == [3]  # force and reading along one line, lever along it: b^T C b of a plane
    forces = [run.force for run in drawn[0].test.observations()]
    assert forces[1] > 2 * forces[0] > 0
