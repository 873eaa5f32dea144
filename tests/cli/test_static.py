"""`elastogeo static`: exit codes, tables, JSON, the report, and what is refused at the door."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from elastogeo.cli.answers.static import static
from elastogeo.errors import FormatError, InputError

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
Call = Callable[..., tuple[int, str]]


@pytest.fixture
def call() -> Call:
    """Run the command in this process: its exit code and standard output."""
    app = typer.Typer()
    app.command()(static)

    def invoke(*arguments: object) -> tuple[int, str]:
        done = CliRunner().invoke(app, [str(argument) for argument in arguments])
        if done.exception is not None and not isinstance(done.exception, SystemExit):
            raise done.exception
        return done.exit_code, done.stdout

    return invoke


@pytest.fixture
def ramps(tmp_path: Path) -> Path:
    """A copy of the force ramps, to spoil."""
    return Path(shutil.copytree(EXAMPLES / "static-force", tmp_path / "ramps"))


def change(folder: Path, old: str, new: str, file: str = "runs/x-500N.csv") -> Path:
    path = folder / file
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")
    return folder


@pytest.mark.parametrize(
    ("name", "words"),
    [
        (
            "force",
            ("Static compliance and hysteresis", "Hysteresis at a force", "C_XXX stands", "energy is lost, not gained"),
        ),
        ("rig", ("Straight line through all runs", "9 of 9 runs say nothing of hysteresis")),
        ("probes", ("Cartesian stiffness [N/µm]", "Principal directions, the softest first", "3 runs are too few")),
        ("frame", ("Twist of the tool at the greatest load", "suspect", "No sensor stands out of the 12")),
    ],
)
def test_every_example_ends_well_and_says_that_it_is_simulated(call: Call, name: str, words: tuple[str, ...]) -> None:
    code, out = call(EXAMPLES / f"static-{name}")
    assert code == 0
    for said in ("Simulated from ", "Parameters", *words):
        assert said in out, said


def test_json_is_one_object_and_nothing_else(call: Call) -> None:
    code, out = call(EXAMPLES / "static-probes", "--json")
    assert code == 0
    document = json.loads(out)
    assert document["schema"] == "elastogeo.static/1"
    assert document["cartesian"]["undetermined"] == []


def test_the_report_holds_the_loops_and_the_joints(call: Call, tmp_path: Path) -> None:
    code, out = call(EXAMPLES / "static-rig", "--report", tmp_path / "r")
    assert code == 0
    assert str(tmp_path / "r" / "report.html") in out.replace("\n", "")
    for name in ("hysteresis.svg", "report.html", "report.pdf", "contributions.svg"):
        assert (tmp_path / "r" / name).stat().st_size > 1000, name


def test_a_turned_sensor_ends_with_1_and_says_what_to_do(call: Call, ramps: Path) -> None:
    code, out = call(change(ramps, "direction = [1, 0, 0]", "direction = [1, 0, 0]\nsensor = [-1, 0, 0]", "test.toml"))
    assert code == 1
    assert "look  displacement with the force" in out
    assert "turn the sensor's sign" in out


def test_a_ball_bar_test_is_sent_to_its_own_command(call: Call) -> None:
    with pytest.raises(InputError, match=r"was made with a loaded-ball-bar; .* use: elastogeo identify"):
        call(EXAMPLES / "one-level")


def test_a_missing_column_is_refused_by_its_name(call: Call, ramps: Path) -> None:
    with pytest.raises(InputError, match="run 'x-500N' lacks the column displacement; its columns are: force, gap"):
        call(change(ramps, "displacement_um", "gap_um"))


def test_a_column_without_a_unit_is_refused(call: Call, ramps: Path) -> None:
    with pytest.raises(FormatError, match=r"x-500N.csv.*column 'displacement' has no unit: write displacement_mm"):
        call(change(ramps, "displacement_um", "displacement"))


def test_micrometres_given_as_millimetres_are_refused(call: Call, ramps: Path) -> None:
    with pytest.raises(InputError, match=r"run 'x-500N': displacement reaches 4.* mm; are they micrometres given as"):
        call(change(ramps, "displacement_um", "displacement_mm"))


def test_one_branch_only_says_so_and_keeps_the_line(call: Call, ramps: Path) -> None:
    for path in (ramps / "runs").glob("*.csv"):
        lines = path.read_text(encoding="utf-8").splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith("force_N")) + 1
        lines = [line.replace("# rows: 120", "# rows: 20") for line in lines]
        path.write_text("\n".join([*lines[: first + 20], ""]), encoding="utf-8")
    code, out = call(ramps)
    assert code == 0
    assert "3 of 3 runs say nothing of hysteresis" in out
    assert "only a rising branch covers its range" in out
    assert "Straight line through all runs" in out
    assert "Static compliance and hysteresis" not in out


def test_a_position_loop_is_closed_on_one_of_two(call: Call) -> None:
    with pytest.raises(InputError, match="a position loop is closed on 'belt'; say motor or scale"):
        call(EXAMPLES / "static-rig", "--feedback", "belt")


def test_the_code_on_its_page_finds_the_hysteresis(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """That all blocks of the page run is tested in tests/test_docs.py."""
    monkeypatch.chdir(EXAMPLES.parent)
    page = (EXAMPLES.parent / "docs" / "static.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    exec(compile(code, "static.md", "exec"), {"__name__": "__main__"})
    told = capsys.readouterr().out
    assert "mean hysteresis 0.6" in told
    assert "more than scatter" in told
