"""Why a compliance is never known alone, and that what is proposed tells it: by the rows that the instruments make."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from elastogeo.formats import read_machine
from elastogeo.machine import Array, Machine, Place, parse_topology
from elastogeo.observe import SIX, JointProbe, Run
from elastogeo.planning import Ceiling, Probe, ceiling, family_ceiling, reason_for
from elastogeo.report.ceilings import reason_words
from elastogeo.sources import design_rows


@cache
def hermle() -> Machine:
    return read_machine("hermle_c50")


@cache
def bound(reciprocal: bool = False) -> Ceiling:
    return ceiling(hermle(), reciprocal)


@cache
def seen(reciprocal: bool = False) -> Array:
    return family_ceiling(hermle(), SIX, (), reciprocal).seen


def rows_of(probes: tuple[Probe, ...], reciprocal: bool = False) -> Array:
    """What the probes read under six unit wrenches at random poses, in scaled parameters."""
    random = np.random.default_rng(5)
    rows = []
    for probe in probes:
        setup = JointProbe((probe.across,), probe.sensor, probe.point)
        columns = {f"force_{axis}": np.ones(60) for axis in "xyz"}
        places = {axis.lower(): random.uniform(-1, 1, 60) for axis in hermle().axes}
        observed = setup.observe(hermle(), Run("one", {**columns, **places, "displacement": np.zeros(60)}))
        wrenches = np.tile(np.diag([1.0, 1, 1, 200, 200, 200]), (10, 1))
        rows.append(design_rows(bound(reciprocal).sources, hermle(), replace(observed, wrench=wrenches))[:, :-1])
    return np.vstack(rows) * bound(reciprocal).scales


def basis(rows: Array) -> Array:
    _, values, Vt = np.linalg.svd(rows / np.linalg.norm(rows, axis=1, keepdims=True).clip(1e-300), full_matrices=False)
    return Vt[values > 1e-9 * values[0]].T


def left_of(name: str, space: Array, reciprocal: bool = False) -> float:
    """The part of a parameter that a space of rows does not hold."""
    unit = np.zeros(len(space))
    unit[bound(reciprocal).labels.index(name)] = 1.0
    return float(np.linalg.norm(unit - space @ (space.T @ unit)))


@pytest.mark.parametrize("reciprocal", [False, True])
def test_a_reason_is_given_exactly_for_what_six_loads_and_readings_do_not_tell(reciprocal: bool) -> None:
    found, space = bound(reciprocal), seen(reciprocal)
    told = {name for name in found.labels if left_of(name, space, reciprocal) < 1e-8}
    assert told == {name for name in found.labels if not found.unseen(name)}
    assert all(reason_for(hermle(), found, name) is None for name in told)
    assert 20 < len(told) < len(found.labels) - 20


def test_the_compliances_of_x_and_y_along_x_are_one_for_every_test_between_tool_and_workpiece() -> None:
    reason = reason_for(hermle(), bound(), "C_XXX")
    assert reason is not None
    assert reason.alike == ("C_XXX", "C_XXY", "C_XXZ", "C_XXA")
    space = seen()[[bound().labels.index(name) for name in reason.alike]]
    assert np.abs(space - space[0]).max() < 1e-9
    assert [(dict(e.gained), dict(e.lost), e.slides, e.turns) for e in reason.exchanges] == [
        ({"C_XXX": 1.0}, {"C_XXY": 1.0}, ("X",), ()),
        ({"C_XXZ": 1.0}, {"C_XXX": 1.0}, ("Z",), ()),
    ]
    assert reason.remedy is not None
    assert reason.remedy.probes == (Probe("X", (1.0, 0.0, 0.0)),)


def test_a_probe_across_x_at_its_origin_lifts_the_ceiling_from_123_to_129_and_makes_c_xxx_exact() -> None:
    reason = reason_for(hermle(), bound(), "C_XXX")
    assert reason is not None
    assert reason.remedy is not None
    assert (bound().rank, reason.remedy.gain) == (123, 6)
    with_probe = basis(np.vstack([seen().T, rows_of(reason.remedy.probes)]))
    assert with_probe.shape[1] == 129
    assert left_of("C_XXX", with_probe) < 1e-8
    assert left_of("C_XXY", with_probe) > 0.1
    (probe,) = reason.remedy.probes
    elsewhere = basis(np.vstack([seen().T, rows_of((replace(probe, point=(0.0, 70.0, 50.0)),))]))
    assert left_of("C_XXX", elsewhere) > 0.1


@pytest.mark.parametrize("reciprocal", [False, True])
@pytest.mark.parametrize("name", ["C_YYA", "C_CZX", "C_AAX", "C_CXZ", "C_BBC", "C_CCC"])
def test_what_is_proposed_tells_all_that_it_promises(name: str, reciprocal: bool) -> None:
    reason = reason_for(hermle(), bound(reciprocal), name)
    assert reason is not None
    assert reason.remedy is not None
    space = basis(np.vstack([seen(reciprocal).T, rows_of(reason.remedy.probes, reciprocal)]))
    assert space.shape[1] == bound(reciprocal).rank + reason.remedy.gain
    assert name in reason.remedy.known
    assert max(left_of(known, space, reciprocal) for known in reason.remedy.known) < 1e-7


def test_the_reasons_in_words() -> None:
    said = {}
    for name in ("C_XXX", "C_AAX", "C_CXX", "C_YYA"):
        reason = reason_for(hermle(), bound(), name)
        assert reason is not None
        said[name] = reason_words(reason)
    assert said["C_XXX"] == (
        "No test between tool and workpiece tells C_XXX by itself. C_XXY, C_XXZ and C_XXA make the same trace in every such "
        "test: what moves between these joints changes neither a translation in x nor a force in x. A displacement probe "
        "across X, along x of its carriage's frame and at that frame's origin (joint-probe) tells C_XXX; at any other point "
        "rotations of X enter."
    )
    assert (
        "X slides between them, which changes neither a rotation about x nor a moment about x, so nothing outside sees"
        in (said["C_AAX"])
    )
    assert (
        "Two displacement probes across X, along y of its carriage's frame, one at that frame's origin and one 100 mm"
        in (said["C_CXX"])
    )
    assert (
        "C_XXA + C_YYA and C_XXC + C_YYC exchange unseen: C turns between them, which changes neither sum" in said["C_YYA"]
    )


def test_a_place_is_told_from_its_carriage_by_no_probe_across_a_joint() -> None:
    machine = Machine("m", parse_topology("wFYXt"), places=(Place("holder", "X", (0.0, 0.0, -50.0)),))
    reason = reason_for(machine, ceiling(machine), "CL_XXholder")
    assert reason is not None
    assert reason.remedy is None
    assert reason.alike == ("C_XXX", "C_XXY", "CL_XXholder")
    assert "probe" not in reason_words(reason)
