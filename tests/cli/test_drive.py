"""`elastogeo drive`: exit codes, tables, the JSON contract, figures."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import typer
from typer.testing import CliRunner

from elastogeo.cli.answers.drive import drive
from elastogeo.errors import FormatError

Run = Callable[..., tuple[int, str]]


def write(path: Path, seed: int, dead: bool = False, forward: bool = False) -> Path:
    """A simulated run of X with its own noise."""
    random = np.random.default_rng(seed)
    time = 0.01 * np.arange(500)
    waves = [(random.uniform(0.2, 2.0), random.uniform(0, 2 * np.pi), random.uniform(3, 10)) for _ in range(4)]
    v = sum(size * np.sin(2 * np.pi * f * time + at) for f, at, size in waves)
    a = sum(size * 2 * np.pi * f * np.cos(2 * np.pi * f * time + at) for f, at, size in waves)
    v = v - v.min() + 1 if forward else v
    current = np.zeros(500) if dead else 0.01 * a + 0.15 * v + 4 * np.sign(v) + 0.5 + 0.2 * random.standard_normal(500)
    rows = [f"{t:.2f},{c!r},{w!r},{b!r}" for t, c, w, b in zip(time, current.tolist(), v.tolist(), a.tolist(), strict=True)]
    path.write_text("time_s,current_x_A,velocity_x_mm_s,acceleration_x_mm_s2\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def run() -> Run:
    """Run the command in this process: its exit code and standard output."""
    app = typer.Typer()
    app.command()(drive)

    def invoke(*arguments: object) -> tuple[int, str]:
        done = CliRunner().invoke(app, [str(argument) for argument in arguments])
        if done.exception is not None and not isinstance(done.exception, SystemExit):
            raise done.exception
        return done.exit_code, done.output

    return invoke


@pytest.fixture
def logs(tmp_path: Path) -> list[Path]:
    return [write(tmp_path / f"run_{seed}.csv", seed) for seed in range(3)]


def test_logs_become_tables_and_a_verdict(run: Run, logs: list[Path]) -> None:
    code, out = run(*logs, "--no-compare")
    assert code == 0
    for words in (
        "1500 samples of 3 runs",
        "inertia",
        "A s²/mm",
        "all other runs",
        "terms distinguished: All 4 parameters",
    ):
        assert words in out


def test_json_holds_every_number_and_nothing_else(run: Run, logs: list[Path], tmp_path: Path) -> None:
    code, out = run(*logs, "--held-out", "run_2", "--json", "--report", tmp_path / "figures")
    document = json.loads(out)
    assert code == 0
    assert document["schema"] == "elastogeo.drive/1"
    assert document["test"]["held_out"] == ["run_2"]
    (axis,) = document["axes"]
    truth = {"inertia": 0.01, "viscous": 0.15, "coulomb": 4.0, "constant": 0.5}
    values = {p["name"]: p["value"] for p in axis["parameters"]}
    assert values == pytest.approx(truth, rel=0.2)
    assert [score["run"] for score in axis["held_out"]] == ["run_2"]
    assert axis["held_out"][0]["rmse"] == pytest.approx(0.2, rel=0.15)
    assert {"plain", "smooth sign", "time shift"} <= {model["name"] for model in axis["models"]}
    assert axis["rank"] == axis["columns"] == 4
    assert {check["name"].partition(": ")[0] for check in document["verdict"]} == {"X"}
    names = {path.name for path in (tmp_path / "figures").iterdir()}
    assert names == {"friction.svg", "run.svg", "models.svg", "report.html", "report.pdf", "report.json"}


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ({"dead": True}, "Axis X cannot be identified, because its effort is 0 A in all 1000 samples"),
        ({"forward": True}, "coulomb + constant is determined as one number only"),
    ],
)
def test_what_the_records_do_not_support_ends_with_code_one(run: Run, tmp_path: Path, kind: dict, words: str) -> None:
    made = [write(tmp_path / f"run_{seed}.csv", seed, **kind) for seed in range(2)]
    code, out = run(*made)
    assert code == 1
    assert words in out
    code, out = run(*made, "--json", "--report", tmp_path / "figures")
    assert code == 1
    (axis,) = json.loads(out)["axes"]
    assert axis["models"] == []
    assert not axis["verdict"][0]["passed"]


def test_wrong_input_is_an_error_of_input(run: Run, logs: list[Path]) -> None:
    with pytest.raises(FormatError, match="have no current, torque or force of axis Q"):
        run(*logs, "--axis", "Q")
