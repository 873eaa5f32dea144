"""Write the pages that are made from the program itself, api.md and extending.md: `python docs/make_reference.py`."""

from __future__ import annotations

import inspect
import re
import textwrap
from importlib import import_module
from itertools import groupby
from pathlib import Path

import elastogeo as eg

FOLDER = Path(__file__).parent

API = """\
# The public face

`import elastogeo as eg`: what is listed here is what the tutorials use, and nothing else is promised before 1.0. Numbers
are in mm, N, rad, s, and N mm for moments, unless a name says otherwise; a path may be a `str` or a `Path`.

This page is written from the docstrings by `docs/make_reference.py`.
"""

GROUPS = {
    "Read and make": (
        "read_test", "read_campaign", "new_test", "simulate", "read_machine", "machines", "read_drives", "read_log",
        "read_run", "inspect_file", "example_test",
    ),
    "Ask": (
        "identify", "explain", "diagnose", "what_if", "compare", "map_stiffness", "evaluate_static", "evaluate_positioning",
        "identify_drives", "calibrate",
    ),
    "Before and after a test": (
        "plan", "write_tests", "map_compliance", "write_program", "read_program", "compensate", "compensate_path",
        "predict", "read_path", "read_cut", "read_design",
    ),
    "Over the years": ("History",),
    "What comes back": ("Result", "Estimate", "MachineTest", "Campaign", "Machine"),
    "What may go wrong": ("ElastogeoError", "InputError", "UnsupportedError"),
}  # fmt: skip

EXTENDING = """\
# Extending elastogeo

A format, an instrument, an error source is one file. It registers itself, nothing else changes, and the contract tests of
its kind run on it at once. The recipes below are the docstrings of the contracts, so they are never older than the program;
this page is written by `docs/make_reference.py`. Unlike every other page it names rooms (`elastogeo.formats`, ...), since
what you write lives in one.
"""

RECIPES = {
    "A format of run files": "elastogeo.formats.run_files",
    "A format of logs": "elastogeo.formats.log_files",
    "Compensation files of a control": "elastogeo.formats.compensation_files",
    "A language of programs": "elastogeo.formats.program_files",
    "An instrument": "elastogeo.observe.instruments",
    "An error source": "elastogeo.sources.families",
    "A test that can be planned": "elastogeo.planning.offers.proposal",
    "What is watched of a result": "elastogeo.changes.indicators.register",
    "A result that shows itself": "elastogeo.report.view",
    "A channel for alarms": "elastogeo.history.alarms.channels.channel",
    "A command, a group of commands": "elastogeo.cli.doors",
    "A page": "elastogeo.web.pages",
}


def api() -> str:
    """The page of the public face."""
    sections = [API]
    for title, names in GROUPS.items():
        sections.append(f"## {title}\n")
        sections.extend(_entry(name) for name in names)
    return "\n".join(sections)


def extending() -> str:
    """The page of the recipes."""
    sections = [EXTENDING]
    for title, module in RECIPES.items():
        place = module.removeprefix("elastogeo.").replace(".", "/")
        sections.append(f"## {title}\n\n`src/elastogeo/{place}.py`:\n\n{_fenced(inspect.getdoc(import_module(module)))}\n")
    return "\n".join(sections)


def _entry(name: str) -> str:
    found = getattr(eg, name)
    heading = f"### eg.{name}\n"
    if isinstance(found, type) and issubclass(found, Exception):
        return f"{heading}\n{inspect.getdoc(found)}\n"
    text = inspect.getdoc(found)
    if isinstance(found, type):
        members = [f".{member}: {_first_line(value)}" for member, value in vars(found).items() if _is_shown(member, value)]
        if members:
            text += "\n\nMembers\n-------\n" + "\n".join(members)
    return f"{heading}\n```text\n{name}{_signature(found)}\n\n{text}\n```\n"


def _signature(found: object) -> str:
    if isinstance(found, type) and "__init__" not in vars(found):
        return ""
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(inspect.signature(found)))
    text = re.sub(r"<function (\w+) at 0x[0-9a-f]+>", r"\1", text)  # a default that is a function, without its address
    return textwrap.fill(text, 110, subsequent_indent="    ") if len(text) > 110 else text


def _is_shown(member: str, value: object) -> bool:
    return (
        not member.startswith("_")
        and bool(getattr(value, "__doc__", None))
        and (callable(value) or isinstance(value, property))
    )


def _first_line(value: object) -> str:
    return inspect.getdoc(value).splitlines()[0]


def _fenced(text: str) -> str:
    """A docstring as Markdown: what is indented is code, the colons before it are one."""
    lines: list[str] = []
    for code, block in groupby(
        text.replace("::\n", ":\n").splitlines(), key=lambda line: line.startswith("    ") or not line
    ):
        found = list(block)
        if code and any(found):
            code_lines = textwrap.dedent("\n".join(found)).strip("\n").splitlines()
            language = "jinja" if code_lines[0].startswith("{") else "python"
            found = ["", f"```{language}", *code_lines, "```", ""]
        lines.extend(found)
    return "\n".join(lines)


PAGES = {"api.md": api, "extending.md": extending}

if __name__ == "__main__":
    for page, write in PAGES.items():
        (FOLDER / page).write_text(write(), encoding="utf-8")
