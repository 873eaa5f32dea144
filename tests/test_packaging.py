"""The wheel is whole: built, installed where no source is, and run there."""

import json
import os
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(ROOT)]
    subprocess.run(command, check=True, capture_output=True, text=True)
    (built,) = folder.glob("*.whl")
    return built


def test_the_wheel_holds_what_a_user_needs_and_nothing_else(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.partition("/")[0] for name in names} == {"elastogeo", f"{'-'.join(wheel.stem.split('-')[:2])}.dist-info"}
    source = ROOT / "src" / "elastogeo"
    files = {path.relative_to(source).as_posix() for path in source.rglob("*") if path.is_file() and path.suffix != ".pyc"}
    assert {f"elastogeo/{name}" for name in files} <= set(names)
    assert "elastogeo/py.typed" in names
    assert "elastogeo/examples/hermle-c50-reconstructed/test.toml" in names


def new_environment(folder: Path) -> tuple[Path, Path]:
    """An environment without pip: its Python, and the folder of its commands."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    scripts = folder / ("Scripts" if os.name == "nt" else "bin")
    return scripts / ("python.exe" if os.name == "nt" else "python"), scripts


def install(python: Path, *what: str) -> None:
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", str(python), "install", "-q"]
    subprocess.run([*pip, *what], check=True)


def run(folder: Path, *command: str | Path) -> str:
    """What a command prints, with no variable of this Python in its environment."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_wheel_runs_where_no_source_is(wheel: Path, tmp_path: Path) -> None:
    """Its dependencies are those of this environment, by a path file: path files that lie there are not followed."""
    python, scripts = new_environment(tmp_path / "env")
    install(python, "--no-deps", "--no-index", str(wheel))
    (packages,) = (tmp_path / "env").rglob("site-packages")
    (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    code = "import elastogeo as eg; print(eg.__file__); print(eg.read_test(eg.example_test()))"
    where, test = run(tmp_path, python, "-c", code).splitlines()
    assert Path(where).is_relative_to(packages)
    assert test.startswith("<MachineTest")
    assert "The thesis's loaded ball bar" in test
    assert run(tmp_path, scripts / "elastogeo", "--version").startswith("elastogeo ")
    assert json.loads(run(tmp_path, scripts / "elastogeo", "machines", "hermle_c50", "--json"))
    assert run(tmp_path, scripts / "elastogeo", "history", "init").startswith("Made: history.db")


@pytest.mark.nightly
def test_the_wheel_installs_into_an_empty_environment_and_demonstrates_itself(wheel: Path, tmp_path: Path) -> None:
    python, scripts = new_environment(tmp_path / "env")
    install(python, "-c", str(ROOT / "constraints.txt"), f"{wheel}[report]")
    assert "C_XXX" in run(tmp_path, scripts / "elastogeo", "demo", "--report", "out")
    assert (tmp_path / "out" / "report.html").is_file()
