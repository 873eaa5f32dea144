"""A static test on paper: the tables hold the result's numbers, the JSON its keys, the figure its runs."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from elastogeo.formats import read_test
from elastogeo.identification.static_tests.assessment import evaluate_static
from elastogeo.identification.static_tests.result import StaticResults
from elastogeo.machine import Machine, parse_topology
from elastogeo.observe import MachineTest, Question, Run, StaticForce
from elastogeo.report import Table
from elastogeo.report.static_tests.document import STATIC_SCHEMA, static_json
from elastogeo.report.static_tests.tables import hysteresis_figure, static_tables

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
KEYS = {
    "schema",
    "software",
    "test",
    "places",
    "cartesian",
    "twists",
    "twist_places",
    "twist_refusal",
    "joints",
    "verdict",
}
UP = np.linspace(-300, 300, 24)
CYCLES = np.tile(np.concatenate([UP, UP[-2:0:-1]]), 3)


@pytest.fixture(scope="module")
def pulled() -> StaticResults:
    """Pull and push with a backlash of 2 um, and positions of the loaded axis, by hand; 50 nm/N in all."""
    random = np.random.default_rng(3)
    moved = 5e-5 * CYCLES + 1e-3 * np.sign(CYCLES) + 2e-5 * random.standard_normal(len(CYCLES))
    columns = {"force": CYCLES, "displacement": moved, "position_x": 1e-5 * CYCLES, "scale_x": 3e-5 * CYCLES}
    setup = StaticForce((1.0, 0.0, 0.0))
    machine = Machine("m", parse_topology("wFYXt"))
    return evaluate_static(MachineTest("t", machine, setup, (Run("<a>", columns),), Question(("C_XXX", "E_R0"))))


@pytest.fixture(scope="module")
def examples() -> dict[str, StaticResults]:
    return {name: evaluate_static(read_test(EXAMPLES / f"static-{name}")) for name in ("force", "rig", "probes", "frame")}


def titled(found: StaticResults, beginning: str) -> Table:
    return next(table for table in static_tables(found) if table.title.startswith(beginning))


def types_in(value: object) -> set[type]:
    inside = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return {type(value)}.union(*(types_in(item) for item in inside))


@pytest.mark.parametrize("name", ["force", "rig", "probes", "frame"])
def test_every_table_is_whole(examples: dict[str, StaticResults], name: str) -> None:
    tables = static_tables(examples[name])
    assert tables
    for table in tables:
        assert table.title
        assert {len(row) for row in table.rows} == {len(table.headings)}
        assert max(table.words) < len(table.headings)


def test_numbers_of_the_tables_are_those_of_the_result(examples: dict[str, StaticResults]) -> None:
    table = titled(examples["force"], "Static compliance")
    (row,) = [row for row in table.rows if row[0] == "x-500N"]
    # simulation.toml: 6e-5 + 1e-5 + 0.8e-5 mm/N
    value, u = map(float, row[table.headings.index("compliance [nm/N]")].rstrip(")").split(" (u "))
    assert abs(value - 78.0) < 4 * u
    assert row[1] == "3"
    line = titled(examples["rig"], "Straight line")
    value, half = map(float, line.rows[0][line.headings.index("stiffness [N/µm]")].split(" ± "))
    assert abs(value - 2.65) < 2 * half
    matrix = titled(examples["probes"], "Cartesian compliance [nm/N]")
    assert float(matrix.rows[1][2].split(" ± ")[0]) == pytest.approx(50, rel=5e-3)
    twist = titled(examples["frame"], "Twist per force")
    # C_CXX is 2e-8 rad/N per newton in x, a third of the force; two runs give no interval
    assert float(twist.rows[0][-1]) == pytest.approx(20 / 3, abs=1.5)


def test_columns_that_say_nothing_are_left_out(examples: dict[str, StaticResults], pulled: StaticResults) -> None:
    assert "backlash [µm]" not in titled(examples["force"], "Hysteresis").headings
    table = titled(pulled, "Hysteresis")
    value, u = map(float, table.rows[0][table.headings.index("backlash [µm]")].rstrip(")").split(" (u "))
    assert abs(value - 2.0) < 6 * u
    assert "another run may differ by more" in titled(pulled, "Static compliance").note


def test_the_drive_has_its_shares(pulled: StaticResults) -> None:
    table = titled(pulled, "Where axis X yields (position loop closed on the motor)")
    assert [row[0] for row in table.rows] == ["servo", "transmission", "guideway and structure", "whole"]
    assert float(table.rows[0][1].split(" ± ")[0]) == pytest.approx(10.0, rel=1e-6)
    assert float(table.rows[0][2].split(" ± ")[0]) == pytest.approx(100.0, rel=1e-6)  # 1 / 10 nm/N
    assert sum(float(row[3]) for row in table.rows[:3]) == pytest.approx(100.0, abs=0.2)


@pytest.mark.parametrize("name", ["force", "rig", "probes", "frame"])
def test_json_has_its_keys_and_plain_types(examples: dict[str, StaticResults], name: str) -> None:
    document = static_json(examples[name])
    assert document["schema"] == STATIC_SCHEMA == "elastogeo.static/1"
    assert set(document) == KEYS
    assert types_in(document) <= {dict, list, str, int, float, bool, type(None)}
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["test"]["simulated"].startswith("Not measured: simulated")
    assert document["joints"]["schema"] == "elastogeo.identification/1"


def test_json_numbers_are_those_of_the_result(examples: dict[str, StaticResults], pulled: StaticResults) -> None:
    (place,) = static_json(pulled)["places"]
    run = pulled.places[0].runs[0].hysteresis
    assert run is not None
    assert run.backlash is not None
    (said,) = place["runs"]
    assert said["backlash"]["value"] == run.backlash.value * 1000
    assert said["static_compliance"]["standard_uncertainty"] == 1000 * run.static_compliance.standard_uncertainty
    assert said["static_compliance"]["interval95"] is None
    assert [part["names"] for part in place["drive"]["parts"]][:2] == [["servo"], ["transmission"]]
    (weights,) = static_json(examples["rig"])["places"]
    assert weights["runs"][0]["mean_hysteresis"] is None
    assert "one level gives no compliance" in weights["runs"][0]["refusal"]
    frame = static_json(examples["frame"])["twists"][1]
    assert frame["steps"][12]["rotation_urad"] == (1e6 * examples["frame"].twists[1].steps[12].twist[3:]).tolist()
    assert frame["suspect"] is None


def test_every_key_is_explained_at_the_top(examples: dict[str, StaticResults], pulled: StaticResults) -> None:
    import elastogeo.report.static_tests.document as module

    def keys(value: object) -> set[str]:
        if isinstance(value, dict):
            return set(value).union(*map(keys, value.values()))
        return set().union(*map(keys, value)) if isinstance(value, list) else set()

    shared = {"schema", "software", "test", "verdict", "joints", "commands"}
    used: set[str] = set()
    for found in (*examples.values(), pulled):
        document = static_json(found)
        used |= {key for name, part in document.items() if name not in shared for key in keys(part) | {name}}
    used -= set("XYZABC")
    assert module.__doc__ is not None
    assert sorted(key for key in used if not re.search(rf"\b{re.escape(key)}\b", module.__doc__)) == []


def test_the_figure_has_two_panels_a_run(examples: dict[str, StaticResults], pulled: StaticResults) -> None:
    figure = hysteresis_figure(examples["force"])
    assert figure is not None
    assert [ax.get_title() for ax in figure.axes[::2]] == [
        f"{name}, simulated" for name in ("x-250N", "x-500N", "x-minus-500N")
    ]
    left, right = figure.axes[:2]
    labels = [line.get_label() for line in left.get_lines()]
    assert labels == ["readings", "rising", "falling", "secant"]
    assert np.abs(right.get_lines()[3].get_ydata()).max() < 1e-9
    one = hysteresis_figure(pulled)
    assert one is not None
    assert len(one.axes) == 2
    assert "simulated" not in one.axes[0].get_title()
    weights = hysteresis_figure(examples["rig"])
    assert weights is not None
    assert weights.axes[0].get_title() == "9 runs without a full cycle, simulated"
    assert len(weights.axes[0].get_lines()[0].get_xdata()) == 27
