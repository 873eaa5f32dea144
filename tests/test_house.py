"""The house rules that no other tool checks: files, names, commands, imports."""

import ast
import importlib
import pkgutil
import re
import subprocess
import sys
import tomllib
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import elastogeo
from elastogeo.cli.doors import Command, Group, doors, every

ROOT = Path(__file__).resolve().parents[1]
SOURCES = sorted((ROOT / "src").rglob("*.py"))
HEAVY = {"jinja2", "matplotlib", "numpy", "pyarrow", "pydantic", "scipy", "typst"}
TARGETS = {"demo", "web", "test", "bench", "studies", "nightly", "check", "docs", "clean", "help"}


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
    shown = re.findall(r"^(?:\.venv/bin/)?elastogeo ([a-z]\w*)(?: ([a-z]\w*))?", blocks, flags=re.MULTILINE)
    known = set(every())
    groups = {typed.partition(" ")[0] for typed in known if " " in typed}
    assert shown
    assert {" ".join((first, second)) if first in groups and second else first for first, second in shown} <= known


def test_the_summary_of_every_command_fits_its_line_of_the_help() -> None:
    """At 80 columns, beside the longest name of a group (`acknowledge`)."""
    groups = [door.commands for door in doors().values() if isinstance(door, Group)]
    single = {name: door for name, door in doors().items() if isinstance(door, Command)}
    for commands in (single, *groups):
        room = 72 - max(map(len, commands))
        summaries = {name: re.match(r"[^.\n]*\.?", one.function().__doc__ or "")[0] for name, one in commands.items()}
        assert {name: said for name, said in summaries.items() if not (said.endswith(".") and len(said) <= room)} == {}


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


def test_no_source_file_is_longer_than_500_lines() -> None:
    lengths = {path.relative_to(ROOT): len(path.read_text(encoding="utf-8").splitlines()) for path in SOURCES}
    assert lengths
    assert {path: length for path, length in lengths.items() if length > 500} == {}


def test_no_folder_is_a_heap() -> None:
    folders = [path for path in (ROOT / "src").rglob("*") if path.is_dir()]
    counts = {folder.relative_to(ROOT): sum(1 for _ in folder.glob("*.py")) for folder in folders}
    assert max(counts.values()) > 5
    assert {folder: count for folder, count in counts.items() if count > 20} == {}


def imports_of(path: Path) -> list[str]:
    """The modules of elastogeo that a file imports from, those for types and those inside functions too."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    return [module for module in found if module.startswith("elastogeo.")]


def test_another_room_is_entered_through_its_face() -> None:
    """The face of a room is its `__init__`, and that of a wing too."""
    past = []
    for path in SOURCES:
        room = path.relative_to(ROOT / "src" / "elastogeo").parts[0]
        for module in imports_of(path):
            folder = ROOT / "src" / module.replace(".", "/")
            if module.count(".") > 1 and module.split(".")[1] != room and not folder.is_dir():
                past.append((path.name, module))
    assert past == []


def test_no_file_imports_itself_by_a_detour() -> None:
    """No circle of imports, those for types included; the faces only pass on what their room exports."""
    inner = [path for path in SOURCES if path.name != "__init__.py"]
    names = {".".join(path.relative_to(ROOT / "src").with_suffix("").parts): path for path in inner}
    graph = {name: {module for module in imports_of(path) if module in names} for name, path in names.items()}
    assert sum(map(len, graph.values())) > 300
    TopologicalSorter(graph).prepare()


def test_every_check_has_a_sentence() -> None:
    """The names of checks in the rooms below and the register of report hold each other."""
    from elastogeo.report.sentences import _sentences

    named = re.compile(r"\bCheck\(\s*\"([^\"{]+)\"")
    below = {
        name for path in SOURCES if "report" not in path.parts for name in named.findall(path.read_text(encoding="utf-8"))
    }
    assert len(below) > 25
    assert below - set(_sentences()) == set()


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
