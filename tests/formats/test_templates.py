"""A new test of every kind: its files are read, and simulated they give a result that the data support."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from elastogeo.errors import FormatError, InputError
from elastogeo.formats import (
    kinds_of_tests,
    new_test,
    read_drives,
    read_simulation,
    read_test,
    shipped_machines,
    simulate,
)
from elastogeo.identification import identify, identify_drives
from elastogeo.observe import instruments

KINDS = [kind for kind in kinds_of_tests() if kind != "drive"]


def test_every_instrument_that_ships_has_a_template() -> None:
    ours = [name for name, kind in instruments().items() if kind.__module__.startswith("elastogeo.")]
    assert set(ours) == set(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_a_new_test_simulated_gives_a_supported_result(kind: str, tmp_path: Path) -> None:
    folder = tmp_path / "t"
    file = new_test(folder, instrument=kind)
    assert str(tmp_path) not in file.read_text()
    simulate(folder, write=True)
    test = read_test(folder)
    assert test.instrument == kind
    assert test.question.parameters == ()
    assert test.simulated == "elastogeo, seed 1"
    result = identify(test)
    assert [check.name for check in result.verdict if check.decisive and check.passed is False] == []
    truth = read_simulation(folder / "simulation.toml").values
    found = {p.name: p for p in result.parameters}
    shown = [name for name in truth if name in found]
    assert shown
    assert all(parameter.interval is not None for parameter in result.parameters)
    for name in shown:
        low, high = found[name].interval
        stated = sum(c * truth.get(other, 0.0) for other, c in found[name].stands_for.items())
        middle, half = (low + high) / 2, (high - low) / 2
        assert abs(stated - middle) < 3 * half, name


def test_a_drive_file_is_made_for_logs_of_feed_drives(tmp_path: Path) -> None:
    folder = tmp_path / "d"
    file = new_test(folder, instrument="drive")
    assert file.name == "drive.toml"
    with pytest.raises(FormatError, match=r"no log matches 'logs/\*\.csv'"):
        read_drives(folder)
    (folder / "logs").mkdir()
    time = np.arange(800) * 1e-2
    for k, period in enumerate((3.1, 4.3, 5.7)):
        position = 40 * np.sin(2 * np.pi * time / period)
        velocity = 40 * 2 * np.pi / period * np.cos(2 * np.pi * time / period)
        current = 3.0 * np.sign(velocity) + 0.02 * velocity + 0.4
        current += 0.01 * np.random.default_rng(k).standard_normal(len(time))
        rows = zip(time.tolist(), position.tolist(), current.tolist(), strict=True)
        lines = ["time_s,position_x_mm,current_x_A", *(",".join(map(repr, row)) for row in rows)]
        (folder / "logs" / f"run_{k}.csv").write_text("\n".join(lines) + "\n")
    file.write_text(file.read_text() + "\n[model]\ncompare = false\n")
    found = identify_drives(read_drives(folder))
    assert [axis.axis for axis in found.axes] == ["X"]


def test_a_machine_of_ones_own_is_named_by_its_path_from_the_test(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "machines").mkdir()
    shutil.copy(shipped_machines()["huron_kx8"], tmp_path / "machines" / "mine.toml")
    monkeypatch.chdir(tmp_path)
    new_test("tests/ours", "machines/mine.toml", instrument="ball-bar")
    assert 'machine = "../../machines/mine.toml"' in (tmp_path / "tests" / "ours" / "test.toml").read_text()
    simulate("tests/ours", write=True)
    assert len(read_test("tests/ours").runs) == 6


_HEADS = """schema = "elastogeo.machine/1"
name = "{topology}"
topology = "{topology}"
tool_mm = [0, 0, -200]
[axes.{first}]
offset_mm = [0, 0, 250]
[axes.{second}]
offset_mm = [40, -30, 60]
travel_deg = [-95, 95]
"""


@pytest.mark.parametrize(("topology", "known"), [("wFXYZCAt", "workpiece"), ("wCYFXZBt", "tool"), ("wCAYFXZt", "tool")])
def test_a_nest_begins_with_the_rotary_axes_of_the_machine(topology: str, known: str, tmp_path: Path) -> None:
    """Head-head, head-table, table-table: every location error comes back, alone or in the sum that is said."""
    first, second = (axis for axis in topology if axis in "ABC")
    (tmp_path / "mine.toml").write_text(_HEADS.format(topology=topology, first=first, second=second))
    new_test(tmp_path / "t", str(tmp_path / "mine.toml"), instrument="sphere-nest")
    assert f'known = ["{known}"]' in (tmp_path / "t" / "test.toml").read_text()
    result = identify(simulate(tmp_path / "t"))
    truth = read_simulation(tmp_path / "t" / "simulation.toml").values
    assert len(truth) == 8 + 3
    assert set(result.confounding.labels) == set(truth)
    for parameter in result.parameters:
        stated = sum(c * truth[name] for name, c in parameter.stands_for.items())
        assert abs(stated - parameter.value) < 3 * parameter.expanded, parameter.name


def test_a_nest_on_a_machine_without_rotary_axes_is_refused(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('schema = "elastogeo.machine/1"\nname = "mill"\ntopology = "wXYFZt"\n')
    with pytest.raises(InputError, match=r"machine 'mill' \(wXYFZt\) has no rotary axis that a sphere nest could look at"):
        new_test(tmp_path / "t", str(tmp_path / "mine.toml"), instrument="sphere-nest")
    assert not (tmp_path / "t").exists()


def test_levels_and_repeats_are_those_that_were_asked_for(tmp_path: Path) -> None:
    new_test(tmp_path / "bar", forces=[500, 100], repeats=2)
    simulated = simulate(tmp_path / "bar")
    assert [(run.force, run.repeat) for run in simulated.runs] == [(100, 1), (100, 2), (500, 1), (500, 2)]
    new_test(tmp_path / "roller", instrument="ball-roller", engagements=[0.0, 0.05], repeats=1)
    text = (tmp_path / "roller" / "test.toml").read_text()
    assert text.count("[[runs]]") == 4
    assert "engagement_um = 50\n" in text


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"instrument": "ball-bar", "forces": [100.0]}, "a test with ball-bar has no level of force; leave it out"),
        ({"engagements": [0.1]}, "a test with loaded-ball-bar has no level of engagement; leave it out"),
        ({"instrument": "laser"}, "there is no template for 'laser'; there are: ball-bar, ball-roller"),
        ({"machine": "mine.toml"}, "there is no machine 'mine.toml'"),
    ],
)
def test_what_cannot_be_made_is_said_and_leaves_nothing(asked: dict[str, object], message: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=message):
        new_test(tmp_path / "t", **asked)  # type: ignore[arg-type]
    assert list(tmp_path.iterdir()) == []
