"""The test maker of the studies is right, and independent: its chain against the closed forms and against elastogeo's."""

from __future__ import annotations

import ast
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.sources import exact_response, select_sources
from studies import ball_bar, chain, noise, truth
from studies.bar_tests import LAYOUTS, machine_test, make_test
from studies.chain import Chain
from studies.noise import NOISES, Noise
from studies.truth import BALL_BAR, FOUR_LOBE, TABLE_5_5, Truth

QUIET = Noise(white=0.0)
OFFSETS = (("X", (30.0, -200.0, 400.0)), ("Y", (-100.0, 50.0, 20.0)), ("Z", (0.0, -120.0, -300.0)))


@pytest.mark.parametrize("module", [chain, truth, noise, ball_bar])
def test_the_physics_imports_nothing_of_elastogeo(module: object) -> None:
    tree = ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8"))  # type: ignore[attr-defined]
    imported = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    imported += [name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names]
    assert not [name for name in imported if name.startswith("elastogeo")]


def test_one_compliance_stretches_the_bar_by_its_projection() -> None:
    """C_XXX under a force along the bar: F C cos^2 (Eq. 4.22)."""
    circles = LAYOUTS["two runs"].circles(Chain("wFYXt"))
    found = circles.true_readings(Truth((("C_XXX", 1e-6),)))
    assert_allclose(found, np.outer(circles.forces, np.ones(72)) * 1e-6 * np.cos(circles.angle) ** 2, rtol=1e-5)


@pytest.mark.parametrize(("topology", "axes"), [("wFYXt", "XY"), ("wXYFt", "XY"), ("wYFXt", "XY")])
def test_backlash_falls_short_on_either_branch(topology: str, axes: str) -> None:
    """X that falls short by 8 um when it reverses: the tool trails by 4 um, behind its motion, wherever X is."""
    circles = LAYOUTS["three pairs"].circles(Chain(topology))
    assert sorted(circles.linear) == sorted(axes)
    found = circles.true_readings(Truth((("B_XX", 0.008),)))
    sense = np.array(circles.senses)[:, np.newaxis]
    expected = 0.004 * np.sign(np.sin(circles.angle)) * sense * np.cos(circles.angle)
    assert_allclose(found, expected, atol=1e-7)


@pytest.mark.parametrize("topology", ["wFYXt", "wXYFZt", "wCAFYXZSt", "wCAYFXZt"])
def test_it_agrees_with_the_exact_transforms_of_elastogeo(topology: str) -> None:
    """Two programs, written apart, on machines with offsets and a tool: every compliance and error motion of X and Y."""
    offsets = tuple((axis, shift) for axis, shift in OFFSETS if axis in topology)
    circles = replace(
        LAYOUTS["two runs"].circles(Chain(topology, offsets, (10.0, -20.0, -150.0)), readings=16),
        held=(("X", 40.0), ("Y", -25.0)),
    )
    random = np.random.default_rng(4)
    test = machine_test(circles, Truth(()), QUIET, 0)
    names = ["C_??[XY]", "E_?[XY][12]", "E_?(0*)[XY]", "E_?t0", "E_?w0", "E_R0"]
    sources = select_sources(test.machine, names)
    sizes = {"mm/N": 1e-5, "rad/N": 1e-8, "mm/(N mm)": 1e-8, "rad/(N mm)": 1e-10, "mm": 1e-2, "rad": 1e-5}
    sizes |= {"mm/mm": 1e-5, "rad/mm": 1e-7, "mm/mm^2": 1e-7, "rad/mm^2": 1e-9}
    values = {source: sizes[source.unit] * random.standard_normal() for source in sources}
    true = circles.true_readings(Truth(tuple((source.name, value) for source, value in values.items())))
    for seen, observations in zip(true, test.observations(), strict=True):
        assert_allclose(seen, exact_response(values, test.machine, observations), atol=1e-10)
    assert np.ptp(true) > 0.02


def test_faults_have_the_stated_sizes() -> None:
    circles = LAYOUTS["7 runs"].circles(Chain("wFYXt"))
    plain = (("C_XXX", 6e-5),)
    sound = circles.true_readings(Truth(plain))
    softened = circles.true_readings(Truth(plain, softening=-0.2))
    assert np.ptp(softened[-1]) == pytest.approx(0.8 * np.ptp(sound[-1]), rel=1e-3)
    contact = circles.true_readings(Truth(plain, contact=0.3))
    assert np.ptp(contact[-1]) == pytest.approx(np.ptp(sound[-1]), rel=1e-3)
    share = 36 / 742
    assert np.ptp(contact[0]) == pytest.approx(np.ptp(sound[0]) * (0.7 + 0.3 * share ** (-1 / 3)), rel=5e-3)
    lobed = circles.true_readings(Truth(plain, four_lobe=FOUR_LOBE)) - sound
    assert_allclose(lobed, -13.5e-3 * np.sin(2 * circles.angle) ** 2 / 4, atol=1e-12)
    bent = circles.true_readings(Truth(plain, force_bend=0.1))
    assert np.ptp(bent[0]) == pytest.approx(np.ptp(sound[0]) * (1 + 0.1 * (1 - share)), rel=1e-3)
    off = circles.true_readings(Truth(plain, off_level=((490.0, 3e-3, 2),))) - sound
    at = np.array(circles.forces)[:, np.newaxis] == 490
    assert_allclose(off, at * 3e-3 * np.cos(2 * circles.angle), atol=1e-12)
    yielding = circles.true_readings(Truth(plain, setup_compliance=1e-6)) - sound
    assert_allclose(yielding, 1e-6 * np.outer(circles.forces, np.ones(72)), atol=1e-9)


def test_noises_have_the_stated_sizes() -> None:
    """Standard deviation of a reading over many runs; 4 standard errors of it."""
    angle = LAYOUTS["one run"].circles(Chain("wFYXt")).angle.repeat(4000, axis=0)
    half = np.sqrt(0.5)
    variances = {
        "white": 1e-8,
        "autocorrelated": 1e-8 + 9e-8,
        "of the run": 1e-8 + 25e-8 * 3,
        "harmonic": 1e-8 + 25e-8 * 5 * half**2,
        "eccentricity": 1e-8 + 1e-6,
    }
    random = np.random.default_rng(7)
    for name, variance in variances.items():
        seen = NOISES[name].on(np.zeros(angle.shape), angle, random)[:, 5]
        assert seen.std() == pytest.approx(np.sqrt(variance), rel=4 * 1.2 / np.sqrt(2 * 4000)), name
    traces = noise.autocorrelated(random, 4000, 30, 0.9)
    assert np.mean(traces[:, 7] * traces[:, 8]) == pytest.approx(0.9, abs=4 * 1.4 / np.sqrt(4000))
    stepped = NOISES["quantised"].on(np.zeros(angle.shape), angle, random) / 5e-4
    assert_allclose(stepped, np.round(stepped), atol=1e-9)


def test_a_seed_repeats_and_layouts_are_as_named() -> None:
    one, same, other = (make_test("15 runs", noise="of the run", seed=s) for s in (3, 3, 4))
    assert all(np.array_equal(a.columns["radial"], b.columns["radial"]) for a, b in zip(one.runs, same.runs, strict=True))
    assert not np.array_equal(one.runs[0].columns["radial"], other.runs[0].columns["radial"])
    assert [run.force for run in one.runs].count(364.0) == 5
    pairs = make_test("three pairs")
    assert [run.sense for run in pairs.runs] == [1, -1] * 3
    assert np.all(np.diff(pairs.runs[1].columns["angle"]) < 0)
    assert dict(BALL_BAR).keys() - dict(TABLE_5_5).keys() == {"B_XX", "B_YY"}


def test_an_unknown_parameter_is_refused() -> None:
    with pytest.raises(ValueError, match="knows no parameter 'C_XX'"):
        make_test("one run", Truth((("C_XX", 1e-6),)))
