"""The house rules that no other tool checks: files, names, commands, imports."""

import importlib
import pkgutil
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import elastogeo

ROOT = Path(__file__).resolve().parents[1]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
HEAVY = {"jinja2", "matplotlib", "numba", "numpy", "pyarrow", "pydantic", "scipy", "typst"}
TARGETS = {"demo", "test", "bench", "studies", "nightly", "check", "docs", "clean", "help"}


def subpackages() -> list[str]:
    return sorted(m.name for m in pkgutil.walk_packages(elastogeo.__path__, "elastogeo.") if m.ispkg)


def canonical(name: str) -> str:
    """Spell a distribution's name as indexes compare it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def isort_style(name: str) -> tuple[int, list[tuple[bool, int, str]]]:
    """Order of `__all__` as ruff keeps it: CONSTANTS, then Classes, then functions, numbers by value."""
    rank = 0 if name.isupper() and len(name) > 1 else 1 if name[0].isupper() else 2
    return rank, [(not part.isdigit(), int(part) if part.isdigit() else 0, part) for part in re.split(r"(\d+)", name)]


def test_constraints_hold_names_versions_and_markers_only() -> None:
    pin = re.compile(r"[a-z0-9][a-z0-9._-]*==[0-9][0-9a-z.!+]*( ; [^:/@]+)?")
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    assert lines
    assert [line for line in lines if not pin.fullmatch(line)] == []


def test_constraints_pin_every_dependency() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = [project["dependencies"], *project["optional-dependencies"].values()]
    wanted = {canonical(re.match(r"[\w.-]+", line)[0]) for group in groups for line in group} - {"elastogeo"}  # type: ignore[index]
    pins = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    assert wanted - {canonical(line.partition("==")[0]) for line in pins} == set()


def test_makefile_has_exactly_the_promised_targets_and_make_py_knows_them() -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z]\w*):", makefile, flags=re.MULTILINE))
    assert targets == TARGETS
    spoken = subprocess.run(
        [sys.executable, "-m", "make", "help"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    assert set(re.findall(r"^  (\w+) ", spoken, flags=re.MULTILINE)) == TARGETS


def test_readme_make_commands_exist() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    named = set(re.findall(r"(?:^|`)(?:python -m )?make (\w+)", readme, flags=re.MULTILINE))
    assert {"demo", "test"} <= named
    assert named <= TARGETS


def test_readme_elastogeo_commands_exist() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    blocks = "".join(re.findall(r"^```bash\n(.*?)^```", readme, flags=re.MULTILINE | re.DOTALL))
    commands = sorted(set(re.findall(r"^(?:\.venv/bin/)?elastogeo ([a-z]\w*)", blocks, flags=re.MULTILINE)))
    assert commands
    for command in commands:
        run = subprocess.run(
            [sys.executable, "-m", "elastogeo", command, "--help"], capture_output=True, text=True, check=False
        )
        assert run.returncode == 0, f"README shows `elastogeo {command}`: {run.stderr}"


@pytest.mark.parametrize("package", subpackages())
def test_public_names_exist_and_are_sorted(package: str) -> None:
    module = importlib.import_module(package)
    names = list(getattr(module, "__all__", []))
    assert [name for name in names if not hasattr(module, name)] == []
    assert names == sorted(set(names), key=isort_style)


@pytest.mark.parametrize("package", subpackages())
def test_every_room_says_what_it_is_for(package: str) -> None:
    assert importlib.import_module(package).__doc__


def test_no_file_has_a_name_that_says_nothing() -> None:
    folders = [ROOT / top for top in ("src", "tests", "studies", "benchmarks", "docs", "examples")]
    paths = [path.relative_to(ROOT) for folder in folders for path in folder.rglob("*.py")]
    assert paths
    assert [path for path in paths if path.name in {"utils.py", "helpers.py", "common.py"}] == []


def test_no_source_file_is_longer_than_700_lines() -> None:
    lengths = {path.relative_to(ROOT): len(path.read_text(encoding="utf-8").splitlines()) for path in SOURCES}
    assert lengths
    assert {path: length for path, length in lengths.items() if length > 700} == {}


def test_the_command_line_imports_nothing_heavy() -> None:
    probe = "import sys, elastogeo.cli; print(*sorted({name.partition('.')[0] for name in sys.modules}))"
    imported = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=False)
    assert imported.returncode == 0, imported.stderr
    assert HEAVY & set(imported.stdout.split()) == set()


def test_the_array_type_is_defined_once() -> None:
    spelled = re.compile(r"NDArray\[np\.float64\]")
    defined = [path.relative_to(ROOT) for path in SOURCES if spelled.search(path.read_text(encoding="utf-8"))]
    assert defined == [Path("src/elastogeo/estimate/factor.py")]


def test_no_room_above_observe_asks_which_instrument_it_was() -> None:
    """An instrument says its own facts, limits and radius; whoever asks for its class knows a list of instruments."""
    asks = re.compile(r"isinstance\([^)\n]*setup\b")
    above = [path for path in SOURCES if "observe" not in path.parts]
    assert above
    assert [path.relative_to(ROOT) for path in above if asks.search(path.read_text(encoding="utf-8"))] == []
