"""The terms of the torque balance, each against its law, and a new one by the recipe."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from elastogeo.drive import TorqueModel
from elastogeo.drive.terms import Motion, Term, term_named, terms
from elastogeo.errors import InputError

VELOCITY = np.array([-40.0, -1.0, 0.0, 1.0, 40.0])
MOTION = Motion(VELOCITY, np.array([1.0, 2.0, 3.0, 4.0, 5.0]), stribeck_speed=2.0)


def columns(name: str, motion: Motion = MOTION) -> np.ndarray:
    return term_named(name).columns(motion)


def test_each_term_is_its_law() -> None:
    assert_allclose(columns("inertia")[:, 0], [1, 2, 3, 4, 5])
    assert_allclose(columns("viscous")[:, 0], VELOCITY)
    assert_allclose(columns("coulomb")[:, 0], [-1, -1, 0, 1, 1])
    assert_allclose(columns("constant")[:, 0], 1.0)
    assert_allclose(columns("stribeck")[:, 0], [0, -np.exp(-0.25), 0, np.exp(-0.25), 0], atol=1e-12)


def test_asymmetric_terms_add_up_to_the_symmetric_ones() -> None:
    for symmetric in ("coulomb", "viscous"):
        assert_allclose(columns(f"{symmetric} asymmetric").sum(axis=1), columns(symmetric)[:, 0])


def test_the_smooth_law_is_the_sign_far_from_standstill_and_a_line_near_it() -> None:
    smooth = Motion(VELOCITY, VELOCITY, smooth_speed=0.5)
    assert_allclose(columns("coulomb", smooth)[[0, 4], 0], [-1, 1], atol=1e-15)
    near = Motion(np.array([1e-4]), np.array([0.0]), smooth_speed=0.5)
    assert columns("coulomb", near)[0, 0] == pytest.approx(1e-4 / 0.5, rel=1e-6)


@pytest.mark.parametrize("name", sorted(terms()))
def test_every_term_gives_a_column_for_each_of_its_units(name: str) -> None:
    found: Term = terms()[name]
    assert columns(name).shape == (5, len(found.units))
    assert found.meaning
    assert all("{effort}" in unit for unit in found.units.values())
    reversed_ = Motion(-MOTION.velocity, -MOTION.acceleration, stribeck_speed=2.0)
    if found.signed and len(found.units) == 1:
        assert_allclose(columns(name, reversed_), -columns(name))


def test_models_that_are_none_are_refused() -> None:
    with pytest.raises(InputError, match=r"no term 'friction'; there are inertia, viscous, coulomb, constant"):
        TorqueModel(("inertia", "friction"))
    with pytest.raises(InputError, match="name one or more, each once"):
        TorqueModel(("inertia", "inertia"))
    with pytest.raises(InputError, match="name one or more, each once"):
        TorqueModel(())
    with pytest.raises(InputError, match="least_speed is -1"):
        TorqueModel(least_speed=-1.0)
    with pytest.raises(InputError, match="smooth_speed is 0; write a positive speed"):
        TorqueModel(smooth_speed=0.0)
    with pytest.raises(InputError, match="stribeck and a stribeck_speed belong together"):
        TorqueModel(("coulomb", "stribeck"))
    with pytest.raises(InputError, match="the delay of the effort is nan s"):
        TorqueModel(delay=float("nan"))
    with pytest.raises(InputError, match=r"the share of the neighbours is 0.6"):
        TorqueModel(neighbours=0.6)
    with pytest.raises(InputError, match="the term stribeck needs a stribeck_speed"):
        columns("stribeck", Motion(VELOCITY, VELOCITY))
