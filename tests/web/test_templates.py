"""A template uses no name that nothing gives it: a page would find out only when it is asked."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from jinja2 import meta

import elastogeo.web
from elastogeo.web.templating import _environment

WEB = Path(elastogeo.web.__file__).parent
TEMPLATES = sorted((WEB / "templates").rglob("*.j2"))


@pytest.fixture(scope="module")
def given() -> set[str]:
    """Every word of the pages' code, and every name that a template sets for those it includes or extends."""
    words = {word for file in WEB.rglob("*.py") for word in re.findall(r"\w+", file.read_text(encoding="utf-8"))}
    texts = [file.read_text(encoding="utf-8") for file in TEMPLATES]
    return words | {name for text in texts for name in re.findall(r"{% (?:set|import \S+ as) (\w+)", text)}


@pytest.mark.parametrize("file", TEMPLATES, ids=lambda file: file.stem)
def test_a_template_uses_what_it_is_given(file: Path, given: set[str]) -> None:
    used = meta.find_undeclared_variables(_environment().parse(file.read_text(encoding="utf-8")))
    assert used - given == set()
