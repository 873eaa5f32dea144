"""Faces whose names are imported when they are used first: what is promised, typed and found is one list."""

from __future__ import annotations

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[1] / "src"
FACES = sorted(
    ".".join(path.relative_to(SOURCE).parent.parts)
    for path in SOURCE.rglob("__init__.py")
    if "first_use(" in path.read_text(encoding="utf-8")
)


def typed(face: str) -> dict[str, str]:
    """The module of each name that a face imports for types only."""
    path = SOURCE.joinpath(*face.split("."), "__init__.py")
    (guarded,) = [node for node in ast.parse(path.read_text(encoding="utf-8")).body if isinstance(node, ast.If)]
    imports = [node for node in guarded.body if isinstance(node, ast.ImportFrom)]
    return {alias.name: str(node.module) for node in imports for alias in node.names}


def at_once(face: str) -> set[str]:
    """The names that a face imports with itself."""
    path = SOURCE.joinpath(*face.split("."), "__init__.py")
    found = [node for node in ast.parse(path.read_text(encoding="utf-8")).body if isinstance(node, ast.ImportFrom)]
    return {alias.name for node in found for alias in node.names}


def test_there_are_such_faces() -> None:
    assert {"elastogeo.identification", "elastogeo.formats", "elastogeo.drive"} <= set(FACES)


@pytest.mark.parametrize("face", FACES)
def test_each_name_comes_from_where_the_types_say(face: str) -> None:
    module = importlib.import_module(face)
    assert sorted(typed(face)) == sorted(set(module.__all__) - at_once(face))
    for name, home in typed(face).items():
        assert getattr(module, name) is getattr(importlib.import_module(home), name)


@pytest.mark.parametrize("face", FACES)
def test_no_name_is_that_of_a_module(face: str) -> None:
    """Once it is imported, the module would stand in the place of the name."""
    folder = SOURCE.joinpath(*face.split("."))
    modules = {path.stem for path in folder.glob("*.py")} | {path.parent.name for path in folder.glob("*/__init__.py")}
    assert modules & set(importlib.import_module(face).__all__) == set()


@pytest.mark.parametrize("face", FACES)
def test_a_name_that_is_none_is_said(face: str) -> None:
    with pytest.raises(AttributeError, match=rf"{face} has no 'nothing_of_the_kind'; it has \w+"):
        _ = importlib.import_module(face).nothing_of_the_kind


def test_a_test_of_a_bar_imports_no_rollers() -> None:
    done = subprocess.run(
        [sys.executable, "-c", "import sys; from elastogeo.identification import identify; print(*sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
    )
    loaded = set(done.stdout.split())
    assert "elastogeo.identification.identification" in loaded
    assert not [
        name for name in loaded if name.startswith(("elastogeo.identification.rollers", "elastogeo.identification.feed"))
    ]
