"""An interpreter of SINUMERIK programs that this project did not write, in an environment of its own.

`nc-gcode-interpreter` needs Python 3.12 or newer, which the project does not. The first call makes an environment for it
in the folder for caches; where there is no such Python, or no package, `NotHereError` says so and the tests are left out.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.linuxcnc.unpacked import NotHereError, alone, cache_folder

PACKAGE = "nc-gcode-interpreter==0.2.8"
NEWEST, OLDEST = 15, 12
_SCRIPT = """
import json, sys
from nc_gcode_interpreter import nc_to_dataframe

KEPT = ["line_no", "gg01_motion", "gg06_plane_select", "gg15_feed_type", *"XYZABCFIJK", "dwell"]
for name in sys.argv[1:]:
    out = []
    for more in {}, {"flatten_tolerance": 1e-3}:
        made, _ = nc_to_dataframe(open(name).read(), extra_axes=["A", "B"], include_line_numbers=True, **more)
        out.append(made.select([column for column in KEPT if column in made.columns]).to_dicts())
    print(json.dumps(out))
"""


@dataclass(frozen=True)
class Interpreted:
    """What the interpreter makes of a program: rows of words, by the line of the program from 1.

    `blocks` has one row a line, all modal values filled in; `flat` has as many rows as an arc takes as lines.
    """

    blocks: dict[int, dict[str, Any]]
    flat: dict[int, list[dict[str, Any]]]


def interpreter_or_skip() -> Path:
    """The Python that has the interpreter; leaves the test out where there is none."""
    try:
        return environment()
    except NotHereError as why:
        pytest.skip(f"SINUMERIK's judge: {why}")


@cache
def environment() -> Path:
    """The Python of an environment that has the interpreter.

    Raises
    ------
    NotHereError
        If there is no Python that is new enough, or the package cannot be had.
    """
    folder = cache_folder() / "nc-gcode-interpreter"
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    folder.parent.mkdir(parents=True, exist_ok=True)
    with alone(folder.with_suffix(".lock")):
        if not (folder / "complete").exists():
            _make(folder, python)
    return python


def interpret(texts: Sequence[str], folder: Path) -> list[Interpreted]:
    """What the interpreter makes of programs.

    Raises
    ------
    ValueError
        With its message, if it does not take one.
    """
    names = [f"{k}.mpf" for k in range(len(texts))]
    for name, text in zip(names, texts, strict=True):
        (folder / name).write_text(text, encoding="ascii")
    done = subprocess.run(
        [str(environment()), "-c", _SCRIPT, *names], cwd=folder, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise ValueError(done.stderr.strip()[-600:])
    return [_interpreted(*json.loads(line)) for line in done.stdout.splitlines()]


def _interpreted(blocks: list[dict[str, Any]], flat: list[dict[str, Any]]) -> Interpreted:
    parts: dict[int, list[dict[str, Any]]] = {}
    for row in flat:
        parts.setdefault(row["line_no"], []).append(row)
    return Interpreted({row["line_no"]: row for row in blocks}, parts)


def _make(folder: Path, python: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    commands = [
        [_newer_python(), "-m", "venv", str(folder)],
        [str(python), "-m", "pip", "install", "--no-input", "--disable-pip-version-check", "-q", PACKAGE],
        [str(python), "-c", "import nc_gcode_interpreter"],
    ]
    for command in commands:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise NotHereError(f"{PACKAGE} cannot be installed for Python 3.{OLDEST} or newer")
    (folder / "complete").touch()


def _newer_python() -> str:
    """A Python that the package takes: this one, one on the path, or one of pyenv."""
    if sys.version_info >= (3, OLDEST):
        return sys.executable
    minors = range(NEWEST, OLDEST - 1, -1)
    found = [path for minor in minors if (path := shutil.which(f"python3.{minor}"))]
    versions = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
    found += [str(path) for minor in minors for path in sorted(versions.glob(f"3.{minor}.*/bin/python3"))]
    for path in found:
        if subprocess.run([path, "-c", "import venv, ensurepip"], capture_output=True, check=False).returncode == 0:
            return path
    raise NotHereError(f"there is no Python 3.{OLDEST} or newer")
