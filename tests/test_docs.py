"""The documentation is true: its commands run, its code runs, its reference is that of the commands."""

import importlib.util
import re
import shlex
import shutil
import sys
from pathlib import Path

import pytest

import elastogeo as eg
from elastogeo.cli import main

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
PAGES = (
    "tutorial.md",
    "drive.md",
    "ball-roller.md",
    "static.md",
    "ball-bar.md",
    "rotary-axes.md",
    "positioning.md",
    "compensation.md",
    "programs.md",
    "prediction.md",
    "campaigns.md",
    "planning.md",
    "history.md",
    "changes.md",
)


@pytest.mark.parametrize("page", PAGES)
def test_every_block_of_a_page_runs(page, tmp_path, monkeypatch, capsys):
    """In a folder that looks like the repository's root: the examples are there, and nothing that a page writes stays."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```(bash|python)\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), flags=re.DOTALL)
    assert len(blocks) >= 4
    for language, code in blocks:
        if language == "bash":
            words = shlex.split(code)
            assert words[0] == "elastogeo"
            monkeypatch.setattr(sys, "argv", words)
            assert main() == 0, f"{code}\n{capsys.readouterr()}"
        else:
            exec(compile(code, page, "exec"), {"__name__": "__main__"})
        assert capsys.readouterr().out, code


def test_tutorials_use_the_public_face_only():
    """What a page shows is what is promised: `import elastogeo as eg`, and no room behind it."""
    pages = [ROOT / "README.md", *DOCS.glob("*.md")]
    blocks = {page.name: re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL) for page in pages}
    blocks["extending.md"] = []  # teaches the rooms
    lines = [(page, line.strip()) for page, found in blocks.items() for block in found for line in block.splitlines()]
    imports = [(page, line) for page, line in lines if re.match(r"(import|from) elastogeo", line)]
    assert {page for page, _ in imports} >= {"tutorial.md", "drive.md", "static.md", "ball-roller.md"}
    assert {line for _, line in imports} == {"import elastogeo as eg"}
    used = {name for _, line in lines for name in re.findall(r"\beg\.(\w+)", line)}
    assert used <= set(eg.__all__)


def script(name):
    """A script of the folder docs, as a module."""
    spec = importlib.util.spec_from_file_location(name, DOCS / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("page", ["api.md", "extending.md"])
def test_the_pages_made_from_docstrings_are_those_of_the_program(page):
    made = script("make_reference")
    assert (DOCS / page).read_text(encoding="utf-8") == made.PAGES[page](), "run: python docs/make_reference.py"


def test_the_page_of_the_public_face_has_every_name():
    grouped = [name for names in script("make_reference").GROUPS.values() for name in names]
    assert sorted(grouped) == sorted(set(eg.__all__) - {"__version__"})


def test_every_page_is_reached_from_the_index_as_a_plain_file():
    linked = set(re.findall(r"\]\((\w[\w/-]*\.md)\)", (DOCS / "index.md").read_text(encoding="utf-8")))
    pages = {path.name for path in DOCS.glob("*.md")} - {"index.md"}
    assert linked == pages | {"decisions/README.md"}


def test_the_keys_of_the_files_are_those_of_the_program_and_each_of_a_drive_file_is_described():
    make_keys = script("make_keys")
    page = make_keys.reference()
    assert make_keys.PAGE.read_text(encoding="utf-8") == page, "run: python docs/make_keys.py"
    drive = page[page.index("## drive.toml") : page.index("## test.toml")]
    bare = re.findall(r"^\| `(\w+)` \|[^|]*\|  \|$", drive, re.MULTILINE)
    assert set(bare) <= {"axis", "value"}
    assert {"`[[drives]]`", "`held_out`", "`axes`", "`sense`"} <= set(re.findall(r"`[^`]+`", drive))


def test_the_reference_of_the_command_line_is_that_of_the_commands():
    make_cli = script("make_cli")
    assert make_cli.PAGE.read_text(encoding="utf-8") == make_cli.reference(), "run: python docs/make_cli.py"


def test_table_5_9_of_the_real_data_is_what_the_program_gives():
    made = script("make_real_data")
    page = (DOCS / "real-data.md").read_text(encoding="utf-8")
    assert made.with_table(page) == page, "run: python docs/make_real_data.py"
    assert all((DOCS / name).is_file() for name in re.findall(r"\]\(([\w-]+\.svg)\)", page))
