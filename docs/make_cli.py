"""Write the reference of the command line, docs/cli.md, from the help texts of the commands: `python docs/make_cli.py`."""

import os
import subprocess
import sys
from pathlib import Path

from elastogeo.cli.app import commands

PAGE = Path(__file__).with_name("cli.md")
INTRODUCTION = """\
# Command line

Exit codes: 0 done; 1 the data do not support what was asked, the message says why; 2 wrong input or usage, one error on
standard error. `--json` prints one object on standard output and nothing else (see [Files](formats.md)). Colours follow
`NO_COLOR`. `elastogeo --install-completion` sets up completion for your shell.

This page is written from the help texts by `docs/make_cli.py`.
"""


def reference() -> str:
    """The page as it should be."""
    sections = [INTRODUCTION, section()]
    return "\n".join([*sections, *(section(command) for command in (one.__name__ for one in commands()))])


def section(*command: str) -> str:
    """The help text of one command."""
    environment = {**os.environ, "COLUMNS": "100", "TERMINAL_WIDTH": "100", "NO_COLOR": "1"}
    line = [sys.executable, "-m", "elastogeo", *command, "--help"]
    shown = subprocess.run(line, capture_output=True, text=True, check=True, env=environment).stdout
    title = " ".join(["elastogeo", *command])
    text = "\n".join(part.rstrip() for part in shown.strip().splitlines()).replace("python -m elastogeo", "elastogeo")
    return f"## {title}\n\n```text\n{text}\n```\n"


if __name__ == "__main__":
    PAGE.write_text(reference(), encoding="utf-8")
