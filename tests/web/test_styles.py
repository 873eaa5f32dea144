"""The style sheets and scripts of the pages: whole, and nothing in them that no page has."""

from __future__ import annotations

import re
from importlib.resources import files
from pathlib import Path

import pytest

WEB = Path(str(files("elastogeo.web")))
SHEETS = sorted(WEB.glob("static/*.css"), key=lambda path: path.name)
SCRIPTS = sorted(set(WEB.glob("static/*.js")) - set(WEB.glob("static/*.min.js")), key=lambda path: path.name)
DRAWN = re.compile(r"[fpt]-|c-")
"""How classes begin that drawings and columns get from the names of what they show."""


def rules_of(sheet: Path) -> str:
    """A style sheet without its comments."""
    return re.sub(r"/\*.*?\*/", "", sheet.read_text(encoding="utf-8"), flags=re.DOTALL)


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda path: path.name)
def test_a_style_sheet_closes_what_it_opens(sheet: Path) -> None:
    depth = 0
    for number, line in enumerate(rules_of(sheet).splitlines(), start=1):
        depth += line.count("{") - line.count("}")
        assert depth >= 0, f"line {number} closes what nothing opened: {line.strip()}"
    assert depth == 0


@pytest.mark.parametrize("sheet", SHEETS, ids=lambda path: path.name)
def test_a_style_sheet_names_no_class_that_no_page_has(sheet: Path) -> None:
    shown = [*WEB.glob("templates/**/*.j2"), *SCRIPTS, *WEB.parent.glob("report/drawing/*.py")]
    text = "\n".join(path.read_text(encoding="utf-8") for path in shown)
    selectors = re.findall(r"([^{};]+)\{", rules_of(sheet))
    named = {name for one in selectors for name in re.findall(r"\.([a-zA-Z][\w-]*)", one)}
    missing = {name for name in named if not DRAWN.match(name) and not re.search(rf"(?<![\w-]){name}(?![\w-])", text)}
    assert not missing


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.name)
def test_a_script_is_strict_and_some_page_has_it(script: Path) -> None:
    code = [line for line in script.read_text(encoding="utf-8").splitlines() if line and not line.startswith("//")]
    assert code[0] == '"use strict";'
    assert any(f'static("{script.name}")' in path.read_text(encoding="utf-8") for path in WEB.glob("templates/**/*.j2"))
