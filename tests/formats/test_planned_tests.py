"""Planned tests on disk: what is written is read back as it was, and identified when the runs are there."""

from pathlib import Path

import numpy as np
import pytest

import elastogeo as eg
from elastogeo.errors import FormatError
from elastogeo.formats.text.table import Table
from elastogeo.observe import Campaign, MachineTest
from elastogeo.planning import Means, candidates
from elastogeo.sources import simulate

HERMLE = eg.read_machine("hermle_c50")


def drawn(instrument: str, count: int) -> dict[str, MachineTest]:
    means = Means(HERMLE, readings=24, tools=((0.0, 0.0, -160.0), (1.0, 2.0, -210.5)))
    return {one.name: one.test for one in candidates(means, [instrument], count)}


@pytest.mark.parametrize(
    "instrument", ["loaded-ball-bar", "ball-bar", "static-force", "displacement-probes", "sensor-frame", "joint-probe"]
)
def test_a_planned_test_is_read_as_it_was_written(tmp_path: Path, instrument: str) -> None:
    tests = drawn(instrument, 8)
    written = eg.write_tests(Campaign("plan", tests), tmp_path / "plan", "hermle_c50")
    assert [path.name for path in written] == ["campaign.toml", *["test.toml"] * 8]
    for name, test in tests.items():
        columns = test.runs[0].columns

        def poses(path: Path, columns: dict[str, np.ndarray] = dict(columns)) -> Table:  # type: ignore[type-arg]  # noqa: B006
            return Table(dict(columns), {}, str(path))

        again = eg.read_test(tmp_path / "plan" / name, poses)
        assert type(again.setup) is type(test.setup)
        assert again.machine == test.machine
        assert [run.force for run in again.runs] == [run.force for run in test.runs]
        assert [run.sense for run in again.runs] == [run.sense for run in test.runs]
        one, other = again.observations()[0], test.observations()[0]
        assert one.commands == pytest.approx(other.commands, abs=1e-9)
        assert one.direction == pytest.approx(other.direction, abs=1e-12)
        assert one.wrench == pytest.approx(other.wrench, abs=1e-9)
        assert one.tool == pytest.approx(other.tool)


def test_what_is_there_is_not_written_over(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="is there already; choose another name, nothing was changed"):
        eg.write_tests(Campaign("plan", drawn("static-force", 1)), tmp_path, "hermle_c50")


def test_a_machine_file_of_ones_own_is_named_from_each_folder(tmp_path: Path) -> None:
    from importlib.resources import files

    own = tmp_path / "mine.toml"
    own.write_text(
        (files("elastogeo.formats") / "machines" / "hermle_c50.toml").read_text(encoding="utf-8"), encoding="utf-8"
    )
    eg.write_tests(Campaign("plan", drawn("static-force", 2)), tmp_path / "plan", str(own))
    assert 'machine = "../../mine.toml"' in (tmp_path / "plan" / "static_1" / "test.toml").read_text(encoding="utf-8")
    assert 'machine = "../mine.toml"' in (tmp_path / "plan" / "campaign.toml").read_text(encoding="utf-8")


def test_a_written_plan_is_measured_and_identified(tmp_path: Path) -> None:
    """From the plan to folders, runs as a bar writes them, one campaign: no geometry is taken for compliance."""
    plan = eg.plan(Means(HERMLE, readings=36, rotary=False), tests=3, count=20)
    eg.write_tests(plan.campaign, tmp_path / "plan", "hermle_c50")
    values = {"C_XXX": 2e-5, "C_ZZZ": 1.5e-5, "C_YYY": 1e-5}
    for name, test in plan.campaign.tests.items():
        measured = simulate(test, values, exact=False)
        (tmp_path / "plan" / name / "runs").mkdir()
        for run in measured.runs:
            rows = np.column_stack([np.rad2deg(run.columns["angle"]), 1000 * run.columns["radial"]])
            text = "angle_deg,radial_um\n" + "\n".join(f"{angle:.9f},{radial:.9f}" for angle, radial in rows)
            (tmp_path / "plan" / name / "runs" / f"{run.name.replace(' ', '')}.csv").write_text(text, encoding="utf-8")
    found = eg.identify(eg.read_campaign(tmp_path / "plan"))
    assert found.confounding.rank > plan.rank
    for parameter in (p for p in found.parameters if p.elastic):
        true = sum(c * values.get(name, 0.0) for name, c in parameter.stands_for.items())
        assert parameter.value == pytest.approx(true, abs=1e-3 * abs(parameter.value) + 1e-7)
