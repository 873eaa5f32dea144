"""Results to report on: one as rich as a result gets, and one as poor."""

from __future__ import annotations

from dataclasses import replace

import pytest

from elastogeo.identification import identify
from elastogeo.observe import Imperfection, KnownInfluence, Question
from elastogeo.sources import simulate

TRUTH = {"C_XXX": 6.19e-5, "C_XYX": 7.98e-7, "C_YYY": 4.61e-5, "C_CXY": -2.69e-8, "C_CYY": -1.66e-8, "C_CCY": -1.1e-9}


@pytest.fixture(scope="session")
def rich(make_test, thesis_forces):
    """Seven levels, two of them repeated three times, reference subtracted, resolution given, simulated."""
    test = make_test("wCAFYXZSt", thesis_forces, readings=180, repeats=3, reference=36.0)
    runs = tuple(run for run in test.runs if run.repeat == 1 or run.force in (364.0, 490.0))
    test = replace(test, runs=runs, resolution=0.00024, simulated="the global parameters of Table 5.5")
    return identify(simulate(test, TRUTH, Imperfection(noise=7e-5, resolution=0.00024), seed=1))


@pytest.fixture(scope="session")
def poor(make_test):
    """One level, one run, nothing repeated, no reference, no resolution, measured."""
    test = make_test("wFYXt", (100.0,), readings=36)
    return identify(replace(simulate(test, TRUTH, Imperfection(noise=7e-5), seed=2), simulated=""))


@pytest.fixture(scope="session")
def geometric(make_test, thesis_forces):
    """Compliance and geometry together: everything distinguished."""
    test = make_test("wCAFYXZSt", thesis_forces, readings=90)
    test = replace(test, question=Question(("elasto-geometric-xy",)))
    return identify(simulate(test, {**TRUTH, "E_XX1": -1.3e-4, "E_Xt0": 0.0039}, Imperfection(noise=7e-5), seed=3))


@pytest.fixture(scope="session")
def separated(make_machine, make_test, thesis_forces):
    """Compliance and geometry with repeats: uncertainty by run, systematic influences, models, all there is."""
    machine = make_machine("wCAFYXZSt")
    joints = tuple(replace(joint, pitch=20.0) if joint.name == "X" else joint for joint in machine.joints)
    test = make_test(replace(machine, joints=joints), thesis_forces[::2], readings=60, repeats=3)
    known = (
        KnownInfluence("force-scale", "gauge", relative=0.01),
        KnownInfluence("ball-form", "form of the balls", length=0.003, distribution="rectangular"),
        KnownInfluence("bar-length", "bar", length=0.0005, degrees_of_freedom=20.0),
    )
    test = replace(test, question=Question(("elasto-geometric-xy", "P_XX[cs]1")), influences=known, resolution=0.00024)
    truth = {**TRUTH, "E_XX1": -1.3e-4, "E_YY1": -1e-4, "E_Xt0": 0.0039, "P_XXc1": 0.002, "P_XXs1": 0.001}
    return identify(simulate(test, truth, Imperfection(noise=7e-5), seed=4))


@pytest.fixture(scope="session")
def mixed(make_test):
    """Compliance and geometry at one force level: not distinguished."""
    test = make_test("wCAFYXZSt", (742.0,), readings=90, repeats=3)
    test = replace(test, question=Question(("elasto-geometric-xy",)))
    truth = {**TRUTH, "E_XX1": -1.3e-4, "E_YX2": 4e-7, "E_Xt0": 0.0039}
    return identify(simulate(test, truth, Imperfection(noise=7e-5), seed=5))
